#pragma once
/// A world request as the functions of this directory use it.
#include <array>
#include <cstdint>
#include <memory>

#include "core/generators/world/asset.h"
#include "core/generators/world/store.h"
#include "generated/params/world.h"

namespace seedmesh {
struct CityParams;
}

namespace seedmesh::world {

constexpr double leaf_side = 64;             ///< metres
constexpr std::int64_t region_side = 32768;  ///< metres; the unit of the origin
constexpr int tile_cells = 32;               ///< cells along a side of the terrain of most tiles

enum class Layer : std::uint8_t { terrain, water, roads, buildings, plants };

constexpr int range_octaves = 5, hill_octaves = 3, detail_octaves = 7, gully_octaves = 3;

/// The keys of all octaves of the land, which follow from World::key.
struct NoiseKeys {
  std::array<std::uint64_t, 4> coast{};
  std::array<std::uint64_t, 2> belts{};
  std::array<std::uint64_t, range_octaves> ranges{};
  std::array<std::uint64_t, hill_octaves> hills{};
  std::array<std::uint64_t, detail_octaves> detail{};
  std::array<std::uint64_t, gully_octaves> gullies{};
  std::array<std::uint64_t, 3> moisture{};
  std::uint64_t temperature = 0;
};
/// Derives the keys of all noises from the key of a world.
NoiseKeys noise_keys(std::uint64_t key);

/// The data that a layer reads around the part that it makes: cells of a region; water; settlements that
/// determine roads; earthworks of roads; settlements with fields; settlements with houses; the data of the plan
/// of a town.
enum class LayerInput : std::uint8_t { cells, water, roads, works, fields, houses, towns };

/// Immutable; copies share the store. Positions of the plane ("absolute") are metres from its own zero; those of
/// tiles and maps are relative to the middle of the world.
struct World {
  WorldParams params;
  std::uint64_t seed = 0;
  std::uint64_t key = 0;             ///< key of all random choices
  std::uint64_t id = 0;              ///< distinguishes worlds in the store
  int levels = 15;                   ///< levels of the tree; the last has the leaves
  double extent = 1048576;           ///< metres
  std::int64_t east = 0, north = 0;  ///< the middle, absolute
  std::shared_ptr<Store> store;
  MakeAsset make_asset;  ///< makes plants and houses by requests; without it they have their plain forms

  bool has(Layer layer) const { return (layers & (1U << static_cast<unsigned>(layer))) != 0; }
  unsigned layers = 31;
  double land_bias = 0;  ///< bias of the continents
  NoiseKeys noise;
  std::shared_ptr<const CityParams> town_rules;  ///< never null

  /// Returns the distance within which a layer with a declared reach reads. Tests change `reach_factor` and
  /// `reach_more` of one layer, to show that its reach is enough and that half of it is not.
  double reach(LayerInput layer, double declared) const {
    const auto n = static_cast<std::size_t>(layer);
    return reach_factor[n] * declared + reach_more[n];
  }
  static constexpr std::size_t reaches = static_cast<std::size_t>(LayerInput::towns) + 1;
  std::array<double, reaches> reach_factor{1, 1, 1, 1, 1, 1, 1}, reach_more{};
};

/// Returns the errors that the schema cannot express: /extent is no power of two, /layers names one twice, or two
/// classes of /plants have one name.
std::vector<Issue> issues_of(const WorldParams& params);

/// Checks the parameters and returns the world. `store` keeps values that tiles share; without one, the world
/// gets its own of 64 MiB.
Result<World> read_world(const WorldParams& params, std::uint64_t seed,
                         std::shared_ptr<Store> store = nullptr);

}  // namespace seedmesh::world
