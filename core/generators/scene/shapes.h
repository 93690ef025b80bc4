#pragma once
/// Shapes on the ground, and neighbour search. Positions are (x, z) in metres.
#include <cmath>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "core/generators/scene/candidate_positions.h"

namespace seedmesh::scene {

/// The area that a model covers: a disc, or a rotated rectangle.
struct Footprint {
  glm::dvec2 at{0};
  glm::dvec2 half{0};  ///< half of width and depth before rotation; both are the radius of a disc
  double cos = 1, sin = 0;
  bool round = true;

  /// Returns the footprint of a placement. `half` is the half size at scale 1.
  static Footprint of(const Placement& placement, const glm::dvec2& half, bool round);
  /// Returns the distance from the edge in metres, negative inside.
  double outside(const glm::dvec2& p) const;
  double reach() const { return round ? half.x : glm::length(half); }
};

/// Returns true if two footprints of the same kind overlap. Footprints that only touch do not overlap.
bool overlap(const Footprint& a, const Footprint& b);

/// Returns true inside the polygon, by the even-odd rule.
bool is_inside(std::span<const glm::dvec2> polygon, const glm::dvec2& p);
Extent extent_of(std::span<const glm::dvec2> points);

/// A polyline with a width.
struct PathBand {
  std::vector<glm::dvec2> points;
  double half_width = 0;
  Extent box;                 ///< bounds of the covered area
  std::vector<Extent> boxes;  ///< bounds of runs of segments, including half the width

  /// Returns true where the distance to `p` is below `margin`. Checks the boxes first, then the segments of
  /// near boxes.
  bool covers(const glm::dvec2& p, double margin) const;
};
PathBand path_band_of(std::vector<glm::dvec2> points, double width);

/// Positions in a uniform grid. Grows by add(). The result of a query does not depend on the order of
/// additions.
class Neighbours {
 public:
  /// `cell`: approximate query distance in metres. It grows where there would be too many cells.
  Neighbours(const Extent& extent, double cell, const Job& job);

  void add(const glm::dvec2& at, std::uint32_t id);

  /// Calls visit(id, squared distance) for all positions within `radius` until it returns true. Returns
  /// whether it did.
  template <class Visit>
  bool any(const glm::dvec2& at, double radius, const Visit& visit) const {
    const auto [x0, z0] = square_of(at - radius);
    const auto [x1, z1] = square_of(at + radius);
    const double most = radius * radius;
    for (std::int32_t z = z0; z <= z1; ++z) {
      for (std::int32_t x = x0; x <= x1; ++x) {
        for (std::uint32_t i = head_[static_cast<std::size_t>(z) * wide_ + static_cast<std::size_t>(x)];
             i != none; i = next_[i]) {
          const glm::dvec2 delta = position_[i] - at;
          const double squared = glm::dot(delta, delta);
          if (squared <= most && visit(id_[i], squared)) return true;
        }
      }
    }
    return false;
  }

  /// Returns the squared distance to the nearest position within `radius`, or a larger value where there is
  /// none.
  double nearest(const glm::dvec2& at, double radius) const;

  std::size_t size() const { return position_.size(); }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFFU;
  struct Square {
    std::int32_t x, z;
  };
  Square square_of(const glm::dvec2& at) const;

  Extent extent_;
  double per_cell_ = 1;
  std::size_t wide_ = 1, deep_ = 1;
  Array<std::uint32_t> head_, next_, id_;
  Array<glm::dvec2> position_;
};

/// A set of footprints of one kind that do not overlap. `cell`: about twice the reach of the largest.
class FootprintSet {
 public:
  FootprintSet(const Extent& extent, double cell, const Job& job)
      : by_position_(extent, cell, job), all_(job) {}

  /// Adds a footprint if it overlaps no other, and returns whether it was added.
  bool take(const Footprint& footprint);

 private:
  Neighbours by_position_;
  Array<Footprint> all_;
  double widest_ = 0;
};

}  // namespace seedmesh::scene
