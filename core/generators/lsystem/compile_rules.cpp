/// Compiles productions and words from their slices to kinds, slots and templates.
#include <algorithm>
#include <cmath>

#include "core/generators/lsystem/compilation.h"
#include "core/generators/lsystem/statements.h"

namespace seedmesh::lsystem {
namespace {

std::uint64_t hash_of(std::string_view symbol) { return Rng(0).at(symbol).key(); }

bool is_star(std::string_view text, Slice slice) {
  return erases(text, slice) &&
         text.substr(slice.from, slice.to - slice.from).find('*') != std::string_view::npos;
}

void add_template(Compilation& c, Source& source, const WrittenModule& module) {
  Template made;
  made.kind =
      kind_of(c, module.symbol, static_cast<std::uint32_t>(module.arguments.size()), source, module.offset);
  made.first_argument = static_cast<std::uint32_t>(c.grammar.arguments.size());
  const std::vector<std::uint8_t> frames = c.grammar.kinds[made.kind].frames;
  for (std::size_t i = 0; i < module.arguments.size(); ++i) {
    const bool is_frame = !frames.empty() && frames[i] != 0;
    const lang::Expression value = is_frame ? compile_frame(c, source, module.arguments[i])
                                            : compile_expression(c, source, module.arguments[i]);
    c.grammar.arguments.push_back(value);
  }
  if (made.kind == c.grammar.cut) c.grammar.cuts = true;
  std::uint64_t& count = c.occurrences.try_emplace(std::string(module.symbol), 0).first->second;
  made.occurrence = key_at(hash_of(module.symbol), count++);
  c.grammar.templates.push_back(made);
  check_module(c, source, module, made);
}

void bind_parameter(Compilation& c, Source& source, const lang::Token& name, bool is_frame,
                    std::uint32_t& slots) {
  const lang::Names::Binding* before = c.names.find(name.text);
  const bool is_parameter = before && !before->is_constant && before->slot >= c.grammar.variables.size();
  if (is_parameter || c.frame_slots.count(name.text)) {
    source.errors.push_back({name.offset, "the parameter `" + std::string(name.text) + "` is named twice",
                             IssueKind::duplicate_key});
  }
  if (!is_frame) {
    c.names.bind_slot(std::string(name.text), slots++);
    return;
  }
  c.frame_slots.insert_or_assign(std::string(name.text), slots);
  constexpr const char* origin[] = {".x", ".y", ".z"};
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    c.names.bind_slot(std::string(name.text) + origin[axis], slots + frame_numbers - 3 + axis);
  }
  slots += frame_numbers;
}

/// Reads a module with formal parameters and binds each name to the next slot, or to twelve slots for a
/// frame.
KindId read_formal(Compilation& c, Source& source, const WrittenModule& module, std::uint32_t& slots) {
  if (module.arguments.size() > most_parameters) {
    source.errors.push_back({module.offset, "found too many parameters; expected at most 64"});
    return c.grammar.open;
  }
  const KindId id =
      kind_of(c, module.symbol, static_cast<std::uint32_t>(module.arguments.size()), source, module.offset);
  const std::vector<std::uint8_t> frames = c.grammar.kinds[id].frames;
  for (std::size_t i = 0; i < module.arguments.size(); ++i) {
    const Slice argument = module.arguments[i];
    const bool is_frame = !frames.empty() && frames[i] != 0;
    const std::vector<lang::Token> tokens =
        lang::tokenize(source.text, argument.from, argument.to, source.errors);
    if (tokens.size() == 2 && tokens[0].kind == lang::TokenKind::name) {
      bind_parameter(c, source, tokens[0], is_frame, slots);
    } else {
      source.errors.push_back({argument.from, "found an expression; expected the name of a parameter"});
      slots += is_frame ? frame_numbers : 1;
    }
  }
  return id;
}

std::vector<KindId> read_context(Compilation& c, Source& source, Slice slice, std::uint32_t& slots) {
  std::vector<KindId> kinds;
  for (const WrittenModule& module : read_modules(source.text, slice, c.symbols, source.errors)) {
    if (!lang::can_add_error(source.errors)) break;
    check_symbol(c, module, source);
    kinds.push_back(read_formal(c, source, module, slots));
  }
  return kinds;
}

void read_predecessor(Compilation& c, Source& source, Slice slice, Production& made, std::uint32_t& slots) {
  const std::vector<WrittenModule> heads = read_modules(source.text, slice, c.symbols, source.errors);
  const bool is_strict = c.params.strict_predecessors && heads.size() > 1;
  if (heads.size() != 1 && !is_strict) {
    if (source.errors.empty()) {
      source.errors.push_back(
          {heads.empty() ? slice.from : heads[1].offset,
           "found " + std::to_string(heads.size()) + " modules; expected one predecessor" +
               (heads.size() > 1 ? "; a name of several characters is declared in `modules`, and "
                                   "`strict_predecessors` allows several modules"
                                 : "")});
    }
    return;
  }
  check_symbol(c, heads[0], source);
  if (c.alphabet_constants.count(heads[0].symbol)) {
    source.errors.push_back({heads[0].offset, "found `" + std::string(heads[0].symbol) +
                                                  "`, which the alphabet lists as a constant"});
  }
  made.predecessor = read_formal(c, source, heads[0], slots);
  const bool is_branch = is_strict && made.predecessor == c.grammar.open;
  if (!is_branch && (made.predecessor == c.grammar.open || made.predecessor == c.grammar.close)) {
    source.errors.push_back(
        {heads[0].offset, "found a bracket as predecessor; brackets cannot be rewritten"});
  }
  if (!is_strict) return;
  check_brackets(c, source, slice);
  for (std::size_t i = 1; i < heads.size() && lang::can_add_error(source.errors); ++i) {
    check_symbol(c, heads[i], source);
    made.rest.push_back(read_formal(c, source, heads[i], slots));
  }
}

void read_contexts(Compilation& c, Source& source, const WrittenProduction& written, Production& made,
                   std::uint32_t& slots) {
  const auto left = [&](Slice slice) {
    std::vector<KindId> path = read_context(c, source, slice, slots);
    std::reverse(path.begin(), path.end());
    for (KindId id : path) {
      if (id == c.grammar.open || id == c.grammar.close) {
        source.errors.push_back(
            {slice.from, "found a bracket in a left context, which is a path without branches"});
        break;
      }
    }
    return path;
  };
  const auto right = [&](Slice slice) {
    check_brackets(c, source, slice);
    return read_context(c, source, slice, slots);
  };
  made.left = left(written.left);
  made.right = right(written.right);
  made.new_left = left(written.new_left);
  made.new_right = right(written.new_right);
}

void read_weight(Compilation& c, Source& source, const WrittenProduction& written, Production& made) {
  made.weighted = true;
  made.weight = compile_expression(c, source, written.weight);
  if (made.weight.is_constant && !(made.weight.value >= 0 && std::isfinite(made.weight.value))) {
    source.errors.push_back({written.weight.from, "found a probability that is negative or not finite"});
  }
}

}  // namespace

lang::Expression compile_expression(Compilation& c, Source& source, Slice slice) {
  const std::size_t before = source.errors.size();
  const std::vector<lang::Token> tokens = lang::tokenize(source.text, slice.from, slice.to, source.errors);
  if (source.errors.size() != before) return {};
  std::size_t at = 0;
  const lang::Expression parsed =
      c.grammar.program.parse(tokens, at, c.names, source.errors, c.limits.expression_depth);
  if (source.errors.size() == before && tokens[at].kind != lang::TokenKind::end) {
    source.errors.push_back(
        {tokens[at].offset, "found `" + std::string(tokens[at].text) + "` after the end of the expression"});
  }
  return parsed;
}

/// Compiles the modules of an axiom, a successor or a part of one to templates.
Range compile_word(Compilation& c, Source& source, Slice slice) {
  Range range{static_cast<std::uint32_t>(c.grammar.templates.size()), 0};
  if (erases(source.text, slice)) return range;
  check_word(c, source, slice);
  std::size_t count = 0;
  for (const WrittenModule& module : read_modules(source.text, slice, c.symbols, source.errors)) {
    if (!lang::can_add_error(source.errors)) break;
    if (c.job && (++count & 4095U) == 0) c.job->check();
    check_symbol(c, module, source);
    check_surface(c, module, source);
    if (c.grammar.templates.size() == most_modules) {
      source.errors.push_back({module.offset, "found more than 1,000,000 modules in one grammar"});
      break;
    }
    if (module.arguments.size() > most_parameters) {
      source.errors.push_back({module.offset, "found too many parameters; expected at most 64"});
      continue;
    }
    add_template(c, source, module);
  }
  range.count = static_cast<std::uint32_t>(c.grammar.templates.size()) - range.first;
  return range;
}

/// [ and ] must pair inside every word. { and } need not, because leaves of the book open them in one branch
/// and close them in another.
void check_brackets(Compilation& c, Source& source, Slice slice) {
  std::vector<std::size_t> open;
  int depth = 0;
  for (std::size_t i = slice.from; i < slice.to && lang::can_add_error(source.errors); ++i) {
    const char sign = source.text[i];
    if (sign == '(') ++depth;
    if (sign == ')') --depth;
    if (depth > 0) continue;
    if (sign == '@') {
      ++i;
    } else if (sign == '[') {
      open.push_back(i);
    } else if (sign == ']') {
      if (open.empty()) {
        source.errors.push_back({i, "found `]` without a `[` before it"});
      } else {
        open.pop_back();
      }
    }
  }
  if (!open.empty()) source.errors.push_back({open.back(), "found `[` without its `]`"});
  if (open.size() > c.limits.bracket_depth) {
    source.errors.push_back(
        {open.back(), "brackets nest deeper than " + std::to_string(c.limits.bracket_depth)});
  }
}

Production compile_production(Compilation& c, Source& source, const WrittenProduction& written) {
  c.names.forget_after(c.constant_count);
  c.frame_slots.clear();
  c.occurrences.clear();
  Production made;
  made.pointer = source.pointer;
  auto slots = static_cast<std::uint32_t>(c.grammar.variables.size());
  read_predecessor(c, source, written.predecessor, made, slots);
  read_contexts(c, source, written, made, slots);
  made.bound = slots;
  made.before = compile_assignments(c, source, written.before, slots);
  const bool statements_alone = written.condition.empty() && written.before.to + written.after.to > 0;
  if (written.has_condition && !statements_alone && !is_star(source.text, written.condition)) {
    made.conditional = true;
    made.condition = compile_expression(c, source, written.condition);
  }
  const auto first_template = static_cast<std::uint32_t>(c.grammar.templates.size());
  const Range after = compile_assignments(c, source, written.after, slots);
  if (has_statements(source, written.successor)) {
    made.code = compile_code(c, source, written.successor, slots);
    made.successor = {first_template,
                      static_cast<std::uint32_t>(c.grammar.templates.size()) - first_template};
  } else {
    made.successor = compile_word(c, source, written.successor);
    check_brackets(c, source, written.successor);
    if (after.count > 0) {
      c.grammar.steps.push_back({Step::Action::write, made.successor, {}, 0, 0});
      made.code = {after.first + after.count, 1};
    }
  }
  if (after.count > 0) made.code = {after.first, after.count + made.code.count};
  if (written.has_weight) read_weight(c, source, written, made);
  c.grammar.most_slots = std::max(c.grammar.most_slots, slots);
  return made;
}

}  // namespace seedmesh::lsystem
