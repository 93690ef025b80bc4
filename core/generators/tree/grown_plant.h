#pragma once
/// The data of the model grown while it grows. Internodes are numbered in the order in which they grow, so parents
/// come before children; shedding keeps the order.
#include "core/base/array.h"
#include "core/generators/tree/skeleton_writer.h"
#include "core/geom/plant/frame.h"
#include "core/geom/plant/limbs.h"

namespace seedmesh::tree {

/// An internode and the node at its end. A root is a node alone.
struct GrownNode {
  glm::dvec3 position{0};
  glm::dvec3 heading{0, 1, 0};
  std::uint32_t parent = Limbs::none;
  std::uint32_t axis = 0;    ///< index into GrownPlant::axes
  std::uint16_t order = 0;   ///< order of its axis; 0: trunk
  std::uint16_t born = 0;    ///< year in which it grew, from 1
  std::uint16_t number = 0;  ///< number of the internode in its axis, from 0
  bool continues = false;    ///< continues the axis of its parent
  std::uint32_t tree = 0;    ///< 0: the tree of the request; its neighbours follow
  std::uint32_t count = 0;   ///< internodes that it carries, itself included
  std::uint32_t young = 0;   ///< number of those that are too young to be shed
  double shade = 0;          ///< weight of its shadow: its length in internodes of full length
  double light = 0;          ///< light of all buds that it carries
  double main_light = 0;     ///< part of `light` from the axis that continues at the node
  double side_light = 0;     ///< part of `light` from side branches and side buds at the node
  double vigour = 0;
  double area = 0, area_before = 0;  ///< radius^radius_exponent, now and a year ago
  std::uint64_t key = 0;
};

struct GrownBud {
  Frame frame;
  std::uint32_t node = 0;
  std::uint32_t axis = 0;        ///< axis that it continues; for a side bud, the axis of its parent
  std::uint16_t order = 0;       ///< order of the axis that it grows
  std::uint16_t number = 0;      ///< number of the next internode of its axis
  std::uint16_t idle_since = 0;  ///< year in which it was made or grew last
  bool ends_axis = false;        ///< whether it is at the end of an axis; otherwise it begins a side branch
  double light = 0, vigour = 0;
  std::uint64_t key = 0;
};

struct GrownPlant {
  explicit GrownPlant(const Job& job) : nodes(job), buds(job) {}
  Array<GrownNode> nodes;
  Array<GrownBud> buds;
  std::uint32_t axes = 0;  ///< number of axes that have begun
};

/// Returns the parameters of axes of this order.
const TreeAxis& axis_level(const TreeGrown& grown, int order);

}  // namespace seedmesh::tree
