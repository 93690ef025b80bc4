#include "core/generators/world/plants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "core/base/math.h"
#include "core/base/wide.h"
#include "core/generators/world/plant_mesh.h"
#include "core/generators/world/resolved.h"

namespace seedmesh::world {
namespace {

constexpr int candidates_a_cell = 2;
constexpr double dry_margin = 2;  ///< metres between a plant and water, a road or a house

struct Candidate {
  double east = 0, north = 0;
  std::uint64_t mark = 0, key = 0;
  enum State : std::uint8_t { undecided, stays, goes } state = undecided;
};

std::uint64_t key_of(const World& world, int plant_class) {
  return key_at(world.key ^ 0x504C414E54U, static_cast<std::uint64_t>(plant_class));
}

struct CoverOctave {
  double wavelength = 0, amplitude = 0;
};
/// Wooded and open country, forests, woods, clearings and ragged edges.
constexpr std::array<CoverOctave, 5> cover_octaves{
    {{19000, 0.42}, {4300, 0.5}, {870, 0.75}, {190, 0.35}, {52, 0.12}}};
constexpr double lone_share = 0.012;  ///< share of candidates outside of woods
constexpr double edge_low = -0.1, edge_high = 0.16;

/// The share of candidates near a position that may compete. Stops when the finer octaves cannot change it.
SEEDMESH_WIDE double cover_at(std::uint64_t key, double density, double east, double north,
                              double spacing = 0) {
  if (density <= 0) return 0;
  // fitted so that woods cover this share of wide areas
  const double more = density - 0.5;
  double sum = 0.03 + 0.81 * more + 5.4 * more * more * more * more * more, left = 0, hidden = 0;
  for (const CoverOctave& o : cover_octaves) left += 1.1 * o.amplitude;
  for (std::size_t k = 0; k < cover_octaves.size(); ++k) {
    const auto [wavelength, amplitude] = cover_octaves[k];
    const double shown = resolved_share(spacing, wavelength);
    hidden += (1 - shown) * amplitude / 2;
    if (shown <= 0) continue;
    if (sum + left < edge_low || sum - left > edge_high) break;
    sum += shown * amplitude * octave(key + 1 + k, east, north, wavelength).value;
    left -= 1.1 * amplitude;
  }
  return lone_share + (1 - lone_share) * smooth_step(sum, edge_low - hidden, edge_high + hidden);
}

/// Candidates by cell; the cells of a row follow each other.
struct Field {
  std::int64_t first_x = 0, first_y = 0;
  int columns = 0, rows = 0;
  std::vector<Candidate> candidates;
  std::vector<std::uint32_t> starts;  ///< first plant of each cell

  template <class Visit>
  void for_near(int column, int row, const Visit& visit) {
    for (int y = std::max(0, row - 2); y <= std::min(rows - 1, row + 2); ++y) {
      const int from = std::max(0, column - 2), to = std::min(columns - 1, column + 2);
      const std::uint32_t begin = starts[static_cast<std::size_t>(y * columns + from)];
      const std::uint32_t end = starts[static_cast<std::size_t>(y * columns + to + 1)];
      for (std::uint32_t k = begin; k < end; ++k) visit(candidates[k]);
    }
  }
};

/// The side of the cells of candidates.
double cell_of(const WorldClass& plant) { return plant.spacing / 1.4142135623730951; }

/// Candidate `n` of the cell (x, y); the next number of its generator decides whether the candidate competes.
Candidate candidate_at(std::uint64_t key, double cell, std::int64_t x, std::int64_t y, int n, Rng& rng) {
  rng = Rng(key_at(cell_key(key, x, y), static_cast<std::uint64_t>(n)));
  Candidate c;
  const auto along = [&](std::int64_t of) {
    return std::floor((static_cast<double>(of) + rng.unit()) * cell * 64) / 64;
  };
  c.east = along(x);
  c.north = along(y);
  c.mark = rng.next();
  c.key = rng.key();
  return c;
}

Field field_of(std::uint64_t key, const WorldClass& plant, const Rectangle& box, double share, double reach) {
  const double cell = cell_of(plant), around = reach * plant.spacing;
  const auto index = [&](double v) { return math::to_int64(std::floor(v / cell)); };
  // 2^63 is exact in a double
  const std::uint64_t below = share >= 1 ? ~std::uint64_t{0} : static_cast<std::uint64_t>(share * 0x1p63) * 2;
  Field field;
  field.first_x = index(box.west - around);
  field.first_y = index(box.south - around);
  field.columns = static_cast<int>(index(box.east + around) - field.first_x) + 1;
  field.rows = static_cast<int>(index(box.north + around) - field.first_y) + 1;
  field.starts.push_back(0);
  for (int row = 0; row < field.rows; ++row) {
    for (int column = 0; column < field.columns; ++column) {
      const std::int64_t x = field.first_x + column, y = field.first_y + row;
      for (int n = 0; n < candidates_a_cell; ++n) {
        Rng rng(0);
        const Candidate c = candidate_at(key, cell, x, y, n, rng);
        if (c.mark >= below) continue;
        if (rng.unit() < cover_at(key, plant.density, c.east, c.north)) field.candidates.push_back(c);
      }
      field.starts.push_back(static_cast<std::uint32_t>(field.candidates.size()));
    }
  }
  return field;
}

bool is_near(const Candidate& a, const Candidate& b, double spacing) {
  const double x = a.east - b.east, y = a.north - b.north;
  return x * x + y * y < spacing * spacing;
}

/// One half of a round: visits the undecided with those near them.
template <class Decide>
void for_undecided(Field& field, const Decide& decide) {
  for (int row = 0; row < field.rows; ++row) {
    for (int column = 0; column < field.columns; ++column) {
      const auto cell = static_cast<std::size_t>(row * field.columns + column);
      for (std::uint32_t k = field.starts[cell]; k < field.starts[cell + 1]; ++k) {
        if (field.candidates[k].state == Candidate::undecided) decide(field.candidates[k], column, row);
      }
    }
  }
}

void thin(Field& field, double spacing, Job& job) {
  std::vector<Candidate*> changed;
  for (int round = 0; round < thinning_rounds; ++round) {
    job.check();
    const bool keeps = round % 2 == 0;
    changed.clear();
    for_undecided(field, [&](Candidate& c, int column, int row) {
      bool changes = keeps;
      field.for_near(column, row, [&](const Candidate& other) {
        if (&other == &c || !is_near(c, other, spacing)) return;
        if (keeps) {
          changes &= other.state != Candidate::undecided || c.mark < other.mark;
        } else {
          changes |= other.state == Candidate::stays;
        }
      });
      if (changes) changed.push_back(&c);
    });
    for (Candidate* c : changed) c->state = keeps ? Candidate::stays : Candidate::goes;
  }
}

bool is_in_biome(const WorldClass& plant, const Climate& climate) {
  return plant.biomes.empty() || std::any_of(plant.biomes.begin(), plant.biomes.end(), [&](const auto biome) {
           return static_cast<int>(biome) == static_cast<int>(biome_of(climate));
         });
}

double slope_of(const Slope& s) { return std::sqrt(s.east * s.east + s.north * s.north); }

bool suits(const World& world, const WorldClass& plant, const GroundSample& sample, const Climate& climate,
           double steepest) {
  if (sample.field >= 0 && !sample.is_hedge) return false;
  if (sample.shore < dry_margin || sample.road < dry_margin || sample.house < dry_margin) return false;
  if (world.params.relief.sea && sample.height < world.params.relief.sea_level + 0.8) return false;
  const double above = sample.height - world.params.relief.sea_level;
  if (above < plant.heights[0] || above > plant.heights[1] || !is_in_biome(plant, climate)) return false;
  return climate.moisture >= plant.moisture[0] && climate.moisture <= plant.moisture[1] &&
         climate.temperature >= plant.temperature[0] && climate.temperature <= plant.temperature[1] &&
         slope_of(sample.land.height) <= steepest;
}

/// The share of plants that villagers and townspeople have cut.
double cleared_share(const WorldClass& plant, const GroundSample& sample) {
  if (sample.is_town) return plant.height < 3 ? 0.88 : 0.95;
  return (plant.height < 3 ? 0.6 : 0.93) * sample.settled;
}

double steepest_of(const WorldClass& plant) {
  const math::SinCos angle = math::sincos_degrees(plant.slope);
  return angle.sin / angle.cos;
}

/// Water makes the ground beside it moist.
double moisture_near(const Climate& climate, const GroundSample& sample) {
  return std::min(1.0, climate.moisture + 0.3 * (1 - smooth_step(sample.shore, 10, 130)));
}

}  // namespace

std::vector<Plant> plants_in(const World& world, int plant_class, const Rectangle& box, const Ground& ground,
                             Job& job, const Competitors& competitors) {
  const WorldClass& plant = world.params.plants[static_cast<std::size_t>(plant_class)];
  Field field = field_of(key_of(world, plant_class), plant, box, competitors.share, competitors.reach);
  thin(field, plant.spacing, job);
  const double steepest = steepest_of(plant);
  std::vector<Plant> plants;
  for (const Candidate& c : field.candidates) {
    if (c.state != Candidate::stays || c.east < box.west || c.east >= box.east || c.north < box.south ||
        c.north >= box.north) {
      continue;
    }
    const GroundSample sample = ground.at(c.east, c.north);
    Climate climate = climate_at(world, c.east, c.north, sample.height);
    climate.moisture = moisture_near(climate, sample);
    Rng rng(key_at(c.key, 1));
    climate.moisture += 0.08 * (rng.unit() - 0.5);  // edges of biomes are no lines
    climate.temperature += 1.2 * (rng.unit() - 0.5);
    if (!suits(world, plant, sample, climate, steepest)) continue;
    const double size = rng.uniform(0.7, 1.3);
    if (!sample.is_hedge && rng.unit() < cleared_share(plant, sample)) continue;
    plants.push_back({c.east, c.north, sample.height - plant_depth, size, rng.next()});
  }
  return plants;
}

double wood_cover(const World& world, int plant_class, const GroundSample& sample, const Climate& climate,
                  const glm::dvec2& at, double spacing) {
  const WorldClass& plant = world.params.plants[static_cast<std::size_t>(plant_class)];
  if (sample.field >= 0) return 0;
  Climate moist = climate;
  moist.moisture = moisture_near(climate, sample);
  if (!suits(world, plant, sample, moist, steepest_of(plant))) return 0;
  return cover_at(key_of(world, plant_class), plant.density, at.x, at.y, spacing) *
         (1 - cleared_share(plant, sample));
}

namespace {

/// Whether there is a candidate of a class in a rectangle.
bool has_candidate(const World& world, int plant_class, const Rectangle& box) {
  const WorldClass& plant = world.params.plants[static_cast<std::size_t>(plant_class)];
  const std::uint64_t key = key_of(world, plant_class);
  const double cell = cell_of(plant);
  const auto index = [&](double v) { return math::to_int64(std::floor(v / cell)); };
  // positions are rounded down to multiples of 1/64 m, so the cell before may have one
  for (std::int64_t y = index(box.south) - 1; y <= index(box.north); ++y) {
    for (std::int64_t x = index(box.west) - 1; x <= index(box.east); ++x) {
      for (int n = 0; n < candidates_a_cell; ++n) {
        Rng rng(0);
        const Candidate c = candidate_at(key, cell, x, y, n, rng);
        const bool is_inside =
            c.east >= box.west && c.east < box.east && c.north >= box.south && c.north < box.north;
        if (is_inside && rng.unit() < cover_at(key, plant.density, c.east, c.north)) return true;
      }
    }
  }
  return false;
}

/// A range of climates.
struct Climates {
  std::array<double, 2> moisture{}, temperature{};
};

/// Whether one of the biomes of a class has a climate of the range. A biome has the climates between two temperatures and
/// two moistures, the lower ones included. The lower ends of the range and the limits inside it thus meet all its biomes.
bool has_biome(const WorldClass& plant, const Climates& range) {
  if (plant.biomes.empty()) return true;
  std::vector<double> moistures{range.moisture[0]}, temperatures{range.temperature[0]};
  const auto add = [](std::vector<double>& list, const auto& limits, const std::array<double, 2>& within) {
    std::copy_if(limits.begin(), limits.end(), std::back_inserter(list),
                 [&](double limit) { return limit > within[0] && limit <= within[1]; });
  };
  add(moistures, moisture_limits, range.moisture);
  add(temperatures, temperature_limits, range.temperature);
  return std::any_of(temperatures.begin(), temperatures.end(), [&](double temperature) {
    return std::any_of(moistures.begin(), moistures.end(), [&](double moisture) {
      return is_in_biome(plant, {moisture, temperature});
    });
  });
}

/// Returns false only if the class is excluded within `spacing` metres of a sample.
bool may_grow(const World& world, const WorldClass& plant, const GroundSample& sample, double east,
              double north, double spacing) {
  const WorldRelief& relief = world.params.relief;
  if (plant.density <= 0) return false;
  const Climate climate = climate_at(world, east, north, sample.height);
  const double far = std::min(1.0, spacing / 400);
  const double wetter = sample.shore < 130 + spacing || spacing > 400 ? 0.3 : 0;
  const double moister = 0.05 + 0.1 * far + wetter, warmer = 0.7 + 3 * far;
  const Climates range{{climate.moisture - 0.05 - 0.1 * far, climate.moisture + moister},
                       {climate.temperature - warmer, climate.temperature + warmer}};
  return range.moisture[1] >= plant.moisture[0] && range.moisture[0] <= plant.moisture[1] &&
         range.temperature[1] >= plant.temperature[0] && range.temperature[0] <= plant.temperature[1] &&
         (!relief.sea || sample.height > relief.sea_level - 2 - 40 * far) && has_biome(plant, range);
}

}  // namespace

double tallest_growing(const World& world, const GroundSample& sample, double east, double north,
                       double spacing) {
  double tallest = 0;
  for (const WorldClass& plant : world.params.plants) {
    if (plant.height > tallest && may_grow(world, plant, sample, east, north, spacing))
      tallest = plant.height;
  }
  return tallest;
}

PresentPlants plants_present(const World& world, const Growth& growth, std::span<const double> tops,
                             const Rectangle& box) {
  constexpr double widest_counted = 256;  ///< metres; side of squares in which candidates are searched
  PresentPlants present;
  if (!world.has(Layer::plants)) return present;
  double most = growth.tallest;
  if (growth.has_river) {
    GroundSample bank;
    bank.height = (growth.low + growth.high) / 2;
    bank.shore = 0;
    const double east = (box.west + box.east) / 2, north = (box.south + box.north) / 2;
    most = std::max(most, tallest_growing(world, bank, east, north, box.east - box.west));
  }
  for (std::size_t k = 0; k < world.params.plants.size(); ++k) {
    const WorldClass& plant = world.params.plants[k];
    const double zero = world.params.relief.sea_level;
    const bool is_higher = plant.height > present.height || tops[k] > present.top;
    const bool may_be = is_higher && plant.height <= most && growth.high - zero >= plant.heights[0] &&
                        growth.low - zero <= plant.heights[1];
    if (!may_be) continue;
    if (box.east - box.west > widest_counted || has_candidate(world, static_cast<int>(k), box)) {
      present.height = std::max(present.height, plant.height);
      present.top = std::max(present.top, tops[k]);
    }
  }
  return present;
}

}  // namespace seedmesh::world
