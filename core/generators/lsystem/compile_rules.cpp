/// Productions and words, from their written parts to kinds, slots and templates.
#include <algorithm>
#include <cmath>

#include "core/generators/lsystem/compiler.h"

namespace seedmesh::lsystem {
namespace {

std::uint64_t hash_of(std::string_view symbol) { return Rng(0).at(symbol).key(); }

bool is_star(std::string_view text, Slice slice) {
  return erases(text, slice) &&
         text.substr(slice.from, slice.to - slice.from).find('*') != std::string_view::npos;
}

}  // namespace

lang::Expression Compiler::expression(Source& source, Slice slice) {
  const std::size_t before = source.faults.size();
  const std::vector<lang::Token> tokens = lang::tokenize(source.text, slice.from, slice.to, source.faults);
  if (source.faults.size() != before) return {};
  std::size_t at = 0;
  const lang::Expression parsed =
      grammar_.program.parse(tokens, at, names_, source.faults, limits_.expression_depth);
  if (source.faults.size() == before && tokens[at].kind != lang::TokenKind::end) {
    source.faults.push_back(
        {tokens[at].offset, "found `" + std::string(tokens[at].text) + "` after the end of the expression"});
  }
  return parsed;
}

/// The modules of an axiom, a successor or a part of one, as templates.
Range Compiler::word(Source& source, Slice slice) {
  Range range{static_cast<std::uint32_t>(grammar_.templates.size()), 0};
  if (erases(source.text, slice)) return range;
  check_word(source, slice);
  std::size_t count = 0;
  for (const WrittenModule& module : read_modules(source.text, slice, symbols_, source.faults)) {
    if (!lang::has_room(source.faults)) break;
    if (job_ && (++count & 4095U) == 0) job_->check();
    check_symbol(module, source);
    check_surface(module, source);
    if (grammar_.templates.size() == most_modules) {
      source.faults.push_back({module.offset, "found more than 1,000,000 modules in one grammar"});
      break;
    }
    if (module.arguments.size() > most_parameters) {
      source.faults.push_back({module.offset, "found too many parameters; expected at most 64"});
      continue;
    }
    add_template(source, module);
  }
  range.count = static_cast<std::uint32_t>(grammar_.templates.size()) - range.first;
  return range;
}

void Compiler::add_template(Source& source, const WrittenModule& module) {
  Template made;
  made.kind = kind(module.symbol, static_cast<std::uint32_t>(module.arguments.size()), source, module.offset);
  made.first_argument = static_cast<std::uint32_t>(grammar_.arguments.size());
  const std::vector<std::uint8_t> frames = grammar_.kinds[made.kind].frames;
  for (std::size_t i = 0; i < module.arguments.size(); ++i) {
    const bool is_frame = !frames.empty() && frames[i] != 0;
    const lang::Expression value =
        is_frame ? frame(source, module.arguments[i]) : expression(source, module.arguments[i]);
    grammar_.arguments.push_back(value);
  }
  if (made.kind == grammar_.cut) grammar_.cuts = true;
  std::uint64_t& count = occurrences_.try_emplace(std::string(module.symbol), 0).first->second;
  made.place = key_at(hash_of(module.symbol), count++);
  grammar_.templates.push_back(made);
  doubt_module(source, module, made);
}

/// [ and ] must pair inside every word; { and } need not (leaves of the book open them in one branch and
/// close in another).
void Compiler::check_brackets(Source& source, Slice slice) {
  std::vector<std::size_t> open;
  int depth = 0;
  for (std::size_t i = slice.from; i < slice.to && lang::has_room(source.faults); ++i) {
    const char c = source.text[i];
    if (c == '(') ++depth;
    if (c == ')') --depth;
    if (depth > 0) continue;
    if (c == '@') {
      ++i;
    } else if (c == '[') {
      open.push_back(i);
    } else if (c == ']') {
      if (open.empty()) {
        source.faults.push_back({i, "found `]` without a `[` before it"});
      } else {
        open.pop_back();
      }
    }
  }
  if (!open.empty()) source.faults.push_back({open.back(), "found `[` without its `]`"});
  if (open.size() > limits_.bracket_depth) {
    source.faults.push_back(
        {open.back(), "brackets nest deeper than " + std::to_string(limits_.bracket_depth)});
  }
}

Production Compiler::production(Source& source, const WrittenProduction& written) {
  names_.forget_after(constant_count_);
  frame_slots_.clear();
  occurrences_.clear();
  Production made;
  made.pointer = source.pointer;
  std::uint32_t slots = 0;
  read_predecessor(source, written.predecessor, made, slots);
  read_contexts(source, written, made, slots);
  made.bound = slots;
  made.before = assignments(source, written.before, slots);
  const bool statements_alone = written.condition.empty() && written.before.to + written.after.to > 0;
  if (written.has_condition && !statements_alone && !is_star(source.text, written.condition)) {
    made.conditional = true;
    made.condition = expression(source, written.condition);
  }
  const auto first_template = static_cast<std::uint32_t>(grammar_.templates.size());
  const Range after = assignments(source, written.after, slots);
  if (has_statements(source, written.successor)) {
    made.code = code(source, written.successor, slots);
    made.successor = {first_template, static_cast<std::uint32_t>(grammar_.templates.size()) - first_template};
  } else {
    made.successor = word(source, written.successor);
    check_brackets(source, written.successor);
    if (after.count > 0) {
      grammar_.steps.push_back({Step::Does::write, made.successor, {}, 0, 0});
      made.code = {after.first + after.count, 1};
    }
  }
  if (after.count > 0) made.code = {after.first, after.count + made.code.count};
  if (written.has_weight) read_weight(source, written, made);
  grammar_.most_slots = std::max(grammar_.most_slots, slots);
  return made;
}

void Compiler::read_predecessor(Source& source, Slice slice, Production& made, std::uint32_t& slots) {
  const std::vector<WrittenModule> heads = read_modules(source.text, slice, symbols_, source.faults);
  if (heads.size() != 1) {
    if (source.faults.empty()) {
      source.faults.push_back(
          {heads.empty() ? slice.from : heads[1].offset,
           "found " + std::to_string(heads.size()) + " modules; expected one predecessor" +
               (heads.size() > 1
                    ? ", whose name is declared in `modules` where it is longer than one character"
                    : "")});
    }
    return;
  }
  check_symbol(heads[0], source);
  if (alphabet_constants_.count(heads[0].symbol)) {
    source.faults.push_back({heads[0].offset, "found `" + std::string(heads[0].symbol) +
                                                  "`, which the alphabet lists as a constant"});
  }
  made.predecessor = formal(source, heads[0], slots);
  if (made.predecessor == grammar_.open || made.predecessor == grammar_.close) {
    source.faults.push_back(
        {heads[0].offset, "found a bracket as predecessor; brackets cannot be rewritten"});
  }
}

void Compiler::read_contexts(Source& source, const WrittenProduction& written, Production& made,
                             std::uint32_t& slots) {
  const auto left = [&](Slice slice) {
    std::vector<KindId> path = context(source, slice, slots);
    std::reverse(path.begin(), path.end());
    for (KindId id : path) {
      if (id == grammar_.open || id == grammar_.close) {
        source.faults.push_back(
            {slice.from, "found a bracket in a left context, which is a path without branches"});
        break;
      }
    }
    return path;
  };
  const auto right = [&](Slice slice) {
    check_brackets(source, slice);
    return context(source, slice, slots);
  };
  made.left = left(written.left);
  made.right = right(written.right);
  made.new_left = left(written.new_left);
  made.new_right = right(written.new_right);
}

void Compiler::read_weight(Source& source, const WrittenProduction& written, Production& made) {
  made.weighted = true;
  made.weight = expression(source, written.weight);
  if (made.weight.is_constant && !(made.weight.value >= 0 && std::isfinite(made.weight.value))) {
    source.faults.push_back({written.weight.from, "found a probability that is negative or not finite"});
  }
}

std::vector<KindId> Compiler::context(Source& source, Slice slice, std::uint32_t& slots) {
  std::vector<KindId> kinds;
  for (const WrittenModule& module : read_modules(source.text, slice, symbols_, source.faults)) {
    if (!lang::has_room(source.faults)) break;
    check_symbol(module, source);
    kinds.push_back(formal(source, module, slots));
  }
  return kinds;
}

/// A module with formal parameters: binds each name to the next slot, or slots where it is a frame.
KindId Compiler::formal(Source& source, const WrittenModule& module, std::uint32_t& slots) {
  if (module.arguments.size() > most_parameters) {
    source.faults.push_back({module.offset, "found too many parameters; expected at most 64"});
    return grammar_.open;
  }
  const KindId id =
      kind(module.symbol, static_cast<std::uint32_t>(module.arguments.size()), source, module.offset);
  const std::vector<std::uint8_t> frames = grammar_.kinds[id].frames;
  for (std::size_t i = 0; i < module.arguments.size(); ++i) {
    const Slice argument = module.arguments[i];
    const bool is_frame = !frames.empty() && frames[i] != 0;
    const std::vector<lang::Token> tokens =
        lang::tokenize(source.text, argument.from, argument.to, source.faults);
    if (tokens.size() == 2 && tokens[0].kind == lang::TokenKind::name) {
      bind(source, tokens[0], is_frame, slots);
    } else {
      source.faults.push_back({argument.from, "found an expression; expected the name of a parameter"});
      slots += is_frame ? frame_numbers : 1;
    }
  }
  return id;
}

void Compiler::bind(Source& source, const lang::Token& name, bool is_frame, std::uint32_t& slots) {
  const lang::Names::Binding* before = names_.find(name.text);
  if ((before && !before->is_constant) || frame_slots_.count(name.text)) {
    source.faults.push_back({name.offset, "the parameter `" + std::string(name.text) + "` is named twice"});
  }
  if (!is_frame) {
    names_.bind_slot(std::string(name.text), slots++);
    return;
  }
  frame_slots_.insert_or_assign(std::string(name.text), slots);
  constexpr const char* origin[] = {".x", ".y", ".z"};
  for (std::uint32_t axis = 0; axis < 3; ++axis) {
    names_.bind_slot(std::string(name.text) + origin[axis], slots + frame_numbers - 3 + axis);
  }
  slots += frame_numbers;
}

}  // namespace seedmesh::lsystem
