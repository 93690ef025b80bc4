#pragma once
/// The table of turtle symbols, one row for each. The interpreter, the documentation, GET /v1/vocabulary and
/// the completion of the editor read it. The signs of rotations follow cpfg, with the names of Prusinkiewicz
/// and Lindenmayer, "The Algorithmic Beauty of Plants", 1990: + left, - right, & down, ^ up, \ roll left, /
/// roll right.
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
  reset_frame,
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
  place_object,
  place_in_frame,
};

/// Returns true for query modules, whose parameters are filled in between two steps.
constexpr bool is_query(Command command) {
  return command >= Command::ask_position && command <= Command::ask_surroundings;
}

struct CommandRow {
  std::string_view symbol;
  Command command;
  /// as written: "" or "(length)"; [] encloses optional ones; a frame has 12 numbers
  std::string_view parameters;
  std::uint32_t least, most;  ///< smallest and largest number of parameters
  std::string_view text;
  std::string_view example;  ///< an axiom that the tests draw
};

std::span<const CommandRow> commands();

/// Returns the command of a symbol with `arity` parameters, or Command::none where the turtle has no such
/// symbol. Surplus parameters are allowed and ignored.
Command command_of(std::string_view symbol, std::uint32_t arity);

}  // namespace seedmesh::lsystem
