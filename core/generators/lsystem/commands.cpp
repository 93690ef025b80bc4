#include "core/generators/lsystem/commands.h"

namespace seedmesh::lsystem {
namespace {

constexpr CommandRow rows[] = {
    {"F", Command::draw, "[(length)]", 0, 1,
     "Moves forward and draws an internode; between braces sets a polygon vertex instead. Bare: by `step`.",
     "F(2)"},
    {"f", Command::move, "[(length)]", 0, 1,
     "Moves forward without drawing; between braces sets a polygon vertex.", "Ff(0.5)F"},
    {"G", Command::draw_plain, "[(length)]", 0, 1,
     "Moves forward and draws an internode; between braces moves only and sets no vertex.", "G(2)"},
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
     "Rolls about heading until left is horizontal and up points as high as it can.", "&(30)/(40)$F"},
    {"@v", Command::upright, "", 0, 0, "The same as $.", "&(30)/(40)@vF"},
    {"[", Command::push, "", 0, 0, "Opens a branch: remembers the turtle.", "F[+F]F"},
    {"]", Command::pop, "", 0, 0, "Closes a branch: the turtle goes back to where the branch opened.",
     "F[-F]F"},
    {"{", Command::polygon_open, "", 0, 0,
     "Opens a filled polygon; polygons may nest and may cross branches.", "{.f+(120)f+(120)f}"},
    {"}", Command::polygon_close, "", 0, 0, "Closes the polygon opened last.", "{.f+(90)f+(90)f}"},
    {".", Command::vertex, "", 0, 0, "Sets a vertex of the open polygon here.", "{.g.+(90)g.}"},
    {"!", Command::width_down, "[(width)]", 0, 1, "Sets the width, or bare: takes `width_decrement` off it.",
     "!(0.2)F"},
    {"#", Command::width_up, "[(width)]", 0, 1, "Sets the width, or bare: adds `width_decrement` to it.",
     "#(0.2)F"},
    {"'", Command::color_next, "", 0, 0, "Goes to the next colour index.", "F'F"},
    {";", Command::color_up, "[(index)]", 0, 1, "Sets the colour index, or bare: adds 1.", ";(2)F"},
    {",", Command::color_down, "[(index)]", 0, 1, "Sets the colour index, or bare: takes 1 off.", ";(2)F,F"},
    {"~", Command::organ, "name[(scale)]", 0, 3,
     "Places the organ that `surfaces` calls so, `scale` times as large; or (across, along, up) three "
     "scales.",
     "F~leaf(2)"},
    {"@Gs", Command::sweep_begin, "", 0, 0,
     "Begins a generalized cylinder, a limb along a smooth curve, whose first control point is here.",
     "@GsF+(40)F@Ge"},
    {"@Gc", Command::sweep_control, "[(strips)]", 0, 1,
     "Sets a control point of the generalized cylinder here and draws up to it, in so many internodes (8); F "
     "sets "
     "one too.",
     "@Gsf&(30)f@Gc(5)@Ge"},
    {"@Ge", Command::sweep_end, "", 0, 0,
     "Sets the last control point of the generalized cylinder here and ends it.", "@Gsf(2)@Ge"},
    {"@#", Command::contour, "(number)", 1, 1,
     "Chooses the cross-section from here on: number so and so of `contours`, 0 the circle; limbs blend one "
     "into "
     "the next.",
     "@Gs@#(0)f(2)@Ge"},
    {"%", Command::cut, "", 0, 0, "Cuts the rest of its branch away in the step after it was written.",
     "F[+F%F]F"},
    {"@M", Command::move_to, "(x,y,z)", 3, 3, "Moves to a point, in metres from the start, without drawing.",
     "@M(1,0,0)F"},
    {"@R", Command::set_heading, "(x,y,z)", 3, 3, "Sets the heading and rolls upright.", "@R(1,1,0)F"},
    {"@Ts", Command::elasticity_set, "([tropism,]elasticity)", 1, 2,
     "Sets how strongly a tropism bends this branch; tropisms count from 0, and the first is meant where "
     "none is named.",
     "@Ts(0.3)F+FF"},
    {"@T", Command::elasticity_up, "[(tropism)]", 0, 1,
     "Adds the tropism's `step` to its elasticity; bare: that of the first.", "@TF+F@TF"},
    {"@Td", Command::elasticity_down, "[(tropism)]", 0, 1,
     "Takes the tropism's `step` off its elasticity; bare: that of the first.", "@TF+F@TdF"},
    {"@V", Command::stand_up, "", 0, 0,
     "Sets the turtle upright: heading, left and up are those of the start.", "F&(70)/(40)F@VF"},
    {"@D", Command::set_scale, "(scale)", 1, 1, "Sets the scale of all lengths that follow.", "F@D(0.5)F"},
    {"@Di", Command::multiply_scale, "(factor)", 1, 1, "Multiplies the scale of lengths.", "F@Di(0.5)F"},
    {"@Dd", Command::divide_scale, "(divisor)", 1, 1, "Divides the scale of lengths.", "F@Dd(2)F"},
    {"@w", Command::multiply_width, "(factor)", 1, 1, "Multiplies the width.", "F@w(0.7)F"},
    {"@a", Command::multiply_turns, "(factor)", 1, 1, "Multiplies the turns of bare symbols that follow.",
     "F+F@a(0.5)+F"},
    {"@-", Command::mirror, "", 0, 0, "Exchanges left and right: + and -, \\ and /, until the next one.",
     "[+F]@-+F"},
    {"?P", Command::ask_position, "(x,y,z)", 3, 3,
     "Asks where the turtle is: between two steps its parameters become the position.", "F?P(0,0,0)F"},
    {"?H", Command::ask_heading, "(x,y,z)", 3, 3, "Asks for the turtle's heading.", "+F?H(0,0,0)F"},
    {"?L", Command::ask_left, "(x,y,z)", 3, 3, "Asks for the turtle's left.", "+F?L(0,0,0)F"},
    {"?U", Command::ask_up, "(x,y,z)", 3, 3, "Asks for the turtle's up.", "&F?U(0,0,0)F"},
    {"?E", Command::ask_surroundings, "(step[,now[,then[,light[,x,y,z]]]])", 1, 7,
     "Asks the environment: `step` becomes 1 where a step of that length along the heading is free, else 0; "
     "`now` and `then` the room to the surface here and after the step, negative past it; `light` 0 to 1; x, "
     "y, "
     "z the direction to the surface.",
     "F?E(1)F"},
    {"@A", Command::enter_frame, "(frame)", 12, 12,
     "Goes to a frame: its origin, its y as heading, and the length of y as scale.",
     "@A(translate(frame(), 1, 0, 0))F"},
    {"@F", Command::draw_frame, "(frame)", 12, 12,
     "Draws an internode from a frame's origin along its y, as long as y and as thick as x, and stays where "
     "it is.",
     "@F(scale(frame(), 0.2, 1, 0.2))"},
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
