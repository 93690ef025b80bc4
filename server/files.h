#pragma once
/// Files and errors of the commands. Functions that read or write set `errno` on failure.
#include <optional>
#include <string>

#include "core/gltf/payload.h"

namespace seedmesh {

/// Returns what the present value of `errno` means. Any thread may call it, which is not true of std::strerror.
std::string system_error_text();

/// Prints an error of a command on standard error, as "seedmesh: what: why". Returns the exit status, 2.
int fail(const std::string& what, const std::string& why);

/// Returns the contents of a file; of standard input for "-". Nothing where it cannot be read.
std::optional<std::string> read_file(const std::string& name);

/// Writes a file; standard output for "-". False where it cannot be written.
bool write_file(const std::string& name, const Payload& payload);

/// Writes a file under a temporary name, then renames it, so that a file with this name is always complete.
/// Makes missing folders. False where it cannot be written. The temporary name is `name`, the id of the process and
/// `suffix`.
bool write_file_atomically(const std::string& name, const Payload& payload, const char* suffix = ".part");

}  // namespace seedmesh
