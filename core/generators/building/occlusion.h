#pragma once
/// What shapes ask of other shapes: is something in the way, is a snap line near. Answers come from the first
/// pass of the derivation (derive.h), so that they do not depend on any order.
///
/// Only closed shapes with a volume are in the way: leaves, and (for "all", "noparent" and names) the shapes
/// they were made of. Ancestors and descendants of who asks never count. Boxes are tested as boxes; what else
/// is closed (roofs, cut solids, cylinders) is cut to the box of who asks. touches() knows boxes alone.
/// visible("street"): is the shortest straight line free from the middle of who asks to the nearest shape of
/// that name, flat ones too? No such shape: no.
#include <map>
#include <unordered_map>

#include "core/generators/building/cover.h"
#include "core/generators/building/shapes.h"

namespace seedmesh::building {

/// A plane that splits keep to: points p with dot(normal, p) = distance.
struct SnapPlane {
  glm::dvec3 normal{0};
  double distance = 0;
};

enum class Cover : std::uint8_t { free, part, full };

class Context {
 public:
  Context(Shapes shapes, std::vector<SnapPlane> snaps, const Grammar& grammar);

  /// The answer for a shape of the second pass, by the keys of it and its ancestors, its own first.
  double answer(const Query& query, const Scope& scope, std::span<const std::uint64_t> lineage,
                Job& job) const;
  std::span<const SnapPlane> snaps() const { return snaps_; }

 private:
  struct Candidate {
    std::uint32_t shape = 0;
    glm::dvec3 low{0}, high{0};  ///< axis-aligned box around it
  };
  bool counts(const Query& query, std::uint32_t shape) const;
  bool is_family(std::uint32_t self, std::uint32_t other) const;
  Scope scope_of(std::uint32_t shape) const;
  /// Null: a box.
  const Solid* solid_of(std::uint32_t shape) const;
  bool is_visible(const Query& query, const Scope& scope, std::uint32_t self, Job& job) const;
  /// Each candidate that has a cell between low and high, perhaps more than once; until `body` says false.
  template <class Body>
  void near(const glm::dvec3& low, const glm::dvec3& high, Job& job, Body&& body) const;

  Shapes shapes_;
  std::vector<SnapPlane> snaps_;
  const Grammar* grammar_;
  std::vector<std::uint32_t> last_;  ///< of each shape: the end of its descendants in order_
  std::vector<std::uint32_t> rank_;  ///< its place in a walk from the root
  std::vector<Candidate> candidates_;
  std::unordered_map<std::uint64_t, std::uint32_t> of_key_;
  glm::dvec3 low_{0}, cell_{1};
  glm::ivec3 cells_{1};
  std::vector<std::uint32_t> first_, members_;
  std::uint32_t cell_of(const glm::ivec3& at) const;
};

}  // namespace seedmesh::building
