/// The speed of worlds on one thread, in processor time: tiles of ground, leaves with plants and houses, a region that
/// no request has asked for before, the first picture of a replica, tiles of a flight, nested tilesets, and samples of
/// noise with gullies.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/generators/world/land.h"
#include "core/pipeline.h"
#include "core/pipeline/world.h"
#include "tests/bench/report.h"

namespace {

using namespace seedmesh;

Job::Options one_thread() {
  Job::Options options;
  options.threads = 1;
  return options;
}

constexpr std::uint64_t memory_bytes = std::uint64_t{64} << 20U;

OpenWorld opened(const char* parameters, unsigned seed) {
  const std::string body = std::string(R"({"generator":"world","seed":)") + std::to_string(seed) +
                           R"(,"parameters":)" + parameters + "}";
  const Result<Request> request = read_request(body, Limits{});
  if (!request) std::abort();
  Result<OpenWorld> world = open_world(*request, make_world_memory(memory_bytes));
  if (!world) std::abort();
  return *world;
}

constexpr const char* bare = R"({"layers":["terrain","water"],"relief":{"land":0.9}})";
constexpr const char* full =
    R"({"relief":{"land":0.95},"plants":[{"class":"oak","height":14,"spacing":8,"moisture":[0,1],"temperature":[-30,45]},)"
    R"({"class":"bush","height":2,"spacing":3,"moisture":[0,1],"temperature":[-30,45]}]})";

std::size_t tile(const OpenWorld& world, const TileAddress& address) {
  const Result<std::string> made = world_tile(world, address, one_thread());
  if (!made) std::abort();
  return made->size();
}

void percentile(const std::string& name, std::vector<double> seconds, double share, double bytes = 0) {
  std::sort(seconds.begin(), seconds.end());
  const double found = seconds[static_cast<std::size_t>(share * static_cast<double>(seconds.size() - 1))];
  std::printf(R"({"name":"%s","unit":"tiles","amount":1,"seconds":%.9f,"bytes":%.0f})"
              "\n",
              name.c_str(), found, bytes);
}

template <class Work>
double once(Work&& work) {
  const double start = bench::CpuClock::seconds();
  work();
  return bench::CpuClock::seconds() - start;
}

/// Addresses of a level beside the middle of the world, row by row.
std::vector<TileAddress> around(int level, std::int64_t side) {
  const std::int64_t middle = std::int64_t{1} << (level - 1);
  std::vector<TileAddress> all;
  for (std::int64_t y = 0; y < side; ++y) {
    for (std::int64_t x = 0; x < side; ++x) all.push_back({level, middle + x, middle + y});
  }
  return all;
}

/// All tiles of a list once to fill the memory, then each by itself.
void bench_tiles(const std::string& name, const OpenWorld& world, const std::vector<TileAddress>& all) {
  std::vector<double> seconds, bytes;
  for (const TileAddress& each : all) tile(world, each);
  for (const TileAddress& each : all) {
    std::size_t size = 0;
    seconds.push_back(once([&] { size = tile(world, each); }));
    bytes.push_back(static_cast<double>(size));
  }
  std::sort(bytes.begin(), bytes.end());
  percentile(name + ", p50", seconds, 0.5, bytes[bytes.size() / 2]);
  percentile(name + ", p99", seconds, 0.99, bytes.back());
}

/// Leaves of worlds that no request has asked for before: region, roads and plans are made as well.
void bench_cold() {
  std::vector<double> seconds;
  for (unsigned seed = 1; seed <= 9; ++seed) {
    const OpenWorld world = opened(full, seed);
    seconds.push_back(once([&] { tile(world, {14, 8192, 8192}); }));
  }
  percentile("first leaf of a region", seconds, 0.5);
}

/// Of each level, the tiles within half of their side of a way from the middle to the east, at most 700 m from it.
std::vector<TileAddress> along(const OpenWorld& world, double length) {
  std::vector<TileAddress> all;
  for (int level = 0; level < world.levels(); ++level) {
    const double side = world.extent() / static_cast<double>(std::int64_t{1} << level);
    const double reach = std::min(0.5 * side, 700.0);
    const TileRange near = tiles_in(world, level, {-reach, -reach, length + reach, reach});
    for (std::int64_t y = near.south; y <= near.north; ++y) {
      for (std::int64_t x = near.west; x <= near.east; ++x) all.push_back({level, x, y});
    }
  }
  return all;
}

/// The tilesets above the middle of a world that no request has asked for before, and the tiles around it.
void bench_first_picture() {
  std::vector<double> seconds;
  for (unsigned seed = 21; seed <= 25; ++seed) {
    const OpenWorld world = opened(full, seed);
    const std::vector<TileAddress> all = along(world, 0);
    seconds.push_back(once([&] {
      for (int level = 0; level < world.levels(); level += world_tileset_levels) {
        const std::int64_t middle = level == 0 ? 0 : std::int64_t{1} << (level - 1);
        if (!world_tileset(world, {level, middle, middle}, "", one_thread())) std::abort();
      }
      for (const TileAddress& each : all) tile(world, each);
    }));
  }
  percentile("first picture of a replica", seconds, 0.5);
}

void bench_samples() {
  WorldParams params;
  params.relief.mountains = 1600;
  params.relief.gullies = 0.8;
  const Result<world::World> land = world::read_world(params, 7);
  if (!land) std::abort();
  constexpr int side = 400;
  constexpr double spacing = 7;
  double sum = 0;
  const double seconds = once([&] {
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        const double east = spacing * x, north = spacing * y;
        sum += world::detail_at(*land, world::land_at(*land, east, north), east, north);
      }
    }
  });
  if (sum == 0) std::abort();  // the sum keeps the work from being removed
  bench::report("samples of noise with gullies", "samples", side * side, seconds);
}

/// What a camera asks for that flies for 4 km: of each level, the tiles that come near.
void bench_flight() {
  const OpenWorld world = opened(full, 7);
  const std::vector<TileAddress> all = along(world, 4000);
  for (const TileAddress& each : all) tile(world, each);
  bench::report("tiles of a flight", "tiles", static_cast<double>(all.size()), once([&] {
                  for (const TileAddress& each : all) tile(world, each);
                }));
}

/// Every file is of another place, so that its 85 boxes are not in the memory.
void bench_tilesets() {
  const OpenWorld world = opened(full, 7);
  tile(world, {14, 8192, 8192});
  for (const int level : {4, 8, 12}) {
    std::vector<double> seconds;
    for (const TileAddress& each : around(level, level == 4 ? 6 : 10)) {
      seconds.push_back(once([&] {
        if (!world_tileset(world, each, "../../../", one_thread())) std::abort();
      }));
    }
    const std::string name = "nested tileset of level " + std::to_string(level);
    percentile(name + ", p50", seconds, 0.5);
    percentile(name + ", p99", seconds, 0.99);
  }
}

}  // namespace

int main() {
  bench_tiles("tile of ground and water", opened(bare, 7), around(12, 8));
  bench_tiles("leaf with plants and houses", opened(full, 7), around(14, 20));
  bench_cold();
  bench_first_picture();
  bench_flight();
  bench_tilesets();
  bench_samples();
}
