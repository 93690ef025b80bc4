/// Operations of a successor and their arguments; see parse_steps.h.
#include <algorithm>

#include "core/generators/building/compile_values.h"
#include "core/generators/building/parse_parts.h"
#include "core/generators/building/parse_steps.h"

namespace seedmesh::building {
namespace {

using lang::Token;
using lang::TokenKind;

Argument parse_word(Parser& p) {
  Argument argument;
  const Token& token = here(p);
  if (token.kind == TokenKind::string) {
    argument.word = word_index(p, lang::string_value(token));
    ++p.at;
  } else if (token.kind == TokenKind::name) {
    std::string word(token.text);
    ++p.at;
    while (is_here(p, ".") && p.tokens.at(p.at + 1).kind == TokenKind::name) {
      word += "." + std::string(p.tokens.at(p.at + 1).text);
      p.at += 2;
    }
    argument.word = word_index(p, word);
  } else {
    add_error(p, token, "found " + in_quotes(token) + ", expected a word");
  }
  return argument;
}

/// The words that operations take where an expression can stand, too.
bool is_keyword(std::string_view word) {
  constexpr std::string_view keywords[] = {"rel",
                                           "abs",
                                           "scope",
                                           "pivot",
                                           "object",
                                           "world",
                                           "surface",
                                           "volume",
                                           "uniform",
                                           "gaussian",
                                           "center",
                                           "front",
                                           "back",
                                           "left",
                                           "right",
                                           "top",
                                           "bottom",
                                           "all",
                                           "faces",
                                           "edges",
                                           "vertices",
                                           "uvs",
                                           "soft",
                                           "hard",
                                           "auto",
                                           "conform",
                                           "normal",
                                           "world.up",
                                           "world.up.flatTop",
                                           "world.x",
                                           "world.y",
                                           "world.z",
                                           "object.x",
                                           "object.y",
                                           "object.z",
                                           "vertex.normal",
                                           "face.normal",
                                           "u",
                                           "v",
                                           "uv",
                                           "separatePerFace",
                                           "append",
                                           "unify",
                                           "recompose",
                                           "collectiveAllFaces",
                                           "yUp",
                                           "zUp",
                                           "xUp",
                                           "scopeCenter",
                                           "scopeOrigin",
                                           "alignPosition",
                                           "keepPosition",
                                           "scope.y",
                                           "alignSizeAndPosition",
                                           "keepSizeAndPosition",
                                           "keepSizeAlignPosition",
                                           "adjustSizeAndPosition",
                                           "union",
                                           "convex",
                                           "cut",
                                           "intersections",
                                           "triangulate"};
  const auto is_axis = [](char c) { return c >= 'x' && c <= 'z'; };
  return std::ranges::find(keywords, word) != std::end(keywords) ||
         (word.size() <= 3 && std::ranges::all_of(word, is_axis));
}

/// A word such as surface or world.up where no name of the rules is meant, else an expression.
Argument parse_word_or_value(Parser& p) {
  const Token& token = here(p);
  if (token.kind == TokenKind::name && !p.functions.contains(token.text) &&
      p.names.find(token.text) == nullptr) {
    std::size_t behind = p.at + 1;
    std::string dotted(token.text);
    for (; p.tokens.is(behind, ".") && p.tokens.at(behind + 1).kind == TokenKind::name; behind += 2)
      dotted += "." + std::string(p.tokens.at(behind + 1).text);
    if (is_keyword(dotted) && (p.tokens.is(behind, ",") || p.tokens.is(behind, ")"))) return parse_word(p);
  }
  return parse_argument(p, 'n');
}

/// 30, byAngle(30), byHeight(3), or as CityEngine has it: byHeight, 3
Argument parse_slope(Parser& p) {
  Argument argument;
  const bool is_height = p.tokens.is_name(p.at, "byHeight");
  if (!is_height && !p.tokens.is_name(p.at, "byAngle")) {
    argument.value = parse_value(p);
    return argument;
  }
  if (is_height) argument.measure = Measure::height;
  if (!is_height && !p.tokens.is(p.at + 1, "(") && !p.tokens.is(p.at + 1, ",")) {
    add_unexpected(p, "an angle");
    return argument;
  }
  ++p.at;
  const bool has_bracket = is_here(p, "(");
  if (!take(p, "(")) expect(p, ",", is_height ? "byHeight" : "byAngle");
  argument.value = parse_value(p);
  if (has_bracket) expect(p, ")", is_height ? "the height" : "the angle");
  return argument;
}

/// Reads the arguments of an operation; of Subdiv, the sizes after the axis become cells.
void parse_arguments(Parser& p, const OperationRow& row, std::vector<Argument>& out,
                     std::vector<Part>& cells) {
  if (!is_here(p, "(")) return;  // an operation without arguments
  const std::size_t close = p.tokens.partner(p.at);
  ++p.at;
  std::size_t mandatory = row.arguments.find('|');
  std::string kinds;
  for (const char c : row.arguments) {
    if (c != '|') kinds += c;
  }
  if (mandatory == std::string_view::npos) mandatory = kinds.size();
  const bool has_sizes = row.braces == Braces::names;
  while (p.at < close) {
    const std::size_t before = p.at;
    if (has_sizes && out.size() == 1) {
      parse_cells(p, cells, false);
      break;
    }
    if (out.size() == kinds.size()) {
      report_surplus(p, row, close);
      return;
    }
    out.push_back(parse_argument(p, kinds[out.size()]));
    if (p.at == before) break;
    if (!take(p, ",")) break;
    if (p.at >= close && has_sizes) break;
  }
  const bool is_short =
      out.size() < mandatory || (row.op == Op::color && out.size() > 1 && out.size() != 4 && out.size() != 3);
  if (p.at < close || is_short) {
    add_error(p, is_short && p.at >= close ? p.tokens.at(close) : here(p),
              lang::in_quotes(row.name) + " takes (" + std::string(row.parameters) + "), found " +
                  (is_short ? std::to_string(out.size()) + " of them" : in_quotes(here(p))));
  }
  p.at = std::min(close + 1, p.tokens.end());
}

/// Gives the bodies in the braces of an operation of 2006 to its parts. Returns what is wrong with them, or nothing.
std::string give_bodies(Parser& p, const OperationRow& row, Step& step, const std::vector<Argument>& list,
                        const std::vector<std::uint32_t>& bodies, std::vector<Part>& parts) {
  if (row.op == Op::comp) {
    parse_selectors_2006(p, step, list, parts);
    if (parts.size() == 1) {
      // One successor serves all components; several serve one each, in order.
      const Part first = parts.front();
      parts.clear();
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        Part part = first;
        part.body = bodies[i];
        if (bodies.size() > 1) part.index = static_cast<std::int32_t>(i);
        parts.push_back(part);
      }
    }
  } else if (row.op == Op::repeat || row.op == Op::roof || row.op == Op::scatter) {
    Part part;
    part.body = bodies.front();
    parts.assign(1, part);
    if (bodies.size() > 1) {
      return "found " + std::to_string(bodies.size()) + " successors, expected one for " +
             lang::in_quotes(row.name);
    }
  } else {
    std::size_t next = 0;
    assign_bodies(p, parts, bodies, next);
    if (next != bodies.size() || next == 0) {
      return "found " + std::to_string(next) + " sizes and " + std::to_string(bodies.size()) +
             " successors, expected equal numbers";
    }
  }
  return {};
}

/// The step behind `inline` as a body of its own.
void parse_next(Parser& p, std::vector<Part>& out) {
  if (!enter_bracket(p, here(p))) return;
  std::vector<Step> steps;
  Choice choice;
  if (take(p, "{")) {
    choice = parse_successor(p);
    expect(p, "}", "the operations of `inline`");
  } else {
    if (here(p).kind == TokenKind::name) {
      parse_step(p, steps);
    } else {
      add_unexpected(p, "an operation, a symbol or `{` after `inline`");
    }
    append_rows(p.grammar.steps, steps, choice.first_step, choice.step_count);
  }
  --p.depth;
  Branch branch;
  append_rows(p.grammar.choices, std::vector<Choice>{choice}, branch.first_choice, branch.choice_count);
  p.grammar.branches.push_back(branch);
  p.grammar.bodies.push_back({static_cast<std::uint32_t>(p.grammar.branches.size()) - 1, 1});
  Part part;
  part.body = static_cast<std::uint32_t>(p.grammar.bodies.size()) - 1;
  out.push_back(part);
}

/// length : depth : successor | ...
void parse_sections(Parser& p, std::vector<Part>& out) {
  do {
    Part part;
    part.offset = offset_here(p);
    part.size = parse_argument(p, 'n');
    expect(p, ":", "the length");
    part.depth = parse_argument(p, 'n');
    expect(p, ":", "the depth");
    part.body = parse_body(p);
    out.push_back(part);
  } while (take(p, "|"));
}

/// { remainder : successor }, which may be left out
void parse_remainder(Parser& p, std::vector<Part>& out) {
  if (!take(p, "{")) return;
  Part part = parse_selector(p);
  if (!part.is_remainder) add_unexpected(p, "remainder");
  part.body = parse_body(p);
  expect(p, "}", "the remainder");
  out.push_back(part);
}

void parse_operands(Parser& p, const OperationRow& row, std::vector<Part>& out) {
  do {
    Part part;
    part.offset = offset_here(p);
    part.body = parse_body(p);
    out.push_back(part);
  } while (take(p, "|"));
  if (out.size() != 2) {
    add_error(
        p, here(p),
        "found " + std::to_string(out.size()) + " operands, expected two for " + lang::in_quotes(row.name));
  }
}

}  // namespace

void parse_operation(Parser& p, const OperationRow& row, std::vector<Step>& out) {
  const Token token = here(p);
  Step step;
  step.op = row.op;
  step.offset = static_cast<std::uint32_t>(token.offset);
  if (row.status != Status::done) {
    const std::string reason = row.text.empty() ? std::string() : " (" + std::string(row.text) + ")";
    if (row.status == Status::error) {
      add_error(p, token, in_quotes(token) + " is not supported" + reason);
    } else {
      add_warning(p, step.offset, in_quotes(token) + " has no effect here" + reason);
    }
    step.op = Op::ignored;
  }
  ++p.at;
  std::vector<Argument> list;
  std::vector<Part> parts;
  parse_arguments(p, row, list, parts);
  read_axis(p, row, step, list);
  // The attribute of a rule file that the request does not have; a warning has said so.
  if (row.op == Op::set && !list.empty() && list[0].word < p.grammar.words.size() &&
      p.tokens.is_missing(p.grammar.words[list[0].word]))
    step.op = Op::ignored;
  append_rows(p.grammar.arguments, list, step.first_argument, step.argument_count);
  if (row.braces == Braces::next) {
    parse_next(p, parts);
  } else if (row.braces != Braces::absent) {
    if (!is_here(p, "{")) {
      add_error(
          p, here(p),
          "found " + in_quotes(here(p)) + ", expected `{` after " + lang::in_quotes(row.name) + "(...)");
      return;
    }
    const std::size_t close = p.tokens.partner(p.at);
    if (!enter_bracket(p, here(p))) return;
    ++p.at;
    if (row.braces == Braces::cells) parse_cells(p, parts, true);
    if (row.braces == Braces::perimeter) parse_sections(p, parts);
    if (row.braces == Braces::operands) parse_operands(p, row, parts);
    if (row.braces == Braces::selectors) parse_selectors(p, parts);
    if (row.braces == Braces::names || (row.braces == Braces::one)) {
      std::vector<std::uint32_t> bodies;
      do bodies.push_back(parse_body(p));
      while (take(p, "|"));
      const std::string wrong = give_bodies(p, row, step, list, bodies, parts);
      if (!wrong.empty()) add_error(p, token, wrong);
    }
    --p.depth;
    if (!is_here(p, "}")) {
      add_unexpected(p, "`|` or `}`");
      p.at = std::max(p.at, std::min(close, p.tokens.end()));
    }
    take(p, "}");
    if (row.braces == Braces::perimeter) {
      step.is_repeated = take(p, "*");
      parse_remainder(p, parts);
    }
    if (row.braces == Braces::cells && is_here(p, "*")) {
      ++p.at;
      Part group;
      group.is_group = true;
      group.offset = step.offset;
      append_rows(p.grammar.parts, parts, group.first_part, group.part_count);
      parts.assign(1, group);
    }
  }
  append_rows(p.grammar.parts, parts, step.first_part, step.part_count);
  out.push_back(step);
}

/// The operation that begins at the next token. Those without arguments need no brackets, unless a rule has their name
/// or a point makes them a leaf.
const OperationRow* operation_here(const Parser& p) {
  const Token& token = here(p);
  const OperationRow* const row = find_operation(token.text);
  if (row == nullptr) return nullptr;
  if (p.tokens.is(p.at + 1, "(")) {
    // Rules can have the names of operations of 2006, such as Roof(kind), which end with braces.
    const bool has_braces = p.tokens.is(std::min(p.tokens.partner(p.at + 1) + 1, p.tokens.end()), "{");
    const bool needs_them = row->braces == Braces::one || row->braces == Braces::names;
    return needs_them && !has_braces && p.symbols_with_rules.contains(token.text) ? nullptr : row;
  }
  if (p.symbols_with_rules.contains(token.text)) return nullptr;
  const bool takes_none = row->arguments.empty() || row->arguments.front() == '|';
  if (p.tokens.is(p.at + 1, "{")) return row->braces == Braces::operands ? row : nullptr;
  const bool is_leaf =
      p.tokens.is(p.at + 1, ".") && p.tokens.at(p.at + 1).offset == token.offset + token.length;
  const bool needs_braces = row->braces != Braces::absent && row->braces != Braces::next;
  return takes_none && !is_leaf && !needs_braces && token.text.size() > 3 ? row : nullptr;
}

Argument parse_argument(Parser& p, char kind) {
  if (kind == 'i' && here(p).kind == TokenKind::number) {
    Argument index;
    index.word = word_index(p, here(p).text);
    ++p.at;
    return index;
  }
  if (kind == 'x') return parse_word_or_value(p);
  if (kind == 'w' || kind == 'i') return parse_word(p);
  if (kind == 'h') return parse_slope(p);
  Argument argument;
  if (take(p, "'")) {
    argument.measure = Measure::relative;
  } else if (take(p, "~")) {
    argument.measure = Measure::floating;
  }
  argument.value = parse_value(p);
  const Token& behind = here(p);
  const Token& last = p.tokens.at(p.at > 0 ? p.at - 1 : 0);
  if (behind.kind == TokenKind::name && behind.text == "r" && behind.offset == last.offset + last.length) {
    argument.measure = Measure::floating;
    ++p.at;
  }
  return argument;
}

}  // namespace seedmesh::building
