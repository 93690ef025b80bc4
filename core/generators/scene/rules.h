#pragma once
/// Rules of a layer. Each rule gives a share from 0 to 1; their product is the probability that a position is
/// kept.
#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/base/array.h"
#include "core/generators/scene/ground.h"
#include "core/generators/scene/shapes.h"

namespace seedmesh {
struct ScenePlace;
}

namespace seedmesh::scene {

/// Returns 1 well inside the limits, falling to 0 at soft limits, and 0 outside. The template accepts any
/// limits type of the schema.
template <class Limits>
double share_of_limits(const Limits& limits, double value) {
  double share = 1;
  if (limits.from) {
    if (value < *limits.from) return 0;
    if (limits.soft > 0) share = std::min(share, (value - *limits.from) / limits.soft);
  }
  if (limits.to) {
    if (value > *limits.to) return 0;
    if (limits.soft > 0) share = std::min(share, (*limits.to - value) / limits.soft);
  }
  return share;
}

/// The placements of an earlier layer, searchable by position.
struct PlacedLayer {
  const Array<Placement>* placements = nullptr;
  std::optional<Neighbours> by_position;
  double crown = 0;         ///< radius at scale 1, in metres
  double widest_crown = 0;  ///< largest crown radius of the layer, in metres
};

/// Areas of the ground that must stay free: paths and footprints.
class Obstacles {
 public:
  Obstacles(const Extent& extent, const Job& job) : extent_(extent), job_(job) {}
  void add_path(PathBand band) { paths_.push_back(std::move(band)); }
  void add_footprints(Array<Footprint> footprints);

  /// Returns true where a disc of radius `reach` around `p` meets an obstacle.
  bool intersects(const glm::dvec2& p, double reach) const;

 private:
  struct Group {
    Array<Footprint> footprints;
    double widest = 0;
    Neighbours by_position;
  };
  const Extent& extent_;
  const Job& job_;
  std::vector<PathBand> paths_;
  std::vector<Group> groups_;
};

/// A greyscale image stretched over the ground.
struct DensityImage {
  std::uint32_t width = 0, depth = 0;
  Array<float> share;  ///< row by row, from the north
  /// Returns the bilinear interpolation between pixel centres, clamped at the border.
  double at(const glm::dvec2& position) const;  ///< 0..1 from the north-west corner
};

/// Returns smooth noise of three octaves, about -1 to 1 (Perlin, "Improving noise", 2002, in 2D).
double patch_noise(const glm::dvec2& p, std::uint64_t key);

/// Returns the share of light that the crowns of the first `before` layers absorb at a position. The
/// absorption of a crown decreases to 0 at its edge. The transmissions of several crowns are multiplied.
double shade_at(const glm::dvec2& p, const std::vector<PlacedLayer>& planted, std::size_t before);

/// The compiled rules of one layer. Does not own its inputs.
class Rules {
 public:
  struct Inputs {
    const ScenePlace& place;
    const Ground& ground;
    const Obstacles& obstacles;
    const std::vector<PlacedLayer>& planted;  ///< earlier layers
    std::vector<std::size_t> near;            ///< for each entry of place.near, the index of its layer
    std::uint64_t noise_key = 0;
  };
  /// Throws Stop (Code::invalid) at `pointer` for an unreadable image.
  Rules(Inputs given, const std::string& pointer, const Job& job);

  /// Returns the probability of a placement at `p`, 0 where it is forbidden. `reach`: radius of ground that
  /// the model covers, in metres.
  double share(const glm::dvec2& p, double reach) const;

  /// Returns true where the rules depend on other placements.
  static bool reads_neighbours(const ScenePlace& place);

  const std::vector<glm::dvec2>& area() const { return area_; }

 private:
  double share_of_ground(const glm::dvec2& p) const;
  double share_of_neighbours(const glm::dvec2& p) const;

  Inputs inputs_;
  std::vector<glm::dvec2> area_;
  std::optional<DensityImage> image_;
};

}  // namespace seedmesh::scene
