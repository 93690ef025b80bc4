#pragma once
/// The log: one line of JSON for each event, on standard error.
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace spdlog {
class logger;
}

namespace seedmesh {

class Log {
 public:
  enum class Level { debug, info, warn, error };

  explicit Log(const std::string& level);
  ~Log();

  bool writes(Level level) const;
  /// Writes time, level, message and `fields`.
  void write(Level level, std::string_view message, const nlohmann::ordered_json& fields) const;
  void write(Level level, std::string_view message) const;

 private:
  std::shared_ptr<spdlog::logger> logger_;
};

}  // namespace seedmesh
