#pragma once
/// The commands that work on files. Each returns the exit status: 0; 1 for a refused request, with the problem as
/// JSON on standard error; 2 for a file that cannot be read or written.
#include <string>
#include <vector>

#include "server/config.h"

namespace seedmesh {

/// Generates the model of the request in the file `in` and writes it to the file `out`. Both names may be "-" for
/// standard input and output. The extension of `out` selects the format, as in a URL.
int generate_command(const Config& config, const std::string& in, const std::string& out);
/// Print the response of POST /v1/validate and of POST /v1/derive for the request in a file.
int validate_command(const Config& config, const std::string& in);
int derive_command(const Config& config, const std::string& in);

struct ImportFiles {
  std::string in, out;
  std::string format, entry;           ///< as in ImportInput
  std::vector<std::string> with = {};  ///< further files beside it
  std::string to = {};  ///< the program for which the request is written; empty: the request itself
};
/// Converts a file of another program to a request and writes it. With `to`, it writes a file of that program
/// instead, and `in` can also be a request. Prints warnings on standard error.
int import_command(const Config& config, const ImportFiles& files);

/// Prints the target with a signature that is valid for `valid_for` seconds; 0: it does not expire. Returns 2
/// without signing keys, for a target that no client can send, and for a time outside 0 to 1e10.
int sign_command(const Config& config, const std::string& target, double valid_for);

/// Prints a new API key, and the lines for the settings `api-keys` and `signing-keys`. Returns 2 for a name that
/// these settings refuse.
int key_command(const std::string& name);

/// Prints all names with titles, or the request of one preset.
int presets_command(const std::string& name);

}  // namespace seedmesh
