#include "server/files.h"

#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <system_error>

namespace seedmesh {

std::string system_error_text() { return std::generic_category().message(errno); }

int fail(const std::string& what, const std::string& why) {
  std::fprintf(stderr, "seedmesh: %s: %s\n", what.c_str(), why.c_str());
  return 2;
}

std::optional<std::string> read_file(const std::string& name) {
  std::FILE* file = name == "-" ? stdin : std::fopen(name.c_str(), "rb");
  if (!file) return std::nullopt;
  std::string text;
  char part[64 * 1'024];
  while (const std::size_t count = std::fread(part, 1, sizeof(part), file)) text.append(part, count);
  const bool failed = std::ferror(file) != 0;  // a folder opens, but cannot be read
  const int reason = errno;
  if (file != stdin) std::fclose(file);
  errno = reason;
  if (failed) return std::nullopt;
  return text;
}

bool write_file(const std::string& name, const Payload& payload) {
  std::FILE* file = name == "-" ? stdout : std::fopen(name.c_str(), "wb");
  if (!file) return false;
  bool written = true;
  for (const auto piece : payload.pieces())
    written = written && std::fwrite(piece.data(), 1, piece.size(), file) == piece.size();
  written = std::fflush(file) == 0 && written;
  return (file == stdout || std::fclose(file) == 0) && written;
}

bool write_file_atomically(const std::string& name, const Payload& payload, const char* suffix) {
  namespace fs = std::filesystem;
  const fs::path path = name, partial = name + "." + std::to_string(::getpid()) + suffix;
  std::error_code error;
  if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
  if (write_file(partial.string(), payload)) {
    fs::rename(partial, path, error);
    if (!error) return true;
    errno = error.value();
  }
  const int reason = errno;
  fs::remove(partial, error);
  errno = reason;
  return false;
}

}  // namespace seedmesh
