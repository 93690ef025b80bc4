#include "core/generators/lsystem/text.h"

#include <algorithm>
#include <charconv>

namespace seedmesh::lsystem {
namespace {

class PlainText {
 public:
  PlainText(const Grammar& grammar, std::uint32_t steps, std::size_t most, const Job& job)
      : grammar_(grammar),
        most_(most),
        job_(job),
        text_(job),
        known_((std::size_t{steps} + 1) * grammar.kinds.size()) {}

  Array<char> write(std::uint32_t steps) {
    for (const Template& each : grammar_.successor(grammar_.axiom)) write(each.kind, steps);
    return std::move(text_);
  }

 private:
  struct Piece {
    std::size_t first = 0, length = none;
  };
  static constexpr std::size_t none = ~std::size_t{0};

  /// Appends the derivation of `kind` over `steps` steps. The recursion depth is `steps`.
  void write(KindId kind, std::uint32_t steps) {
    if (full_) return;
    if (steps == 0 || !grammar_.productions.rewrites(kind)) return symbol(kind);
    Piece& piece = known_[std::size_t{steps} * grammar_.kinds.size() + kind];
    if (piece.length != none && text_.size() + piece.length <= most_) {
      char* to = text_.extend(piece.length);
      std::memcpy(to, text_.data() + piece.first, piece.length);
      return;
    }
    job_.check();
    const std::size_t first = text_.size();
    const Range range = grammar_.productions.of_kind[kind];
    for (const Template& each : grammar_.successor(grammar_.productions.productions[range.first].successor)) {
      write(each.kind, steps - 1);
    }
    if (!full_) piece = {first, text_.size() - first};
  }

  void symbol(KindId kind) {
    const std::string& symbol = grammar_.kinds[kind].symbol;
    if (text_.size() + symbol.size() > most_) {
      full_ = true;
    } else {
      text_.append({symbol.data(), symbol.size()});
    }
  }

  const Grammar& grammar_;
  std::size_t most_;
  const Job& job_;
  Array<char> text_;
  std::vector<Piece> known_;
  bool full_ = false;
};

}  // namespace

void TextWriter::module(KindId kind, const double* parameters) {
  ++counts_[kind];
  if (truncated) return;
  const Kind& written = grammar_.kinds[kind];
  const std::size_t before = text.size();
  text += written.symbol;
  for (std::uint32_t i = 0; i < written.arity; ++i) {  // all twelve numbers of a frame
    char digits[32];
    const auto end =
        std::to_chars(digits, digits + sizeof digits, parameters[i], std::chars_format::general, 6);
    text += i == 0 ? '(' : ',';
    text.append(digits, end.ptr);
  }
  if (written.arity > 0) text += ')';
  if (text.size() > most_) {
    text.resize(before);
    truncated = true;
  }
}

bool is_plain(const Grammar& grammar) {
  const Rules& rules = grammar.productions;
  return grammar.is_context_free() && grammar.widest == 0 && !grammar.cuts && !rules.random &&
         std::none_of(rules.productions.begin(), rules.productions.end(), [](const Production& each) {
           return each.conditional || each.weighted || each.has_context();
         });
}

Array<char> plain_text(const Grammar& grammar, std::uint32_t steps, std::size_t most, const Job& job) {
  return PlainText(grammar, steps, most, job).write(steps);
}

}  // namespace seedmesh::lsystem
