#pragma once
/// Shapes on the ground that things stand in or keep off, and how to find what is near. Places are (x, z).
#include <cmath>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "core/generators/scene/stands.h"

namespace seedmesh::scene {

/// What a model covers of the ground: a disc, or a rectangle that is turned.
struct Footprint {
  glm::dvec2 at{0};
  glm::dvec2 half{0};  ///< of width and depth before it is turned; a disc has its radius in both
  double cos = 1, sin = 0;
  bool round = true;

  /// Of a place with that size at scale 1 and that turn.
  static Footprint of(const Stand& stand, const glm::dvec2& half, bool round);
  /// Distance from the edge, below 0 inside.
  double outside(const glm::dvec2& p) const;
  double reach() const { return round ? half.x : glm::length(half); }
};

/// Do two of one kind, discs or rectangles, cover ground together? Not where they only touch.
bool overlap(const Footprint& a, const Footprint& b);

/// Is the place inside of the polygon? Edges count by the rule of crossings.
bool is_inside(std::span<const glm::dvec2> polygon, const glm::dvec2& p);
Extent extent_of(std::span<const glm::dvec2> points);

/// A broken line with a width.
struct Way {
  std::vector<glm::dvec2> points;
  double half_width = 0;
  Extent box;                 ///< of all that it covers
  std::vector<Extent> boxes;  ///< of runs of pieces, half the width around them included

  /// Does it come nearer to the place than the margin? Looks at the boxes, and at the pieces of those that
  /// are near.
  bool covers(const glm::dvec2& p, double margin) const;
};
Way way_of(std::vector<glm::dvec2> points, double width);

/// Places by the square of a grid in which they lie. Grows; queries do not depend on the order of additions
/// where what is asked does not.
class Neighbours {
 public:
  /// `cell`: about the distance that will be asked for. Squares are made larger where there would be too
  /// many.
  Neighbours(const Extent& extent, double cell, const Job& job);

  void add(const glm::dvec2& at, std::uint32_t id);

  /// visit(id, squared distance) for all within `radius` until it says true; whether it did.
  template <class Visit>
  bool any(const glm::dvec2& at, double radius, const Visit& visit) const {
    const auto [x0, z0] = square_of(at - radius);
    const auto [x1, z1] = square_of(at + radius);
    const double most = radius * radius;
    for (std::int32_t z = z0; z <= z1; ++z) {
      for (std::int32_t x = x0; x <= x1; ++x) {
        for (std::uint32_t i = head_[static_cast<std::size_t>(z) * wide_ + static_cast<std::size_t>(x)];
             i != none; i = next_[i]) {
          const glm::dvec2 way = place_[i] - at;
          const double squared = glm::dot(way, way);
          if (squared <= most && visit(id_[i], squared)) return true;
        }
      }
    }
    return false;
  }

  /// The square of the distance to the nearest within `radius`; above radius * radius: none.
  double nearest(const glm::dvec2& at, double radius) const;

  std::size_t size() const { return place_.size(); }

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
  Array<glm::dvec2> place_;
};

/// Footprints of one kind that lie beside each other. `cell`: about twice the reach of the largest.
class Plots {
 public:
  Plots(const Extent& extent, double cell, const Job& job) : by_place_(extent, cell, job), all_(job) {}

  /// Whether there is room for it; then it is taken.
  bool take(const Footprint& footprint);

 private:
  Neighbours by_place_;
  Array<Footprint> all_;
  double widest_ = 0;
};

}  // namespace seedmesh::scene
