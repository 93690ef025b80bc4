#pragma once
/// The cross-sections of welded limbs: how many corners a ring has, where they lie, and how ribs change it.
#include <algorithm>
#include <glm/vec2.hpp>
#include <vector>

#include "core/geom/plant/graft/graft.h"
#include "core/geom/plant/tube_formulas.h"

namespace seedmesh {

/// Ribs deeper than this share of the radius get corners on every crest and in every trough.
constexpr float deep_ribs = 0.1F;

/// Returns the largest base radius of all internodes.
float thickest_base(const Limbs& limbs);

/// Whether the ribs of limbs are deeper than `deep_ribs`.
inline bool has_deep_ribs(const GraftOptions& options) {
  return options.lobes > 0 && options.lobe_depth > deep_ribs;
}

/// Returns the number of corners of a ring that would have `sides` corners without ribs: at least three for each rib.
/// With deep ribs, all rings of a limb have the same number, at least four for each rib.
inline int ribbed_corners(const GraftOptions& options, int sides) {
  if (options.lobes == 0) return sides;
  if (!has_deep_ribs(options)) return std::max({sides, 3 * options.lobes, 8});
  const int corners = std::max({sides, options.sides, 4 * options.lobes});
  return (corners + options.lobes - 1) / options.lobes * options.lobes;
}

/// The corners of a regular polygon in the unit circle. The first corner is repeated at the end, followed by
/// further ones, so that blocks of four can be read from any corner on.
struct UnitCircle {
  std::vector<float> x, y;
};

/// Tables that all rings of one graft() share.
struct RingTables {
  const UnitCircle* circles = nullptr;  ///< circles, indexed by number of corners
  std::vector<UnitCircle> own_circles;  ///< circles with more corners than the common table has
  std::vector<float> corner_radius;     ///< the least radii of limbs with 4, 5, ... corners
};
/// Makes the tables for a skeleton, up to its thickest limb.
RingTables ring_tables(const Limbs& limbs, const GraftOptions& options);

/// Returns the same as corners_by_radius(), but looks it up in the tables instead of calling pow().
int corners_by_table(const RingTables& tables, const GraftOptions& options, float radius);

}  // namespace seedmesh
