#pragma once
/// Finds the request files below a directory, and which of their models agree with a lock file.
#include <string>
#include <vector>

#include "server/request_file.h"
#include "server/sync_lock.h"

namespace seedmesh {

/// The suffix of the names of files that are being written.
inline constexpr char part_suffix[] = ".seedmesh-part";

struct ScannedOutput {
  std::string name;
  bool is_current = false;  ///< made from this request file, and unchanged since
};

struct ScannedFile {
  std::string key;     ///< path relative to the directory, with slashes
  std::string path;    ///< path for messages and for reading
  std::string digest;  ///< hexadecimal SHA-256
  std::vector<ScannedOutput> outputs;
  ErrorLines errors;  ///< reasons why it has no outputs
};

struct Scan {
  std::vector<ScannedFile> files;  ///< sorted by key
  std::vector<std::string> parts;  ///< unfinished files that an interrupted run left
  std::string failure;             ///< reason why the directory cannot be read; "" if it can
};

/// Folders and files whose names begin with a dot are left out. An unchanged request file is not parsed, because the
/// lock has its outputs. Compares the sizes of models with the lock; the bytes too if `is_thorough`.
Scan scan_directory(const std::string& directory, const Lock& lock, bool is_thorough, int threads);

/// The folder of a key, with a slash at its end; "" for the directory itself.
std::string folder_of(const std::string& key);

/// `directory` and a path inside it.
std::string path_in(const std::string& directory, const std::string& path);

/// Whether a file has this hexadecimal SHA-256.
bool has_digest(const std::string& path, const std::string& digest);

}  // namespace seedmesh
