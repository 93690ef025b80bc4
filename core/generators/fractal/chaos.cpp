/// Maps are chosen by the alias method (M. Vose, "A linear algorithm for generating random numbers with a
/// given distribution", 1991): one look-up and one comparison for any number of maps.
#include "core/generators/fractal/chaos.h"

#include <algorithm>

#include "core/base/parallel.h"
#include "core/generators/fractal/element.h"
#include "generated/params/fractal.h"

namespace seedmesh::fractal {
namespace {

constexpr std::size_t chunk = 65'536;
constexpr std::size_t lanes = 4;

/// A map, padded to whole cache lines.
struct alignas(64) Row {
  double m[12];  ///< rows of the linear part, each followed by its offset
};

struct Column {
  std::uint32_t limit;  ///< below it: the column's own map
  std::uint32_t other;
};

class Wheel {
 public:
  explicit Wheel(const Instructions& instructions) {
    for (const Affine& map : instructions.maps) {
      Row& row = rows_.emplace_back();
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) row.m[4 * r + c] = map.linear[c][r];
        row.m[4 * r + 3] = map.offset[r];
      }
    }
    fill(instructions.weights);
  }

  /// Chooses a map by 32 random bits, which are multiplied by the number of maps. The upper half of the product is
  /// the column of the alias table, and the lower half selects one of the two maps of this column.
  std::uint32_t spin(std::uint32_t bits) const {
    const std::uint64_t product = std::uint64_t{bits} * columns_.size();
    const auto column = static_cast<std::uint32_t>(product >> 32U);
    const Column& at = columns_[column];
    return static_cast<std::uint32_t>(product) < at.limit ? column : at.other;
  }

  glm::dvec3 move(std::uint32_t map, const glm::dvec3& p) const {
    const double* m = rows_[map].m;
    return {m[0] * p.x + m[1] * p.y + (m[2] * p.z + m[3]), m[4] * p.x + m[5] * p.y + (m[6] * p.z + m[7]),
            m[8] * p.x + m[9] * p.y + (m[10] * p.z + m[11])};
  }

 private:
  void fill(const std::vector<double>& weights) {
    double sum = 0;
    for (const double weight : weights) sum += weight;
    const std::size_t count = weights.size();
    std::vector<double> share(count);
    std::vector<std::uint32_t> poor, rich;
    for (std::size_t i = 0; i < count; ++i) {
      share[i] = weights[i] / sum * static_cast<double>(count);
      (share[i] < 1 ? poor : rich).push_back(static_cast<std::uint32_t>(i));
    }
    columns_.assign(count, {0xFFFFFFFFU, 0});
    for (std::size_t i = 0; i < count; ++i) columns_[i].other = static_cast<std::uint32_t>(i);
    while (!poor.empty() && !rich.empty()) {
      const std::uint32_t small = poor.back(), large = rich.back();
      poor.pop_back();
      columns_[small] = {static_cast<std::uint32_t>(
                             share[small] * 0x1p32 < 4294967295.0 ? share[small] * 0x1p32 : 4294967295.0),
                         large};
      share[large] -= 1 - share[small];
      if (share[large] < 1) {
        rich.pop_back();
        poor.push_back(large);
      }
    }
  }

  std::vector<Row> rows_;
  std::vector<Column> columns_;
};

glm::dvec3 drawn_in_cube(Rng& rng) {
  const double x = rng.uniform(-0.5, 0.5), y = rng.uniform(-0.5, 0.5), z = rng.uniform(-0.5, 0.5);
  return {x, y, z};
}

/// Plays four alternating chains. Two random words are enough for one step of all four.
void play_chunk(const Wheel& wheel, const StartPoints& start, Rng rng, std::uint32_t drop,
                std::span<glm::vec3> position, std::span<std::uint8_t> map) {
  std::array<glm::dvec3, lanes> point;
  for (std::size_t lane = 0; lane < lanes; ++lane) point[lane] = start.draw(rng.at("start").at(lane));
  Rng bits = rng.at("spin");
  const auto turn = [&](auto&& keep) {
    const std::uint64_t first = bits.next(), second = bits.next();
    const std::uint32_t spins[lanes] = {
        static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(first >> 32U),
        static_cast<std::uint32_t>(second), static_cast<std::uint32_t>(second >> 32U)};
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::uint32_t chosen = wheel.spin(spins[lane]);
      point[lane] = wheel.move(chosen, point[lane]);
      keep(lane, chosen);
    }
  };
  for (std::uint32_t i = 0; i < drop; ++i) turn([](std::size_t, std::uint32_t) {});
  for (std::size_t i = 0; i < position.size(); i += lanes) {
    turn([&](std::size_t lane, std::uint32_t chosen) {
      if (i + lane >= position.size()) return;
      position[i + lane] = glm::vec3(point[lane]);
      map[i + lane] = static_cast<std::uint8_t>(chosen);
    });
  }
}

/// Plays one chain.
void play_alone(const Wheel& wheel, const StartPoints& start, Rng rng, std::uint32_t drop, Cloud& cloud) {
  glm::dvec3 point = start.draw(rng.at("start"));
  Rng bits = rng.at("spin");
  const std::size_t steps = drop + cloud.position.size();
  for (std::size_t i = 0; i < steps; ++i) {
    const std::uint32_t chosen = wheel.spin(static_cast<std::uint32_t>(bits.next() >> 32U));
    point = wheel.move(chosen, point);
    if (i < drop) continue;
    cloud.position[i - drop] = glm::vec3(point);
    cloud.map[i - drop] = static_cast<std::uint8_t>(chosen);
  }
}

}  // namespace

StartPoints::StartPoints(std::span<const Primitive> element) {
  double sum = 0;
  for (const Primitive& primitive : element) {
    const Mesh& mesh = primitive.mesh;
    const std::size_t corners = mesh.topology == Topology::triangles ? 3 : 2;
    if (mesh.topology == Topology::points) continue;
    const auto at = [&](std::size_t i) { return glm::dvec3(mesh.position[mesh.index.at(i)]); };
    for (std::size_t i = 0; i + corners <= mesh.index.size(); i += corners) {
      const glm::dvec3 a = at(i), ab = at(i + 1) - a, ac = corners == 3 ? at(i + 2) - a : glm::dvec3(0);
      sum += corners == 3 ? glm::length(glm::cross(ab, ac)) / 2 : glm::length(ab);
      pieces_.push_back({a, ab, ac, sum});
    }
  }
  if (!(sum > 0)) pieces_.clear();
}

glm::dvec3 StartPoints::draw(Rng rng) const {
  if (pieces_.empty()) return drawn_in_cube(rng);
  const double wanted = rng.unit() * pieces_.back().until;
  auto found = std::ranges::upper_bound(pieces_, wanted, {}, &Piece::until);
  if (found == pieces_.end()) --found;
  double u = rng.unit(), v = rng.unit();
  if (found->ac != glm::dvec3(0) && u + v > 1) {  // the other half of the parallelogram
    u = 1 - u;
    v = 1 - v;
  }
  return found->a + u * found->ab + v * found->ac;
}

Result<StartPoints> start_of(const FractalParams& params, const GenerateContext& context) {
  if (params.start == FractalStart::cube) return StartPoints();
  // The element is not a part of the model, so its triangles do not count.
  Job own = context.job.for_estimate();
  const Result<Element> element = element_of(params, {own, {}, context.generators});
  if (!element) return element.error();
  return StartPoints(element->primitives);
}

Cloud play(const Instructions& instructions, const StartPoints& start, std::uint64_t count,
           std::uint32_t drop, Job& job) {
  job.spend(Resource::triangles, count);
  const auto size = static_cast<std::size_t>(count);
  Cloud cloud{Array<glm::vec3>(job, size), Array<std::uint8_t>(job, size)};
  const Wheel wheel(instructions);
  const Rng rng = job.rng().at("chaos");
  if (size <= chunk) {
    play_alone(wheel, start, rng, drop, cloud);
    return cloud;
  }
  parallel_for(job, size, chunk, [&](std::size_t begin, std::size_t end, std::size_t index) {
    job.check();
    play_chunk(wheel, start, rng.at(index), drop, cloud.position.span().subspan(begin, end - begin),
               cloud.map.span().subspan(begin, end - begin));
  });
  return cloud;
}

}  // namespace seedmesh::fractal
