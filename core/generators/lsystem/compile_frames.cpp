/// Compiles frames:
///
///   frame = name | "frame" "(" ")" | "copy" "(" frame ")" | "translate" "(" frame "," x "," y "," z ")"
///         | "rotate_x" "(" frame "," degrees ")" | "rotate_y" ... | "rotate_z" ...
///         | "scale" "(" frame "," factor [ "," factor "," factor ] ")" ;
#include <algorithm>
#include <array>

#include "core/generators/lsystem/compilation.h"

namespace seedmesh::lsystem {
namespace {

using Move = FrameExpression::Move;

struct MoveRow {
  std::string_view name;
  Move move;
  std::size_t least, most;  ///< numbers after the frame
};
constexpr std::array<MoveRow, 5> moves = {{{"translate", Move::translate, 3, 3},
                                           {"rotate_x", Move::rotate_x, 1, 1},
                                           {"rotate_y", Move::rotate_y, 1, 1},
                                           {"rotate_z", Move::rotate_z, 1, 1},
                                           {"scale", Move::scale, 1, 3}}};
constexpr std::size_t most_parts = 100;
constexpr std::size_t longest_frame = 10'000;  // bytes; every nesting level scans the rest

/// Returns the slices between the commas of text[open + 1, close).
std::vector<Slice> parts_between(std::string_view text, std::size_t open, std::size_t close) {
  std::vector<Slice> parts;
  std::size_t from = open + 1;
  int depth = 0;
  for (std::size_t i = from; i <= close; ++i) {
    if (text[i] == '(') ++depth;
    if (text[i] == ')' && i != close) --depth;
    if (i != close && (depth > 0 || text[i] != ',')) continue;
    parts.push_back({from, i});
    from = i + 1;
  }
  return parts;
}

}  // namespace

/// Walks from the outermost move inwards; the moves are executed from the innermost outwards.
lang::Expression compile_frame(Compilation& c, Source& source, Slice slice) {
  const std::string_view text = source.text;
  FrameExpression made;
  const auto add_error = [&](std::size_t at, std::string message) {
    source.errors.push_back({at, std::move(message)});
  };
  for (std::size_t level = 0;; ++level) {
    if (level > 2 * most_parts || slice.to - slice.from > longest_frame) {
      add_error(slice.from, "found a frame of more than 200 nested moves or 10,000 characters");
      break;
    }
    const std::size_t at = skip_spaces(text, slice.from, slice.to);
    std::size_t end = at;
    while (end < slice.to && text[end] != '(' && text[end] != ' ' && text[end] != ',') ++end;
    const std::string_view name = text.substr(at, end - at);
    const std::size_t open = skip_spaces(text, end, slice.to);
    if (open == slice.to) {
      const auto known = c.frame_slots.find(name);
      if (known == c.frame_slots.end()) {
        add_error(at, "found " + lang::in_quotes(name) + "; expected a frame parameter or frame()");
      } else {
        made.slot = known->second;
      }
      break;
    }
    const std::size_t close = text[open] == '(' ? source.marks_of_text().closing(open, slice.to) : slice.to;
    if (close == slice.to || skip_spaces(text, close + 1, slice.to) < slice.to) {
      add_error(open, "expected a frame, as in translate(f, 0, 1, 0)");
      break;
    }
    const std::vector<Slice> parts = parts_between(text, open, close);
    const bool nothing = parts.size() == 1 && skip_spaces(text, parts[0].from, parts[0].to) == parts[0].to;
    if (name == "frame") {
      if (!nothing) add_error(open, "found parameters; frame() takes none");
      break;
    }
    const auto* const row =
        std::find_if(moves.begin(), moves.end(), [&](const MoveRow& each) { return each.name == name; });
    const std::size_t numbers = parts.size() - 1;
    const bool counts = row != moves.end() && (numbers == row->least || numbers == row->most);
    if (name != "copy" && row == moves.end()) {
      add_error(at, "found " + lang::in_quotes(name) +
                        "; expected frame, copy, translate, rotate_x, rotate_y, rotate_z or scale");
      break;
    }
    if ((name == "copy" && numbers != 0) || (name != "copy" && !counts) || made.parts.size() == most_parts) {
      add_error(
          at, "found " + std::to_string(numbers) + " numbers after the frame of `" + std::string(name) + "`");
      break;
    }
    if (row != moves.end()) {
      FrameExpression::Part part{row->move, {}};
      for (std::size_t i = 0; i < numbers; ++i) part.by[i] = compile_expression(c, source, parts[i + 1]);
      if (row->move == Move::scale && numbers == 1) part.by[1] = part.by[2] = part.by[0];
      made.parts.push_back(part);
    }
    slice = parts[0];
  }
  std::reverse(made.parts.begin(), made.parts.end());
  lang::Expression index;
  index.is_constant = true;
  index.value = static_cast<double>(c.grammar.frames.size());
  c.grammar.frames.push_back(std::move(made));
  return index;
}

}  // namespace seedmesh::lsystem
