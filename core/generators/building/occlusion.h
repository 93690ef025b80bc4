#pragma once
/// Queries that a shape makes about other shapes: occlusion, containment, contact, visibility, and snap lines. They test
/// the shapes of the first pass of the derivation (derive.h), so that results do not depend on any order.
///
/// Only closed shapes with a volume can occlude. Shapes that rules have replaced occlude only if the target of the
/// query is "all", "noparent" or a name. Ancestors and descendants of the querying shape never count. Boxes are
/// tested as boxes; other closed solids (roofs, cut solids, cylinders) are cut to the box of the querying shape.
/// touches() tests boxes only. visible("street") is true if the shortest line from the middle of the querying
/// shape to the nearest shape of that name is not blocked; flat shapes count as targets. Without such a shape
/// it is false.
#include <unordered_map>

#include "core/generators/building/shapes.h"
#include "core/generators/building/spatial_queries.h"

namespace seedmesh::building {

/// A plane of snap lines: the points p with dot(normal, p) = distance.
struct SnapPlane {
  glm::dvec3 normal{0};
  double distance = 0;
};

enum class Cover : std::uint8_t { free, part, full };

/// The shapes of the first pass, and an index that answers queries about them. Immutable.
class FirstPassIndex {
 public:
  FirstPassIndex(Shapes shapes, std::vector<SnapPlane> snaps, const Grammar& grammar);

  /// Returns the answer for a shape of the second pass: 0 or 1, or a Cover. `lineage` has the keys of the shape and
  /// its ancestors, its own first.
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
  /// Returns null for a box.
  const Solid* solid_of(std::uint32_t shape) const;
  /// Returns the number of other active shapes with the label of the query, or the distance to the nearest of their
  /// scopes in metres. The distance is 1e6 if there is none.
  double measure(const Query& query, const Scope& scope, std::uint32_t self, Job& job) const;
  bool is_visible(const Query& query, const Scope& scope, std::uint32_t self, Job& job) const;
  /// Calls `body` for each candidate in a cell between low and high, perhaps more than once, until it returns
  /// false.
  template <class Body>
  void near(const glm::dvec3& low, const glm::dvec3& high, Job& job, Body&& body) const;

  Shapes shapes_;
  std::vector<SnapPlane> snaps_;
  const Grammar* grammar_;
  std::vector<std::uint32_t> last_;  ///< end of the descendants of each shape, by rank
  std::vector<std::uint32_t> rank_;  ///< position of each shape in a depth-first walk
  std::vector<Candidate> candidates_;
  std::unordered_map<std::uint64_t, std::uint32_t> of_key_;
  glm::dvec3 low_{0}, cell_{1};
  glm::ivec3 cells_{1};
  std::vector<std::uint32_t> first_, members_;
  std::uint32_t cell_of(const glm::ivec3& at) const;
};

}  // namespace seedmesh::building
