/// Executes the turtle command of a module that no interpretation rule rewrites.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/base/quick_math.h"
#include "core/generators/lsystem/draw.h"
#include "core/generators/lsystem/materials.h"
#include "core/schema/json.h"

namespace seedmesh::lsystem {
namespace {

double length_of(const double* axis) {
  return std::sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
}

/// Returns true for commands that set a value which can change gradually, other than width and turns.
bool sets_pose(Command command) {
  switch (command) {
    case Command::upright:
    case Command::move_to:
    case Command::set_heading:
    case Command::elasticity_set:
    case Command::elasticity_up:
    case Command::elasticity_down:
    case Command::reset_frame:
    case Command::set_scale:
    case Command::multiply_scale:
    case Command::divide_scale:
    case Command::multiply_width:
    case Command::multiply_turns:
    case Command::mirror:
    case Command::enter_frame:
      return true;
    default:
      return false;
  }
}

math::SinCos opposite(math::SinCos angle) { return {-angle.sin, angle.cos}; }

}  // namespace

/// Interpolates between the random value of the module's predecessor and its own by `own_share`.
double Drawing::spread(const Keys& keys, Spread of, double amount, double own_share) {
  const double own = spread(keys.own, of, amount);
  if (keys.before == 0) return own;
  const double before = spread(keys.before, of, amount);
  return before + (own - before) * own_share;
}

/// Moves the turtle to a frame.
void Drawing::enter_frame(const double* parameters) {
  const auto axis = [&](int i) {
    return glm::dvec3(parameters[3 * i], parameters[3 * i + 1], parameters[3 * i + 2]);
  };
  const Frame start;
  turtle_.move_to(axis(3));
  turtle_.set_frame(
      {math::unit(axis(1), start.heading), math::unit(-axis(0), start.left), math::unit(axis(2), start.up)});
}

math::SinCos Drawing::turn(const Kind& kind, const double* parameters, const Angle& angle, Keys keys) {
  return turn(kind, parameters, angle, keys, turned_share());
}

/// Returns a turn to the left, or to the right for a mirrored turtle.
math::SinCos Drawing::leftward(const Kind& kind, const double* parameters, const Angle& angle, Keys keys) {
  const double side = turtle_.side();
  const math::SinCos turned = turn(kind, parameters, angle, keys, turned_share() * std::abs(side));
  return side < 0 ? opposite(turned) : turned;
}

math::SinCos Drawing::turn(const Kind& kind, const double* parameters, const Angle& angle, Keys keys,
                           double share) {
  double degrees = angle.degrees;
  if (kind.arity > 0) {
    degrees = parameters[0];
  } else if (params_.angle.spread > 0) {
    degrees = (degrees + spread(keys, Spread::angle, params_.angle.spread, growth_.own_share)) *
              turtle_.turn_scale();
  } else if (turtle_.turn_scale() != 1) {
    degrees *= turtle_.turn_scale();
  } else if (share == 1) {
    return angle.bare;
  }
  return math::quick_sincos_degrees(degrees * share);
}

/// A scale or width that is not finite would cause errors only much later.
double Drawing::finite(double value, const Kind& kind, const double* parameters) const {
  if (!(std::abs(value) < 1e100)) refuse(kind, parameters, "makes a scale or width infinite");
  return value;
}

double Drawing::length(const Kind& kind, const double* parameters, Keys keys) const {
  const double scale = growth_.share * turtle_.scale();
  if (kind.arity > 0) return scale * parameters[0];
  if (params_.step.spread == 0) return scale * params_.step.value;
  const double length =
      params_.step.value + spread(keys, Spread::step, params_.step.spread, growth_.own_share);
  return length > 0 ? scale * length : 0;
}

void Drawing::set_width(const Kind& kind, const double* parameters, double change) {
  const double width = turtle_.width();
  const double wanted = kind.arity > 0 ? parameters[0] : width + change;
  turtle_.set_width(growth_.share == 1 ? wanted : width + growth_.share * (wanted - width));
}

void Drawing::set_contour(const Kind& kind, const double* parameters) {
  const std::int64_t wanted = math::to_int64(parameters[0]);
  const auto count = static_cast<std::int64_t>(params_.contours.size());
  if (wanted < 0 || wanted > count) {
    refuse(kind, parameters,
           "found the contour " + std::to_string(wanted) + "; expected 0 (circle) to " +
               std::to_string(count) + " (last of `contours`)");
  }
  turtle_.set_contour(static_cast<std::uint8_t>(wanted));
}

/// Reads one scale, or one for each direction: across, along and above the organ.
void Drawing::add_organ(const Kind& kind, const double* parameters, std::uint64_t key) {
  if (kind.surface == Kind::none) return;
  glm::dvec3 scale(kind.arity > 0 ? parameters[0] : 1);
  if (kind.arity > 2) scale = {parameters[0], parameters[1], parameters[2]};
  place_organ(kind, parameters, kind.surface, scale, key);
}

/// Adds the organ that a parameter refers to.
void Drawing::place_object(const Kind& kind, const double* parameters, double object, const glm::dvec3& scale,
                           std::uint64_t key) {
  const bool is_known =
      object >= 0 && object < static_cast<double>(surfaces_.size()) && object == std::floor(object);
  if (!is_known) {
    refuse(kind, parameters,
           "found " + number_text(object) + " as an object, expected the name of an entry of `surfaces`");
  }
  place_organ(kind, parameters, static_cast<std::uint32_t>(object), scale, key);
}

void Drawing::place_organ(const Kind& kind, const double* parameters, std::uint32_t number, glm::dvec3 scale,
                          std::uint64_t key) {
  const LsystemSurface& surface = *surfaces_[number];
  scale *= surface.size * turtle_.scale() * growth_.share;
  scale.x *= surface.width;
  constexpr double largest = 1e9;
  if (!(std::max({scale.x, scale.y, scale.z}) < largest)) {
    refuse(kind, parameters, "the organ is larger than 1e9 metres");
  }
  // In the first colour of the palette, that of bark, leaves would be brown.
  const bool is_bark = surface.color < 0 && params_.materials.empty() && turtle_.color() == 0;
  const std::int32_t color = is_bark ? palette_color_of(surface.shape) : surface.color;
  if (scale.x > 0 && scale.y > 0 && scale.z > 0) turtle_.place_organ(number, scale, color, key);
}

void Drawing::close_polygon(std::uint64_t key) {
  if (open_polygons_ > 0) {
    --open_polygons_;
  } else {
    ++stray_closings_;
  }
  turtle_.close_polygon(key);
}

void Drawing::execute(const Kind& kind, const double* parameters, Keys keys) {
  follow(kind, parameters, keys);
  if (turtle_.is_out_of_range()) refuse(kind, parameters, Turtle::too_far);
}

/// Refuses the request because of a module, and points to the text that writes such modules.
void Drawing::refuse(const Kind& kind, const double* parameters, const std::string& message) const {
  std::string module = kind.symbol;
  for (std::uint32_t i = 0; i < kind.arity; ++i) {
    char digits[32];
    const auto end =
        std::to_chars(digits, digits + sizeof digits, parameters[i], std::chars_format::general, 6);
    module += (i == 0 ? "(" : ",") + std::string(digits, end.ptr);
  }
  if (kind.arity > 0) module += ")";
  job_.refuse({IssueKind::evaluation, writer_of(grammar_, static_cast<KindId>(&kind - grammar_.kinds.data())),
               "`" + module + "`: " + message});
}

/// Interpolates what a symbol sets, and the bend of a segment, by the share of the module.
void Drawing::follow(const Kind& kind, const double* parameters, Keys keys) {
  if (growth_.share == 1) return execute_whole(kind, parameters, keys);
  turtle_.set_tropism_share(turned_share());
  if (!sets_pose(kind.command)) return execute_whole(kind, parameters, keys);
  const Turtle::Pose before = turtle_.pose();
  execute_whole(kind, parameters, keys);
  turtle_.interpolate_from(before, growth_.share, turned_share());
}

/// A growing polygon keeps its angles. Only the net turn that it leaves on the turtle is scaled.
void Drawing::begin_shape() {
  ++growth_.brackets;
  shapes_.push_back(turtle_.pose());
}

void Drawing::end_shape() {
  if (shapes_.empty()) return;
  --growth_.brackets;
  turtle_.interpolate_from(shapes_.back(), 1, turned_share());
  shapes_.pop_back();
}

void Drawing::execute_whole(const Kind& kind, const double* parameters, Keys keys) {
  const std::uint64_t key = keys.own;
  switch (kind.command) {
    case Command::draw:
      return turtle_.draw(length(kind, parameters, keys), key);
    case Command::move:
      return turtle_.walk(length(kind, parameters, keys));
    case Command::draw_plain:
      return turtle_.draw_plain(length(kind, parameters, keys), key);
    case Command::move_plain:
      return turtle_.walk_plain(length(kind, parameters, keys));
    case Command::left:
      return turtle_.turn(leftward(kind, parameters, yaw_, keys));
    case Command::right:
      return turtle_.turn(opposite(leftward(kind, parameters, yaw_, keys)));
    case Command::down:
      return turtle_.pitch(turn(kind, parameters, pitch_, keys));
    case Command::up:
      return turtle_.pitch(opposite(turn(kind, parameters, pitch_, keys)));
    case Command::roll_left:
      return turtle_.roll(leftward(kind, parameters, roll_, keys));
    case Command::roll_right:
      return turtle_.roll(opposite(leftward(kind, parameters, roll_, keys)));
    case Command::turn_around:
      if (growth_.share != 1 && growth_.brackets == 0)
        return turtle_.turn(math::sincos_degrees(180 * growth_.share));
      return turtle_.turn_around();
    case Command::upright:
      return turtle_.upright();
    case Command::push:
      if (growth_.share != 1) ++growth_.brackets;
      return turtle_.push();
    case Command::pop:
      if (growth_.share != 1) --growth_.brackets;
      return turtle_.pop();
    case Command::polygon_open:
      if (growth_.share != 1) begin_shape();
      ++open_polygons_;
      return turtle_.open_polygon();
    case Command::polygon_close:
      if (growth_.share != 1) end_shape();
      return close_polygon(key);
    case Command::vertex:
      return turtle_.set_vertex();
    default:
      return execute_state(kind, parameters, key);
  }
}

void Drawing::execute_state(const Kind& kind, const double* parameters, std::uint64_t key) {
  const auto index = [&](int change) {
    return kind.arity > 0 ? math::to_int64(parameters[0]) : turtle_.color() + change;
  };
  switch (kind.command) {
    case Command::width_down:
      return set_width(kind, parameters, -params_.width_decrement);
    case Command::width_up:
      return set_width(kind, parameters, params_.width_decrement);
    case Command::color_next:
      return turtle_.set_color(turtle_.color() + 1);
    case Command::color_up:
      return turtle_.set_color(index(1));
    case Command::color_down:
      return turtle_.set_color(index(-1));
    case Command::move_to:
      return turtle_.move_to({parameters[0], parameters[1], parameters[2]});
    case Command::set_heading:
      return turtle_.set_heading({parameters[0], parameters[1], parameters[2]});
    case Command::elasticity_set:
      return turtle_.set_elasticity(kind.arity > 1 ? math::to_int64(parameters[0]) : 0,
                                    parameters[kind.arity > 1 ? 1 : 0]);
    case Command::elasticity_up:
      return turtle_.change_elasticity(kind.arity > 0 ? math::to_int64(parameters[0]) : 0, 1);
    case Command::elasticity_down:
      return turtle_.change_elasticity(kind.arity > 0 ? math::to_int64(parameters[0]) : 0, -1);
    case Command::reset_frame:
      return turtle_.reset_frame();
    case Command::set_scale:
      return turtle_.set_scale(parameters[0]);
    case Command::multiply_scale:
      return turtle_.set_scale(finite(turtle_.scale() * parameters[0], kind, parameters));
    case Command::divide_scale:
      return turtle_.set_scale(finite(turtle_.scale() / parameters[0], kind, parameters));
    case Command::multiply_width:
      return turtle_.set_width(finite(turtle_.width() * parameters[0], kind, parameters));
    case Command::multiply_turns:
      return turtle_.set_turn_scale(finite(turtle_.turn_scale() * parameters[0], kind, parameters));
    case Command::mirror:
      return turtle_.mirror();
    case Command::sweep_begin:
      return turtle_.begin_sweep();
    case Command::sweep_control:
      return turtle_.set_control(kind.arity > 0 ? math::to_int64(parameters[0]) : 8, key);
    case Command::sweep_end:
      return turtle_.end_sweep(key);
    case Command::contour:
      return set_contour(kind, parameters);
    case Command::organ:
      return add_organ(kind, parameters, key);
    case Command::enter_frame:
      enter_frame(parameters);
      return turtle_.set_scale(finite(length_of(parameters + 3), kind, parameters));
    case Command::draw_frame:
      turtle_.push();
      enter_frame(parameters);
      turtle_.set_width(finite(length_of(parameters), kind, parameters));
      turtle_.draw_plain(length_of(parameters + 3) * growth_.share, key);
      return turtle_.pop();
    case Command::place_object: {
      const double* by = parameters + 1;
      const glm::dvec3 scale =
          kind.arity > 3 ? glm::dvec3(by[0], by[1], by[2]) : glm::dvec3(kind.arity > 1 ? by[0] : 1);
      return place_object(kind, parameters, parameters[0], scale, key);
    }
    case Command::place_in_frame:
      turtle_.push();
      enter_frame(parameters);
      turtle_.set_scale(1);
      place_object(kind, parameters, parameters[12],
                   {length_of(parameters), length_of(parameters + 3), length_of(parameters + 6)}, key);
      return turtle_.pop();
    default:  // nothing to draw: queries, cuts and symbols that the turtle does not interpret
      return;
  }
}

}  // namespace seedmesh::lsystem
