/// Successors: symbols, operations, brackets, and what stands in braces.
#include <algorithm>

#include "core/generators/building/parser.h"

namespace seedmesh::building {
namespace {

using lang::Token;
using lang::TokenKind;

constexpr int deepest = 100;  ///< brackets and braces inside each other

struct ClassName {
  std::string_view name;
  std::uint32_t classes;
};
constexpr ClassName class_names[] = {
    {"front", face_front},   {"back", face_back},         {"left", face_left},
    {"right", face_right},   {"top", face_top},           {"bottom", face_bottom},
    {"side", face_side},     {"all", face_all},           {"horizontal", face_horizontal},
    {"aslant", face_aslant}, {"vertical", face_vertical}, {"nutant", face_nutant},
    {"inside", face_inside}, {"border", face_border},
};
constexpr ClassName old_names[] = {
    {"faces", face_all},          {"face", face_all},          {"sidefaces", face_side},
    {"sideface", face_side},      {"topfaces", face_top},      {"topface", face_top},
    {"bottomfaces", face_bottom}, {"bottomface", face_bottom}, {"edges", face_all},
    {"edge", face_all},           {"topedges", face_top},      {"bottomedges", face_bottom},
    {"sideedges", face_side},     {"vertices", face_all},      {"vertex", face_all},
};

std::string_view nearest_operation(std::string_view name) {
  std::string_view best;
  std::uint32_t least = lang::hint_distance(name) + 1;
  for (const OperationRow& row : operations()) {
    const std::uint32_t distance = lang::name_distance(name, row.name);
    if (distance >= least) continue;
    least = distance;
    best = row.name;
  }
  return best;
}

}  // namespace

bool Parser::enter(const Token& token) {
  if (++depth_ <= deepest) return true;
  fault(token, "brackets go more than 100 deep");
  --depth_;
  at_ = tokens_.end();
  return false;
}

/// case ... else ..., or one list of choices.
std::uint32_t Parser::body() {
  std::vector<Branch> branches;
  if (!enter(here())) return 0;
  if (!tokens_.is_name(at_, "case")) {
    Branch& branch = branches.emplace_back();
    std::vector<Choice> list;
    choices(list);
    branch.first_choice = static_cast<std::uint32_t>(grammar_.choices.size());
    branch.choice_count = static_cast<std::uint32_t>(list.size());
    grammar_.choices.insert(grammar_.choices.end(), list.begin(), list.end());
  } else {
    while (tokens_.is_name(at_, "case") || tokens_.is_name(at_, "else")) {
      const bool is_else = tokens_.is_name(at_, "else");
      ++at_;
      Branch branch;
      if (!is_else) branch.condition = value();
      expect(":", is_else ? "else" : "the condition");
      std::vector<Choice> list;
      choices(list);
      branch.first_choice = static_cast<std::uint32_t>(grammar_.choices.size());
      branch.choice_count = static_cast<std::uint32_t>(list.size());
      grammar_.choices.insert(grammar_.choices.end(), list.begin(), list.end());
      branches.push_back(branch);
      if (is_else) break;
    }
  }
  --depth_;
  grammar_.bodies.push_back(
      {static_cast<std::uint32_t>(grammar_.branches.size()), static_cast<std::uint32_t>(branches.size())});
  grammar_.branches.insert(grammar_.branches.end(), branches.begin(), branches.end());
  return static_cast<std::uint32_t>(grammar_.bodies.size()) - 1;
}

/// 30% : A  50% : B  else : C, or a plain successor.
void Parser::choices(std::vector<Choice>& out) {
  if (!tokens_.is(tokens_.behind_expression(at_), "%")) {
    out.push_back(successor());
    return;
  }
  while (tokens_.is(tokens_.behind_expression(at_), "%")) {
    const std::size_t from = at_, to = tokens_.behind_expression(at_);
    Value weight = value_of(from, to);
    at_ = to + 1;
    expect(":", "the percentage");
    // A percentage is a weight in hundredths; the sum is what counts in the end.
    if (weight.expression.is_constant) {
      weight.expression.value /= 100;
    } else {
      fault(tokens_.at(from), "a percentage is a constant");
    }
    Choice choice = successor();
    choice.weight = weight;
    out.push_back(choice);
  }
  if (tokens_.is_name(at_, "else") && tokens_.is(at_ + 1, ":")) {
    at_ += 2;
    out.push_back(successor());
  }
}

bool Parser::ends_successor() const {
  const Token& token = here();
  if (token.kind == TokenKind::end || is_here("|") || is_here("}") || is_here("]") || is_here(":") ||
      is_here(")") || tokens_.is_arrow(at_))
    return true;
  if (token.kind == TokenKind::name && (token.text == "case" || token.text == "else")) return true;
  const std::size_t behind = tokens_.behind_expression(at_);
  if (token.kind != TokenKind::name && tokens_.is(behind, "%")) return true;
  return begins_statement(at_);
}

Choice Parser::successor() {
  std::vector<Step> steps;
  int brackets = 0;
  while (true) {
    if (is_here("]") && brackets > 0) {
      --brackets;
      steps.push_back({.op = Op::pop, .offset = offset_here()});
      ++at_;
      continue;
    }
    if (is_here("[")) {
      if (++brackets > deepest) {
        fault(here(), "brackets go more than 100 deep");
        at_ = tokens_.end();
        break;
      }
      steps.push_back({.op = Op::push, .offset = offset_here()});
      ++at_;
      continue;
    }
    if (ends_successor()) break;
    if (!step(steps)) break;
  }
  if (brackets > 0) fault(here(), "found " + in_quotes(here()) + ", expected `]`");
  Choice choice;
  choice.first_step = static_cast<std::uint32_t>(grammar_.steps.size());
  choice.step_count = static_cast<std::uint32_t>(steps.size());
  grammar_.steps.insert(grammar_.steps.end(), steps.begin(), steps.end());
  return choice;
}

bool Parser::step(std::vector<Step>& out) {
  const Token& token = here();
  if (take("*") || take("ε")) {  // an empty successor, as in L-systems
    out.push_back({.op = Op::nil, .offset = static_cast<std::uint32_t>(token.offset)});
    return true;
  }
  if (token.kind != TokenKind::name) {
    fault(token, "found " + in_quotes(token) + ", expected a symbol, an operation or a bracket");
    return false;
  }
  if (token.text == "NIL" || token.text == "NULL" || token.text == "epsilon") {
    out.push_back({.op = Op::nil, .offset = static_cast<std::uint32_t>(token.offset)});
    ++at_;
    if (is_here("(") && tokens_.is(at_ + 1, ")")) at_ += 2;
    return true;
  }
  const OperationRow* row = tokens_.is(at_ + 1, "(") ? find_operation(token.text) : nullptr;
  if (row != nullptr) {
    operation_step(*row, out);
  } else {
    symbol_step(out);
  }
  return true;
}

void Parser::symbol_step(std::vector<Step>& out) {
  const Token token = here();
  Step step;
  step.offset = static_cast<std::uint32_t>(token.offset);
  step.symbol = symbol_of(token.text, step.offset);
  ++at_;
  std::vector<Argument> list;
  const auto point = [&] {
    if (!is_here(".") || here().offset != tokens_.at(at_ - 1).offset + tokens_.at(at_ - 1).length) return;
    ++at_;
    step.is_leaf = true;
  };
  point();
  if (!step.is_leaf && is_here("(")) {
    const std::size_t close = tokens_.partner(at_);
    ++at_;
    while (at_ < close && !is_here(")")) {
      Argument argument;
      argument.value = value();
      list.push_back(argument);
      if (!take(",")) break;
    }
    if (at_ < close) {
      fault(here(), "found " + in_quotes(here()) + ", expected `,` or `)`");
    }
    at_ = std::min(close + 1, tokens_.end());
    point();
  }
  step.first_argument = static_cast<std::uint32_t>(grammar_.arguments.size());
  step.argument_count = static_cast<std::uint32_t>(list.size());
  grammar_.arguments.insert(grammar_.arguments.end(), list.begin(), list.end());
  // A call of what is no symbol of any rule is most likely an operation written wrong.
  if (!list.empty() && !step.is_leaf && !symbols_with_rules_.contains(std::string(token.text))) {
    const std::string_view hint = nearest_operation(token.text);
    fault(token, "there is no operation and no rule " + in_quotes(token) +
                     (hint.empty() ? std::string() : "; did you mean " + lang::in_quotes(hint) + "?"));
  }
  out.push_back(step);
}

void Parser::operation_step(const OperationRow& row, std::vector<Step>& out) {
  const Token token = here();
  Step step;
  step.op = row.op;
  step.offset = static_cast<std::uint32_t>(token.offset);
  ++at_;
  std::vector<Argument> list;
  std::vector<Part> parts;
  if (!arguments(row, list, step, parts)) return;
  settle_axis(row, step, list);
  step.first_argument = static_cast<std::uint32_t>(grammar_.arguments.size());
  step.argument_count = static_cast<std::uint32_t>(list.size());
  grammar_.arguments.insert(grammar_.arguments.end(), list.begin(), list.end());
  if (row.braces != Braces::absent) {
    if (!is_here("{")) {
      fault(here(), "found " + lang::in_quotes(here()) + ", expected `{` after " + lang::in_quotes(row.name) +
                        "(...)");
      return;
    }
    const std::size_t close = tokens_.partner(at_);
    if (!enter(here())) return;
    ++at_;
    if (row.braces == Braces::cells) cells(parts);
    if (row.braces == Braces::selectors) selectors(parts);
    if (row.braces == Braces::names || (row.braces == Braces::one)) {
      std::vector<std::uint32_t> bodies;
      do bodies.push_back(body());
      while (take("|"));
      if (row.op == Op::comp) {
        old_selectors(step, list, parts);
        if (parts.size() == 1) {
          // One successor serves all; several are taken in turn, by number.
          const Part first = parts.front();
          parts.clear();
          for (std::size_t i = 0; i < bodies.size(); ++i) {
            Part part = first;
            part.body = bodies[i];
            if (bodies.size() > 1) part.index = static_cast<std::int32_t>(i);
            parts.push_back(part);
          }
        }
      } else if (row.op == Op::repeat || row.op == Op::roof) {
        Part part;
        part.body = bodies.front();
        if (bodies.size() > 1)
          fault(token,
                lang::in_quotes(row.name) + " has one successor, found " + std::to_string(bodies.size()));
        parts.assign(1, part);
      } else {
        std::size_t next = 0;
        fill_bodies(parts, bodies, next);
        if (next != bodies.size() || next == 0)
          fault(token, "found " + std::to_string(next) + " sizes and " + std::to_string(bodies.size()) +
                           " successors, expected as many of both");
      }
    }
    --depth_;
    if (!is_here("}")) {
      fault(here(), "found " + in_quotes(here()) + ", expected `|` or `}`");
      at_ = std::max(at_, std::min(close, tokens_.end()));
    }
    take("}");
    if (row.op == Op::split && row.braces == Braces::cells && is_here("*")) {
      ++at_;
      Part group;
      group.is_group = true;
      group.offset = step.offset;
      group.first_part = static_cast<std::uint32_t>(grammar_.parts.size());
      group.part_count = static_cast<std::uint32_t>(parts.size());
      grammar_.parts.insert(grammar_.parts.end(), parts.begin(), parts.end());
      parts.assign(1, group);
    }
  }
  add_parts(step, parts);
  out.push_back(step);
}

bool Parser::arguments(const OperationRow& row, std::vector<Argument>& out, Step& step,
                       std::vector<Part>& cells) {
  const std::size_t close = tokens_.partner(at_);
  ++at_;
  std::size_t mandatory = row.arguments.find('|');
  std::string kinds;
  for (const char c : row.arguments) {
    if (c != '|') kinds += c;
  }
  if (mandatory == std::string_view::npos) mandatory = kinds.size();
  const bool has_sizes = row.braces == Braces::names;
  while (at_ < close) {
    const std::size_t before = at_;
    if (has_sizes && out.size() == 1) {
      size_list(cells);
      break;
    }
    if (out.size() < kinds.size())
      out.push_back(argument(kinds[out.size()]));
    else
      ++at_;
    if (at_ == before) break;
    if (!take(",")) break;
    if (at_ >= close && has_sizes) break;
  }
  const bool is_short =
      out.size() < mandatory || (row.op == Op::color && out.size() > 1 && out.size() != 4 && out.size() != 3);
  if (at_ < close || is_short) {
    fault(is_short && at_ >= close ? tokens_.at(close) : here(),
          lang::in_quotes(row.name) + " takes (" + std::string(row.parameters) + "), found " +
              (is_short ? std::to_string(out.size()) + " of them" : in_quotes(here())));
  }
  at_ = std::min(close + 1, tokens_.end());
  (void)step;
  return true;
}

Argument Parser::word_argument() {
  Argument argument;
  const Token& token = here();
  if (token.kind == TokenKind::string) {
    argument.word = word_of(lang::string_value(token));
    ++at_;
  } else if (token.kind == TokenKind::name) {
    std::string word(token.text);
    ++at_;
    while (is_here(".") && tokens_.at(at_ + 1).kind == TokenKind::name) {
      word += "." + std::string(tokens_.at(at_ + 1).text);
      at_ += 2;
    }
    argument.word = word_of(word);
  } else {
    fault(token, "found " + in_quotes(token) + ", expected a word");
  }
  return argument;
}

Argument Parser::argument(char kind) {
  if (kind == 'w') return word_argument();
  Argument argument;
  if (take("'"))
    argument.measure = Measure::relative;
  else if (take("~"))
    argument.measure = Measure::floating;
  argument.value = value();
  const Token& behind = here();
  const Token& last = tokens_.at(at_ > 0 ? at_ - 1 : 0);
  if (behind.kind == TokenKind::name && behind.text == "r" && behind.offset == last.offset + last.length) {
    argument.measure = Measure::floating;
    ++at_;
  }
  return argument;
}

/// "X", x, "YS": the axis of a split, and whether it listens to snap lines.
void Parser::settle_axis(const OperationRow& row, Step& step, const std::vector<Argument>& list) {
  if (list.empty() || list[0].word == none) return;
  const std::string& word = grammar_.words[list[0].word];
  if (row.op == Op::split || row.op == Op::repeat) {
    const char letter = word.empty() ? ' ' : static_cast<char>(word[0] | 0x20);
    const bool listens = word.size() == 2 && word[1] == 'S';
    if (letter < 'x' || letter > 'z' || (word.size() != 1 && !listens)) {
      fault(tokens_.at(at_ - 1), "found the axis " + lang::in_quotes(word) + ", expected x, y or z");
      return;
    }
    step.axis = static_cast<std::uint8_t>(letter - 'x');
    step.listens = listens;
    grammar_.listens_to_snaps |= listens;
    step.is_2006 = row.op == Op::repeat;
    if (list.size() > 1 && list[1].word != none) {
      step.keeps_slab = grammar_.words[list[1].word] == "noAdjust";
      if (!step.keeps_slab && grammar_.words[list[1].word] != "adjust")
        fault(tokens_.at(at_ - 1),
              "found " + lang::in_quotes(grammar_.words[list[1].word]) + ", expected adjust or noAdjust");
    }
  } else if (row.op == Op::center || row.op == Op::snap) {
    for (const char c : word) {
      const int axis = (c | 0x20) - 'x';
      if (axis < 0 || axis > 2) {
        fault(tokens_.at(at_ - 1), "found " + lang::in_quotes(word) + ", expected axes out of x, y and z");
        return;
      }
      step.axis = static_cast<std::uint8_t>(step.axis | (1U << static_cast<unsigned>(axis)));
    }
  } else if (row.op == Op::comp && row.braces == Braces::selectors) {
    constexpr std::string_view kinds[] = {"f", "e", "v"};
    const auto* const found = std::ranges::find(kinds, word);
    if (found == std::end(kinds))
      fault(tokens_.at(at_ - 1), "found " + lang::in_quotes(word) + ", expected f, e or v");
    else
      step.axis = static_cast<std::uint8_t>(found - std::begin(kinds));
  }
}

/// size : successor | { ... }* | ...
void Parser::cells(std::vector<Part>& out) {
  do {
    Part part;
    part.offset = offset_here();
    if (is_here("{")) {
      if (!enter(here())) return;
      ++at_;
      std::vector<Part> inner;
      cells(inner);
      --depth_;
      expect("}", "the cells");
      if (!take("*")) fault(here(), "found " + in_quotes(here()) + ", expected `*` after the group");
      part.is_group = true;
      part.first_part = static_cast<std::uint32_t>(grammar_.parts.size());
      part.part_count = static_cast<std::uint32_t>(inner.size());
      grammar_.parts.insert(grammar_.parts.end(), inner.begin(), inner.end());
    } else {
      part.size = argument('n');
      expect(":", "the size");
      part.body = body();
    }
    out.push_back(part);
  } while (take("|"));
}

/// 3.5, 1r, { 2, 1r }*
void Parser::size_list(std::vector<Part>& out) {
  do {
    Part part;
    part.offset = offset_here();
    if (is_here("{")) {
      if (!enter(here())) return;
      ++at_;
      std::vector<Part> inner;
      size_list(inner);
      --depth_;
      expect("}", "the sizes");
      if (!take("*")) fault(here(), "found " + in_quotes(here()) + ", expected `*` after the group");
      part.is_group = true;
      part.part_count = static_cast<std::uint32_t>(inner.size());
      part.first_part = static_cast<std::uint32_t>(grammar_.parts.size());
      grammar_.parts.insert(grammar_.parts.end(), inner.begin(), inner.end());
    } else {
      part.size = argument('n');
    }
    out.push_back(part);
  } while (take(","));
}

void Parser::fill_bodies(std::vector<Part>& parts, const std::vector<std::uint32_t>& bodies,
                         std::size_t& next) {
  for (Part& part : parts) {
    if (part.is_group) {
      std::vector<Part> inner(grammar_.parts.begin() + part.first_part,
                              grammar_.parts.begin() + part.first_part + part.part_count);
      fill_bodies(inner, bodies, next);
      std::ranges::copy(inner, grammar_.parts.begin() + part.first_part);
    } else {
      if (next < bodies.size()) part.body = bodies[next];
      ++next;
    }
  }
}

/// front : A | side = B | 3 : C
void Parser::selectors(std::vector<Part>& out) {
  do {
    Part part;
    part.offset = offset_here();
    if (tokens_.is_name(at_, "street") && tokens_.is(at_ + 1, "."))
      at_ += 2;  // a lot without streets: its own sides
    const Token& token = here();
    if (token.kind == TokenKind::name && (token.text == "remainder" || token.text == "shape")) {
      part.is_remainder = token.text == "remainder";
      part.classes = part.is_remainder ? 0U : static_cast<std::uint32_t>(face_all);
    } else if (token.kind == TokenKind::number) {
      part.classes = face_all;
      part.index = static_cast<std::int32_t>(std::clamp(token.number, 0.0, 1e9));
    } else {
      const auto* const found = std::ranges::find(class_names, token.text, &ClassName::name);
      if (token.kind != TokenKind::name || found == std::end(class_names))
        fault(token, "found " + in_quotes(token) +
                         ", expected a selector: front, back, left, right, side, top, bottom, "
                         "horizontal, aslant, vertical, nutant, all or a number");
      else
        part.classes = found->classes;
    }
    ++at_;
    if (take("="))
      part.is_merged = true;
    else
      expect(":", "the selector");
    part.body = body();
    out.push_back(part);
  } while (take("|"));
}

/// Comp("sidefaces"), Comp("edge", 3)
void Parser::old_selectors(Step& step, const std::vector<Argument>& list, std::vector<Part>& out) {
  Part part;
  part.offset = step.offset;
  const std::string word = list.empty() || list[0].word == none ? "" : grammar_.words[list[0].word];
  const auto* const found = std::ranges::find(old_names, std::string_view(word), &ClassName::name);
  if (found == std::end(old_names)) {
    if (!word.empty())
      fault(tokens_.at(at_ > 0 ? at_ - 1 : 0), "found the component " + lang::in_quotes(word) +
                                                   ", expected faces, sidefaces, topfaces, bottomfaces, "
                                                   "edges, topedges, bottomedges, sideedges or vertices");
  } else {
    part.classes = found->classes;
  }
  step.axis = word.find("edge") != std::string::npos ? 1 : word.find("vert") == 0 ? 2 : 0;
  if (list.size() > 1) {
    if (!list[1].value.expression.is_constant)
      fault(tokens_.at(at_ - 1), "the number of a component is a constant");
    part.index = static_cast<std::int32_t>(std::clamp(list[1].value.expression.value, 0.0, 1e9));
  }
  out.push_back(part);
}

void Parser::add_parts(Step& step, const std::vector<Part>& parts) {
  step.first_part = static_cast<std::uint32_t>(grammar_.parts.size());
  step.part_count = static_cast<std::uint32_t>(parts.size());
  grammar_.parts.insert(grammar_.parts.end(), parts.begin(), parts.end());
}

}  // namespace seedmesh::building
