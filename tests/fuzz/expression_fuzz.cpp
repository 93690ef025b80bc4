/// Any bytes as a list of expressions: lexer, parser and evaluation, twice, with what must hold of every
/// text.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "core/lang/expression.h"

namespace {

using namespace seedmesh;

// Not assert: it must hold in release too.
void require(bool holds) {
  if (!holds) std::abort();
}

std::uint64_t bits(double value) {
  if (value != value) return 0;  // one NaN is as good as another
  std::uint64_t word = 0;
  std::memcpy(&word, &value, sizeof word);
  return word;
}

lang::Names some_names() {
  lang::Names names;
  names.bind_slot("x", 0);
  names.bind_slot("Scope.sx", 1);
  names.bind_slot("l", 2);
  names.bind_constant("r", 0.9);
  names.bind_constant("zero", 0);
  return names;
}

void check_faults(const std::vector<lang::TextError>& faults, std::size_t before, std::size_t size) {
  require(faults.size() - before <= lang::max_errors);
  for (std::size_t i = before; i < faults.size(); ++i) {
    require(faults[i].offset <= size && !faults[i].message.empty());
    require(i == before || faults[i - 1].offset <= faults[i].offset);
  }
}

void check_value(const lang::Program& program, const lang::Expression& expression) {
  constexpr std::array slots = {3.0, -0.5, 1e9};
  Rng once = Rng::of_seed(1), again = once;
  const double value = program.evaluate(expression, slots.data(), once);
  require(bits(value) == bits(program.evaluate(expression, slots.data(), again)));
  const std::uint64_t after = once.next();
  require(after == again.next());
  Rng fresh = Rng::of_seed(1);
  require(program.draws(expression) || after == fresh.next());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  static const lang::Names names = some_names();
  std::vector<lang::TextError> faults;
  const std::vector<lang::Token> tokens = lang::tokenize(text, 0, size, faults);
  check_faults(faults, 0, size);
  require(!tokens.empty() && tokens.back().kind == lang::TokenKind::end && tokens.back().offset == size);
  for (std::size_t i = 1; i < tokens.size(); ++i)
    require(tokens[i - 1].offset + tokens[i - 1].length <= tokens[i].offset);

  lang::Program program;
  for (std::size_t at = 0; at < tokens.size(); ++at) {
    const std::size_t start = at, before = faults.size();
    const lang::Expression expression = program.parse(tokens, at, names, faults);
    require(at >= start && at < tokens.size());
    check_faults(faults, before, size);
    require(faults.size() == before || (expression.is_constant && expression.value == 0));
    check_value(program, expression);
    faults.clear();
  }
  return 0;
}
