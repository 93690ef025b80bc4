#pragma once
/// Generates the models of many requests in one file: `seedmesh manifest jobs.jsonl -o dir`.
///
/// Each line of the file is a request, or {"name": "oaks/7", "request": {…}}; the default name is the number of
/// the line. The model goes to <dir>/<name>.<extension of the format> through a temporary file, so that each file
/// is complete. The result of each line is a line of <dir>/results.jsonl (results-<index>-of-<count>.jsonl for
/// one part of several). During the run, lines are added as models are done, so that a run that is killed can be
/// resumed. At the end they are in the order of the input, and results of models that are not in the input follow.
/// A second run makes only the models that are missing or whose request has changed.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "server/config.h"

namespace seedmesh {

struct ManifestOptions {
  std::string file;    ///< "-" = standard input
  std::string folder;  ///< created if it does not exist
  std::string part;    ///< "3/8": part 3 of the parts 0 to 7; "": all lines
  bool quiet = false;  ///< no progress
  bool times = false;  ///< add `milliseconds` to each result, so that equal runs have different results
};

/// A line of the file.
struct ManifestJob {
  std::size_t line = 0;  ///< line number, from 1
  std::string name;
  std::string request;  ///< JSON
};

/// A part contains each line n, counted from 1, with (n - 1) % count == index.
struct ManifestPart {
  std::size_t index = 0, count = 1;
};
/// Parses the text of a part. Returns nothing if it is not valid.
std::optional<ManifestPart> read_part(std::string_view text);

/// Parses a manifest; empty lines are skipped. Returns all errors: invalid JSON, an unknown member, a name that
/// leaves the folder or occurs twice. The line of an error is the line of the file.
Result<std::vector<ManifestJob>> read_manifest(std::string_view text);

/// Runs a manifest. Returns the exit status: 0 if all models exist, 1 if some were refused or the run was
/// interrupted, 2 if a file or folder cannot be used.
int manifest_command(const Config& config, const ManifestOptions& options);

}  // namespace seedmesh
