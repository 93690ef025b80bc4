#include "server/config.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "server/http/text.h"
#include "server/settings.h"

namespace seedmesh {
namespace {

using Json = nlohmann::ordered_json;

/// The CPU quota of the control group (version 2 or 1) in cores; nothing where there is no quota.
std::optional<double> quota() {
  std::string most;
  double period = 0;
  if (std::ifstream file("/sys/fs/cgroup/cpu.max"); file >> most >> period) {
    const auto value = http::parse_number<double>(most);
    if (value && period > 0) return *value / period;
  }
  double amount = -1;
  std::ifstream amount_file("/sys/fs/cgroup/cpu/cpu.cfs_quota_us"),
      period_file("/sys/fs/cgroup/cpu/cpu.cfs_period_us");
  if (amount_file >> amount && period_file >> period && amount > 0 && period > 0) return amount / period;
  return std::nullopt;
}

}  // namespace

std::vector<SettingInfo> settings() {
  std::vector<SettingInfo> all;
  const Config defaults;
  for (const Setting& row : setting_rows()) {
    const Json value = row.get(defaults);
    all.push_back({row.name, row.text,
                   row.name == "threads" ? "cores"
                   : value.is_string()   ? value.get<std::string>()
                   : value.is_array()    ? ""
                                         : value.dump(),
                   row.is_switch, row.unit});
  }
  return all;
}

/// Sets one value. An error message begins with `source` and repeats the value unless it may be a secret.
static void set_value(ConfigResult& result, const Setting& setting, const std::string& source,
                      const std::string& value) {
  const std::string error = setting.set(result.config, value);
  if (error.empty()) return;
  const bool secret =
      setting.name == "api-keys" || setting.name == "signing-keys" || setting.name == "redis-url";
  result.errors.push_back(source + (secret ? ": it " : " is \"" + value + "\": it ") + error);
}

static void read_environment(ConfigResult& result, const std::vector<std::string>& environment) {
  const std::string prefix = "SEEDMESH_";
  for (const std::string& entry : environment) {
    if (entry.compare(0, prefix.size(), prefix) != 0) continue;
    const auto equals = entry.find('=');
    if (equals == std::string::npos) continue;
    const std::string variable = entry.substr(0, equals);
    const std::string value = entry.substr(equals + 1);
    // Kubernetes sets SEEDMESH_PORT=tcp://... in every pod of a namespace with a Service named seedmesh.
    if (value.compare(0, 6, "tcp://") == 0 || variable == "SEEDMESH_CONFIG") continue;
    std::string name = variable.substr(prefix.size());
    std::transform(name.begin(), name.end(), name.begin(), [](char c) {
      return c == '_' ? '-' : c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    if (const Setting* setting = find_setting(name)) {
      set_value(result, *setting, variable, value);
    } else {
      result.warnings.push_back(variable + " is not a setting");
    }
  }
}

/// A value of the file as the text of a flag; nothing where its type is not allowed.
static std::optional<std::string> flag_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number() || value.is_boolean()) return value.dump();
  if (!value.is_array()) return std::nullopt;
  std::string list;
  for (const Json& element : value) {
    if (!element.is_string()) return std::nullopt;
    list += element.get<std::string>() + "\n";
  }
  return list;
}

static void read_config_file(ConfigResult& result, const std::string& name) {
  std::ifstream file(name, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  if (!file.good() && !file.eof()) {
    result.errors.push_back("config: " + name + " cannot be read");
    return;
  }
  Json object;
  try {
    object = Json::parse(text, nullptr, true, true);
  } catch (const Json::parse_error& error) {
    result.errors.push_back("config: " + name + " is not valid JSON: " + error.what());
    return;
  }
  if (!object.is_object()) {
    result.errors.push_back("config: " + name + " does not contain an object");
    return;
  }
  for (const auto& [key, value] : object.items()) {
    const Setting* setting = find_setting(key);
    const std::string source = name + ": " + key;
    if (!setting) {
      result.errors.push_back(source + " is not a setting");
    } else if (const auto given = flag_text(value)) {
      set_value(result, *setting, source, *given);
    } else {
      result.errors.push_back(source + " must be a string, a number, true, false or a list of strings");
    }
  }
}

static void read_certificate(ConfigResult& result) {
  Config& config = result.config;
  if (config.tls_certificate.empty() && config.tls_key.empty()) return;
  if (config.tls_certificate.empty() || config.tls_key.empty()) {
    result.errors.push_back("tls-certificate and tls-key are needed together");
    return;
  }
  auto read = http::TlsIdentity::read(config.tls_certificate, config.tls_key);
  if (auto* error = std::get_if<std::string>(&read)) {
    result.errors.push_back("tls: " + *error);
  } else {
    config.tls = std::get<0>(std::move(read));
  }
}

/// The configuration file named by flags or environment; "" where there is none.
static std::string config_file(const std::vector<std::string>& environment,
                               const std::vector<std::pair<std::string, std::string>>& flags) {
  for (const auto& [name, value] : flags) {
    if (name == "config") return value;
  }
  const std::string variable = "SEEDMESH_CONFIG=";
  for (const std::string& entry : environment) {
    if (entry.compare(0, variable.size(), variable) == 0) return entry.substr(variable.size());
  }
  return {};
}

ConfigResult load_config(const std::vector<std::string>& environment,
                         const std::vector<std::pair<std::string, std::string>>& flags) {
  ConfigResult result;
  if (const std::string file = config_file(environment, flags); !file.empty()) read_config_file(result, file);
  read_environment(result, environment);
  for (const auto& [name, value] : flags) {
    if (name == "config") continue;
    if (const Setting* setting = find_setting(name)) {
      set_value(result, *setting, "--" + name, value);
    } else {
      result.errors.push_back("--" + name + " is not a setting");
    }
  }
  if (result.config.body_limit > result.config.body_memory) {
    result.errors.push_back(
        "body-limit is larger than body-memory, so that such a body would always be refused");
  }
  if (result.config.link_lifetime > 0 && result.config.signing_keys.empty()) {
    result.errors.push_back("link-lifetime needs signing-keys, because links are not signed without them");
  }
  read_certificate(result);
  if (result.config.threads == 0) result.config.threads = usable_cores();
  return result;
}

std::vector<std::string> process_environment() {
  std::vector<std::string> all;
  for (char** entry = environ; *entry != nullptr; ++entry) all.emplace_back(*entry);
  return all;
}

std::string config_json(const Config& config) {
  Json object = Json::object();
  for (const Setting& row : setting_rows()) object[row.name] = row.get(config);
  return object.dump(2);
}

int usable_cores() {
  int cores = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  cpu_set_t set;
  if (::sched_getaffinity(0, sizeof(set), &set) == 0) cores = std::min(cores, std::max(1, CPU_COUNT(&set)));
  if (const auto limit = quota()) cores = std::min(cores, std::max(1, static_cast<int>(std::ceil(*limit))));
  return cores;
}

}  // namespace seedmesh
