#include "core/generators/terrain/subdivide.h"

#include <algorithm>
#include <vector>

#include "core/base/parallel.h"

namespace seedmesh::terrain {
namespace {

// Number of old rows that one chunk refines.
constexpr std::size_t rows_a_chunk = 32;

constexpr std::int64_t floor_div(std::int64_t a, std::int64_t b) {
  return a / b - (a % b != 0 && (a < 0) != (b < 0));
}
constexpr std::int64_t floor_mod(std::int64_t a, std::int64_t b) { return a - b * floor_div(a, b); }

/// Heights of one level, and the position of the first one in the world of that level.
struct Level {
  std::int64_t x = 0, z = 0;
  std::int64_t width = 0, depth = 0;
  Array<float> heights;

  Level(const Job& job, std::int64_t left, std::int64_t top, std::int64_t wide, std::int64_t deep)
      : x(left), z(top), width(wide), depth(deep), heights(job, static_cast<std::size_t>(wide * deep)) {}
  float* row(std::int64_t index) { return heights.data() + index * width; }
  const float* row(std::int64_t index) const { return heights.data() + index * width; }
};

/// Three deviations for each square of a level: of its centre, its northern side and its western side.
class Deviations {
 public:
  Deviations(Rng rng, int level, double amplitude)
      : key_(rng.at(static_cast<std::uint64_t>(level)).key()), scale_(static_cast<float>(amplitude / half)) {}

  std::uint64_t row(std::int64_t z) const { return key_at(key_, static_cast<std::uint64_t>(z)); }
  static std::uint64_t draw(std::uint64_t row, std::int64_t x) {
    return mix(row + 0x9E3779B97F4A7C15U * static_cast<std::uint64_t>(x));
  }
  float centre(std::uint64_t bits) const { return part(bits); }
  float north(std::uint64_t bits) const { return part(bits >> 21U); }
  float west(std::uint64_t bits) const { return part(bits >> 42U); }

 private:
  static constexpr std::int32_t half = 1 << 20;
  float part(std::uint64_t bits) const {
    return static_cast<float>(static_cast<std::int32_t>(bits & (2 * half - 1)) - half) * scale_;
  }
  std::uint64_t key_;
  float scale_;
};

/// One round, in which every square of `old` becomes four squares of `next`.
class Round {
 public:
  Round(const SquareSubdivision& plan, World world, int level, const Level& old, Level& next, Rng rng)
      : plan_(plan),
        old_(old),
        next_(next),
        side_(std::int64_t{1} << level),
        bounded_(world == World::bounded),
        deviations_(rng, level, deviation(plan, level)) {}

  /// Refines rows [begin, end) of old samples and the rows of centres below them.
  void run(std::size_t begin, std::size_t end) const {
    std::vector<float> above(static_cast<std::size_t>(old_.width)),
        below(static_cast<std::size_t>(old_.width));
    const auto first = static_cast<std::int64_t>(begin), last = static_cast<std::int64_t>(end);
    centres(first > 0 ? first - 1 : old_.depth - 2,
            above);  // centres of the row before; a world that wraps continues at its other end
    for (std::int64_t z = first; z < last; ++z) {
      centres(z < old_.depth - 1 ? z : 0, below);
      even_row(z, above, below);
      if (z < old_.depth - 1) odd_row(z, below);
      std::swap(above, below);
    }
  }

 private:
  static double deviation(const SquareSubdivision& plan, int level) {
    double size = plan.amplitude;
    if (plan.rule != SquareRule::triangle_random) {
      for (int i = 0; i < level; ++i) size *= plan.falloff;
    }
    return size;
  }

  bool is_border(std::int64_t position) const { return floor_mod(position, side_) == 0; }
  /// Returns the square that a side belongs to. Both borders of a world that wraps have the same random number.
  std::int64_t owner(std::int64_t position) const {
    return bounded_ && plan_.border == BorderRule::wrap && position == side_ ? 0 : position;
  }

  void centres(std::int64_t z, std::vector<float>& out) const {
    const float* north = old_.row(z);
    const float* south = old_.row(z + 1);
    const std::uint64_t row = deviations_.row(old_.z + z);
    const bool mean_of_four = plan_.rule == SquareRule::diamond_square;
    const float weight = plan_.rule == SquareRule::triangle_random ? 0.0F : 0.5F;
    for (std::int64_t x = 0; x + 1 < old_.width; ++x) {
      const float chance = deviations_.centre(Deviations::draw(row, old_.x + x));
      out[static_cast<std::size_t>(x)] =
          (mean_of_four ? ((north[x] + south[x + 1]) + (north[x + 1] + south[x])) * 0.25F
                        : (north[x] + south[x + 1]) * weight) +
          chance;
    }
  }

  /// Returns the height of a side from its ends and the centres on both sides of it.
  float side(float a, float b, float before, float after) const {
    if (plan_.rule == SquareRule::diamond_square) return ((a + b) + (before + after)) * 0.25F;
    return plan_.rule == SquareRule::triangle_random ? 0.0F : (a + b) * 0.5F;
  }
  /// Returns the same on a border. `inner` is the only centre, and `far` is that of the opposite border.
  float border_side(float a, float b, float inner, float far) const {
    if (plan_.rule != SquareRule::diamond_square) return side(a, b, inner, far);
    switch (plan_.border) {
      case BorderRule::three:
        return ((a + b) + inner) / 3.0F;
      case BorderRule::interpolate:
        return ((a + b) + (inner + (a + b) * 0.5F)) * 0.25F;
      case BorderRule::wrap:
        return ((a + b) + (inner + far)) * 0.25F;
      case BorderRule::two_neighbours:
        break;
    }
    return (a + b) * 0.5F;
  }

  /// Writes old samples and the sides between them. `above` and `below` are centres of the squares there.
  void even_row(std::int64_t z, const std::vector<float>& above, const std::vector<float>& below) const {
    const float* old = old_.row(z);
    float* out = next_.row(2 * z);
    const std::uint64_t row = deviations_.row(owner(old_.z + z));
    const bool border = is_border(old_.z + z);
    const bool last = z == old_.depth - 1;
    for (std::int64_t x = 0; x + 1 < old_.width; ++x) {
      const auto i = static_cast<std::size_t>(x);
      const float chance = deviations_.north(Deviations::draw(row, old_.x + x));
      const float a = old[x], b = old[x + 1];
      out[2 * x] = a;
      out[2 * x + 1] = (border ? border_side(a, b, last ? above[i] : below[i], last ? below[i] : above[i])
                               : side(a, b, above[i], below[i])) +
                       chance;
    }
    out[2 * (old_.width - 1)] = old[old_.width - 1];
  }

  /// Writes centres and the sides between them.
  void odd_row(std::int64_t z, const std::vector<float>& centre) const {
    const float* north = old_.row(z);
    const float* south = old_.row(z + 1);
    float* out = next_.row(2 * z + 1);
    const std::uint64_t row = deviations_.row(old_.z + z);
    const std::int64_t last = old_.width - 1;
    const auto chance = [&](std::int64_t x) {
      return deviations_.west(Deviations::draw(row, owner(old_.x + x)));
    };
    const auto at = [&](std::int64_t x) { return centre[static_cast<std::size_t>(x)]; };
    for (std::int64_t x = 0; x <= last; ++x) {
      const bool ends = x == 0 || x == last;
      const float a = north[x], b = south[x];
      float value = 0;
      if (ends || is_border(old_.x + x)) {
        value = border_side(a, b, x == last ? at(last - 1) : at(x),
                            x == last ? at(0) : at(x == 0 ? last - 1 : x - 1));
      } else {
        value = side(a, b, at(x - 1), at(x));
      }
      out[2 * x] = value + chance(x);
      if (x < last) out[2 * x + 1] = at(x);
    }
  }

  const SquareSubdivision& plan_;
  const Level& old_;
  Level& next_;
  std::int64_t side_;
  bool bounded_;
  Deviations deviations_;
};

/// Returns a height within the amplitude, at a position of the coarsest grid.
float drawn(Rng rng, std::int64_t x, std::int64_t z, double amplitude) {
  Rng stream = rng.at("start").at(static_cast<std::uint64_t>(z)).at(static_cast<std::uint64_t>(x));
  return static_cast<float>(stream.uniform(-amplitude, amplitude));
}

Level cut(const Level& level, std::int64_t x0, std::int64_t z0, std::int64_t x1, std::int64_t z1,
          const Job& job) {
  Level part(job, x0, z0, x1 - x0 + 1, z1 - z0 + 1);
  for (std::int64_t z = z0; z <= z1; ++z) {
    const float* from = level.row(z - level.z) + (x0 - level.x);
    std::copy(from, from + part.width, part.row(z - z0));
  }
  return part;
}

Field as_field(Level level) {
  Field field;
  field.width = static_cast<std::int32_t>(level.width);
  field.depth = static_cast<std::int32_t>(level.depth);
  field.heights = std::move(level.heights);
  return field;
}

}  // namespace

Field subdivide(const SquareSubdivision& plan, World world, const Window& window, Rng rng, const Job& job) {
  const bool bounded = world == World::bounded;
  // Number of coarser samples around the window at a level. The outermost sides lack a neighbour and are cut.
  const std::int64_t around = bounded ? 0 : 2;
  const auto first = [&](std::int64_t position, int level) {
    return floor_div(position, std::int64_t{1} << (plan.rounds - level)) - around;
  };
  const auto last = [&](std::int64_t position, int level) {
    return -floor_div(-position, std::int64_t{1} << (plan.rounds - level)) + around;
  };
  const std::int64_t x1 = window.x + window.width - 1, z1 = window.z + window.depth - 1;
  const std::int64_t left = first(window.x, 0), top = first(window.z, 0);
  Level level(job, left, top, last(x1, 0) - left + 1, last(z1, 0) - top + 1);
  const bool repeats = plan.border == BorderRule::wrap;
  for (std::int64_t z = 0; z < level.depth; ++z) {
    for (std::int64_t x = 0; x < level.width; ++x) {
      level.row(z)[x] = plan.corners
                            ? static_cast<float>((*plan.corners)[static_cast<std::size_t>(2 * z + x)])
                            : drawn(rng, repeats ? 0 : left + x, repeats ? 0 : top + z, plan.amplitude);
    }
  }
  for (int round = 0; round < plan.rounds; ++round) {
    Level next(job, 2 * level.x, 2 * level.z, 2 * level.width - 1, 2 * level.depth - 1);
    const Round work(plan, world, round, level, next, rng);
    parallel_for(job, static_cast<std::size_t>(level.depth), rows_a_chunk,
                 [&](std::size_t begin, std::size_t end, std::size_t) {
                   job.check();
                   work.run(begin, end);
                 });
    if (bounded) {
      level = std::move(next);
    } else {
      level = cut(next, first(window.x, round + 1), first(window.z, round + 1), last(x1, round + 1),
                  last(z1, round + 1), job);
    }
  }
  if (!bounded) level = cut(level, window.x, window.z, x1, z1, job);
  return as_field(std::move(level));
}

Field subdivide_nested(const NestedSubdivision& plan, const Window& window, Rng rng, const Job& job) {
  std::vector<Window> windows(static_cast<std::size_t>(plan.rounds) + 1);
  windows.back() = window;
  for (std::size_t k = windows.size() - 1; k > 0; --k) {
    const Window& finer = windows[k];
    Window& coarser = windows[k - 1];
    coarser.x = floor_div(finer.x, 2);
    coarser.z = floor_div(finer.z, 2);
    coarser.width = static_cast<std::int32_t>(floor_div(finer.x + finer.width - 1, 2) + 1 - coarser.x + 1);
    coarser.depth = static_cast<std::int32_t>(floor_div(finer.z + finer.depth - 1, 2) + 1 - coarser.z + 1);
  }
  Level level(job, windows[0].x, windows[0].z, windows[0].width, windows[0].depth);
  for (std::int64_t z = 0; z < level.depth; ++z) {
    for (std::int64_t x = 0; x < level.width; ++x) {
      level.row(z)[x] = plan.grid ? static_cast<float>((*plan.grid)[static_cast<std::size_t>(3 * z + x)])
                                  : drawn(rng, level.x + x, level.z + z, plan.amplitude);
    }
  }
  double amplitude = plan.amplitude;
  for (std::size_t round = 0; round + 1 < windows.size(); ++round, amplitude *= plan.falloff) {
    const Window& finer = windows[round + 1];
    Level next(job, finer.x, finer.z, finer.width, finer.depth);
    const std::uint64_t key = rng.at(round).key();
    const auto scale = static_cast<float>(amplitude * 0x1p-31);
    parallel_for(job, static_cast<std::size_t>(next.depth), 2 * rows_a_chunk,
                 [&](std::size_t begin, std::size_t end, std::size_t) {
                   job.check();
                   for (auto j = static_cast<std::int64_t>(begin); j < static_cast<std::int64_t>(end); ++j) {
                     const std::int64_t z = next.z + j, square = floor_div(z, 2);
                     // Nearer and farther row of old corners, and the random numbers of a row of squares.
                     const float* near = level.row(square + (z & 1) - level.z);
                     const float* far = level.row(square + 1 - (z & 1) - level.z);
                     const std::uint64_t row = key_at(key, static_cast<std::uint64_t>(z));
                     float* out = next.row(j);
                     for (std::int64_t i = 0; i < next.width; ++i) {
                       const std::int64_t x = next.x + i, at = (x >> 1) - level.x;
                       const std::int64_t close = at + (x & 1), away = at + 1 - (x & 1);
                       // Both samples of a square in this row use one draw.
                       const std::uint64_t bits = Deviations::draw(row, x >> 1) >> ((x & 1) * 32);
                       const float chance = static_cast<float>(static_cast<std::int32_t>(bits)) * scale;
                       out[i] =
                           (9 * near[close] + 3 * (near[away] + far[close]) + far[away]) * 0.0625F + chance;
                     }
                   }
                 });
    level = std::move(next);
  }
  return as_field(std::move(level));
}

}  // namespace seedmesh::terrain
