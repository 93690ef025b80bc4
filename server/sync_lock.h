#pragma once
/// The lock file of `seedmesh sync`. `seedmesh.lock` has the hash of each request file, and the engine, size,
/// ETag and hash of each file made from it. The Python client reads and writes the same file, byte for byte.
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace seedmesh {

inline constexpr char lock_file_name[] = "seedmesh.lock";

struct LockedOutput {
  std::uint64_t bytes = 0;
  std::string engine;
  std::string etag;    ///< ETag of the response of the server; "" where it had none
  std::string sha256;  ///< hexadecimal
};

struct LockEntry {
  std::string request;  ///< hexadecimal SHA-256 of the request file; "" if an output is missing
  std::map<std::string, LockedOutput> outputs;  ///< outputs, by the name of the file, without a folder
};

/// Entries by the path of the request file, relative to the directory, with slashes.
using Lock = std::map<std::string, LockEntry>;

/// Returns nothing where the text is not that of a lock file.
std::optional<Lock> read_lock(const std::string& text);

/// Returns the text of a lock file, with one line for each request file, so that a version control system can
/// merge it.
std::string lock_text(const Lock& lock);

}  // namespace seedmesh
