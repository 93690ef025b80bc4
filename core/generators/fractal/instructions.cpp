/// Named instructions: Kogovšek, "Proceduralno modeliranje" (2014), 2.3.2, for menger_sponge to word_test;
/// Barnsley, "Fractals Everywhere" (1988), table 3.3, for the fern; the others are standard.
#include "core/generators/fractal/instructions.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "core/base/math.h"
#include "core/generators/fractal/word.h"
#include "core/schema/json.h"
#include "generated/params/fractal.h"

namespace seedmesh::fractal {
namespace {

using Name = FractalInstructions;

constexpr double least_share = 0.01;     ///< of a map without volume, which would otherwise never be chosen
constexpr double norm_tolerance = 1e-9;  ///< so that rounding errors of rotations do not count as stretching
constexpr double grow_tolerance = 1e-9;

Affine scaled(double scale, const glm::dvec3& offset) { return {glm::dmat3(scale), offset}; }

/// The cells of the unit cube divided into parts^3 for which keep(|x|, |y|, |z|) is true. Indices count from
/// the middle.
template <class Keep>
std::vector<Affine> cells(int parts, int depth, const Keep& keep) {
  std::vector<Affine> maps;
  const int half = parts / 2, deep = depth / 2;
  for (int z = -deep; z <= deep; ++z) {
    for (int y = -half; y <= half; ++y) {
      for (int x = -half; x <= half; ++x) {
        if (keep(std::abs(x), std::abs(y), std::abs(z)))
          maps.push_back(scaled(1.0 / parts, glm::dvec3(x, y, z) / static_cast<double>(parts)));
      }
    }
  }
  return maps;
}

std::vector<Affine> thirds(bool (*keep)(int distance)) {
  return cells(3, 3, [keep](int x, int y, int z) { return keep(x + y + z); });
}

/// At each corner of the block three copies of a third of its size, one on each of the three faces that meet
/// there.
std::vector<Affine> corners_outside() {
  std::vector<Affine> maps;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 sign{(corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1};
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 offset = sign / 3.0;
      offset[axis] *= 2;
      maps.push_back(scaled(1.0 / 3, offset));
    }
  }
  return maps;
}

std::vector<Affine> corners(double scale) {
  std::vector<Affine> maps;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 sign{(corner & 1) ? 1 : -1, (corner & 2) ? 1 : -1, (corner & 4) ? 1 : -1};
    maps.push_back(scaled(scale, sign * ((1 - scale) / 2)));
  }
  return maps;
}

/// The cube of Eric Baird: eight corners of scale r and twelve edges of scale r², with r² + 2r = 1.
std::vector<Affine> jerusalem() {
  const double r = std::sqrt(2.0) - 1;
  std::vector<Affine> maps = corners(r);
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 4; ++side) {
      glm::dvec3 offset{0};
      offset[(axis + 1) % 3] = ((side & 1) ? 1 : -1) * (1 - r * r) / 2;
      offset[(axis + 2) % 3] = ((side & 2) ? 1 : -1) * (1 - r * r) / 2;
      maps.push_back(scaled(r * r, offset));
    }
  }
  return maps;
}

/// A map of the XY plane with the scale `depth` along Z.
Affine plane(double degrees, double scale, const glm::dvec2& offset, double depth) {
  const math::SinCos turn = math::sincos_degrees(degrees);
  return {
      glm::dmat3{
          {turn.cos * scale, turn.sin * scale, 0}, {-turn.sin * scale, turn.cos * scale, 0}, {0, 0, depth}},
      {offset, 0}};
}

/// Heighway's dragon between (-1/3, 0) and (2/3, 0).
std::vector<Affine> dragon() {
  const double r = std::sqrt(0.5);
  // Maps of the segment from 0 to 1, conjugated by the translation of the frame.
  const auto moved = [](Affine map) {
    const glm::dvec3 origin{-1.0 / 3, 0, 0};
    map.offset += origin - map.linear * origin;
    return map;
  };
  return {moved(plane(45, r, {0, 0}, r)), moved(plane(135, r, {1, 0}, r))};
}

/// Four smaller trees on a trunk.
std::vector<Affine> tree_branches() {
  // The foot of a copy is on the trunk.
  const auto branch = [](double scale, double lean, double about, double height) {
    const math::SinCos l = math::sincos_degrees(lean), a = math::sincos_degrees(about);
    const glm::dmat3 leaning{{l.cos, l.sin, 0}, {-l.sin, l.cos, 0}, {0, 0, 1}};
    const glm::dmat3 turned{{a.cos, 0, -a.sin}, {0, 1, 0}, {a.sin, 0, a.cos}};
    Affine map{turned * leaning * scale, {0, 0, 0}};
    map.offset = glm::dvec3(0, height, 0) - map.linear * glm::dvec3(0, -0.5, 0);
    return map;
  };
  return {branch(0.62, -28, 0, -0.14), branch(0.6, -32, 120, -0.2), branch(0.58, -36, 240, -0.24),
          branch(0.5, 6, 60, -0.12)};
}

/// Barnsley's fern, scaled by a tenth into the unit frame. Its box is [-2.182, 2.656] x [0, 9.998].
std::vector<Affine> fern() {
  constexpr double unit = 10;
  const glm::dvec3 middle{0.24, 5, 0};
  const auto row = [&](double a, double b, double c, double d, double f, double depth) {
    Affine map{glm::dmat3{{a, c, 0}, {b, d, 0}, {0, 0, depth}}, {0, f, 0}};
    map.offset = (map(middle) - middle) / unit;
    return map;
  };
  return {row(0, 0, 0, 0.16, 0, 0.05), row(0.85, 0.04, -0.04, 0.85, 1.6, 0.85),
          row(0.2, -0.26, 0.23, 0.22, 1.6, 0.3), row(-0.15, 0.28, 0.26, 0.24, 0.44, 0.3)};
}

std::vector<Affine> koch() {
  const double third = 1.0 / 3, height = std::sqrt(3.0) / 12;
  return {scaled(third, {-third, 0, 0}), plane(60, third, {-third / 4, height}, third),
          plane(-60, third, {third / 4, height}, third), scaled(third, {third, 0, 0})};
}

/// The sides of a triangle with edges of 3/4, so that the snowflake fits into the unit frame.
std::vector<Affine> triangle_sides() {
  constexpr double edge = 0.75;
  const double inner = edge * std::sqrt(3.0) / 6;
  std::vector<Affine> sides;
  for (int side = 0; side < 3; ++side) {
    const math::SinCos turn = math::sincos_degrees(-120.0 * side);
    sides.push_back(plane(-120.0 * side, edge, glm::dvec2(-turn.sin, turn.cos) * inner, edge));
  }
  return sides;
}

std::vector<Affine> gasket() {
  return {scaled(0.5, {-0.25, -0.25, 0}), scaled(0.5, {0.25, -0.25, 0}), scaled(0.5, {0, 0.25, 0})};
}

std::vector<Affine> pyramid() {
  return {scaled(0.5, {-0.25, -0.25, -0.25}), scaled(0.5, {0.25, -0.25, -0.25}),
          scaled(0.5, {-0.25, -0.25, 0.25}), scaled(0.5, {0.25, -0.25, 0.25}), scaled(0.5, {0, 0.25, 0})};
}

std::vector<Affine> tetrahedron() {
  return {scaled(0.5, {0.25, 0.25, 0.25}), scaled(0.5, {0.25, -0.25, -0.25}),
          scaled(0.5, {-0.25, 0.25, -0.25}), scaled(0.5, {-0.25, -0.25, 0.25})};
}

/// Odd numbers of Pascal's triangle, its apex in the upper left.
std::vector<Affine> pascal() {
  return {scaled(0.5, {-0.25, 0.25, 0}), scaled(0.5, {-0.25, -0.25, 0}), scaled(0.5, {0.25, -0.25, 0})};
}

std::vector<Affine> maps_of(Name name, std::string_view text) {
  switch (name) {
    case Name::menger_sponge:
      return thirds([](int d) { return d >= 2; });
    case Name::koch_cube:
      return thirds([](int d) { return d == 2; });
    case Name::corner_cube:
      return thirds([](int d) { return d == 3; });
    case Name::corner_cube_centre:
      return thirds([](int d) { return d == 3 || d == 0; });
    case Name::corner_cube_outside:
      return corners_outside();
    case Name::corner_cube_two_thirds:
      return corners(2.0 / 3);
    case Name::sierpinski_pyramid:
      return pyramid();
    case Name::sierpinski_triangle:
      return gasket();
    case Name::word_test:
      return word_maps(text);
    case Name::sierpinski_tetrahedron:
      return tetrahedron();
    case Name::sierpinski_carpet:
      return cells(3, 1, [](int x, int y, int) { return x + y > 0; });
    case Name::cantor_dust:
      return corners(1.0 / 3);
    case Name::vicsek:
      return thirds([](int d) { return d <= 1; });
    case Name::mosely_snowflake:
      return thirds([](int d) { return d == 1 || d == 2; });
    case Name::jerusalem_cube:
      return jerusalem();
    case Name::pascal_parity:
      return pascal();
    case Name::dragon:
      return dragon();
    case Name::tree:
      return tree_branches();
    case Name::fern:
      return fern();
    case Name::koch_curve:
    case Name::koch_snowflake:
      return koch();
  }
  return {};
}

void fill_named(Instructions& out, Name name, std::string_view text, bool by_chance) {
  out.name = text_of(name);
  out.maps = maps_of(name, text);
  out.keeps = name == Name::corner_cube_outside || (name == Name::tree && !by_chance);
  if (name == Name::sierpinski_pyramid) out.separate = "pyramid";
  if (name == Name::sierpinski_tetrahedron) out.separate = "tetrahedron";
  if (name == Name::fern) out.weights = {0.01, 0.85, 0.07, 0.07};
  if (name == Name::koch_snowflake) out.arrangement = triangle_sides();
  if (name != Name::tree) return;
  out.stem = {glm::dmat3{{0.07, 0, 0}, {0, 0.4, 0}, {0, 0, 0.07}}, {0, -0.3, 0}};
  if (by_chance) out.maps.push_back(out.stem);
}

glm::dmat3 turn_about(int axis, double degrees) {
  const math::SinCos turn = math::sincos_degrees(degrees);
  glm::dmat3 matrix(1);
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  matrix[u][u] = matrix[v][v] = turn.cos;
  matrix[u][v] = turn.sin;
  matrix[v][u] = -turn.sin;
  return matrix;
}

Affine map_of(const FractalMap& given) {
  if (given.matrix) {
    const auto& m = *given.matrix;
    return {glm::dmat3{{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}}, {m[3], m[7], m[11]}};
  }
  glm::dvec3 scale(0);
  for (int axis = 0; axis < 3; ++axis) {
    scale[axis] = given.scale.index() == 0 ? std::get<0>(given.scale)
                                           : std::get<1>(given.scale)[static_cast<std::size_t>(axis)];
  }
  glm::dmat3 linear =
      turn_about(2, given.rotate[2]) * turn_about(1, given.rotate[1]) * turn_about(0, given.rotate[0]);
  for (int axis = 0; axis < 3; ++axis) linear[axis] *= scale[axis];
  return {linear, {given.translate[0], given.translate[1], given.translate[2]}};
}

bool is_identity(const Affine& map) { return map.linear == glm::dmat3(1) && map.offset == glm::dvec3(0); }

/// The volume of a copy, or its area in XY if the map is flat.
double share_of(const Affine& map) {
  const double area = std::abs(map.linear[0][0] * map.linear[1][1] - map.linear[1][0] * map.linear[0][1]);
  const double volume = std::abs(glm::determinant(map.linear));
  return volume > 0 ? volume : area;
}

void fill_weights(Instructions& out) {
  double sum = 0;
  for (const Affine& map : out.maps) sum += share_of(map);
  for (const Affine& map : out.maps)
    out.weights.push_back(std::max(share_of(map), sum > 0 ? least_share * sum : 1));
}

void fill_list(Instructions& out, const std::vector<FractalMap>& list, bool by_chance) {
  bool any = false;
  for (const FractalMap& given : list) {
    const Affine map = map_of(given);
    if (!by_chance && is_identity(map)) {
      out.keeps = true;
      continue;
    }
    out.maps.push_back(map);
    any = any || given.probability.has_value();
  }
  if (!any || !by_chance) return;
  for (std::size_t i = 0; i < list.size(); ++i)
    out.weights.push_back(list[i].probability.value_or(share_of(out.maps[i])));
}

void check_map(const FractalMap& given, const std::string& pointer, bool by_chance,
               std::vector<Issue>& issues) {
  static const FractalMap plain;
  if (given.matrix &&
      !(given.scale == plain.scale && given.rotate == plain.rotate && given.translate == plain.translate)) {
    issues.emplace_back(conflict_with({"matrix", "scale", "rotate", "translate"}), pointer,
                        "found \"matrix\" beside scale, rotate or translate, expected one of the two forms");
    return;
  }
  const Affine map = map_of(given);
  const double stretch = norm(map);
  const std::string member = pointer + (given.matrix ? "/matrix" : "/scale");
  const bool flat = given.scale.index() == 0 ? std::get<0>(given.scale) == 0
                                             : std::ranges::count(std::get<1>(given.scale), 0.0) > 0;
  if (!given.matrix && flat) {
    issues.emplace_back(IssueKind::invalid_value, member,
                        "found a scale of 0, which leaves nothing of the element; a matrix may flatten it");
  } else if (stretch == 0) {
    issues.emplace_back(IssueKind::invalid_value, member,
                        "found a matrix of zeros, which leaves nothing of the element");
  } else if (by_chance && stretch >= 1 - norm_tolerance) {
    issues.emplace_back(
        IssueKind::invalid_value, member,
        "found a map that does not contract: its norm is " + number_text(stretch) + ", expected below 1");
  } else if (!by_chance && stretch > 1 + grow_tolerance) {
    issues.emplace_back(
        IssueKind::invalid_value, member,
        "found a map that enlarges its copy: its norm is " + number_text(stretch) + ", expected at most 1");
  }
}

/// The sum of the probabilities for frcm, if the list gives any and they do not sum to 1.
std::optional<double> odd_sum_of_weights(const FractalParams& params) {
  if (params.method != FractalMethod::frcm || params.instructions.index() == 0) return std::nullopt;
  const auto& list = std::get<1>(params.instructions);
  const auto has_probability = [](const FractalMap& map) { return map.probability.has_value(); };
  if (std::ranges::none_of(list, has_probability)) return std::nullopt;
  double sum = 0;
  for (const FractalMap& map : list) sum += map.probability.value_or(share_of(map_of(map)));
  return std::abs(sum - 1) <= 1e-6 ? std::nullopt : std::optional(sum);
}

}  // namespace

std::optional<Warning> warning_of_weights(const FractalParams& params) {
  if (params.weights == FractalWeights::strict || !odd_sum_of_weights(params)) return std::nullopt;
  return Warning{"/instructions",
                 "the probabilities of the maps do not sum to 1; they count as shares of their sum", 0, 0};
}

Instructions instructions_of(const FractalParams& params) {
  Instructions out;
  const bool by_chance = params.method == FractalMethod::frcm;
  if (params.instructions.index() == 0) {
    fill_named(out, std::get<0>(params.instructions), params.text, by_chance);
  } else {
    fill_list(out, std::get<1>(params.instructions), by_chance);
  }
  if (out.weights.empty()) fill_weights(out);
  return out;
}

std::vector<Issue> check_instructions(const FractalParams& params) {
  std::vector<Issue> issues;
  if (params.instructions.index() == 0) {
    if (std::get<0>(params.instructions) != Name::word_test) return issues;
    const auto odd = std::ranges::find_if(params.text, [](char c) { return !has_letter(c); });
    if (odd != params.text.end()) {
      issues.push_back(issue_at(IssueKind::invalid_value, "/text", params.text,
                                static_cast<std::size_t>(odd - params.text.begin()),
                                "found a character that has no letter, expected A to Z, 0 to 9 or a space"));
    } else if (word_maps(params.text).empty()) {
      issues.emplace_back(IssueKind::invalid_value, "/text", "found a word of spaces, expected letters");
    }
    return issues;
  }
  const auto& list = std::get<1>(params.instructions);
  const bool by_chance = params.method == FractalMethod::frcm;
  double sum = 0;
  std::size_t copies = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    check_map(list[i], "/instructions/" + std::to_string(i), by_chance, issues);
    sum += list[i].probability.value_or(1);
    copies += is_identity(map_of(list[i])) ? 0 : 1;
  }
  if (issues.empty() && !by_chance && copies == 0) {
    issues.emplace_back(IssueKind::invalid_value, "/instructions",
                        "found only the identity, expected a map that makes a smaller copy");
  }
  if (issues.empty() && by_chance && !(sum > 0))
    issues.emplace_back(IssueKind::invalid_value, "/instructions", "found probabilities that are all 0");
  const std::optional<double> odd = issues.empty() ? odd_sum_of_weights(params) : std::nullopt;
  if (odd && params.weights == FractalWeights::strict) {
    issues.emplace_back(IssueKind::invalid_value, "/instructions",
                        "the probabilities of the maps sum to " + number_text(std::round(*odd * 1e9) / 1e9) +
                            ", expected 1 because `weights` is strict");
  }
  return issues;
}

}  // namespace seedmesh::fractal
