#include "server/sync_scan.h"

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>
#include <variant>

#include "server/files.h"
#include "server/http/text.h"
#include "server/signature.h"

namespace seedmesh {
namespace {

namespace fs = std::filesystem;

bool is_utf8(const std::string& text) {
  try {
    return !nlohmann::json(text).dump().empty();
  } catch (const nlohmann::json::exception&) {
    return false;
  }
}

bool is_current(const LockEntry& entry, const std::string& name, const std::string& path, bool is_thorough) {
  const auto made = entry.outputs.find(name);
  if (made == entry.outputs.end()) return false;
  std::error_code error;
  const auto size = fs::file_size(path, error);
  if (error || size != made->second.bytes) return false;
  return !is_thorough || has_digest(path, made->second.sha256);
}

/// Names the request files and the parts below a directory.
void find_files(const std::string& directory, Scan& scan) {
  std::error_code error;
  fs::recursive_directory_iterator each(directory, error);
  for (; !error && each != fs::recursive_directory_iterator(); each.increment(error)) {
    const std::string name = each->path().filename().string();
    std::error_code no_type;
    if (name.front() == '.') {
      if (each->is_directory(no_type)) each.disable_recursion_pending();
    } else if (name.ends_with(part_suffix)) {
      scan.parts.push_back(each->path().string());
    } else if (name.ends_with(request_file_suffix) && each->is_regular_file(no_type)) {
      ScannedFile file;
      file.key = each->path().lexically_relative(directory).generic_string();
      file.path = path_in(directory, file.key);
      scan.files.push_back(std::move(file));
    }
  }
  if (error) scan.failure = directory + ": " + error.message();
  std::ranges::sort(scan.files, {}, &ScannedFile::key);
}

void read_file_of(const std::string& directory, const Lock& lock, bool is_thorough, ScannedFile& file) {
  if (!is_utf8(file.key)) {
    file.errors = {file.path + ":1:1: the name of the file is not UTF-8"};
    return;
  }
  std::optional<std::string> text = read_file(file.path);
  if (!text) {
    file.errors = {file.path + ":1:1: the file cannot be read"};
    return;
  }
  file.digest = http::hex(sha256(*text));
  const auto entry = lock.find(file.key);
  const bool is_known = entry != lock.end() && entry->second.request == file.digest;
  if (is_known) {
    for (const auto& [name, output] : entry->second.outputs) file.outputs.push_back({name});
  } else {
    auto read = read_request_file(file.path, std::move(*text));
    if (auto* errors = std::get_if<ErrorLines>(&read)) {
      file.errors = std::move(*errors);
      return;
    }
    for (RequestFileOutput& output : std::get<RequestFile>(read).outputs)
      file.outputs.push_back({std::move(output.name)});
  }
  for (ScannedOutput& output : file.outputs) {
    const std::string path = path_in(directory, folder_of(file.key) + output.name);
    output.is_current = is_known && is_current(entry->second, output.name, path, is_thorough);
  }
}

}  // namespace

Scan scan_directory(const std::string& directory, const Lock& lock, bool is_thorough, int threads) {
  Scan scan;
  find_files(directory, scan);
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    for (std::size_t i = next++; i < scan.files.size(); i = next++)
      read_file_of(directory, lock, is_thorough, scan.files[i]);
  };
  std::vector<std::thread> others;
  for (int i = 1; i < threads; ++i) others.emplace_back(work);
  work();
  for (std::thread& other : others) other.join();
  return scan;
}

std::string folder_of(const std::string& key) { return key.substr(0, key.find_last_of('/') + 1); }

std::string path_in(const std::string& directory, const std::string& path) {
  return directory.ends_with('/') ? directory + path : directory + "/" + path;
}

bool has_digest(const std::string& path, const std::string& digest) {
  const auto bytes = read_file(path);
  return bytes && http::hex(sha256(*bytes)) == digest;
}

}  // namespace seedmesh
