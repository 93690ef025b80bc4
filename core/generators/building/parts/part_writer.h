#pragma once
/// Writes the closed solids that parts consist of. Solids of one part may intersect but share no edge and no
/// plane, so that every edge has two triangles and no faces coincide.
#include <functional>
#include <glm/vec2.hpp>

#include "core/generators/building/parts/parts.h"
#include "core/geom/polygon/plan.h"

namespace seedmesh::building {

/// The axis along which an outline is extruded.
enum class ExtrusionAxis { x, y, z };

/// A point of the profile of a solid of revolution: the distance from the axis as a share of the radius, and
/// the height in metres.
struct ProfilePoint {
  double radius = 0, height = 0;
};

class PartWriter {
 public:
  explicit PartWriter(Job& job) : job_(job) {}

  void box(std::string_view role, const glm::dvec3& low, const glm::dvec3& high);

  /// The part of a picture that a box shows on its front: the upper left corner and the size, as shares of the picture.
  struct PictureWindow {
    glm::dvec2 corner{0}, size{1};
  };
  /// A box whose texture coordinates are shares of a picture instead of metres; its sides continue the front.
  void picture_box(std::string_view role, const glm::dvec3& low, const glm::dvec3& high,
                   const PictureWindow& window);

  /// An extrusion from `from` to `to`. The two coordinates of the outline are (x, y) for ExtrusionAxis::z, (-z, y)
  /// for ExtrusionAxis::x and (x, -z) for ExtrusionAxis::y. Seen from the `to` end it is counter-clockwise, and holes are
  /// clockwise. `side` gives the role of each edge, numbered through all rings; null: `role` for all.
  struct Extrusion {
    ExtrusionAxis along = ExtrusionAxis::z;
    double from = 0, to = 1;
    std::function<std::string_view(std::uint32_t)> side = nullptr;
  };
  void extrude(std::string_view role, const Plan& outline, const Extrusion& extrusion);

  /// A solid of revolution about a vertical axis. The solid is to the left of the profile: outer sides run
  /// upwards. `sides` is rounded up to a multiple of 4, so that the solid touches all sides of its box.
  struct Revolution {
    glm::dvec3 foot{0};      ///< middle of the lower end
    glm::dvec2 radius{0.5};  ///< radii along x and z
    int sides = 24;
  };
  void revolve(std::string_view role, const std::vector<ProfilePoint>& profile, const Revolution& revolution);

  /// A flat convex polygon, counter-clockwise seen from outside.
  void face(std::string_view role, const std::vector<glm::dvec3>& corners);

  std::vector<PartPiece> take();

 private:
  Mesh& mesh_of(std::string_view role);
  void flat(std::string_view role, const std::vector<glm::dvec3>& points,
            std::span<const std::uint32_t> triangles, const glm::dvec3& normal);

  Job& job_;
  std::vector<PartPiece> pieces_;
};

/// Returns the corners of a rectangle, counter-clockwise.
PlanRing rectangle(const glm::dvec2& low, const glm::dvec2& high);

}  // namespace seedmesh::building
