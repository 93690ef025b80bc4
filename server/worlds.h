#pragma once
/// Worlds by the name in their URLs, so that a token is decoded and checked once for all its tiles.
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <variant>

#include "core/pipeline/world.h"
#include "server/lru.h"
#include "server/problem.h"

namespace seedmesh {

constexpr std::size_t longest_world_token = 2'000;  ///< characters; it is part of the URL of every tile

/// A world that a URL names.
struct NamedWorld {
  /// own: a token of this engine. foreign: of another engine or of none. preset: "<preset>.<seed>".
  enum class Kind { own, foreign, preset };
  Kind kind = Kind::own;
  Request request;
  OpenWorld open;
  std::string token;  ///< token with this engine version; "" where it is too long
};

/// Reads the name of a world. The Problem has status 414 for a token that is too long, and 400 for one that
/// cannot be decoded. It has 404 for an unknown preset, a seed that is no 64-bit number, or a request of
/// another generator. It has 422 for an invalid world.
std::variant<std::shared_ptr<const NamedWorld>, Problem> read_world_name(
    std::string_view name, const Job::Options& options, const std::shared_ptr<WorldMemory>& memory);

/// Returns the token of a world's request; "" where it is too long.
std::string world_token(const Request& request);

/// The worlds that were requested most recently, bounded in bytes, and the memory of their tiles.
class Worlds {
 public:
  explicit Worlds(std::uint64_t memory_bytes) : memory_(make_world_memory(memory_bytes)) {}

  std::shared_ptr<const NamedWorld> find(const std::string& name);
  void insert(const std::string& name, std::shared_ptr<const NamedWorld> world);
  const std::shared_ptr<WorldMemory>& memory() const { return memory_; }

 private:
  static constexpr std::uint64_t capacity = 8U << 20U;
  std::mutex mutex_;
  LruMap<std::shared_ptr<const NamedWorld>> by_name_{capacity};
  const std::shared_ptr<WorldMemory> memory_;
};

/// A file of a world, by the path below its name.
struct WorldPath {
  enum class Kind { tileset, implicit, nested, subtree, tile, shared, map };
  Kind kind = Kind::tileset;
  TileAddress address = {};
  std::string_view name = {};  ///< name of a shared file

  bool is_root() const { return kind == Kind::tileset || kind == Kind::implicit; }
};

/// Reads a path such as "c/3/1/7.glb"; nothing where no world has such a file. Numbers have neither signs nor leading
/// zeros.
std::optional<WorldPath> read_world_path(std::string_view path);

/// Whether a world of this many levels has the file.
bool has_file(const WorldPath& path, int levels);

}  // namespace seedmesh
