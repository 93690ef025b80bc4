#pragma once
/// Everything that can be set. One table (config.cpp) gives each setting its flag, its environment variable,
/// its range and its text; defaults are overridden by a file, that by the environment, and that by flags.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/job.h"
#include "server/http/tls.h"
#include "server/keys.h"
#include "server/redis_address.h"

namespace seedmesh {

struct Config {
  std::string host = "127.0.0.1";
  int port = 8080;
  int threads = 0;  ///< generations at once; load_config replaces 0 by the number of usable cores
  int queue = 64;   ///< requests that may wait for a worker
  int connections = 512;
  double time_limit = 30;     ///< seconds for one request, waiting included
  double head_timeout = 10;   ///< seconds for a request's head to arrive
  double body_timeout = 30;   ///< seconds for its body
  double idle_timeout = 75;   ///< seconds that a connection may stay unused
  double write_timeout = 30;  ///< seconds that a client may not read
  double drain_delay = 0;     ///< seconds between SIGTERM and the end of listening
  std::uint64_t body_limit = 16U << 20U;
  std::uint64_t body_memory = 256U << 20U;
  std::uint64_t cache_bytes = 256U << 20U;
  std::uint64_t texture_bytes = 64U << 20U;
  std::string log_level = "info";
  std::vector<ApiKey> api_keys;
  double key_rate = 0;      ///< requests a second of one API key; 0 = any number
  int key_concurrency = 0;  ///< requests at once of one API key; 0 = any number
  std::vector<SigningKey> signing_keys;
  double link_lifetime = 0;  ///< seconds that permalinks of a signing service hold; 0 = for ever
  bool only_presets = false;
  std::vector<std::string> generators;           ///< that may be asked for; empty = all
  std::vector<std::string> cors_origins;         ///< whose pages may read answers; "*" = all
  std::optional<RedisAddress> redis;             ///< of the shared cache
  double redis_timeout = 0.1;                    ///< seconds for one exchange with it
  double redis_lifetime = 604'800;               ///< seconds that it keeps a model
  std::uint64_t redis_value = 32U << 20U;        ///< largest model that it is given
  std::string tls_certificate, tls_key;          ///< files
  std::shared_ptr<const http::TlsIdentity> tls;  ///< what load_config has read there; null: plain HTTP
  Limits limits;
};

/// One setting as it stands in the help and in --print-config.
struct SettingInfo {
  std::string name;  ///< "time-limit": flag --time-limit, variable SEEDMESH_TIME_LIMIT
  std::string text;
  std::string fallback;    ///< the default as text
  bool is_switch = false;  ///< the flag alone means true
};
std::vector<SettingInfo> settings();

struct ConfigResult {
  Config config;
  std::vector<std::string> faults;    ///< every one of them, in words for the operator
  std::vector<std::string> warnings;  ///< e.g. a SEEDMESH_ variable that is none of ours
};

/// Reads the file that the flag "config" or else SEEDMESH_CONFIG names (an object of JSON, in which comments
/// may stand; keys as the flags), then `environment` ("NAME=value"), then `flags` (name, value).
ConfigResult load_config(const std::vector<std::string>& environment,
                         const std::vector<std::pair<std::string, std::string>>& flags);

/// The process's own environment in that form.
std::vector<std::string> process_environment();

/// The effective configuration as a JSON object, keys as the flags; without secrets.
std::string config_json(const Config& config);

/// Cores that this process may use: of the machine, of its affinity, of its control group's quota.
int usable_cores();

}  // namespace seedmesh
