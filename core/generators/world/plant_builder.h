#pragma once
/// Builds the plain forms of plants from surfaces of revolution, crowns and cards with leaves. Lengths are metres; +Y
/// is up.
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "core/base/rng.h"
#include "core/generators/world/leaf_texture.h"
#include "core/generators/world/plant_mesh.h"

namespace seedmesh::world {

using Rgba = std::array<std::uint8_t, 4>;  ///< linear

struct PlantRing {
  double radius = 0, height = 0;
};

/// A part of a crown: an ellipsoid.
struct CrownPart {
  glm::dvec3 middle{0}, radius{1};
};

class PlantBuilder {
 public:
  explicit PlantBuilder(std::uint64_t key) : rng_(key) {}

  /// Adds rings from low to high about an axis. `uneven` displaces the vertices of closed crowns. `cell`: its texture.
  void revolve(const std::vector<PlantRing>& rings, int sides, const Rgba& color, const TextureCell& cell,
               double uneven = 0, const glm::dvec2& at = {0, 0});

  /// Adds an uneven ellipsoid, darker below. Normals turn out of the crown, whose middle is at the height `heart`, so
  /// that its parts are shaded as one body.
  void lobe(const CrownPart& part, double heart, int rings, int sides, const Rgba& color);

  /// Adds `count` squares with clusters of leaves on the surface of the last of `crown`, except inside the others.
  /// `half`: half of their side.
  void leaves(const std::vector<CrownPart>& crown, double heart, int count, double half, const Rgba& color);

  /// Adds a branch with needles from the axis at `base` metres above the ground, outwards by `reach` and down by `drop`.
  void branch(double base, double turn, double reach, double drop, const Rgba& color);

  /// Adds a bent leaf of a palm from `base`, outwards by `reach` and down by `drop`, seen from both sides.
  void blade(double base, double turn, double reach, double drop, double width, const Rgba& color);

  /// The radius of a group of small plants and the height of the tallest.
  struct Group {
    double radius = 0, height = 0;
  };
  /// Adds blades of grass that lean outwards, seen from both sides, with the light of the ground around them.
  void tuft(int blades, const Group& group, const Rgba& color);
  /// Adds heads of flowers that face upwards.
  void heads(int count, const Group& group, const Rgba& color);

  /// Returns the number of corners of triangles so far.
  std::size_t corners() const { return indices_.size(); }
  PlantFile file() const;

 private:
  void add_bands(std::uint32_t first, int rings, int sides);
  void add_quad(const std::array<glm::dvec3, 4>& corners, const std::array<glm::dvec3, 4>& normals,
                const std::array<double, 4>& shades, const Rgba& color, const TextureCell& cell);
  void add(const glm::dvec3& position, const glm::dvec3& normal, const Rgba& color,
           const glm::dvec2& coordinates);

  Rng rng_;
  std::vector<glm::vec3> positions_;
  std::vector<glm::dvec3> normals_;
  std::vector<Rgba> colors_;
  std::vector<glm::dvec2> coordinates_;
  std::vector<std::uint32_t> indices_;
};

}  // namespace seedmesh::world
