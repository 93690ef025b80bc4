#pragma once
/// Streets along a tensor field. Chen, Esch, Wonka, Mueller and Zhang, "Interactive procedural street modeling", 2008.
#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "core/base/job.h"
#include "core/base/result.h"
#include "core/generators/city/geometry.h"
#include "core/generators/city/region.h"

namespace seedmesh {
struct CityStreets;
struct CityTensorField;
}  // namespace seedmesh

namespace seedmesh::city {

struct GrowthInput;
class Landform;
struct Route;

/// A symmetric traceless tensor R [[cos 2a, sin 2a], [sin 2a, -cos 2a]] at each position: the weighted sum of the base
/// fields and of a weak grid. Immutable; threads may share it.
class TensorField {
 public:
  /// Copies the fields and the shores of the region. `landform`, null on level ground, has to outlive the field. The
  /// pattern slope adds a field of heights. Issues: a line or boundary without a position to follow.
  TensorField(const CityStreets& streets, const Region& region, const Landform* landform,
              std::vector<Issue>& issues);

  /// R cos 2a and R sin 2a at a position in centimetres.
  glm::dvec2 tensor_at(const glm::dvec2& cm) const;

  /// The major direction as a unit vector, of either sign; the minor one is its quarter turn. 0, 0 at degenerate
  /// points.
  glm::dvec2 direction_at(const glm::dvec2& cm) const;

 private:
  enum class Shape { grid, radial, line, height };
  struct Base {
    Shape shape = Shape::grid;
    glm::dvec2 position{0}, grid{1, 0};
    double weight = 1, size = 0;  ///< size in centimetres; 0: everywhere alike
    std::vector<CmRing> lines;
  };
  glm::dvec2 tensor_of(const Base& base, const glm::dvec2& cm, double& squared_distance) const;

  std::vector<Base> bases_;
  const Landform* landform_;
};

/// The major streets: streamlines of both directions about `major_spacing` apart (Jobard and Lefer, "Creating evenly
/// spaced streamlines of arbitrary density", 1997), cut where they cross, with the share `t_junctions` of the crossings
/// less one arm. Draws depend on positions only.
Route trace_majors(const GrowthInput& input, const TensorField& field, Job& job);

}  // namespace seedmesh::city
