#pragma once
/// Streets along a tensor field. Chen, Esch, Wonka, Mueller and Zhang, "Interactive procedural street modeling", 2008.
#include <glm/vec2.hpp>
#include <memory>
#include <vector>

#include "core/base/job.h"
#include "core/base/result.h"
#include "core/generators/city/density.h"
#include "core/generators/city/region.h"
#include "core/generators/city/rings.h"

namespace seedmesh {
struct CityStreets;
struct CityTensorField;
enum class CityPattern;
}  // namespace seedmesh

namespace seedmesh::city {

struct GrowthInput;
class Landform;
struct Route;

/// A symmetric traceless tensor R [[cos 2a, sin 2a], [sin 2a, -cos 2a]] at each position: the weighted sum of the base
/// fields and of a weak grid. Immutable; threads may share it.
class TensorField {
 public:
  /// Copies the fields and the shores of the region. `landform`, null on level ground, has to outlive the field.
  /// Issues: a line or boundary without a position to follow.
  TensorField(const CityStreets& streets, const Region& region, const Landform* landform,
              std::vector<Issue>& issues);

  /// Makes the field of the pattern `slope`. It follows the contours of the ground, and the grid of the streets where
  /// the ground is level. `landform`, null on level ground, has to outlive the field.
  TensorField(const CityStreets& streets, const Landform* landform);

  /// Blends the pattern and the second pattern of the streets by a map that has to outlive the field. An organic
  /// pattern is a grid that smooth noise turns by up to 40 degrees.
  TensorField(const CityStreets& streets, const FieldMap& blend, const Landform* landform, Rng rng);

  /// Returns the share of an organic pattern at a position in centimetres; 0 without a blend.
  double organic_share_at(const glm::dvec2& cm) const;

  /// Returns R cos 2a and R sin 2a at a position in centimetres.
  glm::dvec2 tensor_at(const glm::dvec2& cm) const;

  /// Returns the major direction as a unit vector, of either sign; the minor one is its quarter turn. Returns (0, 0)
  /// at degenerate points.
  glm::dvec2 direction_at(const glm::dvec2& cm) const;

 private:
  enum class Shape { grid, radial, line, height, noise };
  struct Base {
    Shape shape = Shape::grid;
    glm::dvec2 position{0}, grid{1, 0};
    double weight = 1, size = 0;  ///< size in centimetres; 0: everywhere alike
    std::vector<CmRing> lines;
    /// Whether it belongs to the second pattern of a blend, whose weight is the value of the map.
    bool is_second = false;
  };
  static Base base_of(CityPattern pattern, const CityStreets& streets);
  glm::dvec2 tensor_of(const Base& base, const glm::dvec2& cm, double& squared_distance) const;
  /// Smooth noise from -1 to 1.
  double noise_at(const glm::dvec2& cm) const;

  std::vector<Base> bases_;
  const Landform* landform_;
  const FieldMap* blend_ = nullptr;
  double noise_size_ = 1;    ///< size of a cell of the noise, centimetres
  double slope_reach_ = 10;  ///< within which the ground decides a slope, m
  Rng rng_{0};
};

/// The fields that streets follow; null where they follow a pattern or the wards instead.
struct StreetFields {
  std::shared_ptr<const TensorField> majors, minors;
};

/// The data, besides the streets, on which the fields of a request depend. `blend` is the map of patterns.
struct FieldGround {
  const Region& region;
  const FieldMap* blend = nullptr;     ///< null: none
  const Landform* landform = nullptr;  ///< null: level ground
};

/// Returns the fields of the method and of the patterns. Minor streets follow the field of the major ones, unless
/// they have a pattern of their own. Issues: those of the tensor field.
StreetFields fields_of(const CityStreets& streets, const FieldGround& ground, Rng rng,
                       std::vector<Issue>& issues);

/// Returns the pattern where the map of patterns is 1.
CityPattern second_pattern_of(const CityStreets& streets);

/// Returns the highways and the major streets, divided where they cross. They are streamlines of both
/// directions, about `highway_spacing` and `major_spacing` apart (Jobard and Lefer, "Creating evenly spaced
/// streamlines of arbitrary density", 1997). At about the share `t_junctions` of the crossings one arm is
/// removed. On ground that is too steep for major streets, pieces are minor streets or left out. Random choices depend
/// on positions only.
Route trace_majors(const GrowthInput& input, const TensorField& field, Job& job);

}  // namespace seedmesh::city
