#pragma once
/// Builds models of a few closed bodies with plain materials, such as street furniture, hedges and fences.
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>

#include "core/base/job.h"
#include "core/model/model.h"

namespace seedmesh::city {

struct SolidMaterial {
  std::string name;
  std::array<std::uint8_t, 3> color{};
  float roughness = 0.9F;
  float metallic = 0;
};
/// Returns the material of a look.
Material material_of(const SolidMaterial& look);

/// Adds bodies to one mesh. Bodies are closed and share no vertices.
class SolidBuilder {
 public:
  explicit SolidBuilder(const Job& job);

  void add_box(const glm::vec3& low, const glm::vec3& high);
  /// Adds a prism or cone about the upright line through `foot`, with `sides` sides. With a radius of 0, the top is a
  /// tip.
  void add_prism(const glm::vec3& foot, float height, std::array<float, 2> radii, int sides);
  /// Adds a convex outline in the plane of x and y, counter-clockwise seen from +z, extruded along z.
  void add_extrusion(std::span<const glm::vec2> outline, float from_z, float to_z);
  /// Adds an ellipsoid with smooth normals. Random numbers of the key vary its radii by up to the share `roughness`.
  void add_blob(const glm::vec3& centre, const glm::vec3& radii, float roughness, std::uint64_t key);
  /// Adds a convex body over a quadrangle: corners counter-clockwise from above, each with its own lower and
  /// upper height.
  void add_slab(const std::array<glm::vec2, 4>& plan, const std::array<float, 4>& low,
                const std::array<float, 4>& high);

  /// Returns the mesh, with equal vertices joined.
  Mesh take(Job& job);
  std::size_t triangles() const { return mesh_.index.wide.size() / 3; }

 private:
  /// Adds a convex, flat face, counter-clockwise seen from outside.
  void add_face(std::span<const glm::vec3> corners);

  Mesh mesh_;
};

}  // namespace seedmesh::city
