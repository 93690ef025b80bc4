/// Precedence climbing (Richards, "The structure and organisation of a compiler", 1979). It emits register code
/// directly, without a syntax tree.
#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "core/lang/emitter.h"
#include "core/lang/expression.h"
#include "core/lang/parse_messages.h"
#include "core/lang/reader.h"

namespace seedmesh::lang {
namespace {

enum class Rank { either, both, comparison, sum, product, power };  ///< the precedence of an operator

Rank above(Rank rank) { return static_cast<Rank>(static_cast<int>(rank) + 1); }

struct Infix {
  std::string_view text;
  Rank rank;
  Operation operation;
};
constexpr std::array<Infix, 17> infixes = {{{"||", Rank::either, Operation::stop_if_true},
                                            {"|", Rank::either, Operation::stop_if_true},
                                            {"&&", Rank::both, Operation::stop_if_false},
                                            {"&", Rank::both, Operation::stop_if_false},
                                            {"<", Rank::comparison, Operation::less},
                                            {"<=", Rank::comparison, Operation::less_equal},
                                            {">", Rank::comparison, Operation::greater},
                                            {">=", Rank::comparison, Operation::greater_equal},
                                            {"==", Rank::comparison, Operation::equal},
                                            {"=", Rank::comparison, Operation::equal},
                                            {"!=", Rank::comparison, Operation::not_equal},
                                            {"+", Rank::sum, Operation::add},
                                            {"-", Rank::sum, Operation::subtract},
                                            {"*", Rank::product, Operation::multiply},
                                            {"/", Rank::product, Operation::divide},
                                            {"%", Rank::product, Operation::modulo},
                                            {"^", Rank::power, Operation::power}}};
constexpr Infix modulo_word = {"mod", Rank::product, Operation::modulo};  ///< an operator only after a value
constexpr Infix star_star = {"**", Rank::power, Operation::power};        ///< two tokens

bool may_begin_operand(const Token& token) {
  if (token.kind == TokenKind::number || token.kind == TokenKind::name) return true;
  if (token.kind == TokenKind::string) return token.number > 0;
  return is_symbol(token, "(") || is_symbol(token, "-") || is_symbol(token, "+") || is_symbol(token, "!");
}

}  // namespace

class Program::Parser {
 public:
  Parser(Program& program, Reader& reader, const Names& names)
      : program_(program), emitter_(program), reader_(&reader), names_(names) {}

  Expression parse() {
    const Operand result = climb(Rank::either);
    check_length();
    if (!reader_->has_errors()) return emitter_.expression_of(result);
    reader_->skip_expression();
    emitter_.forget_all();
    return Emitter::constant_expression({});
  }

 private:
  using Operand = Emitter::Operand;

  /// The arguments of a function that is being expanded.
  struct Scope {
    const Names::Defined* function;
    const Scope* outer;
    std::array<Operand, Names::most_parameters> arguments;

    const Operand* find(std::string_view name) const {
      const auto& names = function->parameters;
      const auto at = std::find(names.begin(), names.end(), name);
      return at == names.end() ? nullptr : &arguments[static_cast<std::size_t>(at - names.begin())];
    }
  };

  static Operand constant(double value) { return Emitter::constant(value); }

  void check_length() {
    if (!emitter_.is_too_long() || !reader_->is_sound()) return;
    reader_->abandon(reader_->token(),
                     "more than " + std::to_string(max_operations) + " operations in one expression");
  }

  /// The operator at this token, or null. `%` is an operator only if an operand follows.
  const Infix* infix_here() const {
    const Token &now = reader_->token(), &next = reader_->token(1);
    if (now.kind == TokenKind::name && now.text == "mod") return &modulo_word;
    if (now.kind != TokenKind::symbol) return nullptr;
    if (now.text == "*" && is_symbol(next, "*") && next.offset == now.offset + 1) return &star_star;
    if (now.text == "%" && !may_begin_operand(next)) return nullptr;
    const auto* const found = std::find_if(infixes.begin(), infixes.end(),
                                           [&](const Infix& infix) { return infix.text == now.text; });
    return found == infixes.end() ? nullptr : found;
  }

  /// Operands joined by operators that bind at least as tightly as `lowest`.
  Operand climb(Rank lowest) {
    const std::uint32_t mark = emitter_.mark();
    Operand left = unary();
    bool compared = false;
    while (reader_->is_sound()) {
      const Infix* const infix = infix_here();
      if (infix == nullptr || infix->rank < lowest) break;
      if (compared && infix->rank == Rank::comparison) {
        reader_->report_expected("`&&` or the end of the comparison (comparisons do not chain)");
        break;
      }
      compared = infix->rank == Rank::comparison;
      reader_->advance(infix == &star_star ? 2 : 1);
      left = infix->rank <= Rank::both ? logic(*infix, left, mark) : arithmetic(*infix, left, mark);
      check_length();
    }
    return left;
  }

  Operand arithmetic(const Infix& infix, const Operand& left, std::uint32_t mark) {
    Operand right;
    if (infix.rank == Rank::power) {  // right associative: one level of depth for each operator
      if (!reader_->enter()) return constant(0);
      right = climb(Rank::power);
      reader_->leave();
    } else {
      right = climb(above(infix.rank));
    }
    return emitter_.combine(infix.operation, left, right, mark);
  }

  /// `left && right` and `left || right`. If a constant on the left decides, the right side is only checked.
  Operand logic(const Infix& infix, const Operand& left, std::uint32_t mark) {
    if (!left.is_constant()) {
      const Emitter::Position begun = emitter_.begin_logic(infix.operation, left, mark);
      return emitter_.end_logic(begun, climb(above(infix.rank)), mark);
    }
    const bool stopping = infix.operation == Operation::stop_if_true;
    const bool is_decided = (left.value != 0) == stopping;
    const Emitter::Position before = emitter_.position();
    const Operand right = climb(above(infix.rank));
    if (!is_decided) return emitter_.truth(right, mark);
    emitter_.forget_after(before);
    emitter_.free_from(mark);
    return constant(stopping ? 1 : 0);
  }

  Operand unary() {
    const std::string_view sign = reader_->token().text;
    const bool is_sign = reader_->is_here("-") || reader_->is_here("+") || reader_->is_here("!");
    if (!is_sign) return primary();
    if (!reader_->enter()) return constant(0);
    const std::uint32_t mark = emitter_.mark();
    reader_->advance();
    const Operand operand = climb(Rank::power);
    reader_->leave();
    if (sign == "+") return operand;
    if (sign == "-") return emitter_.combine(Operation::multiply, operand, constant(-1), mark);
    return emitter_.combine(Operation::equal, operand, constant(0), mark);
  }

  Operand primary() {
    const Token& here = reader_->token();
    if (here.kind == TokenKind::number) {
      reader_->advance();
      return constant(here.number);
    }
    if (here.kind == TokenKind::string && here.number > 0) {
      reader_->advance();
      return Emitter::constant({0, static_cast<std::uint32_t>(here.number)});
    }
    if (here.kind == TokenKind::name) return is_symbol(reader_->token(1), "(") ? call() : name();
    if (reader_->is_here("(")) return bracket();
    reader_->report_expected(reader_->expected_value());
    return constant(0);
  }

  Operand bracket() {
    if (!reader_->enter()) return constant(0);
    reader_->advance();
    const std::uint32_t mark = emitter_.mark();
    const Operand inside = climb(Rank::either);
    if (reader_->is_sound() && !reader_->is_here(")")) reader_->report_expected("an operator or `)`");
    reader_->recover(Reader::Until::bracket);
    if (reader_->is_sound()) reader_->advance();
    if (inside.is_constant()) emitter_.free_from(mark);  // after an error, registers may still be in use
    reader_->leave();
    return inside;
  }

  /// A name, or names joined by points without spaces, which are one name.
  Operand name() {
    const Token start = reader_->token();
    std::size_t length = start.length;
    while (is_symbol(reader_->token(1), ".") && reader_->token(2).kind == TokenKind::name &&
           reader_->token(1).offset == start.offset + length &&
           reader_->token(2).offset == start.offset + length + 1) {
      length += 1 + reader_->token(2).length;
      reader_->advance(2);
    }
    reader_->advance();
    const std::string_view whole(start.text.data(), length);  // tokens of names are parts of one text
    if (scope_ != nullptr) {
      if (const Operand* const argument = scope_->find(whole)) return *argument;
    }
    const Names::Binding* binding = names_.find(whole);
    const bool is_array = binding != nullptr && binding->count > 0;  // functions see them, too
    if (scope_ != nullptr && !is_array) binding = names_.find_constant(whole);
    if (binding == nullptr) {
      reader_->report(start, unknown_name(names_, whole), IssueKind::unknown_name);
      return constant(0);
    }
    if (binding->count > 0) return element(start, *binding);
    return binding->is_constant ? constant(binding->value) : Emitter::slot(binding->slot);
  }

  /// `[ index ]` behind the name of an array.
  Operand element(const Token& array, const Names::Binding& binding) {
    if (!reader_->is_here("[")) {
      reader_->report(array, in_quotes(array) + " is an array: write " +
                                 in_quotes(std::string(array.text) + "[0]") + " for its first element");
      return constant(0);
    }
    if (!reader_->enter()) return constant(0);
    reader_->advance();
    const std::uint32_t mark = emitter_.mark();
    const Operand index = climb(Rank::either);
    if (reader_->is_sound() && !reader_->is_here("]")) {
      reader_->abandon(reader_->token(),
                       "found " + in_quotes(reader_->token()) + ", expected an operator or `]`",
                       IssueKind::syntax);
    }
    if (!reader_->is_sound()) return constant(0);
    reader_->advance();
    reader_->leave();
    return emitter_.element(index, binding.slot, binding.count, mark);
  }

  Operand call() {
    const Token& called = reader_->token();
    const std::span<const Function> rows = rows_of(called.text);
    if (const Names::Defined* const own = rows.empty() ? names_.find_function(called.text) : nullptr) {
      return call_defined(called, *own);
    }
    if (!reader_->enter()) return constant(0);
    reader_->advance(2);
    const std::uint32_t mark = emitter_.mark();
    Emitter::Operands arguments;
    std::size_t most = 0;
    for (const Function& row : rows) most = std::max(most, static_cast<std::size_t>(row.arity));
    const std::optional<std::size_t> count = read_arguments({arguments.data(), most});
    reader_->leave();
    emitter_.free_from(mark);
    if (!count) return constant(0);

    const auto row = std::find_if(rows.begin(), rows.end(), [&](const Function& each) {
      return static_cast<std::size_t>(each.arity) == *count;
    });
    if (row != rows.end()) return emitter_.call(*row, arguments, mark);
    if (rows.empty()) {
      reader_->report(called, unknown_function(names_, called.text), IssueKind::unknown_name);
    } else {
      reader_->report(called, wrong_number_of_arguments(rows, *count), IssueKind::out_of_range);
    }
    return constant(0);
  }

  /// Expands a call of a user-defined function inline. Takes two levels of depth, whose registers hold the arguments.
  Operand call_defined(const Token& called, const Names::Defined& own) {
    for (const Scope* each = scope_; each != nullptr; each = each->outer) {
      if (each->function != &own) continue;
      reader_->abandon(called, in_quotes(called) + " calls itself without end");
      return constant(0);
    }
    if (++expanded_ > max_operations) {  // folded constants emit no code that could be counted
      reader_->abandon(called, "more than " + std::to_string(max_operations) + " calls expanded");
      return constant(0);
    }
    program_.expanded_ += own.body.size();
    if (program_.expanded_ > max_expanded) {
      reader_->abandon(called,
                       "the expanded functions have more than " + std::to_string(max_expanded) + " tokens");
      return constant(0);
    }
    if (!reader_->enter()) return constant(0);
    const bool deep_enough = reader_->enter();
    if (!deep_enough) return constant(0);
    reader_->advance(2);
    const std::uint32_t mark = emitter_.mark();
    Scope scope{&own, scope_, {}};
    const std::size_t arity = own.parameters.size();
    const std::optional<std::size_t> count = read_arguments({scope.arguments.data(), arity});
    Operand result = constant(0);
    if (count && *count != arity) {
      reader_->report(called, wrong_number_of_arguments(called.text, own, *count), IssueKind::out_of_range);
    } else if (count && own.is_valid) {
      emitter_.free_from(mark + static_cast<std::uint32_t>(arity));
      result = expand(called, own, scope);
    }
    reader_->leave();
    reader_->leave();
    return emitter_.settle(result, mark);
  }

  Operand expand(const Token& called, const Names::Defined& own, const Scope& scope) {
    Reader inner(own.body, 0, reader_->remaining_depth());
    Reader* const outer = std::exchange(reader_, &inner);
    const Scope* const around = std::exchange(scope_, &scope);
    const Operand result = climb(Rank::either);
    if (inner.is_sound() && inner.token().kind != TokenKind::end)
      inner.report_expected("the end of the function");
    reader_ = outer;
    scope_ = around;
    if (!inner.has_errors()) return result;
    const TextError first = std::move(inner.take_errors()[0]);
    reader_->abandon(called, in_quotes(called) + ": " + first.message, first.kind);
    return constant(0);
  }

  /// Reads the arguments and the closing bracket. Returns the number of arguments, or nullopt after an error. The n-th
  /// argument owns the n-th register from mark() on. Arguments beyond the greatest arity are only checked.
  std::optional<std::size_t> read_arguments(std::span<Operand> arguments) {
    const std::size_t most = arguments.size();
    const std::size_t last = std::max<std::size_t>(most, max_arity) - 1;
    const std::uint32_t mark = emitter_.mark();
    std::size_t count = 0;
    bool is_whole = true;
    for (bool more = !reader_->is_here(")"); more; ++count) {
      const Emitter::Position before = emitter_.position();
      emitter_.free_from(mark + static_cast<std::uint32_t>(std::min(count, last)));
      const Operand argument = climb(Rank::either);
      const bool ends = reader_->is_here(",") || reader_->is_here(")");
      if (reader_->is_sound() && !ends) reader_->report_expected("an operator, `,` or `)`");
      is_whole = is_whole && reader_->is_sound();
      reader_->recover(Reader::Until::bracket_or_comma);
      if (!reader_->is_sound()) return std::nullopt;
      if (count < most) {
        arguments[count] = argument;
      } else {
        emitter_.forget_after(before);
      }
      more = reader_->is_here(",");
      if (more) reader_->advance();
    }
    reader_->advance();
    return is_whole ? std::optional(count) : std::nullopt;
  }

  Program& program_;
  Emitter emitter_;
  Reader* reader_;
  const Names& names_;
  std::uint32_t expanded_ = 0;
  const Scope* scope_ = nullptr;  ///< of the function that is being expanded
};

Expression Program::parse(std::span<const Token> tokens, std::size_t& at, const Names& names,
                          std::vector<TextError>& errors, std::uint32_t max_depth) {
  Reader reader(tokens, at, std::min(max_depth, greatest_depth));
  const Expression expression = Parser(*this, reader, names).parse();
  at = reader.at();
  for (TextError& error : reader.take_errors()) errors.push_back(std::move(error));
  return expression;
}

}  // namespace seedmesh::lang
