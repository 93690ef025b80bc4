/// Checks of the whole grammar: modules without effect on the turtle, productions that are never used,
/// probabilities that do not sum to 1.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/generators/lsystem/compilation.h"
#include "core/schema/json.h"

namespace seedmesh::lsystem {
namespace {

constexpr std::size_t most_warnings = 100;
constexpr std::size_t most_possible_errors = 1'000;
constexpr double most_strips = 1'000;  // the bound of Turtle::set_control

const CommandRow* row_of(std::string_view symbol) {
  const auto rows = commands();
  const auto row =
      std::find_if(rows.begin(), rows.end(), [&](const CommandRow& each) { return each.symbol == symbol; });
  return row == rows.end() ? nullptr : &*row;
}

bool is_sure(const Production& each) {
  const bool holds = !each.conditional || (each.condition.is_constant && each.condition.value != 0);
  return holds && !each.has_context();
}

std::string_view folder_of(const Production& each) {
  const std::string_view pointer = each.pointer;
  return pointer.substr(0, pointer.rfind('/'));
}

std::string text_of_number(double number) {
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, number, std::chars_format::general, 6);
  return {digits, end.ptr};
}

bool is_name_part(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

void warn(Compilation& c, Warning warning) {
  if (c.grammar.warnings.size() < most_warnings) {
    c.grammar.warnings.push_back(std::move(warning));
  } else {
    ++c.unreported;
  }
}

/// Probabilities are weights. A sum other than 1 is usually a mistake: a warning, or an error where the weights are strict.
void warn_of_weights(Compilation& c, const Rules& rules) {
  for (const Range& range : rules.of_kind) {
    double sum = 0;
    const Production* first = nullptr;
    bool known = true;
    for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
      const Production& each = rules.productions[i];
      if (!each.weighted) continue;
      if (!first) first = &each;
      known = known && each.weight.is_constant && !each.conditional && !each.has_context();
      sum += each.weight.value;
    }
    if (!first || !known || std::abs(sum - 1) <= 1e-6) continue;
    if (!c.warned.insert(first->pointer + ":").second) continue;
    const std::string& symbol = c.grammar.kinds[first->predecessor].symbol;
    if (c.params.weights == LsystemParams::Weights::strict) {
      c.issues.push_back({IssueKind::invalid_value, first->pointer,
                          "the probabilities of the productions of `" + symbol + "` sum to " +
                              number_text(std::round(sum * 1e9) / 1e9) +
                              ", expected 1 because `weights` is strict"});
      continue;
    }
    warn(c, {first->pointer,
             "the probabilities of the productions of `" + symbol +
                 "` do not sum to 1; they are used as weights",
             0, 0});
  }
}

/// A production after one that always applies is never used. The same is true of a production without
/// probability after one with a probability. Tables can hide productions that apply in every step.
void warn_of_dead(Compilation& c, const Rules& rules) {
  for (const Range& range : rules.of_kind) {
    const Production* plain = nullptr;
    const Production* weighted = nullptr;
    for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
      const Production& each = rules.productions[i];
      const Production* before = plain ? plain : each.weighted ? nullptr : weighted;
      if (before && folder_of(*before) == folder_of(each) && c.warned.insert(each.pointer).second) {
        const std::string& symbol = c.grammar.kinds[each.predecessor].symbol;
        warn(c, {each.pointer,
                 "this production of `" + symbol + "` is never used: `" + before->pointer.substr(1) +
                     (plain ? "` before it always applies"
                            : "` before it has a probability and this one has none; add one, as in `: 0.5`"),
                 0, 0});
      }
      if (plain || !is_sure(each)) continue;
      if (!each.weighted && !weighted) plain = &each;
      if (each.weighted && each.weight.is_constant && each.weight.value > 0 && !weighted) weighted = &each;
    }
  }
}

/// By kind: whether the axiom and the productions can lead to it. Conditions and contexts count as met.
std::vector<bool> reachable_kinds(Compilation& c) {
  std::vector<bool> reached(c.grammar.kinds.size(), false);
  std::vector<KindId> open;
  const auto reach = [&](Range templates) {
    for (const Template& each : c.grammar.successor(templates)) {
      if (reached[each.kind]) continue;
      reached[each.kind] = true;
      open.push_back(each.kind);
    }
  };
  reach(c.grammar.axiom);
  while (!open.empty()) {
    const KindId kind = open.back();
    open.pop_back();
    for_all_rules(c, [&](const Rules& rules) {
      const Range range = rules.of_kind[kind];
      for (std::uint32_t i = range.first; i < range.first + range.count; ++i)
        reach(rules.productions[i].successor);
    });
  }
  return reached;
}

/// A production whose predecessor never occurs with its number of parameters, but with another number.
void warn_of_arity(Compilation& c) {
  const std::vector<bool> reached = reachable_kinds(c);
  const auto other_arity = [&](const Kind& kind) -> const Kind* {
    for (auto each = c.ids.lower_bound({kind.symbol, 0});
         each != c.ids.end() && each->first.first == kind.symbol; ++each) {
      if (reached[each->second]) return &c.grammar.kinds[each->second];
    }
    return nullptr;
  };
  const auto parameters = [](const Kind& kind) {
    return std::to_string(kind.written()) + (kind.written() == 1 ? " parameter" : " parameters");
  };
  for_all_rules(c, [&](const Rules& rules) {
    for (const Production& each : rules.productions) {
      if (reached[each.predecessor]) continue;
      const Kind& kind = c.grammar.kinds[each.predecessor];
      const Kind* other = other_arity(kind);
      if (!other || !c.warned.insert(each.pointer).second) continue;
      warn(c, {each.pointer,
               "this production is never used: `" + kind.symbol + "` occurs with " + parameters(*other) +
                   ", and the production expects " + parameters(kind),
               0, 0});
    }
  });
}

}  // namespace

void warn(Compilation& c, Source& source, std::size_t offset, std::string message) {
  if (c.grammar.warnings.size() >= most_warnings) {
    ++c.unreported;
    return;
  }
  const TextPosition position = source.positions.of(offset);
  warn(c, {source.pointer, std::move(message), position.line, position.column});
}

/// Records a doubt about a module of a word: a turtle symbol with too few parameters, or with a value that
/// the turtle cannot use.
void check_module(Compilation& c, Source& source, const WrittenModule& module, const Template& made) {
  const Kind& kind = c.grammar.kinds[made.kind];
  const auto number = [&](std::uint32_t i) -> const double* {
    const lang::Expression& argument = c.grammar.arguments[made.first_argument + i];
    return argument.is_constant ? &argument.value : nullptr;
  };
  const auto add_possible_error = [&](PossibleError::Severity is, std::string message) {
    if (c.possible_errors.size() == most_possible_errors) return;
    const TextPosition position = source.positions.of(module.offset);
    c.possible_errors.push_back(
        {made.kind, is, {source.pointer, std::move(message), position.line, position.column}});
  };
  const auto name = [&] { return "`" + kind.symbol + "`"; };
  const auto check_tropism = [&](const double* index) {
    const double count = static_cast<double>(c.params.tropism.size());
    if (count == 0)
      return add_possible_error(PossibleError::Severity::warning,
                                "found " + name() + " without `tropism`; the symbol has no effect");
    if (index && !(*index >= 0 && *index < count)) {
      add_possible_error(PossibleError::Severity::warning,
                         "found tropism " + text_of_number(*index) + " in " + name() + "; expected 0 to " +
                             text_of_number(count - 1) + ". The symbol has no effect");
    }
  };
  switch (kind.command) {
    case Command::none: {
      if (c.is_checked.size() < c.grammar.kinds.size()) c.is_checked.resize(c.grammar.kinds.size(), 0);
      if (c.is_checked[made.kind] != 0) return;
      c.is_checked[made.kind] = 1;
      const CommandRow* row = row_of(kind.symbol);
      if (!row || kind.arity >= row->least) return;
      return add_possible_error(
          PossibleError::Severity::warning,
          name() + " expects " + std::string(row->parameters) + ", found " + std::to_string(kind.arity) +
              (kind.arity == 1 ? " parameter" : " parameters") + "; the turtle ignores the symbol");
    }
    case Command::contour: {
      const double* wanted = number(0);
      const auto count = static_cast<double>(c.params.contours.size());
      if (!wanted || (std::trunc(*wanted) >= 0 && std::trunc(*wanted) <= count)) return;
      return add_possible_error(PossibleError::Severity::error,
                                "found @#(" + text_of_number(*wanted) + "); expected 0 (circle) to " +
                                    text_of_number(count) + " (last of `contours`)");
    }
    case Command::divide_scale:
      if (number(0) && *number(0) == 0)
        add_possible_error(PossibleError::Severity::error, "found a divisor of 0 in " + name());
      return;
    case Command::sweep_control:
      if (kind.arity > 0 && number(0) && !(*number(0) >= 1 && *number(0) <= most_strips)) {
        add_possible_error(PossibleError::Severity::warning,
                           "found " + text_of_number(*number(0)) + " strips in " + name() +
                               "; expected 1 to " + text_of_number(most_strips) + "; the value is clamped");
      }
      return;
    case Command::set_heading:
      if (number(0) && number(1) && number(2) && *number(0) == 0 && *number(1) == 0 && *number(2) == 0) {
        add_possible_error(PossibleError::Severity::warning,
                           "found no direction in " + name() + "(0,0,0); the heading is unchanged");
      }
      return;
    case Command::elasticity_set:
      return check_tropism(kind.arity > 1 ? number(0) : nullptr);
    case Command::elasticity_up:
    case Command::elasticity_down:
      return check_tropism(kind.arity > 0 ? number(0) : nullptr);
    default:
      return;
  }
}

/// Finds text in a word that is not meant as modules: a second production, or `n = 4;` for a parameter.
void check_word(const Compilation& c, Source& source, Slice slice) {
  const std::string_view text = source.text;
  const std::size_t arrow = find_second_arrow(text, slice);
  if (arrow < slice.to) {
    source.errors.push_back({arrow, "found an arrow among modules; a text is one production"});
    return;
  }
  const std::size_t behind = text.substr(slice.from, slice.to - slice.from).rfind(';');
  if (behind == std::string_view::npos) return;
  const std::size_t last = slice.from + behind;
  int depth = 0;
  for (std::size_t i = slice.from; i < last; ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')') --depth;
    if (depth > 0 || text[i] != '=' || i == slice.from || text[i + 1] == '=') continue;
    std::size_t end = i;
    while (end > slice.from && text[end - 1] == ' ') --end;
    std::size_t from = end;
    while (from > slice.from && end - from <= 64 && is_name_part(text[from - 1])) --from;
    const lang::Names::Binding* bound = from < end ? c.names.find(text.substr(from, end - from)) : nullptr;
    if (!bound || bound->is_constant) continue;
    source.errors.push_back({from, "found " + lang::in_quotes(text.substr(from, i + 1 - from)) +
                                       ", which are modules here; `let m = 4;` declares a local value"});
    return;
  }
}

void check_rules(Compilation& c) {
  const auto is_rewritten = [&](KindId kind) {
    bool is = false;
    for_all_rules(c, [&](const Rules& rules) { is = is || rules.rewrites(kind); });
    return is;
  };
  for (const PossibleError& each : c.possible_errors) {
    if (is_rewritten(each.kind)) continue;
    if (each.severity == PossibleError::Severity::warning) {
      warn(c, each.warning);
    } else {
      c.issues.push_back({IssueKind::unknown_name, each.warning.pointer, each.warning.message,
                          each.warning.line, each.warning.column});
    }
  }
  for_all_rules(c, [&](const Rules& rules) {
    warn_of_weights(c, rules);
    warn_of_dead(c, rules);
  });
  warn_of_arity(c);
  if (c.unreported > 0)
    c.grammar.warnings.push_back({"", "and " + std::to_string(c.unreported) + " more warnings", 0, 0});
}

}  // namespace seedmesh::lsystem
