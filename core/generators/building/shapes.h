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
constexpr std::uint32_t asset_bit =
    0x80000000U;  ///< set in the geometry of an asset, whose number the other bits are

constexpr std::uint8_t no_roof = 3;

/// A shape while the operations of a successor change it: a scope, the geometry in it, and what it inherits.
/// The scope reaches from `origin` along the columns of the axes by `size`. Its geometry lies in it as in the
/// unit cube.
struct ShapeState {
  glm::dvec3 origin{0}, size{0};
  std::uint32_t axes = 0, geometry = box_geometry, style = 0;  ///< into the tables of Shapes
  std::uint32_t split_index = 0, split_total = 0, comp_index = 0, comp_total = 0;
  std::uint8_t tag = 0;             ///< of a face, while a component split classifies it
  std::uint8_t roof_up = no_roof;   ///< of a roof: the axis of its scope that is up
  std::uint16_t selector = 0xFFFF;  ///< that took the shape in a component split: into Grammar::words

  bool has_asset() const { return (geometry & asset_bit) != 0; }
  bool has_solid() const { return geometry != box_geometry && !has_asset(); }
};

/// A shape of the derivation. 112 bytes.
struct Shape : ShapeState {
  std::uint64_t key = 0;  ///< place in the derivation, for random numbers
  std::uint32_t parent = none, symbol = none;
  std::uint32_t first_parameter = 0;
  std::uint16_t depth = 0;
  std::uint8_t parameter_count = 0;
  bool is_active = true;    ///< part of the result
  bool is_leaf = false;     ///< no rule is looked for
  bool is_carried = false;  ///< made of a face of a closed body, or stands on one

  Shape() = default;
  explicit Shape(const ShapeState& state) : ShapeState(state) { tag = 0; }
};

/// The values of an array of the rules. `columns` is 0 for a single column.
struct ValueArray {
  std::vector<lang::TaggedValue> values;
  std::uint32_t columns = 0;
  friend auto operator<=>(const ValueArray&, const ValueArray&) = default;
};

/// The texture coordinates of the sets 1 to 9: projections set up and in force, as in Style.
struct UvSets {
  std::array<std::uint32_t, 9> set_up{}, in_force{};
  friend auto operator<=>(const UvSets&, const UvSets&) = default;
};

/// What shapes inherit besides their scope. Equal styles are stored once.
struct Style {
  std::uint32_t color = 0, material = 0, label = 0;  ///< texts of Shapes::texts; 0: none
  std::uint32_t attributes = 0;                      ///< into Shapes::attribute_sets
  std::uint32_t projection_set_up = 0;               ///< into Shapes::projections, from 1; 0: none
  std::uint32_t projection = 0;                      ///< the one in force
  std::uint32_t options = 0;                         ///< of a part: into Shapes::part_options
  std::uint32_t uv_sets = 0;                         ///< into Shapes::uv_sets
  std::uint32_t tags = 0;                            ///< of all components: into Shapes::tag_sets

  friend auto operator<=>(const Style&, const Style&) = default;
};

/// A closed body that a component split took apart into faces.
struct DecomposedBody {
  glm::dvec3 origin{0}, size{0};
  std::uint32_t axes = 0, geometry = box_geometry;
};

/// The texture coordinates of a point p in the world, in tiles: dot(u, p) + u_at and dot(v, p) + v_at.
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
  std::vector<std::unique_ptr<const Solid>> solids;  ///< geometry 1 is the first
  std::vector<Style> styles{Style{}};
  std::vector<std::vector<lang::TaggedValue>> attribute_sets;
  std::vector<Projection> projections;
  std::vector<UvSets> uv_sets{UvSets{}};
  std::vector<std::vector<std::uint32_t>> tag_sets{{}};  ///< texts, rising
  std::vector<ValueArray> arrays;
  std::vector<DecomposedBody> masses;  ///< those on no other body; only with Task::keeps_masses
  std::vector<PartOptions> part_options{PartOptions{}};
  std::map<std::string, Report> reports;
  std::vector<std::string_view> asset_names;  ///< of geometry with asset_bit; not owned
  Texts texts;
  std::vector<Warning> warnings;
  bool takes_away = false;        ///< a NIL has been run
  std::vector<bool> found_edits;  ///< for each edit of Task::edits: was its shape made?
  std::map<std::uint32_t, std::uint32_t> symbols_before_edits;  ///< of shapes whose rule an edit has changed
  /// For each shape the choice of Grammar::choices that replaced it, or `none`. It may have fewer rows than
  /// `shapes`. Only with Task::keeps_choices.
  std::vector<std::uint32_t> choices;

  explicit Shapes(const Job& job) : shapes(job), parameters(job) {}
  const Solid& solid_of(std::uint32_t geometry) const { return *solids[geometry - 1]; }
};

/// The number of axes of the scope with a size.
inline int dimension(const glm::dvec3& size) { return (size.x != 0) + (size.y != 0) + (size.z != 0); }

/// The axis of the normal of a flat shape: the one without a size, y if there are several.
inline int flat_axis(const glm::dvec3& size) { return size.y == 0 ? 1 : size.z == 0 ? 2 : 0; }

}  // namespace seedmesh::building
