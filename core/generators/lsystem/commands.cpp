#include "core/generators/lsystem/commands.h"

namespace seedmesh::lsystem {
namespace {

constexpr CommandRow rows[] = {
    {"F", Command::draw, "[(length)]", 0, 1,
     "Moves forward and draws an internode; inside braces it sets a polygon vertex instead. The default "
     "length is `step`.",
     "F(2)"},
    {"f", Command::move, "[(length)]", 0, 1,
     "Moves forward without drawing; inside braces it sets a polygon vertex.", "Ff(0.5)F"},
    {"G", Command::draw_plain, "[(length)]", 0, 1,
     "Moves forward and draws an internode; inside braces it only moves and sets no vertex.", "G(2)"},
    {"g", Command::move_plain, "[(length)]", 0, 1, "Moves forward, draws nothing and sets no vertex.",
     "Fg(1)F"},
    {"+", Command::left, "[(degrees)]", 0, 1, "Turns left, about up.", "F+(30)F"},
    {"-", Command::right, "[(degrees)]", 0, 1, "Turns right, about up.", "F-(30)F"},
    {"&", Command::down, "[(degrees)]", 0, 1, "Pitches down, about left.", "F&(30)F"},
    {"^", Command::up, "[(degrees)]", 0, 1, "Pitches up, about left.", "F^(30)F"},
    {"\\", Command::roll_left, "[(degrees)]", 0, 1, "Rolls left, about heading.", "F\\(30)+F"},
    {"/", Command::roll_right, "[(degrees)]", 0, 1, "Rolls right, about heading.", "F/(30)+F"},
    {"|", Command::turn_around, "", 0, 0, "Turns around by 180 degrees, about up.", "F+(20)|F"},
    {"$", Command::upright, "", 0, 0,
     "Rolls about heading until left is horizontal and up points as high as possible.", "&(30)/(40)$F"},
    {"@v", Command::upright, "", 0, 0, "Same as $.", "&(30)/(40)@vF"},
    {"[", Command::push, "", 0, 0, "Opens a branch: stores the state of the turtle.", "F[+F]F"},
    {"]", Command::pop, "", 0, 0,
     "Closes a branch: restores the state that was stored when the branch opened.", "F[-F]F"},
    {"{", Command::polygon_open, "", 0, 0,
     "Opens a filled polygon. Polygons can nest and can cross branches.", "{.f+(120)f+(120)f}"},
    {"}", Command::polygon_close, "", 0, 0, "Closes the polygon that was opened last.", "{.f+(90)f+(90)f}"},
    {".", Command::vertex, "", 0, 0, "Sets a vertex of the open polygon at the position of the turtle.",
     "{.g.+(90)g.}"},
    {"!", Command::width_down, "[(width)]", 0, 1,
     "Sets the width; without a parameter, subtracts `width_decrement`.", "!(0.2)F"},
    {"#", Command::width_up, "[(width)]", 0, 1,
     "Sets the width; without a parameter, adds `width_decrement`.", "#(0.2)F"},
    {"'", Command::color_next, "", 0, 0, "Selects the next colour index.", "F'F"},
    {";", Command::color_up, "[(index)]", 0, 1, "Sets the colour index; without a parameter, adds 1.",
     ";(2)F"},
    {",", Command::color_down, "[(index)]", 0, 1, "Sets the colour index; without a parameter, subtracts 1.",
     ";(2)F,F"},
    {"~", Command::organ, "name[(scale)]", 0, 3,
     "Adds an organ: the entry of `surfaces` with this name, scaled by `scale` or by three scales "
     "(across, along, up).",
     "F~leaf(2)"},
    {"@Gs", Command::sweep_begin, "", 0, 0,
     "Starts a generalized cylinder, a limb along a smooth curve. The first control point is the position "
     "of the turtle.",
     "@GsF+(40)F@Ge"},
    {"@Gc", Command::sweep_control, "[(strips)]", 0, 1,
     "Sets a control point of the generalized cylinder and draws up to it in `strips` internodes (default "
     "8). F sets one too.",
     "@Gsf&(30)f@Gc(5)@Ge"},
    {"@Ge", Command::sweep_end, "", 0, 0,
     "Sets the last control point of the generalized cylinder and ends it.", "@Gsf(2)@Ge"},
    {"@#", Command::contour, "(number)", 1, 1,
     "Selects the cross-section: 0 for a circle, or an entry of `contours` counted from 1. Along a limb, "
     "cross-sections blend.",
     "@Gs@#(0)f(2)@Ge"},
    {"%", Command::cut, "", 0, 0, "Removes the rest of its branch in the step after it was written.",
     "F[+F%F]F"},
    {"@M", Command::move_to, "(x,y,z)", 3, 3,
     "Moves to a point without drawing. The point is in metres, relative to the start.", "@M(1,0,0)F"},
    {"@R", Command::set_heading, "(x,y,z)", 3, 3, "Sets the heading and rolls upright.", "@R(1,1,0)F"},
    {"@Ts", Command::elasticity_set, "([tropism,]elasticity)", 1, 2,
     "Sets how strongly a tropism bends this branch. Tropisms are counted from 0; the default is the "
     "first.",
     "@Ts(0.3)F+FF"},
    {"@T", Command::elasticity_up, "[(tropism)]", 0, 1,
     "Adds the `step` of a tropism to its elasticity. The default is the first tropism.", "@TF+F@TF"},
    {"@Td", Command::elasticity_down, "[(tropism)]", 0, 1,
     "Subtracts the `step` of a tropism from its elasticity. The default is the first tropism.", "@TF+F@TdF"},
    {"@V", Command::reset_frame, "", 0, 0, "Restores the heading, left and up directions of the start.",
     "F&(70)/(40)F@VF"},
    {"@D", Command::set_scale, "(scale)", 1, 1, "Sets the scale of all following lengths.", "F@D(0.5)F"},
    {"@Di", Command::multiply_scale, "(factor)", 1, 1, "Multiplies the scale of lengths.", "F@Di(0.5)F"},
    {"@Dd", Command::divide_scale, "(divisor)", 1, 1, "Divides the scale of lengths.", "F@Dd(2)F"},
    {"@w", Command::multiply_width, "(factor)", 1, 1, "Multiplies the width.", "F@w(0.7)F"},
    {"@a", Command::multiply_turns, "(factor)", 1, 1,
     "Multiplies the turns of the following symbols that have no parameter.", "F+F@a(0.5)+F"},
    {"@-", Command::mirror, "", 0, 0,
     "Exchanges left and right (+ and -, \\ and /) until the next @- or the end of the branch.", "[+F]@-+F"},
    {"?P", Command::ask_position, "(x,y,z)", 3, 3,
     "Queries the position of the turtle. The query replaces its parameters between two steps.",
     "F?P(0,0,0)F"},
    {"?H", Command::ask_heading, "(x,y,z)", 3, 3, "Queries the heading of the turtle.", "+F?H(0,0,0)F"},
    {"?L", Command::ask_left, "(x,y,z)", 3, 3, "Queries the left direction of the turtle.", "+F?L(0,0,0)F"},
    {"?U", Command::ask_up, "(x,y,z)", 3, 3, "Queries the up direction of the turtle.", "&F?U(0,0,0)F"},
    {"?E", Command::ask_surroundings, "(step[,now[,then[,light[,x,y,z]]]])", 1, 7,
     "Queries the environment. `step` becomes 1 where a step of that length along the heading is free, "
     "else 0. `now` and `then` become the distances to the surface before and after the step, negative "
     "inside an obstacle. `light` becomes 0 to 1, and x, y, z the direction to the surface.",
     "F?E(1)F"},
    {"@A", Command::enter_frame, "(frame)", 12, 12,
     "Moves to a frame: to its origin, with its y axis as heading and the length of y as scale.",
     "@A(translate(frame(), 1, 0, 0))F"},
    {"@F", Command::draw_frame, "(frame)", 12, 12,
     "Draws an internode from the origin of a frame along its y axis, with the length of y and the width "
     "of x. The turtle stays.",
     "@F(scale(frame(), 0.2, 1, 0.2))"},
    {"@N", Command::place_object, "(object[,scale])", 1, 4,
     "Adds the organ that a parameter refers to: `object` is the name of an entry of `surfaces`, or a "
     "parameter with "
     "such a value. One scale, or three, as for `~name`.",
     "F@N(leaf)"},
    {"@Nf", Command::place_in_frame, "(frame,object)", 13, 13,
     "Adds the organ that a parameter refers to in a frame, with the lengths of its axes as scales. The "
     "turtle stays.",
     "@Nf(translate(frame(), 0, 1, 0), leaf)"},
};

}  // namespace

std::span<const CommandRow> commands() { return rows; }

Command command_of(std::string_view symbol, std::uint32_t arity) {
  for (const CommandRow& row : rows) {
    if (row.symbol == symbol && arity >= row.least) return row.command;
  }
  return Command::none;
}

}  // namespace seedmesh::lsystem
