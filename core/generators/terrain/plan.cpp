#include "core/generators/terrain/plan.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/terrain/image.h"
#include "core/generators/terrain/layers.h"
#include "generated/params/terrain.h"

namespace seedmesh::terrain {
namespace {

constexpr double default_hurst = 0.8;
constexpr int plane_side = 257, sphere_side = 65;

using Algorithm = TerrainAlgorithm;

bool is_fault(const TerrainParams& params) {
  return params.algorithm == Algorithm::fault_formation || params.algorithm == Algorithm::poisson_faulting;
}
bool is_sphere(const TerrainParams& params) { return params.shape == TerrainShape::sphere; }

double falloff_of(const TerrainParams& params) { return math::pow(2, -params.hurst.value_or(default_hurst)); }

/// Returns the number of samples from the corner of one tile to that of the next.
std::int64_t tile_step(const TerrainParams& params) {
  switch (params.algorithm) {
    case Algorithm::triangular_edge:
    case Algorithm::diamond_square:
    case Algorithm::square_square:
      return std::int64_t{1} << all_iterations(params);
    default:
      return made_side(params) - 1;
  }
}

/// Returns the requested samples and a margin around them.
Window window_of(const TerrainParams& params, std::int32_t margin) {
  Window window;
  const std::int32_t side =
      params.tile ? static_cast<std::int32_t>(tile_step(params)) + 1 : made_side(params);
  if (params.tile) {
    window.x = params.tile->x * tile_step(params);
    window.z = params.tile->z * tile_step(params);
  }
  window.x -= margin;
  window.z -= margin;
  window.width = window.depth = side + 2 * margin;
  return window;
}

Field raw_field(const TerrainParams& params, const Window& window, double cell, Rng rng, const Job& job) {
  Field field = algorithm_field(params, window, cell, rng, job);
  add_layers(params, field, window, cell, rng, job);
  return field;
}

DropletPlan droplet_plan(const TerrainParams& params, const Field& field) {
  const TerrainHydraulic& given = *params.hydraulic;
  DropletPlan plan;
  plan.droplets = given.droplets.value_or(plan.droplets);
  plan.lifetime = given.lifetime.value_or(params.size / 8) / field.cell;
  plan.inertia = given.inertia.value_or(plan.inertia);
  plan.capacity = given.capacity.value_or(plan.capacity);
  plan.erosion = given.erosion.value_or(plan.erosion);
  plan.deposition = given.deposition.value_or(plan.deposition);
  plan.evaporation = given.evaporation.value_or(plan.evaporation);
  plan.radius = given.radius ? *given.radius / field.cell : plan.radius;
  return plan;
}

Heights heights_of(const std::array<double, 2>& pair) { return {pair[0], pair[1]}; }

IslandPlan island_plan(const TerrainParams& params) {
  const TerrainIsland& given = *params.island;
  IslandPlan plan;
  plan.reach = given.reach;
  plan.depth = given.depth;
  plan.roughness = given.roughness;
  plan.floor = given.floor;
  if (params.tile) {
    plan.side = params.tile->across.value_or(1) * tile_step(params) + 1;
    plan.x = params.tile->x * tile_step(params);
    plan.z = params.tile->z * tile_step(params);
  }
  return plan;
}

TerracePlan terrace_plan(const TerrainParams& params) {
  TerracePlan plan;
  plan.count = params.terraces->count;
  plan.sharpness = params.terraces->sharpness;
  if (params.terraces->from) plan.from = heights_of(*params.terraces->from);
  return plan;
}

void filter(const TerrainParams& params, Field& field, Rng rng, const Job& job) {
  if (params.tile) {
    smooth_by_position(field, params.smooth, job);
  } else {
    smooth(field, params.smooth, job);
  }
  if (params.normalise && params.normalise->from) {
    stretch(field, heights_of(*params.normalise->from), {params.normalise->low, params.normalise->high}, job);
  } else if (params.normalise) {
    normalise(field, params.normalise->low, params.normalise->high, job);
  }
  if (params.island) sink_rim(field, island_plan(params), rng.at("island"), job);
  if (params.terraces) terrace(field, terrace_plan(params), job);
  if (params.thermal) {
    erode_thermally(
        field,
        {params.thermal->iterations, math::tan(math::radians(params.thermal->talus)), params.thermal->rate},
        job);
  }
}

/// Erosion by water, which acts from one end of the field to the other. The field has no margin.
void run_water(const TerrainParams& params, Field& field, Rng rng, const Job& job) {
  if (params.hydraulic && params.hydraulic->method == TerrainMethod::droplets)
    erode_by_droplets(field, droplet_plan(params, field), rng.at("droplets"), job);
  if (params.hydraulic && params.hydraulic->method == TerrainMethod::stream_power) {
    const StreamPlan defaults;
    erode_by_streams(field,
                     {params.hydraulic->iterations.value_or(defaults.iterations),
                      params.hydraulic->strength.value_or(defaults.strength),
                      params.hydraulic->area_exponent.value_or(defaults.area_exponent)},
                     job);
  }
}

/// Generates heights without filters.
Range raw_range(const TerrainParams& params) {
  const auto amplitude = static_cast<float>(amplitude_of(params));
  if (is_fault(params)) {
    const FaultPlan plan = fault_plan(params);
    const double sum = (plan.greatest + plan.least) / 2 * plan.planned + plan.greatest * plan.extra;
    const auto typical = static_cast<float>(
        plan.kind == FaultKind::one_sided ? sum / 2 : sum / std::sqrt(all_iterations(params) + 1.0));
    return plan.kind == FaultKind::one_sided ? Range{0, typical} : Range{-typical, typical};
  }
  if (params.algorithm == Algorithm::fbm &&
      params.noise.value_or(TerrainNoise::rolling) == TerrainNoise::ridged)
    return {0, 1.8F * amplitude};
  return {-1.2F * amplitude, 1.2F * amplitude};
}

}  // namespace

Field algorithm_field(const TerrainParams& params, const Window& window, double cell, Rng rng,
                      const Job& job) {
  switch (params.algorithm) {
    case Algorithm::triangular_edge:
    case Algorithm::diamond_square:
      return subdivide(square_plan(params), params.tile ? World::unbounded : World::bounded, window, rng,
                       job);
    case Algorithm::square_square:
      return subdivide_nested(nested_plan(params), window, rng, job);
    case Algorithm::fbm:
      return noisy(noise_plan(params), window, cell, rng, job);
    case Algorithm::expression:
      return expressed_field(params, window, cell, rng, job);
    default: {
      const std::int64_t across = params.tile ? params.tile->across.value_or(1) : 1;
      const auto side = static_cast<std::int32_t>(across * (made_side(params) - 1) + 1);
      return faulted(fault_plan(params), {0, 0, side, side}, window, cell, rng, job);
    }
  }
}

int planned_iterations(const TerrainParams& params) {
  if (params.algorithm == Algorithm::fracture) return params.iterations.value_or(FracturePlan{}.planes);
  return params.iterations.value_or(is_fault(params) ? 64 : 8);
}
int all_iterations(const TerrainParams& params) {
  return planned_iterations(params) + params.extra_iterations;
}

double amplitude_of(const TerrainParams& params) {
  if (params.algorithm == Algorithm::fracture) return params.amplitude.value_or(params.size / 60);
  return params.amplitude.value_or(params.size / (is_sphere(params) ? 20 : 10));
}

SquareSubdivision square_plan(const TerrainParams& params) {
  SquareSubdivision plan;
  if (params.algorithm == Algorithm::triangular_edge) {
    plan.rule = params.mode.value_or(TerrainMode::random) == TerrainMode::random
                    ? SquareRule::triangle_random
                    : SquareRule::triangle_midpoint;
  }
  plan.border = static_cast<BorderRule>(params.edge.value_or(TerrainEdge::two_neighbours));
  plan.rounds = all_iterations(params);
  plan.amplitude = amplitude_of(params);
  plan.falloff = falloff_of(params);
  plan.corners = params.corners;
  return plan;
}
static_assert(static_cast<int>(BorderRule::wrap) == static_cast<int>(TerrainEdge::wrap) &&
              static_cast<int>(BorderRule::three) == static_cast<int>(TerrainEdge::avg3));

NestedSubdivision nested_plan(const TerrainParams& params) {
  NestedSubdivision plan;
  plan.rounds = all_iterations(params);
  plan.amplitude = amplitude_of(params);
  plan.falloff = falloff_of(params);
  plan.grid = params.grid;
  return plan;
}

FaultPlan fault_plan(const TerrainParams& params) {
  FaultPlan plan;
  plan.kind = params.algorithm == Algorithm::fault_formation ? FaultKind::one_sided : FaultKind::normal;
  plan.planned = planned_iterations(params);
  plan.extra = params.extra_iterations;
  plan.greatest = params.fault_max.value_or(params.size / 50);
  plan.least = params.fault_min.value_or(0);
  plan.step = static_cast<FaultStep>(params.fault_step.value_or(TerrainFaultStep::hard));
  plan.width = params.fault_width.value_or(params.size / 8);
  return plan;
}

NoisePlan noise_plan(const TerrainParams& params) {
  NoisePlan plan;
  plan.kind = static_cast<NoiseKind>(params.noise.value_or(TerrainNoise::rolling));
  plan.octaves = all_iterations(params);
  plan.amplitude = amplitude_of(params);
  plan.lacunarity = params.lacunarity.value_or(2);
  plan.gain = math::pow(plan.lacunarity, -params.hurst.value_or(default_hurst));
  plan.wavelength = params.wavelength.value_or(params.size / 3);
  plan.warp = params.warp.value_or(0);
  return plan;
}

Window window_of(const TerrainParams& params) { return window_of(params, 0); }

bool is_subdivided(const TerrainParams& params) {
  return params.algorithm == Algorithm::triangular_edge || params.algorithm == Algorithm::diamond_square ||
         params.algorithm == Algorithm::square_square;
}

int made_side(const TerrainParams& params) {
  switch (params.algorithm) {
    case Algorithm::triangular_edge:
    case Algorithm::diamond_square:
      return (1 << all_iterations(params)) + 1;
    case Algorithm::square_square:
      // There is one more sample than for the other algorithms, except for the start grid. Tiles omit it.
      return (1 << all_iterations(params)) + 2;
    case Algorithm::image:
      return 0;
    default:
      return params.resolution.value_or(is_sphere(params) ? sphere_side : plane_side);
  }
}

std::int64_t samples_across(const TerrainParams& params) {
  return params.tile->across.value_or(1) * tile_step(params) + 1;
}

int finished_side(const TerrainParams& params) {
  if (params.resample) return *params.resample;
  return params.tile && params.algorithm == Algorithm::square_square ? made_side(params) - 1
                                                                     : made_side(params);
}

Range nominal_range(const TerrainParams& params) {
  Range range = raw_range(params);
  if (params.normalise)
    range = {static_cast<float>(params.normalise->low), static_cast<float>(params.normalise->high)};
  if (params.island && params.island->floor)
    range.low = std::min(range.low, static_cast<float>(*params.island->floor));
  return range;
}

PaletteName palette_of(const TerrainParams& params) { return static_cast<PaletteName>(params.palette); }
static_assert(static_cast<int>(PaletteName::none) == static_cast<int>(TerrainPalette::none) &&
              static_cast<int>(PaletteName::moon) == static_cast<int>(TerrainPalette::moon));

/// Samples around what filters read of the neighbours of a tile.
static std::int32_t filter_reach(const TerrainParams& params) {
  // A layer may read slopes, which need the neighbours of a sample.
  return smooth_reach(params.smooth) + (params.thermal ? params.thermal->iterations : 0) +
         static_cast<std::int32_t>(params.layers.size());
}

/// The samples of one tile of a world without margin, with one sample around them for normals. Beyond the border
/// of the world, heights continue the last slope.
static Field cut_tile(const Field& world, const TerrainTile& tile, std::int32_t step, const Job& job) {
  Field field(job, step + 1, step + 1, 1);
  field.cell = world.cell;
  const auto along = [&](std::int32_t at, std::int32_t side, const auto& height) {
    if (at < 0) return 2 * height(0) - height(1);
    return at < side ? height(at) : 2 * height(side - 1) - height(side - 2);
  };
  for (std::int32_t z = -1; z <= step + 1; ++z) {
    job.check();
    for (std::int32_t x = -1; x <= step + 1; ++x) {
      field.at(x, z) = along(tile.z * step + z, world.depth, [&](std::int32_t row) {
        return along(tile.x * step + x, world.width,
                     [&](std::int32_t column) { return world.at(column, row); });
      });
    }
  }
  return field;
}

/// A tile of a world over which water runs: the whole world is made, and the tile is cut out of it.
static Field eroded_tile(const TerrainParams& params, Rng rng, const Job& job) {
  TerrainParams whole = params;
  whole.tile->x = whole.tile->z = 0;
  const auto side = static_cast<std::int32_t>(samples_across(params));
  const std::int32_t margin = filter_reach(params);
  const double cell = params.size / static_cast<double>(tile_step(params));
  Field world = raw_field(whole, {-margin, -margin, side + 2 * margin, side + 2 * margin}, cell, rng, job);
  world.margin = margin;
  world.width = world.depth = side;
  world.cell = cell;
  filter(whole, world, rng, job);
  world = cropped(std::move(world), 0, job);
  run_water(whole, world, rng, job);
  return cut_tile(world, *params.tile, static_cast<std::int32_t>(tile_step(params)), job);
}

Result<Field> field_of(const TerrainParams& params, Job& job) {
  const Rng rng = job.rng().at("terrain");
  if (params.algorithm == Algorithm::image) {
    Result<Field> field = field_of_image(*params.image, job);
    if (!field) return field;
    field->cell = params.size / (field->width - 1);
    add_layers(params, *field, {0, 0, field->width, field->depth}, field->cell, rng, job);
    filter(params, *field, rng, job);
    run_water(params, *field, rng, job);
    if (!params.resample) return field;
    Field finer = resampled(*field, *params.resample, job);
    finer.voids = field->voids;
    finer.notes = std::move(field->notes);
    return finer;
  }
  if (params.tile && params.hydraulic) return eroded_tile(params, rng, job);
  // The margin of a tile is the reach of its filters and one more sample for normals.
  const std::int32_t margin = params.tile ? 1 + filter_reach(params) : 0;
  const Window window = window_of(params, margin);
  const double cell = params.size / static_cast<double>(window.width - 2 * margin - 1);
  Field field = raw_field(params, window, cell, rng, job);
  field.margin = margin;
  field.width -= 2 * margin;
  field.depth -= 2 * margin;
  field.cell = params.size / (field.width - 1);
  filter(params, field, rng, job);
  run_water(params, field, rng, job);
  if (params.tile) return cropped(std::move(field), 1, job);
  return params.resample ? resampled(field, *params.resample, job) : std::move(field);
}

void try_expressions(const TerrainParams& params, Job& job) {
  constexpr std::int64_t most_samples = 2'100'000;
  const bool has_texts = params.algorithm == Algorithm::expression ||
                         std::ranges::any_of(params.layers, [](const TerrainLayer& layer) {
                           return layer.expression.has_value() || layer.mask.has_value();
                         });
  const std::int64_t side = made_side(params), faces = is_sphere(params) ? 6 : 1;
  if (!has_texts || params.algorithm == Algorithm::image || side * side * faces > most_samples) return;
  if (is_sphere(params)) {
    planet_of(params, 0, job);
    return;
  }
  const Window window = window_of(params);
  raw_field(params, window, params.size / static_cast<double>(window.width - 1), job.rng().at("terrain"),
            job);
}

std::int32_t planet_side(const TerrainParams& params, int level) {
  return std::max(1, (made_side(params) - 1) >> level) + 1;
}

Planet planet_of(const TerrainParams& params, int level, Job& job) {
  const Rng rng = job.rng().at("terrain");
  Planet planet = sphere_of(planet_side(params, level), params.size / 2, job);
  algorithm_sphere(params, planet, rng, job);
  add_layers(params, planet, rng, job);
  return planet;
}

void algorithm_sphere(const TerrainParams& params, Planet& planet, Rng rng, const Job& job) {
  if (params.algorithm == Algorithm::fbm) {
    noise_sphere(planet, noise_plan(params), rng, job);
  } else if (params.algorithm == Algorithm::expression) {
    express_sphere(params, planet, rng, job);
  } else if (params.algorithm == Algorithm::fracture) {
    fracture_sphere(planet, fracture_plan(params), rng, job);
  } else {
    fault_sphere(planet, fault_plan(params), rng, job);
  }
}

}  // namespace seedmesh::terrain
