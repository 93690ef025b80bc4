#include "core/generators/fractal/measure.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/fractal/element.h"
#include "core/generators/fractal/pieces.h"
#include "core/generators/fractal/topology.h"
#include "generated/params/fractal.h"

namespace seedmesh::fractal {
namespace {

constexpr double most_counted_cells = 0x1p27;

double power(double base, int exponent) {
  double result = 1;
  for (int i = 0; i < exponent; ++i) result *= base;
  return result;
}

std::optional<double> dimension_of(const Instructions& instructions) {
  std::vector<double> scales;
  for (const Affine& map : instructions.maps) {
    const std::optional<double> scale = similarity(map);
    if (!scale || !(*scale < 1)) return std::nullopt;
    scales.push_back(*scale);
  }
  const auto [least, most] = std::ranges::minmax(scales);
  if (scales.size() == 1) return 0.0;
  if (most - least <= 1e-12 * most)
    return math::log(static_cast<double>(scales.size())) / -math::log(scales.front());
  // The sum falls with D. At 0 it is the number of maps.
  double low = 0, high = 64;
  for (int step = 0; step < 200 && low < high; ++step) {
    const double middle = (low + high) / 2;
    double sum = 0;
    for (const double scale : scales) sum += math::pow(scale, middle);
    (sum > 1 ? low : high) = middle;
  }
  return (low + high) / 2;
}

double cells_of_box(const Lattice& lattice, int rounds) {
  glm::dvec3 least(lattice.cells.front()), most = least;
  for (const glm::ivec3& cell : lattice.cells) {
    least = glm::min(least, glm::dvec3(cell));
    most = glm::max(most, glm::dvec3(cell));
  }
  const double side = lattice.side(rounds), series = (side - 1) / (lattice.parts - 1);
  glm::dvec3 size = (most - least) * series + 1.0;
  if (lattice.keeps) size = glm::max(size, glm::dvec3(side));
  return size.x * size.y * size.z;
}

void measure_lattice(const Lattice& lattice, int rounds, const Job& job, Measure& out) {
  const double side = lattice.side(rounds);
  out.exposed_quads = exposed_quads(lattice, rounds);
  if (lattice.inside())
    out.volume = power(static_cast<double>(lattice.cells.size()) / power(lattice.parts, 3), rounds);
  if (cells_of_box(lattice, rounds) <= most_counted_cells) {
    const SolidTopology topology = topology_of(grid_of(lattice, rounds, {0, 1, 2}, job), job);
    const bool whole = lattice.block == glm::ivec3(1);
    if (whole) out.exposed_quads = static_cast<double>(topology.squares);
    const int in_block = lattice.block.x * lattice.block.y * lattice.block.z;
    if (!lattice.inside()) out.volume = static_cast<double>(topology.cells) / (power(side, 3) * in_block);
    out.non_manifold_edges = static_cast<double>(topology.four_face_edges);
    if (const auto genus = topology.genus()) out.genus = static_cast<double>(*genus);
  }
  if (out.exposed_quads) out.surface_area = *out.exposed_quads / (side * side);
}

/// For copies of one scale that touch at most along edges: areas and volumes add up.
void measure_separate(const FractalParams& params, const Instructions& instructions, int rounds,
                      Measure& out) {
  if (params.element.index() != 0 || text_of(std::get<0>(params.element)) != instructions.separate) return;
  const std::optional<Measures> element = measures_of(params);
  if (!element) return;
  const double scale = similarity(instructions.maps.front()).value_or(1);
  out.surface_area =
      element->area * power(static_cast<double>(instructions.maps.size()) * scale * scale, rounds);
  out.volume =
      element->volume * power(static_cast<double>(instructions.maps.size()) * scale * scale * scale, rounds);
}

/// Bounds for maps without rotation, which map each axis by itself.
std::optional<Box> straight_bounds(const Instructions& instructions, int rounds) {
  for (const Affine& map : instructions.maps) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        if (i != j && map.linear[i][j] != 0) return std::nullopt;
      }
    }
  }
  if (!instructions.arrangement.empty()) return std::nullopt;
  glm::dvec3 low(-0.5), high(0.5);
  for (int round = 0; round < rounds; ++round) {
    glm::dvec3 next_low(1e300), next_high(-1e300);
    if (instructions.keeps) {
      next_low = glm::dvec3(-0.5);
      next_high = glm::dvec3(0.5);
    }
    for (const Affine& map : instructions.maps) {
      const glm::dvec3 a = map(low), b = map(high);
      next_low = glm::min(next_low, glm::min(a, b));
      next_high = glm::max(next_high, glm::max(a, b));
    }
    if (next_low == low && next_high == high) break;
    low = next_low;
    high = next_high;
  }
  return Box{glm::vec3(low), glm::vec3(high)};
}

/// Lengths of copies of a segment add up. The snowflake's plate has the outline of these segments; a triangle is added
/// to each of them in every round, with a ninth of the area of those of the round before. The curve encloses these
/// triangles and the line between its ends.
void measure_curve(const FractalParams& params, const Instructions& instructions, int rounds, Measure& out) {
  if (!is_named(params, FractalElement::segment) && !is_named(params, FractalElement::plate)) return;
  const auto sum_of_scales = [](const std::vector<Affine>& maps) -> std::optional<double> {
    double sum = 0;
    for (const Affine& map : maps) {
      const std::optional<double> scale = similarity(map);
      if (!scale) return std::nullopt;
      sum += *scale;
    }
    return sum;
  };
  const std::optional<double> factor = sum_of_scales(instructions.maps);
  const std::optional<double> first =
      instructions.arrangement.empty() ? 1.0 : sum_of_scales(instructions.arrangement);
  if (!factor || !first || instructions.keeps) return;
  out.length = *first * power(*factor, rounds);
  const bool is_snowflake = instructions.name == "koch_snowflake";
  if (!is_snowflake && instructions.name != "koch_curve") return;
  const double side = is_snowflake ? *first / 3 : *first, triangle = std::sqrt(3.0) / 4 * side * side;
  const double added = 0.2 * (1 - power(4.0 / 9, rounds));  // to one side, as a share of the triangle on it
  out.area = triangle * (is_snowflake ? 1 + 3 * added : added);
}

/// Does the element fill its frame?
bool fills_frame(const FractalParams& params) {
  if (params.element.index() != 0) return false;
  const FractalElement name = std::get<0>(params.element);
  return name != FractalElement::letter_plate && name != FractalElement::segment;
}

}  // namespace

std::optional<double> exposed_quads(const Lattice& lattice, int rounds) {
  if (!lattice.inside()) return std::nullopt;
  const auto copies = static_cast<double>(lattice.cells.size());
  double touching = 0;
  for (int axis = 0; axis < 3; ++axis) {
    double neighbours = 0, across = 0;  // pairs in one block, and across the border of two equal blocks
    for (const glm::ivec3& a : lattice.cells) {
      for (const glm::ivec3& b : lattice.cells) {
        glm::ivec3 step = b - a;
        const int along = step[axis];
        step[axis] = 0;
        if (step != glm::ivec3(0)) continue;
        neighbours += along == 1 ? 1 : 0;
        across += along == 1 - lattice.parts ? 1 : 0;
      }
    }
    double pairs = 0, wall = 1;  // touching cells, and those across the border of two equal blocks
    for (int round = 0; round < rounds; ++round) {
      pairs = copies * pairs + neighbours * wall;
      wall *= across;
    }
    touching += pairs;
  }
  return 6 * power(copies, rounds) - 2 * touching;
}

Measure measure(const FractalParams& params, const Instructions& instructions, int rounds, const Job& job) {
  Measure out;
  out.pieces = pieces_after(instructions, rounds);
  out.dimension = dimension_of(instructions);
  const std::optional<Lattice> lattice = lattice_of(instructions);
  if (is_cube(params) && lattice) measure_lattice(*lattice, rounds, job, out);
  if (!instructions.separate.empty()) measure_separate(params, instructions, rounds, out);
  measure_curve(params, instructions, rounds, out);
  if (fills_frame(params)) out.bounds = straight_bounds(instructions, rounds);
  return out;
}

Measure measure_divided(const FractalParams& params, const Instructions& instructions, int rounds, Job& job) {
  FractalParams plain = params;
  plain.element = FractalElement::letter_plate;  // only the dimension is computed
  Measure result;
  result.dimension = measure(plain, instructions, 0, job).dimension;
  Element one;
  one.elements = 1;
  const DividedCount count = count_divided(instructions, one, {rounds, params.size, params.smallest}, job);
  result.points = static_cast<double>(count.points);
  result.pieces = static_cast<double>(count.elements + count.points);
  return result;
}

}  // namespace seedmesh::fractal
