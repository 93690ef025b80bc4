#include "core/geom/plant/weather.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"

namespace seedmesh {
namespace {

constexpr std::size_t check_interval = 4096;
constexpr double gravity = 9.81;     // m/s^2
constexpr double air_density = 1.2;  // kg/m^3 at 20 degrees
constexpr double drag = 1.0;         // coefficient of a cylinder and of a plate across the flow
constexpr glm::dvec3 down{0, -1, 0};

/// Forces F at positions x, summed so that their torque about any point, after any rotation of the positions,
/// can be computed: the sums of F and of x F^T.
struct Load {
  glm::dvec3 force{0};
  glm::dmat3 place_force{0};  ///< column b: sum of x times F[b]

  void add(const glm::dvec3& at, const glm::dvec3& by) {
    force += by;
    for (int b = 0; b < 3; ++b) place_force[b] += at * by[b];
  }
  void add(const Load& other) {
    force += other.force;
    for (int b = 0; b < 3; ++b) place_force[b] += other.place_force[b];
  }
};

/// The torque of the load about `pivot` when its positions are rotated about it by `turn`.
glm::dvec3 torque_of(const Load& load, const glm::dvec3& pivot, const glm::dquat& turn) {
  glm::dmat3 lever;
  for (int b = 0; b < 3; ++b) lever[b] = turn * (load.place_force[b] - pivot * load.force[b]);
  return {lever[2].y - lever[1].z, lever[0].z - lever[2].x, lever[1].x - lever[0].y};
}

double length_of(const glm::dvec3& v) { return std::sqrt(glm::dot(v, v)); }

double level_length(const glm::dvec3& v) { return std::sqrt(v.x * v.x + v.z * v.z); }

glm::dquat unit(const glm::dquat& q) {
  const double length = std::sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
  return {q.w / length, q.x / length, q.y / length, q.z / length};
}

/// The load on the internode between two points.
glm::dvec3 force_on(const glm::dvec3& step, double thickness, const Weather& weather) {
  const double length = length_of(step);
  if (length == 0) return glm::dvec3{0};
  const glm::dvec3 along = step / length;
  const glm::dvec3 across = weather.wind - along * glm::dot(along, weather.wind);
  const glm::dvec3 wind = across * (0.5 * air_density * drag * thickness * length * length_of(across));
  const double snow = weather.snow * thickness * level_length(step);
  const double rain = weather.rain * math::pi * thickness * length;
  return wind + down * (gravity * (snow + rain));
}

/// The load on a polygon with the given area times normal.
glm::dvec3 force_on_plate(const glm::dvec3& area, const Weather& weather) {
  const double faced = std::abs(glm::dot(area, weather.wind));
  const glm::dvec3 wind = weather.wind * (0.5 * air_density * drag * faced);
  return wind + down * (gravity * (weather.snow * std::abs(area.y) + weather.rain * length_of(area)));
}

class Bending {
 public:
  Bending(Skeleton& skeleton, const Weather& weather, Job& job)
      : limbs_(skeleton.limbs),
        skeleton_(skeleton),
        weather_(weather),
        job_(job),
        load_(job, skeleton.limbs.size(), Load{}),
        turn_(job, skeleton.limbs.size(), glm::dquat{1, 0, 0, 0}),
        before_(job, skeleton.limbs.size()) {}

  void run() {
    std::copy(limbs_.position.begin(), limbs_.position.end(), before_.begin());
    load_internodes();
    load_outlines();
    pass_loads_down();
    for (std::size_t i = 0; i < limbs_.size(); ++i) {
      if (i % check_interval == 0) job_.check();
      move(static_cast<std::uint32_t>(i));
    }
    move_outlines();
    move_organs();
  }

 private:
  std::uint32_t carrier_of(std::size_t joint) const {
    if (limbs_.parent[joint] != Limbs::none) return limbs_.parent[joint];
    return limbs_.anchor.empty() ? Limbs::none : limbs_.anchor[joint];
  }

  void load_internodes() {
    for (std::size_t i = 0; i < limbs_.size(); ++i) {
      if (i % check_interval == 0) job_.check();
      if (limbs_.parent[i] == Limbs::none) continue;
      const glm::dvec3 from = before_[limbs_.parent[i]], to = before_[i];
      const double thickness = double{limbs_.radius[i]} + limbs_.base_radius[i];
      load_[i].add(0.5 * (from + to), force_on(to - from, thickness, weather_));
    }
  }

  void load_outlines() {
    for (const Outline& outline : skeleton_.outlines.outline) {
      if (outline.limb_joint == Limbs::none) continue;
      glm::dvec3 area{0}, centre{0};
      const glm::vec3* vertex = skeleton_.outlines.vertex.data() + outline.first;
      for (std::uint32_t i = 0; i < outline.count; ++i) {
        const glm::dvec3 a = vertex[i], b = vertex[(i + 1) % outline.count];
        area += 0.5 * glm::cross(a - glm::dvec3(vertex[0]), b - glm::dvec3(vertex[0]));
        centre += a / double(outline.count);
      }
      load_[outline.limb_joint].add(centre, force_on_plate(area, weather_));
    }
  }

  void pass_loads_down() {
    for (std::size_t i = limbs_.size(); i-- > 0;) {
      if (i % check_interval == 0) job_.check();
      const std::uint32_t carrier = carrier_of(i);
      if (carrier != Limbs::none) load_[carrier].add(load_[i]);
    }
  }

  void move(std::uint32_t joint) {
    const std::uint32_t carrier = carrier_of(joint);
    if (carrier == Limbs::none) return;
    const glm::dvec3 pivot = before_[carrier];
    const glm::dvec3 step = glm::dvec3(before_[joint]) - pivot;
    glm::dquat turn = turn_[carrier];
    if (limbs_.parent[joint] != Limbs::none) turn = yield(joint, pivot, step) * turn;
    turn_[joint] = unit(turn);
    limbs_.position[joint] = glm::vec3(glm::dvec3(limbs_.position[carrier]) + turn_[joint] * step) + 0.0F;
    if (!limbs_.frame.empty()) limbs_.frame[joint] = turned(turn_[joint], limbs_.frame[joint]);
  }

  /// The additional turn of the internode at its near end, beside that of its parent.
  glm::dquat yield(std::uint32_t joint, const glm::dvec3& pivot, const glm::dvec3& step) const {
    constexpr glm::dquat rigid{1, 0, 0, 0};
    const double radius = 0.5 * (double{limbs_.radius[joint]} + limbs_.base_radius[joint]);
    const double length = length_of(step);
    const double force = length_of(load_[joint].force);
    if (radius == 0 || length == 0 || force == 0) return rigid;
    const glm::dquat& turn = turn_[limbs_.parent[joint]];
    const glm::dvec3 along = turn * (step / length);
    // Moments decrease along an internode. That of what is beyond counts at its middle; its own load counts
    // as for a beam clamped at one end: an eighth of force times length.
    glm::dvec3 moment = torque_of(load_[joint], pivot + 0.5 * step, turn);
    moment += glm::cross(turn * (0.125 * step), force_on(step, 2 * radius, weather_));
    moment -= along * glm::dot(moment, along);  // twists the limb and does not bend it
    const double strength = length_of(moment);
    if (!(strength > 1e-12 * force * length)) return rigid;
    const double squared = radius * radius;
    const double wanted = strength * length / (weather_.stiffness * 0.25 * math::pi * squared * squared);
    const double cosine = glm::dot(along, load_[joint].force) / force;
    const double most = math::acos(std::clamp(cosine, -1.0, 1.0));
    if (most < 1e-9) return rigid;
    // The moment falls while the limb turns into the force: nearly the whole turn where it is small, never
    // all of `most`.
    const double angle = most * (1 - math::exp(-wanted / most));
    const math::SinCos half = math::sincos(0.5 * angle);
    const glm::dvec3 axis = moment * (half.sin / strength);
    return {half.cos, axis.x, axis.y, axis.z};
  }

  static glm::quat turned(const glm::dquat& turn, const glm::quat& frame) {
    return glm::quat(unit(turn * glm::dquat(frame)));
  }

  glm::vec3 carried(std::uint32_t joint, const glm::vec3& point) const {
    const glm::dvec3 arm = glm::dvec3(point) - glm::dvec3(before_[joint]);
    return glm::vec3(glm::dvec3(limbs_.position[joint]) + turn_[joint] * arm) + 0.0F;
  }

  void move_outlines() {
    for (const Outline& outline : skeleton_.outlines.outline) {
      if (outline.limb_joint == Limbs::none) continue;
      for (std::uint32_t i = outline.first; i < outline.first + outline.count; ++i) {
        glm::vec3& vertex = skeleton_.outlines.vertex[i];
        vertex = carried(outline.limb_joint, vertex);
      }
    }
  }

  void move_organs() {
    for (Organ& organ : skeleton_.organs.organ) {
      if (organ.limb_joint == Limbs::none) continue;
      organ.position = carried(organ.limb_joint, organ.position);
      organ.frame = turned(turn_[organ.limb_joint], organ.frame);
    }
  }

  Limbs& limbs_;
  Skeleton& skeleton_;
  const Weather& weather_;
  Job& job_;
  Array<Load> load_;
  Array<glm::dquat> turn_;   ///< of each internode, all earlier turns included
  Array<glm::vec3> before_;  ///< positions without weather
};

}  // namespace

void bend(Skeleton& skeleton, const Weather& weather, Job& job) { Bending(skeleton, weather, job).run(); }

}  // namespace seedmesh
