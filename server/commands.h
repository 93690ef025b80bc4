#pragma once
/// The program's subcommands that work on files. Each gives the exit status: 0, 1 (refused: the problem as
/// JSON on standard error) or 2 (a file cannot be read or written).
#include <string>

#include "server/config.h"

namespace seedmesh {

/// Both names may be "-" for standard input and output. The extension of `out` chooses the format, as in a
/// URL.
int generate_command(const Config& config, const std::string& in, const std::string& out);
int validate_command(const Config& config, const std::string& in);
int derive_command(const Config& config, const std::string& in);
/// The request that a foreign file becomes, on standard output or in `out`; warnings on standard error.
struct ImportFiles {
  std::string in, out, format, entry;
};
int import_command(const Config& config, const ImportFiles& files);
/// All names, one a line with title; or one preset's request.
/// Prints the target with a signature; 2 where there are no signing keys.
int sign_command(const Config& config, const std::string& target, double valid_for);

/// Prints a new API key, and the lines for the settings `api-keys` and `signing-keys`.
int key_command(const std::string& name);

int presets_command(const std::string& name);

}  // namespace seedmesh
