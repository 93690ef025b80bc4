#pragma once
/// The configuration of the program. The table in settings.cpp gives each setting its flag, environment variable,
/// range and description. Flags override the environment, which overrides the file and the defaults.
#include <cstdint>
#include <optional>
#include <string>
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
  int threads = 0;  ///< concurrent generations; load_config replaces 0 by the number of usable cores
  int queue = 64;   ///< requests that may wait for a worker
  int connections = 512;
  double time_limit = 30;      ///< seconds for one request, including the queue
  double head_timeout = 10;    ///< seconds in which a head has to arrive
  double body_timeout = 30;    ///< seconds in which a body has to arrive
  double idle_timeout = 75;    ///< seconds that a connection may be idle
  double write_timeout = 30;   ///< seconds in which a client has to read the next 64 KiB
  double min_rate = 8'192;     ///< bytes per second that a client has to read
  double min_rate_grace = 10;  ///< seconds of waiting for a client before min_rate applies
  double drain_delay = 0;      ///< seconds between SIGTERM and the end of listening
  std::uint64_t body_limit = 16U << 20U;
  std::uint64_t body_memory = 256U << 20U;
  std::uint64_t memory_in_flight = 1U << 30U;  ///< bytes of responses that are being sent
  std::uint64_t compress_from = 1'024;         ///< bytes of the smallest model that is compressed
  bool plain_for_private = false;              ///< no compression for loopback and private addresses
  std::uint64_t cache_bytes = 256U << 20U;
  std::uint64_t texture_bytes = 64U << 20U;
  std::uint64_t world_bytes = 64U << 20U;  ///< bytes of regions, roads and towns that tiles share
  std::string log_level = "info";
  std::vector<ApiKey> api_keys;
  double key_rate = 0;      ///< requests per second of one API key; 0: no limit
  int key_concurrency = 0;  ///< concurrent requests of one API key; 0: no limit
  std::vector<SigningKey> signing_keys;
  double link_lifetime = 0;  ///< seconds that signed permalinks are valid; 0: no end
  bool only_presets = false;
  std::vector<std::string> generators;           ///< the allowed ones; empty: all
  std::vector<std::string> cors_origins;         ///< whose pages may read responses; "*": all
  std::optional<RedisAddress> redis;             ///< the shared cache; nothing: none
  double redis_timeout = 0.1;                    ///< seconds for one command to it
  double redis_lifetime = 604'800;               ///< seconds that it keeps a model
  std::uint64_t redis_value = 32U << 20U;        ///< bytes of the largest model that it stores
  std::string tls_certificate, tls_key;          ///< files
  std::shared_ptr<const http::TlsIdentity> tls;  ///< set by load_config; null: plain HTTP
  Limits limits;
};

/// One setting as the help shows it.
struct SettingInfo {
  std::string name;  ///< "time-limit": flag --time-limit, variable SEEDMESH_TIME_LIMIT
  std::string text;
  std::string fallback;    ///< the default as text
  bool is_switch = false;  ///< the flag without a value means true
  std::string unit;        ///< "SECONDS", "BYTES", "NUMBER", ...
};
/// Returns all settings in the order of the help.
std::vector<SettingInfo> settings();

struct ConfigResult {
  Config config;
  std::vector<std::string> errors;    ///< all errors; the configuration is not usable with one
  std::vector<std::string> warnings;  ///< for example an unknown variable SEEDMESH_...
};

/// Reads the file named by the flag "config" or by SEEDMESH_CONFIG, then `environment` ("NAME=value"), then
/// `flags` (name, value). The file is a JSON object with the names of flags as keys; comments are allowed.
ConfigResult load_config(const std::vector<std::string>& environment,
                         const std::vector<std::pair<std::string, std::string>>& flags);

/// Returns the environment of this process in that form.
std::vector<std::string> process_environment();

/// Returns the effective configuration as a JSON object without secrets; the keys are the names of flags.
std::string config_json(const Config& config);

/// Cores that this process may use: the smallest of the machine, the affinity and the quota of the control group.
int usable_cores();

}  // namespace seedmesh
