#pragma once
/// Tunnels under a terrain. A tunnel begins where its line enters the ground, behind the street at its end. There,
/// the ground ends in an upright wall with an opening. Around the tube the ground is high enough to cover it.
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/generators/city/edge_table.h"
#include "core/generators/city/plan.h"

namespace seedmesh::city {

/// The opening of a tunnel on the border of a block, in metres.
struct TunnelMouth {
  glm::dvec2 middle{0}, along{1, 0};    ///< middle of the opening, and the direction of the border
  double half = 0;                      ///< half of its width along the border
  double floor = 0;                     ///< its height: that of the sidewalk
  std::array<glm::dvec2, 2> corners{};  ///< left and right, seen from outside
};

/// The floor of a tunnel at one position along it.
struct TunnelStation {
  glm::dvec2 left{0}, right{0}, middle{0};
  double height = 0;
};

/// A tunnel from one mouth to the other.
struct Tunnel {
  std::array<TunnelMouth, 2> mouths;
  std::vector<TunnelStation> stations;
  double half = 0;  ///< half of its inner width, metres
};

class Tunnels {
 public:
  /// Clear height of the tube, and thickness of its roof, m.
  static constexpr double clear_height = 5, slab = 0.4;

  Tunnels() = default;
  /// Finds the tunnels of a plan with heights. `part_of_edge` has the edges of all parts.
  Tunnels(const CityPlan& plan, const EdgeTable& part_of_edge);

  std::span<const Tunnel> all() const { return tunnels_; }
  /// Returns how many tunnels were left out: those that meet no straight border of a block at one of their ends, and
  /// those that are not deep enough below a street.
  std::size_t left_out() const { return left_out_; }

  /// Returns the least height that the ground must have at a position in metres to cover the tunnels; far from
  /// tunnels, a value far below the ground.
  double cover(const glm::dvec2& metres) const;

  /// Returns the height of the top of an opening at a position on its border; nothing elsewhere.
  std::optional<double> lintel(const glm::dvec2& metres) const;

  /// Appends the corners of openings strictly between two points of a border.
  void append_corners(const CmPoint& a, const CmPoint& b, std::vector<glm::dvec2>& points) const;

  /// Returns the positions beside and above the tubes at which the ground needs vertices.
  const std::vector<glm::dvec2>& ground_points() const { return ground_points_; }

 private:
  void add_ground_points(const Tunnel& tunnel);

  std::vector<Tunnel> tunnels_;
  std::vector<glm::dvec2> ground_points_;
  std::size_t left_out_ = 0;
};

}  // namespace seedmesh::city
