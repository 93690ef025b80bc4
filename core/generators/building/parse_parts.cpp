#include "core/generators/building/parse_parts.h"

#include <algorithm>

#include "core/generators/building/components.h"
#include "core/generators/building/parse_steps.h"
#include "core/generators/building/value_tree.h"

namespace seedmesh::building {
namespace {

using lang::Token;
using lang::TokenKind;
using Kind = ValueNode::Kind;

struct ClassName {
  std::string_view name;
  std::uint32_t classes;
};
constexpr ClassName names_2006[] = {
    {"faces", face_all},          {"face", face_all},          {"sidefaces", face_side},
    {"sideface", face_side},      {"topfaces", face_top},      {"topface", face_top},
    {"bottomfaces", face_bottom}, {"bottomface", face_bottom}, {"edges", face_all},
    {"edge", face_all},           {"topedges", face_top},      {"bottomedges", face_bottom},
    {"sideedges", face_side},     {"vertices", face_all},      {"vertex", face_all},
};

/// split(u), split(v, unitSpace, 0)
void read_texture_axis(Parser& p, Step& step, const std::vector<Argument>& list) {
  step.axis = p.grammar.words[list[0].word] == "u" ? axis_u : axis_v;
  if (list.size() > 1 && list[1].word != none) {
    const std::string& space = p.grammar.words[list[1].word];
    step.in_metres = space == "unitSpace";
    if (!step.in_metres && space != "uvSpace") add_wrong_word(p, space, "uvSpace or unitSpace");
  }
}

}  // namespace

void read_axis(Parser& p, const OperationRow& row, Step& step, const std::vector<Argument>& list) {
  if (list.empty() || list[0].word == none) return;
  const std::string& word = p.grammar.words[list[0].word];
  if (row.op == Op::split || row.op == Op::split_area || row.op == Op::repeat) {
    if (row.op == Op::split && (word == "u" || word == "v")) return read_texture_axis(p, step, list);
    const char letter = word.empty() ? ' ' : static_cast<char>(word[0] | 0x20);
    const bool keeps_to_snaps = row.op != Op::split_area && word.size() == 2 && word[1] == 'S';
    if (letter < 'x' || letter > 'z' || (word.size() != 1 && !keeps_to_snaps)) {
      add_error(p, p.tokens.at(p.at - 1),
                "found the axis " + lang::in_quotes(word) +
                    (row.op == Op::split ? ", expected x, y, z, u or v" : ", expected x, y or z"));
      return;
    }
    step.axis = static_cast<std::uint8_t>(letter - 'x');
    if (list.size() > 2 && row.op == Op::split) {
      add_error(p, p.tokens.at(p.at - 1),
                "found a set of texture coordinates, expected none with the axes x, y and z");
    }
    step.keeps_to_snaps = keeps_to_snaps;
    p.grammar.has_snap_splits |= keeps_to_snaps;
    step.is_2006 = row.op == Op::repeat;
    if (list.size() > 1 && list[1].word != none) {
      step.keeps_slab = p.grammar.words[list[1].word] == "noAdjust";
      if (!step.keeps_slab && p.grammar.words[list[1].word] != "adjust")
        add_wrong_word(p, p.grammar.words[list[1].word], "adjust or noAdjust");
    }
  } else if (row.op == Op::center || row.op == Op::snap) {
    for (const char c : word) {
      const int axis = (c | 0x20) - 'x';
      if (axis < 0 || axis > 2) {
        add_wrong_word(p, word, "axes out of x, y and z");
        return;
      }
      step.axis = static_cast<std::uint8_t>(step.axis | (1U << static_cast<unsigned>(axis)));
    }
  } else if ((row.op == Op::comp || row.op == Op::modify) && row.braces == Braces::selectors) {
    Token token = p.tokens.at(p.at > 0 ? p.at - 1 : 0);
    token.kind = TokenKind::name;
    token.text = word;
    step.axis = read_component(p, token);
  }
}

void parse_cells(Parser& p, std::vector<Part>& out, bool have_bodies) {
  do {
    Part part;
    part.offset = offset_here(p);
    if (is_here(p, "{")) {
      if (!enter_bracket(p, here(p))) return;
      ++p.at;
      std::vector<Part> inner;
      parse_cells(p, inner, have_bodies);
      --p.depth;
      expect(p, "}", have_bodies ? "the cells" : "the sizes");
      if (!take(p, "*")) {  // braces alone repeat nothing
        out.insert(out.end(), inner.begin(), inner.end());
        continue;
      }
      part.is_group = true;
      append_rows(p.grammar.parts, inner, part.first_part, part.part_count);
    } else {
      part.size = parse_argument(p, 'n');
      if (have_bodies) {
        expect(p, ":", "the size");
        part.body = parse_body(p);
      }
    }
    out.push_back(part);
  } while (take(p, have_bodies ? "|" : ","));
}

void assign_bodies(Parser& p, std::vector<Part>& parts, const std::vector<std::uint32_t>& bodies,
                   std::size_t& next) {
  for (Part& part : parts) {
    if (part.is_group) {
      std::vector<Part> inner(p.grammar.parts.begin() + part.first_part,
                              p.grammar.parts.begin() + part.first_part + part.part_count);
      assign_bodies(p, inner, bodies, next);
      std::ranges::copy(inner, p.grammar.parts.begin() + part.first_part);
    } else {
      if (next < bodies.size()) part.body = bodies[next];
      ++next;
    }
  }
}

std::uint8_t read_component(Parser& p, const Token& token) {
  constexpr std::string_view kinds[] = {"f", "e", "v", "fe", "fv", "g", "m", "h"};
  const auto* const found = std::ranges::find(kinds, token.text);
  if (token.kind == TokenKind::name && found != std::end(kinds))
    return static_cast<std::uint8_t>(found - std::begin(kinds));
  add_error(p, token, "found " + in_quotes(token) + ", expected f, e, v, fe, fv, g, m or h");
  return 0;
}

Part parse_selector(Parser& p) {
  Part part;
  part.offset = offset_here(p);
  const std::size_t from = p.at;
  std::size_t to = p.tokens.after_expression(from);
  // `front = A` is a selector and a sign, and no comparison.
  const Token& token = here(p);
  std::string dotted(token.text);
  std::size_t behind = from + 1;
  for (; p.tokens.is(behind, ".") && p.tokens.at(behind + 1).kind == TokenKind::name; behind += 2)
    dotted += "." + std::string(p.tokens.at(behind + 1).text);
  const bool is_plain = p.tokens.is(behind, ":") || p.tokens.is(behind, "=");
  part.word = word_index(p, dotted);
  if (is_plain && token.kind == TokenKind::name && (dotted == "remainder" || dotted == "shape")) {
    part.is_remainder = dotted == "remainder";
    part.classes = part.is_remainder ? 0U : static_cast<std::uint32_t>(face_all);
    to = behind;
  } else if (is_plain && token.kind == TokenKind::number) {
    part.classes = face_all;
    part.index = static_cast<std::int32_t>(std::clamp(token.number, 0.0, 1e9));
    to = from + 1;
  } else if (is_plain && token.kind == TokenKind::name && read_selector(dotted, part.classes, part.frame)) {
    to = behind;
  } else if (to == from || (is_plain && token.kind == TokenKind::name && p.names.find(dotted) == nullptr &&
                            !p.functions.contains(dotted) && !is_tree_name(dotted))) {
    add_error(p, token,
              "found " + in_quotes(token) +
                  ", expected a selector: front, back, left, right, side, top, bottom, horizontal, aslant, "
                  "vertical, nutant, inside, border, eave, hip, valley, ridge, all, one of them with world. "
                  "or object., isTagged(\"...\") or a number");
    to = std::max(behind, from + 1);
  } else {
    // A condition; a name or sum of numbers is the number of a component.
    part.condition.is_given = true;
    part.condition.offset = part.offset;
    part.condition.tree = parse_selector_tree(p, from, to);
    const Kind kind =
        p.grammar.value_nodes.empty() ? Kind::constant : p.grammar.value_nodes[part.condition.tree].kind;
    const bool is_number = kind == Kind::constant || kind == Kind::slot ||
                           (kind == Kind::binary &&
                            p.grammar.value_nodes[part.condition.tree].operation <= lang::Operation::power);
    if (is_number) part.index = -2;
    part.classes = face_all;
  }
  p.at = to;
  if (take(p, "=")) {
    part.is_merged = true;
    part.is_by_set = take(p, ":");
  } else {
    expect(p, ":", "the selector");
  }
  return part;
}

void parse_selectors(Parser& p, std::vector<Part>& out) {
  do {
    Part part = parse_selector(p);
    part.body = parse_body(p);
    out.push_back(part);
  } while (take(p, "|"));
}

void parse_selectors_2006(Parser& p, Step& step, const std::vector<Argument>& list, std::vector<Part>& out) {
  Part part;
  part.offset = step.offset;
  const std::string word = list.empty() || list[0].word == none ? "" : p.grammar.words[list[0].word];
  const auto* const found = std::ranges::find(names_2006, std::string_view(word), &ClassName::name);
  if (found == std::end(names_2006)) {
    if (!word.empty()) {
      add_error(p, p.tokens.at(p.at > 0 ? p.at - 1 : 0),
                "found the component " + lang::in_quotes(word) +
                    ", expected faces, sidefaces, topfaces, bottomfaces, edges, topedges, bottomedges, "
                    "sideedges or vertices");
    }
  } else {
    part.classes = found->classes;
  }
  step.axis = word.find("edge") != std::string::npos ? 1 : word.find("vert") == 0 ? 2 : 0;
  if (list.size() > 1) {
    if (!list[1].value.expression.is_constant) {
      add_error(p, p.tokens.at(p.at - 1),
                "found an expression, expected a constant for the number of a component");
    }
    part.index = static_cast<std::int32_t>(std::clamp(list[1].value.expression.value, 0.0, 1e9));
  }
  out.push_back(part);
}

void report_surplus(Parser& p, const OperationRow& row, std::size_t close) {
  const std::string message =
      lang::in_quotes(row.name) + " takes (" + std::string(row.parameters) + "), found ";
  if (row.status == Status::done && p.grammar.is_cityengine)
    add_warning(p, offset_here(p), message + "more, which has no effect");
  if (row.status == Status::done && !p.grammar.is_cityengine)
    add_error(p, here(p), message + "another argument");
  p.at = std::min(close + 1, p.tokens.end());
}

}  // namespace seedmesh::building
