/// Precedence climbing (Richards, "The structure and organisation of a compiler", 1979) straight into
/// register code, without a tree between.
#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "core/lang/emitter.h"
#include "core/lang/expression.h"
#include "core/lang/reader.h"

namespace seedmesh::lang {
namespace {

/// How tightly an operator binds.
enum class Rank { either, both, comparison, sum, product, power };

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
/// Two tokens, since `**` may stand for two symbols elsewhere.
/// A word can only be an operator where a value stands before it.
constexpr Infix modulo_word = {"mod", Rank::product, Operation::modulo};
constexpr Infix star_star = {"**", Rank::power, Operation::power};

bool may_begin_operand(const Token& token) {
  if (token.kind == TokenKind::number || token.kind == TokenKind::name) return true;
  return is_symbol(token, "(") || is_symbol(token, "-") || is_symbol(token, "+") || is_symbol(token, "!");
}

std::span<const Function> rows_of(std::string_view name) {
  const std::span<const Function> all = functions();
  std::size_t first = 0;
  while (first < all.size() && all[first].name != name) ++first;
  std::size_t count = 0;
  while (first + count < all.size() && all[first + count].name == name) ++count;
  return all.subspan(first, count);
}

std::string_view nearest_function(const Names& names, std::string_view name) {
  if (!names.may_hint()) return {};
  std::string_view best;
  std::uint32_t least = hint_distance(name) + 1;
  for (const Function& row : functions()) {
    const std::uint32_t distance = name_distance(name, row.name);
    if (distance >= least) continue;
    least = distance;
    best = row.name;
  }
  return best;
}

std::string did_you_mean(std::string_view hint) {
  return hint.empty() ? "" : "; did you mean " + in_quotes(hint) + "?";
}

std::string wrong_number_of_arguments(std::span<const Function> rows, std::size_t found) {
  std::string counts;
  for (const Function& row : rows) counts += (counts.empty() ? "" : " or ") + std::to_string(row.arity);
  const bool is_one = rows.size() == 1 && rows[0].arity == 1;
  return in_quotes(rows[0].name) + " takes " + counts + (is_one ? " argument (" : " arguments (") +
         std::string(rows.back().arguments) + "), found " + std::to_string(found);
}

std::string unknown_name(const Names& names, std::string_view name) {
  const std::span<const Function> rows = rows_of(name);
  if (rows.empty()) return "unknown name " + in_quotes(name) + did_you_mean(names.nearest(name));
  const std::string call = std::string(name) + "(" + std::string(rows.back().arguments) + ")";
  return in_quotes(name) + " is a function: write " + in_quotes(call);
}

std::string wrong_number_of_arguments(std::string_view name, const Names::Defined& function,
                                      std::size_t found) {
  std::string parameters;
  for (const std::string& each : function.parameters) parameters += (parameters.empty() ? "" : ", ") + each;
  const std::size_t count = function.parameters.size();
  return in_quotes(name) + " takes " + std::to_string(count) + (count == 1 ? " argument (" : " arguments (") +
         parameters + "), found " + std::to_string(found);
}

std::string unknown_function(const Names& names, std::string_view name) {
  if (names.find(name) != nullptr) {
    return in_quotes(name) + " is a value and no function: write `*` between it and the bracket";
  }
  return "unknown function " + in_quotes(name) + did_you_mean(nearest_function(names, name));
}

}  // namespace

class Program::Parser {
 public:
  Parser(Program& program, Reader& reader, const Names& names)
      : program_(program), emitter_(program), reader_(&reader), names_(names) {}

  Expression parse() {
    const Operand result = climb(Rank::either);
    check_length();
    if (!reader_->has_faults()) return emitter_.expression_of(result);
    reader_->skip_to_end_of_damage();
    emitter_.forget_all();
    return Emitter::constant_expression(0);
  }

 private:
  using Operand = Emitter::Operand;

  /// The parameters of a function that is written out.
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
    reader_->give_up(reader_->token(),
                     "more than " + std::to_string(max_operations) + " operations in one expression");
  }

  /// The operator that follows, or null; `%` is none where no operand follows it.
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

  /// A run of operands joined by operators that bind at least as tightly as `lowest`.
  Operand climb(Rank lowest) {
    const std::uint32_t mark = emitter_.mark();
    Operand left = unary();
    bool compared = false;
    while (reader_->is_sound()) {
      const Infix* const infix = infix_here();
      if (infix == nullptr || infix->rank < lowest) break;
      if (compared && infix->rank == Rank::comparison) {
        reader_->break_off("`&&` or the end of the comparison (comparisons do not chain)");
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
    if (infix.rank == Rank::power) {  // from right to left, so as deep as there are operators
      if (!reader_->enter()) return constant(0);
      right = climb(Rank::power);
      reader_->leave();
    } else {
      right = climb(above(infix.rank));
    }
    return emitter_.combine(infix.operation, left, right, mark);
  }

  /// `left && right` and `left || right`; where `left` decides at once, the other side is read for faults
  /// only.
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
    if (here.kind == TokenKind::name) return is_symbol(reader_->token(1), "(") ? call() : name();
    if (reader_->is_here("(")) return bracket();
    reader_->break_off(reader_->place_for_message());
    return constant(0);
  }

  Operand bracket() {
    if (!reader_->enter()) return constant(0);
    reader_->advance();
    const std::uint32_t mark = emitter_.mark();
    const Operand inside = climb(Rank::either);
    if (reader_->is_sound() && !reader_->is_here(")")) reader_->break_off("an operator or `)`");
    reader_->recover(Reader::Until::bracket);
    if (reader_->is_sound()) reader_->advance();
    if (inside.is_constant()) emitter_.free_from(mark);  // a fault inside may have left registers behind
    reader_->leave();
    return inside;
  }

  /// Names joined by points without space are one name.
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
    const std::string_view whole(start.text.data(), length);  // tokens of names lie in one text
    if (scope_ != nullptr) {
      if (const Operand* const argument = scope_->find(whole)) return *argument;
    }
    const Names::Binding* const binding = scope_ ? names_.find_constant(whole) : names_.find(whole);
    if (binding == nullptr) {
      reader_->fault(start, unknown_name(names_, whole));
      return constant(0);
    }
    return binding->is_constant ? constant(binding->value) : Emitter::slot(binding->slot);
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
    reader_->fault(called, rows.empty() ? unknown_function(names_, called.text)
                                        : wrong_number_of_arguments(rows, *count));
    return constant(0);
  }

  /// A function of the user's, written out with its arguments in the place of its parameters. Takes two
  /// levels of depth, whose registers hold the arguments.
  Operand call_defined(const Token& called, const Names::Defined& own) {
    for (const Scope* each = scope_; each != nullptr; each = each->outer) {
      if (each->function != &own) continue;
      reader_->give_up(called, in_quotes(called) + " calls itself, which has no end");
      return constant(0);
    }
    if (++written_out_ > max_operations) {  // constants fold, so that no code would tell
      reader_->give_up(called, "more than " + std::to_string(max_operations) + " calls written out");
      return constant(0);
    }
    program_.written_out_ += own.body.size();
    if (program_.written_out_ > max_written_out) {
      reader_->give_up(called, "the functions come to more than " + std::to_string(max_written_out) +
                                   " words and signs where they are written out");
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
      reader_->fault(called, wrong_number_of_arguments(called.text, own, *count));
    } else if (count && own.is_sound) {
      emitter_.free_from(mark + static_cast<std::uint32_t>(arity));
      result = write_out(called, own, scope);
    }
    reader_->leave();
    reader_->leave();
    return emitter_.settle(result, mark);
  }

  Operand write_out(const Token& called, const Names::Defined& own, const Scope& scope) {
    Reader inner(own.body, 0, reader_->room());
    Reader* const outer = std::exchange(reader_, &inner);
    const Scope* const around = std::exchange(scope_, &scope);
    const Operand result = climb(Rank::either);
    if (inner.is_sound() && inner.token().kind != TokenKind::end) inner.break_off("the end of the function");
    reader_ = outer;
    scope_ = around;
    if (!inner.has_faults()) return result;
    reader_->give_up(called, in_quotes(called) + ": " + inner.take_faults()[0].message);
    return constant(0);
  }

  /// The arguments up to and with the closing bracket; returns how many there are, or nothing after damage.
  /// The n-th has the n-th register from here on to itself. Those that no function of the name takes are read
  /// for faults only.
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
      if (reader_->is_sound() && !ends) reader_->break_off("an operator, `,` or `)`");
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
  std::uint32_t written_out_ = 0;
  const Scope* scope_ = nullptr;  ///< of the function that is written out now
};

Expression Program::parse(std::span<const Token> tokens, std::size_t& at, const Names& names,
                          std::vector<Fault>& faults, std::uint32_t max_depth) {
  Reader reader(tokens, at, std::min(max_depth, greatest_depth));
  const Expression expression = Parser(*this, reader, names).parse();
  at = reader.at();
  for (Fault& fault : reader.take_faults()) faults.push_back(std::move(fault));
  return expression;
}

}  // namespace seedmesh::lang
