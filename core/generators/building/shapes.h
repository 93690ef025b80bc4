#pragma once
/// The result of a derivation: shapes with their scopes, and the tables that they share.
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/array.h"
#include "core/generators/building/parts/parts.h"
#include "core/generators/building/solid.h"
#include "core/generators/building/syntax.h"

namespace seedmesh::building {

constexpr std::uint32_t box_geometry = 0;  ///< fills the scope: a box, or a rectangle if a size is 0
/// Set if the geometry is an asset. The other bits are then the index of the asset.
constexpr std::uint32_t asset_bit = 0x80000000U;

/// The value of `roof_up` of a shape that is not a roof; axes are 0 to 2.
constexpr std::uint8_t no_roof = 3;

/// A shape while the operations of a successor change it: a scope, the geometry in it, and what it inherits.
/// The scope is the box at `origin` with edges `size` along the columns of the axes. Geometry is stored in coordinates
/// of the unit cube, which the scope scales.
struct ShapeState {
  glm::dvec3 origin{0}, size{0};
  std::uint32_t axes = 0, geometry = box_geometry, style = 0;  ///< indices into the tables of Shapes
  std::uint32_t split_index = 0, split_total = 0, comp_index = 0, comp_total = 0;
  std::uint8_t tag = 0;            ///< class of a face (front, side, ...) during a component split, else 0
  std::uint8_t roof_up = no_roof;  ///< the axis of the scope of a roof that is up
  /// Index into Grammar::words of the selector that matched this shape in a component split; 0xFFFF: none.
  std::uint16_t selector = 0xFFFF;

  bool has_asset() const { return (geometry & asset_bit) != 0; }
  bool has_solid() const { return geometry != box_geometry && !has_asset(); }
};

/// A shape of the derivation. It takes 112 bytes.
struct Shape : ShapeState {
  std::uint64_t key = 0;  ///< hash of the path in the derivation; it keys the random numbers of the shape
  std::uint32_t parent = none, symbol = none;
  std::uint32_t first_parameter = 0;
  std::uint16_t depth = 0;
  std::uint8_t parameter_count = 0;
  bool is_active = true;  ///< part of the result
  bool is_leaf = false;   ///< no rule is applied to the shape, even if its symbol has one
  /// The shape was made from a face of a closed body, or descends from such a shape.
  bool is_carried = false;

  Shape() = default;
  explicit Shape(const ShapeState& state) : ShapeState(state) { tag = 0; }
};

/// The values of an array of the rules. `columns` is 0 for a single column.
struct ValueArray {
  std::vector<lang::TaggedValue> values;
  std::uint32_t columns = 0;
  friend auto operator<=>(const ValueArray&, const ValueArray&) = default;
};

/// Projections of the texture coordinate sets 1 to 9, as indices like those in Style: those that setupProjection
/// defines, and those that projectUV has applied.
struct UvSets {
  std::array<std::uint32_t, 9> set_up{}, applied{};
  friend auto operator<=>(const UvSets&, const UvSets&) = default;
};

/// What shapes inherit besides their scope. Equal styles are stored once.
struct Style {
  std::uint32_t color = 0, material = 0, label = 0;  ///< texts of Shapes::texts; 0: none
  std::uint32_t attributes = 0;                      ///< index into Shapes::attribute_sets
  std::uint32_t projection_set_up = 0;               ///< index into Shapes::projections plus 1; 0: none
  std::uint32_t projection = 0;                      ///< the one that projectUV has applied
  std::uint32_t options = 0;                         ///< index into Shapes::part_options
  std::uint32_t uv_sets = 0;                         ///< index into Shapes::uv_sets
  std::uint32_t tags = 0;  ///< index into Shapes::tag_sets: tags that all components of the shape have

  friend auto operator<=>(const Style&, const Style&) = default;
};

/// A closed body that a component split has divided into faces.
struct DecomposedBody {
  glm::dvec3 origin{0}, size{0};
  std::uint32_t axes = 0, geometry = box_geometry;
};

/// Maps a world position p to the texture coordinates (dot(u, p) + u_at, dot(v, p) + v_at). A coordinate grows by 1
/// over one repetition of the texture.
struct Projection {
  glm::dvec3 u{0}, v{0};
  double u_at = 0, v_at = 0;
};

/// The values that were reported under one key.
struct Report {
  std::uint64_t count = 0;
  double sum = 0, least = 0, greatest = 0;
};

struct Shapes {
  Array<Shape> shapes;
  Array<lang::TaggedValue> parameters;
  std::vector<glm::dmat3> axes{glm::dmat3(1)};
  std::vector<std::unique_ptr<const Solid>> solids;  ///< solids[g - 1] belongs to geometry g
  std::vector<Style> styles{Style{}};
  std::vector<std::vector<lang::TaggedValue>> attribute_sets;
  std::vector<Projection> projections;
  std::vector<UvSets> uv_sets{UvSets{}};
  std::vector<std::vector<std::uint32_t>> tag_sets{{}};  ///< sets of indices of texts, sorted ascending
  std::vector<ValueArray> arrays;
  /// The main closed bodies: those that come from no face of another body. Filled only if Task::keeps_masses is set.
  std::vector<DecomposedBody> masses;
  std::vector<PartOptions> part_options{PartOptions{}};
  std::map<std::string, Report> reports;
  std::vector<std::string_view> asset_names;  ///< names of the assets to which asset_bit refers; not owned
  Texts texts;
  std::vector<Warning> warnings;
  bool has_removed_shape = false;  ///< a rule or an edit has removed a shape (NIL)
  std::vector<bool> found_edits;   ///< whether the shape of each edit of Task::edits was made
  /// Symbols of shapes whose rule an edit has changed.
  std::map<std::uint32_t, std::uint32_t> symbols_before_edits;
  /// For each shape the choice of Grammar::choices that replaced it, or `none`. It may have fewer rows than
  /// `shapes`. Only with Task::keeps_choices.
  std::vector<std::uint32_t> choices;

  explicit Shapes(const Job& job) : shapes(job), parameters(job) {}
  const Solid& solid_of(std::uint32_t geometry) const { return *solids[geometry - 1]; }
};

/// Returns the number of axes along which the size of the scope is not 0.
inline int dimension(const glm::dvec3& size) { return (size.x != 0) + (size.y != 0) + (size.z != 0); }

/// Returns the axis of the normal of a flat shape: the first of y, z, x whose size is 0.
inline int flat_axis(const glm::dvec3& size) { return size.y == 0 ? 1 : size.z == 0 ? 2 : 0; }

}  // namespace seedmesh::building
