#pragma once
/// Which places suit a layer: its rules, each a share from 0 to 1, and one chance for their product.
#include <cstdint>
#include <optional>
#include <vector>

#include "core/generators/scene/ground.h"
#include "core/generators/scene/shapes.h"

namespace seedmesh {
struct ScenePlace;
}

namespace seedmesh::scene {

/// What stands already, of one layer: by place.
struct Planted {
  const Array<Stand>* stands = nullptr;
  std::optional<Neighbours> by_place;
  double crown = 0;         ///< radius at scale 1
  double widest_crown = 0;  ///< of all
};

/// What lies on the ground that nothing may stand on.
class Obstacles {
 public:
  Obstacles(const Extent& extent, const Job& job) : extent_(extent), job_(job) {}
  void add_way(Way way) { ways_.push_back(std::move(way)); }
  void add_footprints(Array<Footprint> footprints);

  /// Does anything that reaches so far around the place meet one of them?
  bool meet(const glm::dvec2& p, double reach) const;

 private:
  struct Group {
    Array<Footprint> footprints;
    double widest = 0;
    Neighbours by_place;
  };
  const Extent& extent_;
  const Job& job_;
  std::vector<Way> ways_;
  std::vector<Group> groups_;
};

/// A grey picture that lies over the ground.
struct DensityImage {
  std::uint32_t width = 0, depth = 0;
  std::vector<float> share;  ///< row by row, from the north
  /// Between the middles of pixels as a plane each way, beyond the outermost as these.
  double at(const glm::dvec2& place) const;  ///< 0..1 from the north-western corner
};

/// The smooth noise of patches, about -1 to 1 (Perlin, "Improving noise", 2002, on a plane), three octaves.
double patch_noise(const glm::dvec2& p, std::uint64_t key);

/// How much light crowns take away at a place: each its share, fading to its edge, one after the other.
double shade_at(const glm::dvec2& p, const std::vector<Planted>& planted, std::size_t before);

/// The rules of one layer, ready to be asked. Does not own what it was made of.
class Rules {
 public:
  struct Given {
    const ScenePlace& place;
    const Ground& ground;
    const Obstacles& obstacles;
    const std::vector<Planted>& planted;  ///< of the layers before this one
    std::vector<std::size_t> near;        ///< by place.near: which layer is meant
    std::uint64_t noise_key = 0;
  };
  /// Throws Stop (Code::invalid) at `pointer` where the picture cannot be read.
  Rules(Given given, const std::string& pointer, const Job& job);

  /// 0 where nothing may stand. `reach`: how far the model covers the ground around.
  double share(const glm::dvec2& p, double reach) const;

  /// Do the rules ask what stands there already?
  static bool look_at_others(const ScenePlace& place);

  const std::vector<glm::dvec2>& area() const { return area_; }

 private:
  double share_of_ground(const glm::dvec2& p) const;
  double share_of_neighbours(const glm::dvec2& p) const;

  Given given_;
  std::vector<glm::dvec2> area_;
  std::optional<DensityImage> image_;
};

}  // namespace seedmesh::scene
