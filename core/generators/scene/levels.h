#pragma once
/// Which level of detail stands where: by the size on the screen of a camera, and coarser all together where
/// a budget of triangles asks for it.
#include <vector>

#include "core/generators/scene/assemble.h"

namespace seedmesh::scene {

/// A model as it looks from afar.
struct Stature {
  std::vector<std::uint64_t> triangles;  ///< of its meshes, finest first
  bool has_picture = false;              ///< an impostor after them
  double radius = 0;                     ///< of a sphere that holds it
  double middle = 0;                     ///< height of that sphere's centre

  std::size_t levels() const { return triangles.size() + (has_picture ? 1 : 0); }
  std::uint64_t triangles_at(std::size_t level) const;
};

/// Does each place get a level of its own?
bool chooses_levels(const SceneParams& params, const Demand& demand);

/// Are there pictures of plants?
bool wants_pictures(const SceneParams& params, const Demand& demand);

/// How many levels models are made with.
int levels_made_of(const SceneParams& params, const Demand& demand);

/// By layer and stand.
using Levels = std::vector<Array<std::uint8_t>>;

/// The level of a stand follows from the share of the screen's height that it fills: 0 from a half on, then 1
/// from a quarter, 2 from 0.12, 3 from 0.06, and beyond the picture, or the coarsest mesh where there is
/// none. Without a camera the largest plant counts as filling the screen. A budget (Demand::most_triangles)
/// makes all sizes smaller by one factor, the greatest with which `others` and all stands keep it; 0 where
/// none does. `statures`: by Casting::casts. About 50 ns a stand, and 5 for each of 30 steps with a budget.
Levels levels_of(const SceneParams& params, const Plan& plan, const std::vector<Stature>& statures,
                 std::uint64_t others, const Job& job);

}  // namespace seedmesh::scene
