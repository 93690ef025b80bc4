#pragma once
/// Request files (docs/pipelines.md): `oak.seedmesh` contains a request as JSON, and optionally `$schema`, `name` and
/// `outputs`. The Python client reads the same files (clients/python/src/seedmesh/request_file.py).
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/base/result.h"

namespace seedmesh {

inline constexpr std::string_view request_file_suffix = ".seedmesh";

/// A file that is made beside the request file.
struct RequestFileOutput {
  std::string name;     ///< name of the file, without a folder
  std::string request;  ///< JSON
};

struct RequestFile {
  std::string path;
  std::string text;
  std::vector<RequestFileOutput> outputs;  ///< at least one
};

/// Errors for a terminal: "assets/oak.seedmesh:2:24: /parameters/axiom: found …", with line and column from 1.
using ErrorLines = std::vector<std::string>;

/// Splits the text of a request file into one request for each output. Refuses text that is not JSON, duplicate keys,
/// and names that would leave the folder or do not have the extension of their format. Whether the requests are
/// valid is not checked.
std::variant<RequestFile, ErrorLines> read_request_file(const std::string& path, std::string text);

/// Returns the errors of one output's request, with positions in the request file.
ErrorLines error_lines(const RequestFile& file, std::string_view output, const std::vector<Issue>& issues);

}  // namespace seedmesh
