#pragma once
/// Chooses the level of detail of each placement by its size on the screen of a camera, and coarser levels
/// for a budget of triangles.
#include <vector>

#include "core/generators/scene/assemble.h"

namespace seedmesh::scene {

/// Levels of detail and bounds of a variant.
struct LodInfo {
  std::vector<std::uint64_t> triangles;  ///< triangles of each mesh, finest first
  bool has_impostor = false;             ///< an impostor follows the meshes
  double radius = 0;                     ///< radius of a bounding sphere, in metres
  double middle = 0;                     ///< height of the centre of that sphere, in metres

  std::size_t levels() const { return triangles.size() + (has_impostor ? 1 : 0); }
  std::uint64_t triangles_at(std::size_t level) const;
};

/// Returns true if each placement gets its own level.
bool chooses_levels(const SceneParams& params, const Demand& demand);

/// Returns true if plants get impostors.
bool wants_impostors(const SceneParams& params, const Demand& demand);

/// Returns how many levels of detail have to be made of each model.
int level_count_of(const SceneParams& params, const Demand& demand);

/// Levels by layer and placement.
using Levels = std::vector<Array<std::uint8_t>>;

/// Chooses levels by the share of the screen height that a placement fills: level 0 from 0.5, 1 from 0.25, 2
/// from 0.12, 3 from 0.06. A smaller placement is shown by the impostor, or else by the coarsest mesh.
/// Without a camera, sizes are relative to that of the largest plant, which is assumed to fill the screen.
/// Each size is then reduced at random by up to 30 %. With a budget (Demand::most_triangles), all sizes are
/// multiplied by one factor from 0 to 1. The factor is the largest one with which the triangles of all
/// placements, plus `others`, stay within the budget. `lod_infos` is indexed by VariantTable::variants. Cost:
/// about 50 ns for each placement, and 5 ns for each of 30 steps with a budget.
Levels levels_of(const SceneParams& params, const Plan& plan, const std::vector<LodInfo>& lod_infos,
                 std::uint64_t others, const GenerateContext& context);

}  // namespace seedmesh::scene
