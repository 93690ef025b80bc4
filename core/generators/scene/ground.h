#pragma once
/// The ground of a scene: the height field of a terrain, or level ground at height 0. Positions are (x, z),
/// east and south of the centre, in metres.
#include <memory>
#include <optional>

#include "core/base/result.h"
#include "core/generators/api.h"
#include "core/generators/scene/shapes.h"
#include "core/generators/terrain/field.h"
#include "core/model/model.h"

namespace seedmesh {
struct SceneParams;
struct TerrainParams;
enum class SceneGroundClass;
}  // namespace seedmesh
namespace seedmesh::terrain {
class GroundCover;
class RefinedGround;
}  // namespace seedmesh::terrain

namespace seedmesh::scene {

/// A piece of ground that is levelled, and the width of the slope around it.
struct Foundation {
  Footprint footprint;
  double slope_width = 0;
};

class Ground {
 public:
  /// Generates the field. Issues point into the terrain's parameters.
  static Result<Ground> make(const SceneParams& params, const Job& job);

  const Extent& extent() const { return extent_; }
  /// Returns true where there is ground and its border is at least `edge` metres away.
  bool contains(const glm::dvec2& p, double edge) const;

  /// Returns the height of the grid mesh at a position. A reduced mesh differs by its error. On refined
  /// ground, it returns the height of the refined surface, on which the vertices of the mesh lie.
  double height(const glm::dvec2& p) const { return refines(p) ? refined_height(p) : sample(p).height; }
  /// Returns the rise per metre to the east and to the south. It is that of the triangle at the position, or
  /// on refined ground that over a distance of a metre.
  glm::dvec2 gradient(const glm::dvec2& p) const;

  /// Returns 0 where the classes together have at most 0.3 of the ground, and 1 where they have at least 0.55.
  /// Between these shares, it is a smooth step. If cover() was not called, it is 1.
  double share_of(const std::vector<SceneGroundClass>& classes, const glm::dvec2& p) const;
  /// Finds the classes of ground. Foundations that are made later do not change them.
  void cover(const Job& job);

  /// Returns the height of the water, or nullopt without water.
  const std::optional<double>& water() const { return water_; }

  /// Levels the ground under a foundation to the height of the foundation's centre. Ground under an earlier
  /// foundation is unchanged.
  void level(const Foundation& foundation, const Job& job);
  /// Returns the distance around a foundation, in metres, up to which the ground can become level with it. It
  /// follows from the size of the grid squares.
  double level_margin() const;

  /// Returns the ground, and the paths, areas and buildings on it, as a model with one root, and spends its
  /// triangles. A terrain has levels of detail where they are requested. Warnings point into the parameters of
  /// the scene.
  Result<Model> model(const SceneParams& params, const GenerateContext& context) const;

 private:
  struct Sample {
    double height = 0;
    glm::dvec2 gradient{0};
  };
  Sample sample(const glm::dvec2& p) const;
  bool refines(const glm::dvec2& p) const;
  double refined_height(const glm::dvec2& p) const;

  Extent extent_;
  bool round_ = false;
  std::optional<double> water_;
  std::shared_ptr<const TerrainParams> terrain_;  ///< may be null: level ground
  std::uint64_t seed_ = 0;
  terrain::Field field_;
  std::shared_ptr<const terrain::RefinedGround> refined_;  ///< may be null
  std::shared_ptr<const terrain::GroundCover> cover_;      ///< may be null
  Array<std::uint8_t> levelled_;  ///< for each sample 1 under a foundation; empty without foundations
};

}  // namespace seedmesh::scene
