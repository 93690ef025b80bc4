/// What can be told of a grammar when all of it is read: modules that the turtle can do nothing with,
/// productions that are never used, probabilities that do not sum to 1.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/generators/lsystem/compiler.h"

namespace seedmesh::lsystem {
namespace {

constexpr std::size_t most_warnings = 100;
constexpr std::size_t most_doubts = 1'000;
constexpr double most_strips = 1'000;  // as Turtle::set_control bounds them

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

}  // namespace

void Compiler::warn(Warning warning) {
  if (grammar_.warnings.size() < most_warnings) {
    grammar_.warnings.push_back(std::move(warning));
  } else {
    ++untold_;
  }
}

void Compiler::warn(Source& source, std::size_t offset, std::string message) {
  if (grammar_.warnings.size() >= most_warnings) {
    ++untold_;
    return;
  }
  const TextPlace place = source.places.of(offset);
  warn({source.pointer, std::move(message), place.line, place.column});
}

/// Looks at a module of a word: is it a symbol of the turtle with too few parameters, or with a value that
/// the turtle cannot take?
void Compiler::doubt_module(Source& source, const WrittenModule& module, const Template& made) {
  const Kind& kind = grammar_.kinds[made.kind];
  const auto number = [&](std::uint32_t i) -> const double* {
    const lang::Expression& argument = grammar_.arguments[made.first_argument + i];
    return argument.is_constant ? &argument.value : nullptr;
  };
  const auto doubt = [&](Doubt::Is is, std::string message) {
    if (doubts_.size() == most_doubts) return;
    const TextPlace place = source.places.of(module.offset);
    doubts_.push_back({made.kind, is, {source.pointer, std::move(message), place.line, place.column}});
  };
  const auto name = [&] { return "`" + kind.symbol + "`"; };
  const auto check_tropism = [&](const double* index) {
    const double count = static_cast<double>(params_.tropism.size());
    if (count == 0)
      return doubt(Doubt::Is::warning, "found " + name() + " and no `tropism`: it does nothing");
    if (index && !(*index >= 0 && *index < count)) {
      doubt(Doubt::Is::warning, "found tropism " + text_of_number(*index) + " in " + name() +
                                    "; expected 0 to " + text_of_number(count - 1) + ": it does nothing");
    }
  };
  switch (kind.command) {
    case Command::none: {
      if (doubted_.size() < grammar_.kinds.size()) doubted_.resize(grammar_.kinds.size(), 0);
      if (doubted_[made.kind] != 0) return;
      doubted_[made.kind] = 1;
      const CommandRow* row = row_of(kind.symbol);
      if (!row || kind.arity >= row->least) return;
      return doubt(Doubt::Is::warning, name() + " takes " + std::string(row->parameters) + ", found " +
                                           std::to_string(kind.arity) +
                                           (kind.arity == 1 ? " parameter" : " parameters") +
                                           ": the turtle does nothing on it");
    }
    case Command::contour: {
      const double* wanted = number(0);
      const auto count = static_cast<double>(params_.contours.size());
      if (!wanted || (std::trunc(*wanted) >= 0 && std::trunc(*wanted) <= count)) return;
      return doubt(Doubt::Is::fault, "found @#(" + text_of_number(*wanted) +
                                         "); expected 0, the circle, to " + text_of_number(count) +
                                         ", the last of `contours`");
    }
    case Command::divide_scale:
      if (number(0) && *number(0) == 0) doubt(Doubt::Is::fault, "found a divisor of 0 in " + name());
      return;
    case Command::sweep_control:
      if (kind.arity > 0 && number(0) && !(*number(0) >= 1 && *number(0) <= most_strips)) {
        doubt(Doubt::Is::warning, "found " + text_of_number(*number(0)) + " strips in " + name() +
                                      "; expected 1 to " + text_of_number(most_strips) +
                                      ": the nearest of them is taken");
      }
      return;
    case Command::set_heading:
      if (number(0) && number(1) && number(2) && *number(0) == 0 && *number(1) == 0 && *number(2) == 0) {
        doubt(Doubt::Is::warning, "found no direction in " + name() + "(0,0,0): the heading stays as it is");
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

/// What is written as if it were something else than modules: a second production in the same text, and
/// `n = 4;` for a parameter.
void Compiler::check_word(Source& source, Slice slice) const {
  const std::string_view text = source.text;
  const std::size_t arrow = find_second_arrow(text, slice);
  if (arrow < slice.to) {
    source.faults.push_back({arrow, "found an arrow among modules; a text is one production"});
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
    const lang::Names::Binding* bound = from < end ? names_.find(text.substr(from, end - from)) : nullptr;
    if (!bound || bound->is_constant) continue;
    source.faults.push_back(
        {from, "found " + lang::in_quotes(text.substr(from, i + 1 - from)) +
                   ", which are modules here; a value gets a name of its own by `let`, as in `let m = 4;`"});
    return;
  }
}

/// Probabilities are weights; a sum other than 1 is told, since it is mostly a slip.
void Compiler::warn_of_weights(const Rules& rules) {
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
    if (!warned_.insert(first->pointer + ":").second) continue;
    warn({first->pointer,
          "the probabilities of the productions of `" + grammar_.kinds[first->predecessor].symbol +
              "` do not sum to 1; they are used as weights",
          0, 0});
  }
}

/// A production behind one that always applies is never used; nor is one without a probability behind one
/// that has one. Tables may hide what holds in every step.
void Compiler::warn_of_dead(const Rules& rules) {
  for (const Range& range : rules.of_kind) {
    const Production* plain = nullptr;
    const Production* weighted = nullptr;
    for (std::uint32_t i = range.first; i < range.first + range.count; ++i) {
      const Production& each = rules.productions[i];
      const Production* before = plain ? plain : each.weighted ? nullptr : weighted;
      if (before && folder_of(*before) == folder_of(each) && warned_.insert(each.pointer).second) {
        const std::string& symbol = grammar_.kinds[each.predecessor].symbol;
        warn({each.pointer,
              "this production of `" + symbol + "` is never used: the one of " + before->pointer +
                  (plain ? " before it always applies"
                         : " before it has a probability, and it has none; write one, as in `: 0.5`"),
              0, 0});
      }
      if (plain || !is_sure(each)) continue;
      if (!each.weighted && !weighted) plain = &each;
      if (each.weighted && each.weight.is_constant && each.weight.value > 0 && !weighted) weighted = &each;
    }
  }
}

void Compiler::judge() {
  const auto is_rewritten = [&](KindId kind) {
    bool is = false;
    for_all_rules([&](const Rules& rules) { is = is || rules.rewrites(kind); });
    return is;
  };
  for (const Doubt& each : doubts_) {
    if (is_rewritten(each.kind)) continue;
    if (each.is == Doubt::Is::warning) {
      warn(each.told);
    } else {
      issues_.push_back({each.told.pointer, each.told.message, each.told.line, each.told.column});
    }
  }
  for_all_rules([&](const Rules& rules) {
    warn_of_weights(rules);
    warn_of_dead(rules);
  });
  if (untold_ > 0)
    grammar_.warnings.push_back({"", "and " + std::to_string(untold_) + " more warnings", 0, 0});
}

}  // namespace seedmesh::lsystem
