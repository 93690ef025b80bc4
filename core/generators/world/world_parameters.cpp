#include "core/generators/world/world_parameters.h"

#include <set>

#include "core/generators/world/town.h"
#include "core/schema/json.h"
#include "generated/params/city.h"

namespace seedmesh::world {
namespace {

int levels_of(double extent) {
  int levels = 1;
  for (double side = extent; side > leaf_side; side /= 2) ++levels;
  return levels;
}

}  // namespace

std::vector<Issue> issues_of(const WorldParams& params) {
  std::vector<Issue> issues;
  const auto extent = static_cast<std::uint32_t>(params.extent);
  if ((extent & (extent - 1)) != 0) {
    issues.emplace_back(IssueKind::invalid_value, "/extent",
                        "the extent is " + std::to_string(extent) + " m, expected a power of two");
  }
  std::set<WorldLayersItem> layers;
  for (std::size_t k = 0; k < params.layers.size(); ++k) {
    if (layers.insert(params.layers[k]).second) continue;
    issues.emplace_back(IssueKind::duplicate_key, "/layers/" + std::to_string(k),
                        "the layer " + std::string(text_of(params.layers[k])) + " is named twice");
  }
  std::set<std::string> names;
  for (std::size_t k = 0; k < params.plants.size(); ++k) {
    const std::string at = "/plants/" + std::to_string(k);
    const WorldClass& plant = params.plants[k];
    if (!names.insert(plant.class_name).second) {
      issues.emplace_back(IssueKind::duplicate_key, at + "/class",
                          "the class " + plant.class_name + " is listed twice");
    }
    for (const auto& [name, range] : {std::pair{"/moisture", plant.moisture},
                                      {"/temperature", plant.temperature},
                                      {"/heights", plant.heights}}) {
      if (range[0] <= range[1]) continue;
      issues.emplace_back(conflict_with({}), at + name,
                          "found " + number_text(range[0]) + " before " + number_text(range[1]) +
                              ", expected the lower number first");
    }
    if (plant.model && !plant.model->generator.empty() && plant.model->generator != "tree" &&
        plant.model->generator != "lsystem") {
      issues.emplace_back(conflict_with({}), at + "/model/generator",
                          "found \"" + plant.model->generator + "\", expected \"tree\" or \"lsystem\"");
    }
  }
  for (std::size_t k = 0; k < params.settlements.houses.size(); ++k) {
    const std::string& generator = params.settlements.houses[k].model.generator;
    if (generator.empty() || generator == "building") continue;
    issues.emplace_back(conflict_with({}), "/settlements/houses/" + std::to_string(k) + "/model/generator",
                        "found \"" + generator + "\", expected \"building\"");
  }
  check_towns(params, issues);
  return issues;
}

Result<World> read_world(const WorldParams& params, std::uint64_t seed, std::shared_ptr<Store> store) {
  if (std::vector<Issue> issues = issues_of(params); !issues.empty())
    return Error{Code::invalid, std::move(issues)};
  World world;
  world.params = params;
  world.seed = seed;
  world.key = Rng::of_seed(seed).at("world").key();
  world.store = store ? std::move(store) : std::make_shared<Store>();
  world.id = world.store->next_world();
  world.extent = params.extent;
  world.levels = levels_of(world.extent);
  world.east = params.origin[0] * region_side;
  world.north = params.origin[1] * region_side;
  world.layers = 0;
  for (const WorldLayersItem layer : params.layers) world.layers |= 1U << static_cast<unsigned>(layer);
  world.noise = noise_keys(world.key);
  world.town_rules = std::make_shared<const CityParams>(town_rules(params));
  world.land_bias = 1.5 * (params.relief.land - 0.5);
  return world;
}

}  // namespace seedmesh::world
