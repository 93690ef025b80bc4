#pragma once
/// The lock file of `seedmesh sync`: `seedmesh.lock` has, for each request file, its hash, and for each file made
/// from it engine, size, validator and hash. The Python client reads and writes the same file, byte for byte.
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

/// Nothing where the text is not that of a lock file.
std::optional<Lock> read_lock(const std::string& text);

/// Returns one line for each request file, so that branches merge.
std::string lock_text(const Lock& lock);

}  // namespace seedmesh
