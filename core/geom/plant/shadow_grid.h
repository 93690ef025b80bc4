#pragma once
/// Light by shadow propagation on a dense grid, for plants that add and lose internodes one by one. Source: Palubicki
/// et al., "Self-organizing tree models for image synthesis", SIGGRAPH 2009, section 4.1.2. Shades are whole numbers,
/// so that removing a shadow restores the grid exactly.
///
///   layer 0:        [x]            shade
///   layer 1:     [ ][ ][ ]         shade / falloff
///   layer 2:  [ ][ ][ ][ ][ ]      shade / falloff^2
#include <vector>

#include "core/base/array.h"
#include "core/geom/plant/surroundings.h"

namespace seedmesh {

class ShadowGrid {
 public:
  /// The grid is empty, and grows with what is added. Its memory belongs to the job.
  ShadowGrid(const ShadowOptions& options, const Job& job);

  /// Adds the shadow of something in the cell of `point`, times `weight`. Costs about 0.2 us with 6 layers.
  void add(const glm::dvec3& point, double weight = 1);
  /// Removes what one add() with a point of the same cell and the same weight has added.
  void remove(const glm::dvec3& point, double weight = 1);
  /// Returns the sum of the shades at a point, 0 where there is no shadow.
  double shade_at(const glm::dvec3& point) const;

 private:
  struct Cell {
    std::int32_t x, y, z;
  };
  struct Range {
    Cell low{0, 0, 0}, size{0, 0, 0};
  };
  Cell cell_of(const glm::dvec3& point) const;
  bool contains(const Cell& low, const Cell& high) const;
  void extend(const Cell& low, const Cell& high);
  std::size_t index_of(const Cell& cell) const;
  void cast(const Cell& cell, double weight, std::uint32_t sign);

  double cell_;
  std::vector<double> amounts_;  ///< shade of each layer, in the unit of the shades
  Range range_;
  Array<std::uint32_t> shade_;  ///< x by x, within it y by y, and rows along z
};

}  // namespace seedmesh
