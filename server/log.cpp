#include "server/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <nlohmann/json.hpp>

namespace seedmesh {
namespace {

using Json = nlohmann::ordered_json;

spdlog::level::level_enum level_of(Log::Level level) {
  switch (level) {
    case Log::Level::debug:
      return spdlog::level::debug;
    case Log::Level::info:
      return spdlog::level::info;
    case Log::Level::warn:
      return spdlog::level::warn;
    case Log::Level::error:
      return spdlog::level::err;
  }
  return spdlog::level::err;
}

std::string_view name_of(Log::Level level) {
  static constexpr std::string_view names[] = {"debug", "info", "warn", "error"};
  return names[static_cast<std::size_t>(level)];
}

/// "2026-01-31T23:59:59.123Z"
std::string timestamp() {
  using namespace std::chrono;
  const auto now = system_clock::now();
  const std::time_t seconds = system_clock::to_time_t(now);
  std::tm utc{};
  ::gmtime_r(&seconds, &utc);
  char text[40];
  const auto size = std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%S", &utc);
  const auto part = static_cast<int>(duration_cast<milliseconds>(now.time_since_epoch()).count() % 1'000);
  char fraction[8];
  std::snprintf(fraction, sizeof(fraction), ".%03dZ", part);
  return std::string(text, size) + fraction;
}

}  // namespace

Log::Log(const std::string& level)
    : logger_(
          std::make_shared<spdlog::logger>("seedmesh", std::make_shared<spdlog::sinks::stderr_sink_mt>())) {
  logger_->set_pattern("%v");
  logger_->set_level(spdlog::level::from_str(level == "error" ? "err" : level));
}

Log::~Log() = default;

bool Log::writes(Level level) const { return logger_->should_log(level_of(level)); }

void Log::write(Level level, std::string_view message, const Json& fields) const {
  if (!writes(level)) return;
  Json line = {{"time", timestamp()}, {"level", name_of(level)}, {"message", message}};
  line.update(fields);
  const std::string text = line.dump(-1, ' ', false, Json::error_handler_t::replace);
  logger_->log(level_of(level), std::string_view(text));
}

void Log::write(Level level, std::string_view message) const { write(level, message, Json::object()); }

}  // namespace seedmesh
