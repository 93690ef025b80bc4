#include "core/generators/world/plants.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/world/plant_mesh.h"

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

/// The share of candidates near a position that may compete: woods with edges and clearings.
double cover_at(std::uint64_t key, double density, double east, double north) {
  const double n =
      noise(key + 1, east / 870, north / 870).value + 0.35 * noise(key + 2, east / 190, north / 190).value;
  return density <= 0 ? 0 : 0.02 + 0.98 * smooth_step(n + 1.5 * (density - 0.5), -0.12, 0.2);
}

/// Candidates by cell; the cells of a row follow each other.
struct Field {
  std::int64_t first_x = 0, first_y = 0;
  int columns = 0, rows = 0;
  std::vector<Candidate> candidates;
  std::vector<std::uint32_t> starts;  ///< of each cell

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

Field field_of(std::uint64_t key, const WorldClass& plant, const Rectangle& box, double reach) {
  const double cell = plant.spacing / 1.4142135623730951, around = reach * plant.spacing;
  const auto index = [&](double v) { return math::to_int64(std::floor(v / cell)); };
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
        Rng rng(key_at(cell_key(key, x, y), static_cast<std::uint64_t>(n)));
        Candidate c;
        const auto along = [&](std::int64_t of) {
          return std::floor((static_cast<double>(of) + rng.unit()) * cell * 64) / 64;
        };
        c.east = along(x);
        c.north = along(y);
        c.mark = rng.next();
        c.key = rng.key();
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
                             Job& job, double reach) {
  const WorldClass& plant = world.params.plants[static_cast<std::size_t>(plant_class)];
  Field field = field_of(key_of(world, plant_class), plant, box, reach);
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
    plants.push_back({c.east, c.north, sample.height - plant_depth, rng.uniform(0.7, 1.3), rng.unit()});
  }
  return plants;
}

double wood_cover(const World& world, int plant_class, const GroundSample& sample, double east,
                  double north) {
  const WorldClass& plant = world.params.plants[static_cast<std::size_t>(plant_class)];
  const double cover = cover_at(key_of(world, plant_class), plant.density, east, north);
  if (cover < 0.1) return 0;
  Climate climate = climate_at(world, east, north, sample.height);
  climate.moisture = moisture_near(climate, sample);
  return suits(world, plant, sample, climate, steepest_of(plant)) ? cover : 0;
}

bool may_grow(const World& world, const WorldClass& plant, const GroundSample& sample, double east,
              double north, double spacing) {
  const Climate climate = climate_at(world, east, north, sample.height);
  const double far = std::min(1.0, spacing / 400);
  const double wetter = sample.shore < 130 + spacing || spacing > 400 ? 0.3 : 0;
  const double moister = 0.05 + 0.1 * far + wetter, warmer = 0.7 + 3 * far;
  return climate.moisture + moister >= plant.moisture[0] &&
         climate.moisture - 0.05 - 0.1 * far <= plant.moisture[1] &&
         climate.temperature + warmer >= plant.temperature[0] &&
         climate.temperature - warmer <= plant.temperature[1] &&
         (!world.params.relief.sea || sample.height > world.params.relief.sea_level - 2 - 40 * far);
}

}  // namespace seedmesh::world
