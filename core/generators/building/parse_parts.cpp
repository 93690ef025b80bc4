/// What stands in braces behind an operation: cells of a split, selectors of a component split; and its axis.
#include <algorithm>

#include "core/generators/building/parser.h"

namespace seedmesh::building {
namespace {

using lang::Token;
using lang::TokenKind;

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

}  // namespace

/// "X", x, "YS": the axis of a split, and whether it listens to snap lines.
void Parser::settle_axis(const OperationRow& row, Step& step, const std::vector<Argument>& list) {
  if (list.empty() || list[0].word == none) return;
  const std::string& word = grammar_.words[list[0].word];
  if (row.op == Op::split || row.op == Op::split_area || row.op == Op::repeat) {
    if (row.op == Op::split && (word == "u" || word == "v")) return settle_texture_axis(step, list);
    const char letter = word.empty() ? ' ' : static_cast<char>(word[0] | 0x20);
    const bool listens = row.op != Op::split_area && word.size() == 2 && word[1] == 'S';
    if (letter < 'x' || letter > 'z' || (word.size() != 1 && !listens)) {
      fault(tokens_.at(at_ - 1),
            "found the axis " + lang::in_quotes(word) +
                (row.op == Op::split ? ", expected x, y, z, u or v" : ", expected x, y or z"));
      return;
    }
    step.axis = static_cast<std::uint8_t>(letter - 'x');
    if (list.size() > 2 && row.op == Op::split)
      fault(tokens_.at(at_ - 1), "a set of texture coordinates goes with the axes u and v");
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

/// split(u), split(v, unitSpace, 0)
void Parser::settle_texture_axis(Step& step, const std::vector<Argument>& list) {
  step.axis = grammar_.words[list[0].word] == "u" ? axis_u : axis_v;
  if (list.size() > 1 && list[1].word != none) {
    const std::string& space = grammar_.words[list[1].word];
    step.in_metres = space == "unitSpace";
    if (!step.in_metres && space != "uvSpace")
      fault(tokens_.at(at_ - 1), "found " + lang::in_quotes(space) + ", expected uvSpace or unitSpace");
  }
  if (list.size() > 2 && (!list[2].value.expression.is_constant || list[2].value.expression.value != 0))
    fault(tokens_.at(at_ - 1), "there is one set of texture coordinates, number 0");
}

/// size : successor | { ... }* | ...  or, where the bodies stand apart,  3.5, 1r, { 2, 1r }*
void Parser::cells(std::vector<Part>& out, bool have_bodies) {
  do {
    Part part;
    part.offset = offset_here();
    if (is_here("{")) {
      if (!enter(here())) return;
      ++at_;
      std::vector<Part> inner;
      cells(inner, have_bodies);
      --depth_;
      expect("}", have_bodies ? "the cells" : "the sizes");
      if (!take("*")) fault(here(), "found " + in_quotes(here()) + ", expected `*` after the group");
      part.is_group = true;
      part.first_part = static_cast<std::uint32_t>(grammar_.parts.size());
      part.part_count = static_cast<std::uint32_t>(inner.size());
      grammar_.parts.insert(grammar_.parts.end(), inner.begin(), inner.end());
    } else {
      part.size = argument('n');
      if (have_bodies) {
        expect(":", "the size");
        part.body = body();
      }
    }
    out.push_back(part);
  } while (take(have_bodies ? "|" : ","));
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

}  // namespace seedmesh::building
