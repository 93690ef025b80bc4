#pragma once
/// The turtle symbols, one row each: the interpreter, the docs, GET /v1/vocabulary and the editor's
/// completion read the same table. Signs of the rotations are those measured in cpfg (Prusinkiewicz and
/// Lindenmayer, "The Algorithmic Beauty of Plants", 1990, names them): + left, - right, & down, ^ up, \ roll
/// left, / roll right.
#include <cstdint>
#include <span>
#include <string_view>

namespace seedmesh::lsystem {

enum class Command : std::uint8_t {
  none,
  draw,
  move,
  draw_plain,
  move_plain,
  left,
  right,
  down,
  up,
  roll_left,
  roll_right,
  turn_around,
  upright,
  push,
  pop,
  polygon_open,
  polygon_close,
  vertex,
  width_down,
  width_up,
  color_next,
  color_up,
  color_down,
  cut,
  move_to,
  set_heading,
  elasticity_set,
  elasticity_up,
  elasticity_down,
  stand_up,
  set_scale,
  multiply_scale,
  divide_scale,
  multiply_width,
  multiply_turns,
  mirror,
  ask_position,
  ask_heading,
  ask_left,
  ask_up,
  ask_surroundings,
  organ,
  sweep_begin,
  sweep_control,
  sweep_end,
  contour,
  enter_frame,
  draw_frame,
};

/// True for modules that ask and are answered between two steps.
constexpr bool asks(Command command) {
  return command >= Command::ask_position && command <= Command::ask_surroundings;
}

struct CommandRow {
  std::string_view symbol;
  Command command;
  std::string_view parameters;  ///< "(frame)", which is twelve numbers; or as a reader would write them: "",
                                ///< "(length)", ...; square brackets: optional
  std::uint32_t least, most;    ///< number of parameters understood
  std::string_view text;
  std::string_view example;  ///< an axiom that the tests draw
};

std::span<const CommandRow> commands();

/// The command of a symbol with so many parameters; Command::none where the turtle has no such symbol.
/// Parameters beyond those it understands are left to the grammar.
Command command_of(std::string_view symbol, std::uint32_t arity);

}  // namespace seedmesh::lsystem
