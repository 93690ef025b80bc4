#pragma once
/// The files of a streamed world: a request of the generator "world" in, OGC 3D Tiles 1.1 out. Each file is a function
/// of the request and its own address. All functions may run on any number of threads at the same time.
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "core/pipeline.h"

namespace seedmesh {

/// A cache of values that tiles share (regions, sites, roads), bounded in bytes. It affects the time and never
/// the result.
class WorldMemory;
std::shared_ptr<WorldMemory> make_world_memory(std::uint64_t bytes);

/// A tile of the quadtree. Level 0 is the whole extent; x runs east and y north, from 0 to 2^level - 1.
struct TileAddress {
  int level = 0;
  std::int64_t x = 0, y = 0;
};

/// A world that is ready to make tiles. Immutable; copies share it.
class OpenWorld {
 public:
  struct Body;
  explicit OpenWorld(std::shared_ptr<const Body> body) : body_(std::move(body)) {}
  const Body& body() const { return *body_; }
  int levels() const;     ///< levels of the tree; the last has the leaves
  double extent() const;  ///< side of the world in metres

 private:
  std::shared_ptr<const Body> body_;
};

/// Whether a request describes a world.
bool is_world(const Request& request);

/// Opens the world of a request. Code::invalid with pointer "/generator" for a request of another generator.
Result<OpenWorld> open_world(const Request& request, std::shared_ptr<WorldMemory> memory);

/// Refuses the options of a request's output that tiles do not have. These are all but the name and the provenance.
std::optional<Error> output_error_of_tiles(const Request& request);

/// Levels of an explicit tileset and of a subtree.
constexpr int world_tileset_levels = 4, world_subtree_levels = 5;

// The functions below take addresses inside the tree. `prefix` leads from the address of the file to the folder that
// has the folders c, e, s and a; it is empty or ends with "/".

/// A box of the plane in metres from the middle of the world: x = east, y = north.
struct WorldBox {
  double west = 0, south = 0, east = 0, north = 0;
};
constexpr double longest_world_box = 65'536;  ///< metres along a side of the box of a map

/// Some levels of a world inside a box.
struct WorldPart {
  int first = 0, last = 0;  ///< levels, both included
  WorldBox box = {};
};

/// The columns (x) and rows (y) of a level whose squares have an area in common with a box, both ends included.
struct TileRange {
  std::int64_t west = 0, south = 0, east = 0, north = 0;
};
TileRange tiles_in(const OpenWorld& world, int level, const WorldBox& box);

/// Returns the explicit tileset of four levels below a tile whose level is a multiple of four. With `part`,
/// it contains only the tiles inside the part, and those above them, which have no content.
Result<std::string> world_tileset(const OpenWorld& world, const TileAddress& root, std::string_view prefix,
                                  const Job::Options& options, const WorldPart* part = nullptr);
/// Returns the implicit tileset of the whole world.
Result<std::string> world_implicit(const OpenWorld& world, std::string_view prefix,
                                   const Job::Options& options);
/// Returns the binary subtree of five levels below a tile whose level is a multiple of five.
Result<std::string> world_subtree(const OpenWorld& world, const TileAddress& root,
                                  const Job::Options& options);
/// Returns the content of a tile as binary glTF.
Result<std::string> world_tile(const OpenWorld& world, const TileAddress& address,
                               const Job::Options& options);

/// A file that tiles share, by its name in the folder a ("<hash>.bin"); nothing for an unknown name.
struct WorldFile {
  std::string bytes, media_type;
};
Result<std::optional<WorldFile>> world_file(const OpenWorld& world, std::string_view name,
                                            const Job::Options& options);

/// Reads "west,south,east,north", in metres. Errors are Code::invalid with pointer "/box": a text that is no
/// box, a side of more than `longest` metres, and a box that leaves the world.
Result<WorldBox> read_world_box(const OpenWorld& world, std::string_view text,
                                double longest = longest_world_box);

/// Whether world_map() adds a grid of heights.
enum class WorldHeights { none, grid };
/// Returns settlements, rivers, lakes, roads and plants of a box as JSON text.
Result<std::string> world_map(const OpenWorld& world, const WorldBox& box, WorldHeights heights,
                              const Job::Options& options);

}  // namespace seedmesh
