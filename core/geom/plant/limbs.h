#pragma once
/// The skeleton of a plant as data. The turtle and the growth models write it; skin() and graft() make meshes
/// of it. Flat arrays, parents before children.
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "core/base/array.h"

namespace seedmesh {

/// A joint is a point of the skeleton. A joint with a parent is also the internode (a straight piece of bark)
/// that runs from its parent to itself. A limb is a chain of internodes. A joint continues the limb of its
/// parent unless `starts_limb` is set (a side branch) or it has no parent (a root). At most one child
/// continues a limb. All arrays that are not empty have size() elements.
struct Limbs {
  static constexpr std::uint32_t none = 0xFFFFFFFFU;

  Array<glm::vec3> position;
  Array<float> radius;  ///< radius of the internode at this joint, its far end
  /// Radius of the internode at its near end (at the parent); unused at roots.
  Array<float> base_radius;
  Array<std::uint32_t> parent;      ///< `none` at a root; always less than the joint's own index
  Array<std::uint8_t> starts_limb;  ///< 1: begins a side branch at its parent
  Array<std::int16_t> color;        ///< the turtle's colour index; material of the internode
  Array<std::uint16_t> order;       ///< 0 trunk, 1 its branches, ... (Gravelius)
  Array<glm::quat> frame;  ///< rotation that takes +Y to heading, -X to left, +Z to up; optional (empty)
  /// Cross-section at the joint: 0 is a circle, k is the caller's contour k - 1. Optional (empty).
  Array<std::uint8_t> contour;
  Array<float> birth;        ///< age in iterations at which the internode appears; optional (empty)
  Array<std::uint64_t> key;  ///< identity of the joint, the key of its random numbers; optional (empty)
  /// Index of an earlier joint with which a root moves, or `none`. Optional (empty).
  Array<std::uint32_t> anchor;
  /// Fraction of the internode that has grown, for fractional iterations. Width rules use it. Optional (empty: 1).
  Array<float> share;

  Limbs() = default;
  explicit Limbs(const Job& job);
  std::size_t size() const { return position.size(); }
};

/// A surface placed on the skeleton: a leaf, a petal, a fruit, or any model by name.
struct Organ {
  std::uint32_t surface = 0;  ///< index into the caller's list of surfaces
  glm::quat frame{1, 0, 0, 0};
  glm::vec3 position{0};
  glm::vec3 scale{1};
  std::uint32_t limb_joint = Limbs::none;  ///< joint with which the organ moves
  std::int16_t color = 0;                  ///< the turtle's colour index
  std::uint64_t key = 0;                   ///< identity of the organ, the key of its random numbers
};
struct Organs {
  Array<Organ> organ;
  Organs() = default;
  explicit Organs(const Job& job) : organ(job) {}
};

/// A filled polygon drawn by the turtle between { and }. Outlines::outline has the order of the closing braces.
struct Outline {
  std::uint32_t first = 0, count = 0;  ///< range in Outlines::vertex
  std::int16_t color = 0;
  std::uint64_t key = 0;
  std::uint32_t limb_joint = Limbs::none;  ///< joint with which the polygon moves
};
struct Outlines {
  Array<glm::vec3> vertex;
  Array<Outline> outline;
  Outlines() = default;
  explicit Outlines(const Job& job) : vertex(job), outline(job) {}
};

/// All data of a plant before it becomes meshes.
struct Skeleton {
  Limbs limbs;
  Organs organs;
  Outlines outlines;
  Skeleton() = default;
  explicit Skeleton(const Job& job) : limbs(job), organs(job), outlines(job) {}
};

}  // namespace seedmesh
