#include "core/import/cpfg_preprocessor.h"

#include "core/base/rng.h"
#include "core/import/cpfg_text.h"
#include "core/import/traced_text.h"
#include "core/lang/expression.h"

namespace seedmesh {
namespace {

/// One choice that is open.
struct Choice {
  std::size_t at = 0;
  bool was_active = true;  ///< outside of it
  bool is_active = true;   ///< the present part
  bool is_taken = false;   ///< a part of it was active
};

class Preprocessor {
 public:
  Preprocessor(ForeignText& source, std::string& text, CpfgMacros& macros)
      : source_(source), text_(text), macros_(macros) {}

  void run() {
    for (const Line& each : lines_of(text_)) {
      const Line line = trimmed(text_, each);
      if (is_cpfg_directive(text_, line)) {
        directive(line);
      } else if (!is_active()) {
        for (std::size_t i = each.from; i < each.to; ++i) text_[i] = ' ';
      }
    }
    for (const Choice& each : open_) source_.report(each.at, "found a choice without its `#endif`");
  }

 private:
  bool is_active() const { return open_.empty() || open_.back().is_active; }

  void directive(Line line) {
    const std::size_t from = trimmed(text_, {line.from + 1, line.to}).from;
    std::size_t end = from;
    while (end < line.to && is_letter(text_[end])) ++end;
    const std::string name = text_.substr(from, end - from);
    const Line rest = trimmed(text_, {end, line.to});
    if (name == "if" || name == "ifdef" || name == "ifndef") {
      const bool holds = is_active() && (name == "if" ? value(rest) : is_defined(rest) == (name == "ifdef"));
      open_.push_back({line.from, is_active(), holds, holds});
    } else if (name == "elif" || name == "else" || name == "endif") {
      if (open_.empty()) return source_.report(line.from, "found `#" + name + "` without an `#if` before it");
      Choice& choice = open_.back();
      if (name == "endif") return open_.pop_back();
      choice.is_active = choice.was_active && !choice.is_taken && (name == "else" || value(rest));
      choice.is_taken = choice.is_taken || choice.is_active;
    } else if (!is_active() || name == "line" || name == "pragma") {
      return;
    } else if (name == "include") {
      source_.report(line.from, "the file of this `#include` is not given; send it as one of `files`",
                     IssueKind::not_available);
    } else if (name == "undef") {
      macros_.undefine(text_.substr(rest.from, rest.to - rest.from));
    } else {
      macros_.define(text_, line);
    }
  }

  bool is_defined(Line name) const { return macros_.knows(text_.substr(name.from, name.to - name.from)); }

  /// Whether the condition of #if is true. Unknown names are 0.
  bool value(Line line) {
    TracedText condition;
    for (std::size_t at = line.from; at < line.to;) {
      std::size_t end = at;
      while (end < line.to && is_name_part(text_[end])) ++end;
      if (text_.compare(at, end - at, "defined") != 0 || end == at) {
        const std::size_t next = std::max(end, at + 1);
        condition.copy(text_, at, next);
        at = next;
        continue;
      }
      std::size_t from = end;
      while (from < line.to && !is_name_part(text_[from])) ++from;
      std::size_t to = from;
      while (to < line.to && is_name_part(text_[to])) ++to;
      condition.write(is_defined({from, to}) ? "1" : "0", at);
      at = to;
      while (at < line.to && (is_blank(text_[at]) || text_[at] == ')')) ++at;
    }
    const TracedText expanded = macros_.expanded(condition);
    std::vector<lang::TextError> errors;
    const std::vector<lang::Token> tokens = lang::tokenize(expanded.text(), 0, expanded.size(), errors);
    lang::Names names;
    for (const lang::Token& token : tokens) {
      if (token.kind == lang::TokenKind::name && names.find(token.text) == nullptr)
        names.bind_constant(std::string(token.text), 0);
    }
    lang::Program program;
    std::size_t at = 0;
    const lang::Expression expression = program.parse(tokens, at, names, errors);
    if (!errors.empty() || tokens[at].kind != lang::TokenKind::end) {
      source_.report(line.from, "expected a condition of numbers and macros, such as `#if LEAVES == 1`");
      return false;
    }
    Rng unused(0);
    return program.evaluate(expression, nullptr, unused) != 0;
  }

  ForeignText& source_;
  std::string& text_;
  CpfgMacros& macros_;
  std::vector<Choice> open_;
};

}  // namespace

void preprocess_cpfg(ForeignText& source, std::string& text, CpfgMacros& macros) {
  Preprocessor(source, text, macros).run();
}

}  // namespace seedmesh
