#include "core/pipeline/world.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/generators/world/world.h"
#include "core/pipeline/body.h"
#include "core/pipeline/guarded.h"
#include "core/pipeline/tileset.h"
#include "core/pipeline/world_assets.h"
#include "core/schema/json.h"

namespace seedmesh {

static_assert(world_tileset_levels == tiles::levels_a_tileset &&
              world_subtree_levels == tiles::levels_a_subtree);

class WorldMemory {
 public:
  explicit WorldMemory(std::uint64_t bytes) : store(std::make_shared<world::Store>(bytes)) {}
  const std::shared_ptr<world::Store> store;
};

struct OpenWorld::Body {
  world::World world;
};

namespace {

world::TileKey key_of(const tiles::Address& at) { return {at.level, at.x, at.y}; }
tiles::Address address_of(const TileAddress& at) { return {at.level, at.x, at.y}; }

tiles::BoundsOf bounds_in(const world::World& world, Job& job) {
  return [&world, &job](const tiles::Address& at) -> tiles::Bounds {
    const world::TileBounds b = world::tile_bounds(world, key_of(at), job);
    return {b.west, b.south, b.low, b.east, b.north, b.high, b.geometric_error};
  };
}

/// Runs the work on one file of a world.
template <class T, class Work>
Result<T> made(const OpenWorld& open, const Job::Options& options, const Work& work) {
  return guarded<T>([&]() -> Result<T> {
    world::World world = open.body().world;
    world.make_asset = asset_maker(options);
    Job job(world.seed, options);
    return work(world, job);
  });
}

Error bad_box(std::string message) {
  return {Code::invalid, {{IssueKind::invalid_value, "/box", std::move(message)}}};
}

/// The start of a message about a text, of which it shows the beginning.
std::string found(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string shown(text.substr(0, longest));
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "found \"" + shown + (text.size() > longest ? "..." : "") + "\", ";
}

std::string whole(double number) { return std::to_string(static_cast<std::int64_t>(number)); }

}  // namespace

std::shared_ptr<WorldMemory> make_world_memory(std::uint64_t bytes) {
  return std::make_shared<WorldMemory>(bytes);
}

int OpenWorld::levels() const { return body_->world.levels; }
double OpenWorld::extent() const { return body_->world.extent; }

TileRange tiles_in(const OpenWorld& world, int level, const WorldBox& box) {
  const auto count = std::int64_t{1} << level;
  const double half = world.extent() / 2, side = world.extent() / static_cast<double>(count);
  const auto first = [&](double at) {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor((at + half) / side)), 0, count - 1);
  };
  const auto last = [&](double at) {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::ceil((at + half) / side)) - 1, 0,
                                    count - 1);
  };
  return {first(box.west), first(box.south), last(box.east), last(box.north)};
}

bool is_world(const Request& request) { return request.generator() == "world"; }

Result<OpenWorld> open_world(const Request& request, std::shared_ptr<WorldMemory> memory) {
  if (!is_world(request)) {
    return Error{Code::invalid,
                 {{conflict_with({}), "/generator",
                   "found \"" + std::string(request.generator()) + "\"; only a world has tiles"}}};
  }
  return guarded<OpenWorld>([&]() -> Result<OpenWorld> {
    const auto& params = *static_cast<const WorldParams*>(request.body().params.get());
    Result<world::World> read = world::read_world(params, request.seed(), memory ? memory->store : nullptr);
    if (!read) return in_request(std::move(read).error());
    return OpenWorld(std::make_shared<const OpenWorld::Body>(OpenWorld::Body{*std::move(read)}));
  });
}

std::optional<Error> output_error_of_tiles(const Request& request) {
  Json options = write_output(request.body().output);
  for (const char* name : {"name", "provenance"}) options.erase(name);
  Error error{Code::invalid, {}};
  for (const auto& [name, value] : options.items()) {
    error.issues.emplace_back(IssueKind::not_available, "/output/" + name,
                              "found " + value.dump() +
                                  "; the format of tiles is fixed, so they do not have this option; "
                                  "`seedmesh generate` makes a model of the root tile, which has it");
  }
  if (error.issues.empty()) return std::nullopt;
  return error;
}

Result<std::string> world_tileset(const OpenWorld& world, const TileAddress& root, std::string_view prefix,
                                  const Job::Options& options, const WorldPart* part) {
  return made<std::string>(world, options, [&](const world::World& own, Job& job) -> Result<std::string> {
    tiles::Naming naming{prefix, own.levels};
    if (part) {
      naming.levels = part->last + 1;
      naming.first_content = part->first;
      naming.has_tile = [&](const tiles::Address& at) {
        const TileRange range = tiles_in(world, at.level, part->box);
        return at.x >= range.west && at.x <= range.east && at.y >= range.south && at.y <= range.north;
      };
    }
    return tiles::explicit_tileset(address_of(root), naming, bounds_in(own, job));
  });
}

Result<std::string> world_implicit(const OpenWorld& world, std::string_view prefix,
                                   const Job::Options& options) {
  return made<std::string>(world, options, [&](const world::World& own, Job& job) -> Result<std::string> {
    return tiles::implicit_tileset(own.extent, world::greatest_error(own), {prefix, own.levels},
                                   bounds_in(own, job));
  });
}

Result<std::string> world_subtree(const OpenWorld& world, const TileAddress& root,
                                  const Job::Options& options) {
  return made<std::string>(world, options, [&](const world::World& own, Job& job) -> Result<std::string> {
    return tiles::subtree(address_of(root), own.levels, bounds_in(own, job));
  });
}

Result<std::string> world_tile(const OpenWorld& world, const TileAddress& address,
                               const Job::Options& options) {
  return made<std::string>(world, options, [&](const world::World& own, Job& job) -> Result<std::string> {
    return world::tile_glb(own, {address.level, address.x, address.y}, job);
  });
}

Result<std::optional<WorldFile>> world_file(const OpenWorld& world, std::string_view name,
                                            const Job::Options& options) {
  using Found = std::optional<WorldFile>;
  return made<Found>(world, options, [&](const world::World& own, Job& job) -> Result<Found> {
    const auto dot = name.find('.');
    if (dot == std::string_view::npos) return Found();
    std::optional<world::SharedFile> file = world::shared_file(own, name.substr(0, dot), job);
    if (!file || file->extension != name.substr(dot + 1)) return Found();
    return Found(WorldFile{std::move(file->bytes), std::move(file->media_type)});
  });
}

Result<WorldBox> read_world_box(const OpenWorld& world, std::string_view text, double longest) {
  constexpr std::size_t sides = 4;
  double side[sides] = {};
  const char* at = text.data();
  const char* const end = at + text.size();
  for (std::size_t i = 0; i < sides; ++i) {
    const auto [next, error] = std::from_chars(at, end, side[i]);
    const bool is_last = i + 1 == sides;
    if (error != std::errc() || !std::isfinite(side[i]) ||
        (is_last ? next != end : next == end || *next != ','))
      return bad_box(found(text) + "expected four numbers of metres: west,south,east,north");
    at = is_last ? next : next + 1;
  }
  const WorldBox box{side[0], side[1], side[2], side[3]};
  if (!(box.west < box.east) || !(box.south < box.north))
    return bad_box(found(text) + "expected west below east, and south below north");
  if (box.east - box.west > longest || box.north - box.south > longest)
    return bad_box(found(text) + "expected sides of at most " + whole(longest) + " m");
  const double half = world.body().world.extent / 2;
  if (box.west < -half || box.south < -half || box.east > half || box.north > half) {
    return bad_box(found(text) + "expected a box inside the world, from -" + whole(half) + " to " +
                   whole(half) + " m");
  }
  return box;
}

Result<std::string> world_map(const OpenWorld& world, const WorldBox& box, WorldHeights heights,
                              const Job::Options& options) {
  return made<std::string>(world, options, [&](const world::World& own, Job& job) -> Result<std::string> {
    const auto wanted = heights == WorldHeights::grid ? world::MapHeights::grid : world::MapHeights::none;
    return canonical_text(world::map_json(own, {box.west, box.south, box.east, box.north}, wanted, job),
                          [&] { job.check(); });
  });
}

}  // namespace seedmesh
