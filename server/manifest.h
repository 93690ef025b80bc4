#pragma once
/// Thousands of requests from one file: `seedmesh manifest jobs.jsonl -o dir`.
///
/// A line of the file is a request, or {"name": "oaks/7", "request": {…}}; a line without a name is called
/// after its number. The model of a line goes to <dir>/<name>.<extension of its format>, by way of a
/// temporary file, so that what is there is whole. What became of a line is a line of <dir>/results.jsonl
/// (results-<part>-of-<parts>.jsonl where several share the work). Run again, it makes what is missing and
/// what is no longer what the file says.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "server/config.h"

namespace seedmesh {

struct ManifestOptions {
  std::string file;    ///< "-" = standard input
  std::string folder;  ///< made where it is not there
  std::string part;    ///< "3/8": the lines of part 3 of the parts 0 to 7; "" = all
  bool quiet = false;  ///< no progress
};

/// A line of the file.
struct ManifestJob {
  std::size_t line = 0;  ///< from 1
  std::string name;
  std::string request;  ///< JSON
};

/// Which lines a part takes: those whose number minus one leaves `index` when divided by `count`.
struct ManifestPart {
  std::size_t index = 0, count = 1;
};
std::optional<ManifestPart> read_part(std::string_view text);

/// The lines of a manifest, empty ones left out; all faults at once: no JSON, an unknown member, a name that
/// leads out of the folder or stands twice. A fault's line is that of the file.
Result<std::vector<ManifestJob>> read_manifest(std::string_view text);

/// Runs it. 0 = all is made, 1 = some were refused or it was interrupted, 2 = file or folder cannot be used.
int manifest_command(const Config& config, const ManifestOptions& options);

}  // namespace seedmesh
