#pragma once
/// What a scene stands on: the height field of a terrain, or level ground at height 0. Places are (x, z):
/// east and south of the middle, in metres.
#include <memory>
#include <optional>

#include "core/base/result.h"
#include "core/generators/scene/shapes.h"
#include "core/generators/terrain/field.h"
#include "core/model/model.h"

namespace seedmesh {
struct SceneParams;
struct TerrainParams;
}  // namespace seedmesh

namespace seedmesh::scene {

/// A piece of ground that is made level, and how wide the slope around it is.
struct Foundation {
  Footprint footprint;
  double slope_width = 0;
};

class Ground {
 public:
  /// Makes the field. Issues point to the terrain's parameters.
  static Result<Ground> make(const SceneParams& params, const Job& job);

  const Extent& extent() const { return extent_; }
  /// Is there ground, and its edge at least so far off?
  bool holds(const glm::dvec2& p, double edge) const;

  /// Height of the triangle of a grid mesh on which the place lies; a reduced mesh differs by its error.
  double height(const glm::dvec2& p) const { return sample(p).height; }
  /// Rise per metre to the east and to the south, of the same triangle.
  glm::dvec2 gradient(const glm::dvec2& p) const { return sample(p).gradient; }

  /// Height of the water; nothing where there is none.
  const std::optional<double>& water() const { return water_; }

  /// Puts the ground under a foundation on the height of its middle. What lies under an earlier one stays.
  void level(const Foundation& foundation, const Job& job);
  /// How far around a foundation the ground becomes level with it: so far its squares reach.
  double level_margin() const;

  /// Spends triangles. The ground and the ways on it as a model, one root; with levels of detail where they
  /// are asked for and the ground is a terrain. Warnings point to the parameters of the scene.
  Result<Model> model(const SceneParams& params, Job& job) const;

 private:
  struct Sample {
    double height = 0;
    glm::dvec2 gradient{0};
  };
  Sample sample(const glm::dvec2& p) const;

  Extent extent_;
  bool round_ = false;
  std::optional<double> water_;
  std::shared_ptr<const TerrainParams> terrain_;  ///< null: level ground
  std::uint64_t seed_ = 0;
  terrain::Field field_;
  Array<std::uint8_t> levelled_;  ///< by sample: 1 under a foundation; empty: there is none
};

}  // namespace seedmesh::scene
