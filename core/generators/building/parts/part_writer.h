#pragma once
/// Closed solids of which parts are put together. Solids of one part may stand in each other but share no
/// edge and no plane, so that every edge has two triangles and nothing flickers.
#include <functional>
#include <glm/vec2.hpp>

#include "core/generators/building/parts/parts.h"
#include "core/geom/plan.h"

namespace seedmesh::building {

/// What a flat outline is pushed along.
enum class Along { x, y, z };

/// A point of a turned profile: distance from the axis as a share of the half width, and height in metres.
struct ProfilePoint {
  double radius = 0, height = 0;
};

class PartWriter {
 public:
  explicit PartWriter(Job& job) : job_(job) {}

  void box(std::string_view role, const glm::dvec3& low, const glm::dvec3& high);

  /// An outline pushed from `from` to `to`. It lies in (x, y) for z, in (-z, y) for x and in (x, -z) for y:
  /// seen against the direction of the push it turns counter-clockwise, holes the other way. `side` names the
  /// role of each edge (numbered through all rings); null: all `role`.
  struct Push {
    Along along = Along::z;
    double from = 0, to = 1;
    std::function<std::string_view(std::uint32_t)> side = nullptr;
  };
  void push(std::string_view role, const Plan& outline, const Push& push);

  /// A profile turned about an upright axis; the solid is to the left of the profile (upwards outside).
  /// `sides` is rounded up to a multiple of 4, so that the box is met exactly.
  struct Turn {
    glm::dvec3 foot{0};      ///< middle of the lower end
    glm::dvec2 radius{0.5};  ///< along x and z
    int sides = 24;
  };
  void turn(std::string_view role, const std::vector<ProfilePoint>& profile, const Turn& turn);

  /// A convex or flat face, counter-clockwise seen from outside.
  void face(std::string_view role, const std::vector<glm::dvec3>& corners);

  std::vector<PartPiece> take();

 private:
  struct Frame {
    glm::dvec3 right, up, normal;
  };
  Mesh& mesh_of(std::string_view role);
  void flat(std::string_view role, const std::vector<glm::dvec3>& points,
            std::span<const std::uint32_t> triangles, const glm::dvec3& normal);

  Job& job_;
  std::vector<PartPiece> pieces_;
};

/// Points of a rectangle as a ring.
PlanRing rectangle(const glm::dvec2& low, const glm::dvec2& high);

}  // namespace seedmesh::building
