#include "core/generators/terrain/refined_ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/math.h"
#include "core/generators/terrain/smooth_step.h"

namespace seedmesh::terrain {
namespace {

// Wavelengths of the forms in metres. No wavelength is a multiple of another one, so that lattices do not coincide.
constexpr std::array<double, 5> wavelengths{9.1, 4.3, 2.05, 1.03, 0.51};
constexpr std::array<double, 3> outcrop_wavelengths{23, 7.3, 2.9};
constexpr std::array<double, 3> block_sizes{8.7, 3.3, 1.2};
constexpr std::array<float, 2> thicknesses{2.3F, 0.8F};  // of beds of rock
// An octave is complete where a wave has three steps, and absent where it has half of that.
constexpr float least_steps = 1.5F, enough_steps = 3;
// Amplitude of waves longer than the first wavelength, by their length: the forms that a coarse grid lacks.
constexpr float wide_amplitude = 0.035F;
// Cells at the border of the field over which forms end.
constexpr float border_cells = 4;
// Mean of the absolute value of gradient noise, which ridges and lumps subtract.
constexpr float mean_size = 0.3F;

/// Weights of four samples for a position at the share t between the second and the third (Catmull-Rom).
std::array<double, 4> spline_weights(double t) {
  return {0.5 * t * (-1 + t * (2 - t)), 0.5 * (2 + t * t * (-5 + 3 * t)), 0.5 * t * (1 + t * (4 - 3 * t)),
          0.5 * t * t * (t - 1)};
}

/// Returns the height at a sample, which continues the last slope beyond the border of the field.
float height_at(const Field& field, std::int32_t x, std::int32_t z) {
  const std::int32_t m = field.margin;
  const std::int32_t in_x = std::clamp(x, -m, field.width - 1 + m),
                     in_z = std::clamp(z, -m, field.depth - 1 + m);
  float height = field.at(in_x, in_z);
  if (in_x != x) height += height - field.at(in_x < x ? in_x - 1 : in_x + 1, in_z);
  if (in_z != z) height += field.at(in_x, in_z) - field.at(in_x, in_z < z ? in_z - 1 : in_z + 1);
  return height;
}

float ridge(float noise) { return mean_size - std::abs(noise); }
float lump(float noise) { return std::abs(noise) - mean_size; }

/// Returns how far a bed of rock with ledges is above an even one: steps of `thickness` with steep fronts.
float ledge(float level, float thickness) {
  const float share = level / thickness - std::floor(level / thickness);
  return thickness * (smooth_step(0.25F, 0.7F, share) - share);
}

}  // namespace

/// Blocks of rock: flat facets of random height and tilt, one for each cell of a Voronoi diagram (Worley, "A cellular
/// texture basis function", 1996), with cracks between them. Keeps the facets around the last position, because most
/// positions follow one in the same square.
class RefinedGround::Sampler::Blocks {
 public:
  Blocks(std::uint64_t key, float size) : key_(key), size_(size) {}

  /// Returns about -1 to 1 for a position in metres.
  float at(double x, double z) {
    const double across = x / static_cast<double>(size_), down = z / static_cast<double>(size_);
    const double left = std::floor(across), top = std::floor(down);
    if (left != left_ || top != top_) take_square(left, top);
    const auto u = static_cast<float>(across - left), v = static_cast<float>(down - top);
    float nearest = 9, next = 9, facet = 0, neighbour = 0;
    for (const Facet& each : facets_) {
      const float dx = u - each.x, dz = v - each.z;
      const float distance = dx * dx + dz * dz;
      if (distance >= next) continue;
      const float height = each.height + each.tilt_x * dx + each.tilt_z * dz;
      if (distance < nearest) {
        next = std::exchange(nearest, distance);
        neighbour = std::exchange(facet, height);
      } else {
        next = distance;
        neighbour = height;
      }
    }
    // Both sides have the same height where they meet.
    const float inside = std::sqrt(next) - std::sqrt(nearest);
    const float own = 0.5F + 0.5F * smooth_step(0, 0.16F, inside);
    return neighbour + own * (facet - neighbour) - 0.35F * (1 - smooth_step(0, 0.2F, inside));
  }

 private:
  /// A facet with its middle, relative to the corner of the square.
  struct Facet {
    float x, z, height, tilt_x, tilt_z;
  };

  /// One of five random numbers 0 .. 1 of 12 bits.
  static float part(std::uint64_t bits, unsigned number) {
    return static_cast<float>(bits >> (12U * number) & 0xFFFU) * 0x1p-12F;
  }

  void take_square(double left, double top) {
    left_ = left;
    top_ = top;
    Facet* out = facets_.data();
    for (int j = -1; j <= 1; ++j) {
      const std::uint64_t row = key_at(key_, static_cast<std::uint64_t>(math::to_int64(top) + j));
      for (int i = -1; i <= 1; ++i) {
        const std::uint64_t bits = key_at(row, static_cast<std::uint64_t>(math::to_int64(left) + i));
        *out++ = {static_cast<float>(i) + part(bits, 0), static_cast<float>(j) + part(bits, 1),
                  (part(bits, 2) - 0.5F) * 1.6F, (part(bits, 3) - 0.5F) * 1.5F,
                  (part(bits, 4) - 0.5F) * 1.5F};
      }
    }
  }

  std::uint64_t key_;
  float size_;
  double left_ = 0.5, top_ = 0.5;  ///< of the square; no square begins at a half
  std::array<Facet, 9> facets_;
};

namespace {

/// Ripples: crests that rise over three quarters of their length.
float ripple(float phase) {
  constexpr float front = 0.75F;
  const float share = phase - std::floor(phase);
  return (share < front ? share / front : (1 - share) / (1 - front)) - 0.5F;
}

}  // namespace

/// Values of the octaves at a point.
struct RefinedGround::Sampler::Waves {
  std::array<float, wavelengths.size()> noise{};
  float wide = 0;     ///< metres
  float ripples = 0;  ///< of sand
  float along = 0;    ///< metres along the dip of the beds of rock
  std::array<float, block_sizes.size()> blocks{};
};

/// Heights in metres of forms above and below a metre.
struct RefinedGround::Sampler::Form {
  float wide = 0, small = 0;
};

RefinedGround::RefinedGround(const Refinement& refinement, const GroundColors& colors, const Field& field,
                             const Window& world, Rng rng, const Job& job)
    : refinement_(refinement),
      world_east_(static_cast<double>(world.x) * field.cell),
      world_south_(static_cast<double>(world.z) * field.cell),
      rng_(rng.at("relief")) {
  const Window squares = refinement.squares();
  left_ = static_cast<std::int32_t>(squares.x);
  top_ = static_cast<std::int32_t>(squares.z);
  heights_ = Field(job, squares.width + 1, squares.depth + 1, 1);
  for (std::int32_t z = -1; z <= heights_.depth; ++z) {
    job.check();
    for (std::int32_t x = -1; x <= heights_.width; ++x)
      heights_.at(x, z) = height_at(field, left_ + x, top_ + z);
  }
  const Sites sites(field, world, rng, job);
  const std::size_t count =
      static_cast<std::size_t>(heights_.width) * static_cast<std::size_t>(heights_.depth);
  sites_.reserve(count);
  shares_.reserve(count);
  for (std::int32_t z = 0; z < heights_.depth; ++z) {
    job.check();
    for (std::int32_t x = 0; x < heights_.width; ++x) {
      sites_.push_back(sites.at(left_ + x, top_ + z));
      shares_.push_back(ground_shares(colors, sites_.back()));
    }
  }
}

bool RefinedGround::contains(double x, double z) const {
  return refinement_.level(math::to_int32(std::floor(x / refinement_.cell)),
                           math::to_int32(std::floor(z / refinement_.cell))) > 0;
}

double RefinedGround::spline(double x, double z) const {
  const std::int32_t i = std::clamp(math::to_int32(std::floor(x)), 0, heights_.width - 2),
                     j = std::clamp(math::to_int32(std::floor(z)), 0, heights_.depth - 2);
  const std::array<double, 4> across = spline_weights(x - i), down = spline_weights(z - j);
  double sum = 0;
  for (std::int32_t b = 0; b < 4; ++b) {
    double row = 0;
    for (std::int32_t a = 0; a < 4; ++a)
      row += across[static_cast<std::size_t>(a)] * static_cast<double>(heights_.at(i + a - 1, j + b - 1));
    sum += down[static_cast<std::size_t>(b)] * row;
  }
  return sum;
}

float RefinedGround::weight(double x, double z) const {
  const Refinement& r = refinement_;
  const double dx = x - r.east, dz = z - r.south, reach = r.reach();
  const double border =
      std::min(std::min(x, (r.width - 1) * r.cell - x), std::min(z, (r.depth - 1) * r.cell - z));
  const auto inside = static_cast<float>(1 - std::sqrt(dx * dx + dz * dz) / reach);
  return smooth_step(0, 0.5F, inside) * smooth_step(0, border_cells, static_cast<float>(border / r.cell));
}

/// The step at a distance, without jumps and never below that of the squares.
float RefinedGround::step(double distance) const {
  constexpr double begin = 0.75;  // share of a ring where the step of the next one begins to have an effect
  double own = refinement_.cell, limit = refinement_.radius;
  for (int i = 0; i < refinement_.halvings; ++i) own /= 2;
  for (; distance > limit && own < refinement_.cell; limit *= 2) own *= 2;
  return static_cast<float>(own * (1 + std::max(0.0, distance / limit - begin) / (1 - begin)));
}

RefinedGround::Sampler::Sampler(const RefinedGround& ground) : ground_(ground) {
  const auto add = [](std::vector<OctavePath>& to, Rng rng, double wavelength) {
    to.emplace_back(Octave{rng.key(), 1 / wavelength, 0});
  };
  for (std::size_t i = 0; i < wavelengths.size(); ++i) add(octaves_, ground.rng_.at(i), wavelengths[i]);
  for (std::size_t i = 0; i < outcrop_wavelengths.size(); ++i)
    add(outcrops_, ground.rng_.at("outcrops").at(i), outcrop_wavelengths[i]);
  blocks_.reserve(block_sizes.size());
  const Rng blocks = ground.rng_.at("blocks");
  for (std::size_t i = 0; i < block_sizes.size(); ++i)
    blocks_.emplace_back(blocks.at(i).key(), static_cast<float>(block_sizes[i]));
  std::uint64_t number = 0;
  for (double length = 2 * wavelengths[0]; length <= 2 * ground.refinement_.cell; length *= 2)
    add(wide_, ground.rng_.at("wide").at(number++), length);
}

RefinedGround::Sampler::~Sampler() = default;

/// Noise whose highest parts are outcrops of rock.
float RefinedGround::Sampler::outcrop_noise(double x, double z) {
  constexpr std::array<float, outcrop_wavelengths.size()> amplitudes{0.62F, 0.33F, 0.15F};
  float sum = 0;
  for (std::size_t i = 0; i < outcrops_.size(); ++i) {
    OctavePath& octave = outcrops_[i];
    sum += amplitudes[i] * octave.value((x + ground_.world_east_) * octave.frequency(),
                                        (z + ground_.world_south_) * octave.frequency());
  }
  return sum;
}

RefinedGround::Sampler::Waves RefinedGround::Sampler::waves(double x, double z, float step, bool is_stony) {
  const double east = x + ground_.world_east_, south = z + ground_.world_south_;
  const auto value = [&](OctavePath& octave) {
    return octave.value(east * octave.frequency(), south * octave.frequency());
  };
  const auto share = [step](double wavelength) {
    return smooth_step(least_steps * step, enough_steps * step, static_cast<float>(wavelength));
  };
  Waves all;
  for (std::size_t i = 0; i < octaves_.size(); ++i) {
    const float complete = share(wavelengths[i]);
    if (complete > 0) all.noise[i] = complete * value(octaves_[i]);
  }
  for (OctavePath& octave : wide_)
    all.wide += wide_amplitude * static_cast<float>(1 / octave.frequency()) * value(octave);
  constexpr double length = 1.7;
  const auto phase = (0.9 * east + 0.44 * south) / length;
  all.ripples = share(length) * ripple(static_cast<float>(phase - std::floor(phase)) + 0.6F * all.noise[0] +
                                       0.3F * all.noise[1]);
  for (std::size_t i = 0; is_stony && i < block_sizes.size(); ++i) {
    const float complete = share(block_sizes[i]);
    // The borders of blocks are not straight.
    const double bend_x = 0.7 * static_cast<double>(all.noise[1]) + 0.3 * static_cast<double>(all.noise[2]),
                 bend_z = 0.5 * static_cast<double>(all.noise[0] - all.noise[2]);
    if (complete > 0) {
      all.blocks[i] = complete * blocks_[i].at(east + bend_x, south + bend_z);
    }
  }
  // Both thicknesses divide the cycle.
  const double dip = 0.17 * east + 0.09 * south, cycle = 18.4;
  all.along = static_cast<float>(dip - cycle * std::floor(dip / cycle));
  return all;
}

RefinedGround::Sampler::Form RefinedGround::Sampler::form(const GroundShares& shares, const Waves& waves,
                                                          const Site& site, float outcrop) const {
  const auto& [n9, n4, n2, n1, n05] = waves.noise;
  Form sum;
  const auto add = [&sum](float share, float wide, float small) {
    sum.wide += share * wide;
    sum.small += share * small;
  };
  add(shares.of[GroundShares::grass], 0.5F * n9 + 0.55F * lump(n4) + 0.6F * waves.wide,
      0.42F * lump(n2) + 0.24F * lump(n1) + 0.07F * n05);
  add(shares.of[GroundShares::soil], 0.2F * n9 + 0.13F * n4 + 0.5F * waves.wide,
      0.08F * n2 + 0.08F * lump(n1) + 0.04F * lump(n05));
  // Mounds of moss and roots below the litter.
  add(shares.of[GroundShares::litter], 0.35F * n9 + 0.3F * lump(n4) + 0.5F * waves.wide,
      0.14F * lump(n2) + 0.1F * lump(n1) + 0.05F * n05);
  add(shares.of[GroundShares::sand], 0.2F * n9 + 0.06F * n4 + 0.4F * waves.wide, 0.07F * waves.ripples);
  add(shares.of[GroundShares::snow], 0.24F * n9 + 0.12F * n4 + 0.4F * waves.wide, 0.03F * n2);
  const auto& [huge, large, middle] = waves.blocks;
  add(shares.of[GroundShares::scree], 0.3F * n9 + 0.25F * n4 + 0.12F * large + waves.wide,
      0.22F * middle + 0.22F * lump(n2) + 0.25F * lump(n1) + 0.15F * lump(n05));
  const float rock = shares.of[GroundShares::rock] + outcrop * (1 - shares.of[GroundShares::rock]);
  const float steep = smooth_step(0.3F, 0.9F, site.slope);
  // Beds of two thicknesses, which come and go.
  const float level = site.height + waves.along + 0.9F * n9 + 0.5F * n4 + 0.2F * n2;
  const auto& [thick, thin] = thicknesses;
  const float bed = ledge(level, thick) * (0.5F + n9) + ledge(level + 3 * n9, thin) * (0.4F - n9);
  add(rock,
      0.6F * ridge(n9) + 0.6F * ridge(n4) + (0.5F + steep) * huge + 0.7F * large + steep * bed +
          1.4F * waves.wide,
      0.28F * middle + 0.3F * ridge(n2) + 0.14F * ridge(n1) + 0.08F * ridge(n05));
  sum.wide += 0.35F * outcrop;
  return sum;
}

RefinedPoint RefinedGround::Sampler::at(double x, double z) {
  constexpr float small_amplitude = 0.12F;
  const Refinement& refinement = ground_.refinement_;
  const double column = x / refinement.cell - ground_.left_, row = z / refinement.cell - ground_.top_;
  const std::int32_t i = std::clamp(math::to_int32(std::floor(column)), 0, ground_.heights_.width - 2),
                     j = std::clamp(math::to_int32(std::floor(row)), 0, ground_.heights_.depth - 2);
  const auto u = static_cast<float>(column - i), v = static_cast<float>(row - j);
  const auto number = [&](std::int32_t a, std::int32_t b) {
    return static_cast<std::size_t>(j + b) * static_cast<std::size_t>(ground_.heights_.width) +
           static_cast<std::size_t>(i + a);
  };
  RefinedPoint point;
  point.site = bilinear([&](int a, int b) { return ground_.sites_[number(a, b)]; }, u, v);
  point.site.height = static_cast<float>(ground_.spline(column, row));
  point.height = point.site.height;
  point.weight = ground_.weight(x, z);
  if (point.weight <= 0) return point;
  const double dx = x - refinement.east, dz = z - refinement.south;
  const GroundShares shares = bilinear([&](int a, int b) { return ground_.shares_[number(a, b)]; }, u, v);
  // Rock is exposed on steep ground rather than on gentle ground, and hardly under snow and sand.
  const float least = 0.28F - 0.45F * point.site.slope;
  const float covered = shares.of[GroundShares::snow] + shares.of[GroundShares::sand];
  const float outcrop = (1 - covered) * smooth_step(least, least + 0.2F, outcrop_noise(x, z));
  const bool is_stony = outcrop + shares.of[GroundShares::rock] + shares.of[GroundShares::scree] > 0;
  const Waves all = waves(x, z, ground_.step(std::sqrt(dx * dx + dz * dz)), is_stony);
  const Form both = form(shares, all, point.site, outcrop);
  const auto relief = static_cast<float>(refinement.relief) * point.weight;
  point.height += relief * (both.wide + both.small);
  point.small = point.weight * std::clamp(both.small / small_amplitude, -1.0F, 1.0F);
  // The tops of hummocks are worn here and there.
  const float bare = (1 - covered) * smooth_step(0.2F, 0.6F, all.noise[1] + 0.6F * all.noise[2]);
  point.site.slope += point.weight * (0.85F * outcrop + 0.55F * bare + 0.12F * all.noise[1]);
  point.site.slope = std::max(point.site.slope, 0.0F);
  point.site.patch += point.weight * (0.5F * all.noise[0] + 0.4F * all.noise[1] + 0.3F * all.noise[2]);
  return point;
}

}  // namespace seedmesh::terrain
