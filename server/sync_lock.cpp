#include "server/sync_lock.h"

#include <nlohmann/json.hpp>

namespace seedmesh {
namespace {

using Json = nlohmann::json;

LockedOutput read_output(const Json& value) {
  return {value.at("bytes").get<std::uint64_t>(), value.at("engine").get<std::string>(),
          value.value("etag", ""), value.at("sha256").get<std::string>()};
}

std::string quoted(const std::string& text) {
  return Json(text).dump(-1, ' ', true, Json::error_handler_t::replace);
}

std::string output_text(const LockedOutput& output) {
  const std::string etag = output.etag.empty() ? "" : R"("etag": )" + quoted(output.etag) + ", ";
  return R"({"bytes": )" + std::to_string(output.bytes) + R"(, "engine": )" + quoted(output.engine) + ", " +
         etag + R"("sha256": )" + quoted(output.sha256) + "}";
}

}  // namespace

std::optional<Lock> read_lock(const std::string& text) {
  Lock lock;
  try {
    const Json value = Json::parse(text);
    for (const auto& [key, entry] : value.at("files").items()) {
      LockEntry& read = lock[key];
      read.request = entry.at("request").get<std::string>();
      for (const auto& [name, output] : entry.at("outputs").items()) read.outputs[name] = read_output(output);
    }
  } catch (const Json::exception&) {
    return std::nullopt;
  }
  return lock;
}

std::string lock_text(const Lock& lock) {
  std::string text = "{\n \"files\": {\n";
  bool is_first = true;
  for (const auto& [key, entry] : lock) {
    text += (is_first ? "  " : ",\n  ") + quoted(key) + R"(: {"outputs": {)";
    is_first = false;
    bool is_first_output = true;
    for (const auto& [name, output] : entry.outputs) {
      text += (is_first_output ? "" : ", ") + quoted(name) + ": " + output_text(output);
      is_first_output = false;
    }
    text += R"(}, "request": )" + quoted(entry.request) + "}";
  }
  return text + "\n }\n}\n";
}

}  // namespace seedmesh
