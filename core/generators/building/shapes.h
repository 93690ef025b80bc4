#pragma once
/// What a derivation makes: shapes with their scopes, and the tables they share: axes, geometry, style.
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

constexpr std::uint32_t box_geometry = 0;  ///< the whole scope, or the rectangle that a size of 0 leaves
constexpr std::uint32_t asset_bit = 0x80000000U;  ///< geometry that is an asset: its place with this bit

constexpr std::uint8_t no_roof = 3;

/// A scope with what fills it. Scope: from `origin` along the columns of the axes by `size`. Its geometry
/// lies in it as in the unit cube. 112 bytes.
struct Shape {
  glm::dvec3 origin{0}, size{1};
  std::uint64_t key = 0;  ///< place in the derivation, for randomness
  std::uint32_t parent = none, symbol = none;
  std::uint32_t axes = 0, geometry = box_geometry, style = 0;
  std::uint32_t first_parameter = 0;
  std::uint32_t split_index = 0, split_total = 0, comp_index = 0, comp_total = 0;
  std::uint16_t depth = 0;
  std::uint8_t parameter_count = 0;
  bool is_active = true;           ///< part of the result
  bool is_leaf = false;            ///< no rule is looked for
  std::uint8_t roof_up = no_roof;  ///< of a roof: the axis of its scope that is up
  bool is_carried = false;         ///< made of a face of a closed body, or stands on one
};

/// What shapes inherit besides their place. Equal ones are one.
struct Style {
  double color = 0;     ///< text of "#rrggbb", 0: none
  double material = 0;  ///< text of its name, 0: none
  double label = 0;
  std::uint32_t attributes = 0;         ///< into Shapes::attribute_sets
  std::uint32_t projection_set_up = 0;  ///< into Shapes::projections, from 1; 0: none
  std::uint32_t projection = 0;         ///< the one in force
  std::uint32_t options = 0;            ///< of a part: into Shapes::part_options

  friend auto operator<=>(const Style&, const Style&) = default;
};

/// A closed body that was taken apart into faces.
struct TakenApart {
  glm::dvec3 origin{0}, size{0};
  std::uint32_t axes = 0, geometry = box_geometry;
};

/// Texture coordinates of a point in the world: dot(u, p) + u_at and dot(v, p) + v_at, in tiles.
struct Projection {
  glm::dvec3 u{0}, v{0};
  double u_at = 0, v_at = 0;
};

/// count, sum, least and greatest of what was reported under one key.
struct Report {
  std::uint64_t count = 0;
  double sum = 0, least = 0, greatest = 0;
};

struct Shapes {
  Array<Shape> shapes;
  Array<double> parameters;
  std::vector<glm::dmat3> axes{glm::dmat3(1)};
  std::vector<std::unique_ptr<const Solid>> solids;  ///< geometry 1 is the first
  std::vector<Style> styles{Style{}};
  std::vector<std::vector<double>> attribute_sets;
  std::vector<Projection> projections;
  std::vector<TakenApart> masses;  ///< those that nothing carries; where Task::keeps_masses asks for them
  std::vector<PartOptions> part_options{PartOptions{}};
  std::map<std::string, Report> reports;
  std::vector<std::string> asset_names;  ///< of geometry with asset_bit
  Texts texts;
  std::vector<Warning> warnings;
  bool takes_away = false;  ///< a NIL has been run
  /// By shape, into Grammar::choices: what replaced it. Where Task::keeps_choices asks for them; it may end
  /// before the shapes do, and `none` is no choice.
  std::vector<std::uint32_t> choices;

  explicit Shapes(const Job& job) : shapes(job), parameters(job) {}
  const Solid& solid_of(std::uint32_t geometry) const { return *solids[geometry - 1]; }
};

/// How many axes of the scope have a size.
inline int dimension(const glm::dvec3& size) { return (size.x != 0) + (size.y != 0) + (size.z != 0); }

/// The axis of a flat shape's normal: the one without size; y where there are more.
inline int flat_axis(const glm::dvec3& size) { return size.y == 0 ? 1 : size.z == 0 ? 2 : 0; }

}  // namespace seedmesh::building
