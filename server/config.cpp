#include "server/config.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

namespace seedmesh {
namespace {

using Json = nlohmann::ordered_json;

/// A row of the table. `set` gives "" or what is wrong with the text.
struct Setting {
  std::string name;
  std::string text;
  std::function<std::string(Config&, std::string_view)> set;
  std::function<Json(const Config&)> get;
  bool is_switch = false;
};

template <class Number>
std::optional<Number> number(std::string_view text) {
  Number value{};
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

template <class Value>
Value& at(Config& config, Value Config::*member) {
  return config.*member;
}
template <class Value>
Value& at(Config& config, Value Limits::*member) {
  return config.limits.*member;
}

template <class Owner, class Value>
std::function<Json(const Config&)> getter(Value Owner::*member) {
  return [=](Config config) { return Json(at(config, member)); };
}

template <class Owner, class Value>
Setting count(std::string name, std::string text, Value Owner::*member, std::uint64_t low,
              std::uint64_t high) {
  const auto set = [=](Config& config, std::string_view given) -> std::string {
    const auto value = number<std::uint64_t>(given);
    if (!value || *value < low || *value > high) {
      return "must be a whole number from " + std::to_string(low) + " to " + std::to_string(high);
    }
    at(config, member) = static_cast<Value>(*value);
    return {};
  };
  return {std::move(name), std::move(text), set, getter(member)};
}

Setting real(std::string name, std::string text, double Config::*member, double low, double high) {
  const auto set = [=](Config& config, std::string_view given) -> std::string {
    const auto value = number<double>(given);
    if (!value || !(*value >= low && *value <= high)) {
      return "must be a number from " + Json(low).dump() + " to " + Json(high).dump();
    }
    at(config, member) = *value;
    return {};
  };
  return {std::move(name), std::move(text), set, getter(member)};
}

/// A number of bytes, also as "512KiB", "64MiB", "2GiB".
template <class Owner>
Setting bytes(std::string name, std::string text, std::uint64_t Owner::*member, std::uint64_t low) {
  const std::uint64_t high = std::uint64_t{1} << 40U;
  const auto set = [=](Config& config, std::string_view given) -> std::string {
    unsigned shift = 0;
    for (const auto& [suffix, bits] : {std::pair{"KiB", 10U}, std::pair{"MiB", 20U}, std::pair{"GiB", 30U}}) {
      if (given.size() > 3 && given.substr(given.size() - 3) == suffix) {
        shift = bits;
        given.remove_suffix(3);
        break;
      }
    }
    const auto value = number<std::uint64_t>(given);
    if (!value || *value > (high >> shift) || (*value << shift) < low) {
      return "must be bytes from " + std::to_string(low) + " to 1024GiB, such as 64MiB";
    }
    at(config, member) = *value << shift;
    return {};
  };
  return {std::move(name), std::move(text), set, getter(member)};
}

std::string set_host(Config& config, std::string_view given) {
  const auto sound = [](char c) { return c > 0x20 && c < 0x7F && c != '/'; };
  if (given.empty() || !std::all_of(given.begin(), given.end(), sound))
    return "must be an address or a host name";
  config.host = given;
  return {};
}

Setting file(std::string name, std::string text, std::string Config::*member) {
  const auto set = [=](Config& config, std::string_view given) -> std::string {
    config.*member = given;
    return {};
  };
  return {std::move(name), std::move(text), set, getter(member)};
}

/// A list or an address with a reader of its own in keys.h; secrets may stand in a file
/// ("@/run/secrets/keys").
template <class Value, class Read>
Setting text(std::string name, std::string help, Value Config::*member, Read read,
             std::function<Json(const Config&)> get) {
  const auto set = [=](Config& config, std::string_view given) -> std::string {
    std::string whole;
    if (!read_indirect(given, whole)) return "names a file that cannot be read";
    return read(whole, config.*member);
  };
  return {std::move(name), std::move(help), set, std::move(get)};
}

/// Names of what is kept secret.
template <class Item>
std::function<Json(const Config&)> hidden(std::vector<Item> Config::*member, std::string Item::*name) {
  return [=](const Config& config) {
    Json names = Json::array();
    for (const Item& item : config.*member) names.push_back(item.*name + ":(hidden)");
    return names;
  };
}

Setting yes_or_no(std::string name, std::string help, bool Config::*member) {
  const auto set = [=](Config& config, std::string_view given) -> std::string {
    if (given != "true" && given != "false") return "must be true or false";
    config.*member = given == "true";
    return {};
  };
  return {std::move(name), std::move(help), set, getter(member), true};
}

std::string set_log_level(Config& config, std::string_view given) {
  for (std::string_view level : {"debug", "info", "warn", "error", "off"}) {
    if (given == level) {
      config.log_level = given;
      return {};
    }
  }
  return "must be debug, info, warn, error or off";
}

const std::vector<Setting>& table() {
  static const std::vector<Setting> rows = {
      {"host", "Address to listen on.", set_host, [](const Config& c) { return Json(c.host); }},
      count("port", "Port to listen on; 0 takes any that is free.", &Config::port, 0, 65'535),
      count("threads", "Generations at once; also the most threads of one.", &Config::threads, 1, 1'024),
      count("queue", "Requests that may wait for a worker; one more is answered 429.", &Config::queue, 0,
            100'000),
      count("connections", "Connections at once; one more is answered 503.", &Config::connections, 1,
            100'000),
      real("time-limit", "Seconds for one request, waiting included.", &Config::time_limit, 0.01, 86'400),
      real("head-timeout", "Seconds for a request's head to arrive.", &Config::head_timeout, 1, 3'600),
      real("body-timeout", "Seconds for a request's body to arrive.", &Config::body_timeout, 1, 3'600),
      real("idle-timeout", "Seconds that a connection may stay unused.", &Config::idle_timeout, 1, 3'600),
      real("write-timeout", "Seconds that a client may leave an answer unread.", &Config::write_timeout, 1,
           3'600),
      real("drain-delay", "Seconds from SIGTERM, with /readyz at 503, to the end of listening.",
           &Config::drain_delay, 0, 3'600),
      bytes("body-limit", "Largest request body.", &Config::body_limit, 1'024),
      bytes("body-memory", "Memory for the bodies of all requests together; one more is answered 503.",
            &Config::body_memory, 1'024),
      bytes("cache-bytes", "Memory for finished models; 0 keeps none.", &Config::cache_bytes, 0),
      bytes("texture-bytes", "Memory for made textures; 0 keeps none.", &Config::texture_bytes, 0),
      {"log-level", "debug, info, warn, error or off.", set_log_level,
       [](const Config& c) { return Json(c.log_level); }},
      text("api-keys", "Keys of clients, name:SHA-256[:rate[:concurrency]], ...; @file reads them from one.",
           &Config::api_keys, read_api_keys, hidden(&Config::api_keys, &ApiKey::name)),
      real("key-rate", "Requests a second of one API key; 0 is any number.", &Config::key_rate, 0, 1e6),
      count("key-concurrency", "Requests at once of one API key; 0 is any number.", &Config::key_concurrency,
            0, 100'000),
      text("signing-keys", "Keys that sign URLs, id:hex, ...; the first signs, all verify; @file as above.",
           &Config::signing_keys, read_signing_keys, hidden(&Config::signing_keys, &SigningKey::id)),
      real("link-lifetime", "Seconds that permalinks hold where URLs are signed; 0 is for ever.",
           &Config::link_lifetime, 0, 1e10),
      yes_or_no("only-presets", "Make presets alone, with any seed and output.", &Config::only_presets),
      text("generators", "Generators that may be asked for; none named is all.", &Config::generators,
           read_generators, getter(&Config::generators)),
      text("cors-origins", "Origins whose pages may read answers, or *.", &Config::cors_origins, read_origins,
           getter(&Config::cors_origins)),
      text("redis-url", "Shared cache: redis://[user:password@]host[:port][/database] or unix:///path.",
           &Config::redis, read_redis_address,
           [](const Config& c) { return Json(c.redis ? shown_address(*c.redis) : ""); }),
      real("redis-timeout", "Seconds for one exchange with the shared cache.", &Config::redis_timeout, 0.001,
           10),
      real("redis-lifetime", "Seconds that the shared cache keeps a model.", &Config::redis_lifetime, 1, 1e9),
      bytes("redis-value", "Largest model that the shared cache is given.", &Config::redis_value, 1'024),
      file("tls-certificate", "Certificate and its chain in PEM: HTTPS is spoken instead of HTTP.",
           &Config::tls_certificate),
      file("tls-key", "The certificate's key in PEM.", &Config::tls_key),
      count("max-modules", "Modules one request may derive.", &Limits::modules, 1, 1'000'000'000'000),
      count("max-shapes", "Shapes one request may derive.", &Limits::shapes, 1, 1'000'000'000'000),
      count("max-triangles", "Triangles one request may make.", &Limits::triangles, 1, 4'000'000'000),
      bytes("max-output", "Bytes of one answer.", &Limits::output_bytes, 1'024),
      bytes("max-memory", "Memory for the work of one request.", &Limits::memory_bytes, 1U << 20U),
      count("max-iterations", "Iterations one request may ask for.", &Limits::iterations, 0, 1'000'000),
      count("max-bracket-depth", "Depth of brackets in a derivation.", &Limits::bracket_depth, 1, 1'000'000),
      count("max-expression-depth", "Depth of an expression.", &Limits::expression_depth, 1, 1'000),
  };
  return rows;
}

const Setting* find_setting(std::string_view name) {
  const auto& rows = table();
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const Setting& row) { return row.name == name; });
  return found == rows.end() ? nullptr : &*found;
}

/// The number of cores that a control group's quota is worth, in version 2 or 1; nothing where there is none.
std::optional<double> quota() {
  std::string most;
  double period = 0;
  if (std::ifstream file("/sys/fs/cgroup/cpu.max"); file >> most >> period) {
    const auto value = number<double>(most);
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
  for (const Setting& row : table()) {
    const Json value = row.get(defaults);
    all.push_back({row.name, row.text,
                   row.name == "threads" ? "cores"
                   : value.is_string()   ? value.get<std::string>()
                   : value.is_array()    ? ""
                                         : value.dump(),
                   row.is_switch});
  }
  return all;
}

/// Sets one value; the fault begins with `source`, and shows the text unless that may be a secret.
static void set_value(ConfigResult& result, const Setting& setting, const std::string& source,
                      const std::string& value) {
  const std::string fault = setting.set(result.config, value);
  if (fault.empty()) return;
  const bool secret =
      setting.name == "api-keys" || setting.name == "signing-keys" || setting.name == "redis-url";
  result.faults.push_back(source + (secret ? ": it " : " is \"" + value + "\": it ") + fault);
}

static void read_environment(ConfigResult& result, const std::vector<std::string>& environment) {
  const std::string prefix = "SEEDMESH_";
  for (const std::string& entry : environment) {
    if (entry.compare(0, prefix.size(), prefix) != 0) continue;
    const auto equals = entry.find('=');
    if (equals == std::string::npos) continue;
    const std::string variable = entry.substr(0, equals);
    const std::string value = entry.substr(equals + 1);
    // Kubernetes gives every pod of a namespace SEEDMESH_PORT=tcp://... when a Service is called seedmesh.
    if (value.compare(0, 6, "tcp://") == 0 || variable == "SEEDMESH_CONFIG") continue;
    std::string name = variable.substr(prefix.size());
    std::transform(name.begin(), name.end(), name.begin(), [](char c) {
      return c == '_' ? '-' : c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    if (const Setting* setting = find_setting(name)) {
      set_value(result, *setting, variable, value);
    } else {
      result.warnings.push_back(variable + " is no setting");
    }
  }
}

/// A value of the file as the text that a flag would have; nothing where it is of no such type.
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
    result.faults.push_back("config: " + name + " cannot be read");
    return;
  }
  Json object;
  try {
    object = Json::parse(text, nullptr, true, true);
  } catch (const Json::parse_error& error) {
    result.faults.push_back("config: " + name + " is no JSON: " + error.what());
    return;
  }
  if (!object.is_object()) {
    result.faults.push_back("config: " + name + " holds no object");
    return;
  }
  for (const auto& [key, value] : object.items()) {
    const Setting* setting = find_setting(key);
    const std::string source = name + ": " + key;
    if (!setting) {
      result.faults.push_back(source + " is no setting");
    } else if (const auto given = flag_text(value)) {
      set_value(result, *setting, source, *given);
    } else {
      result.faults.push_back(source + " must be a text, a number, true, false or a list of texts");
    }
  }
}

static void read_certificate(ConfigResult& result) {
  Config& config = result.config;
  if (config.tls_certificate.empty() && config.tls_key.empty()) return;
  if (config.tls_certificate.empty() || config.tls_key.empty()) {
    result.faults.push_back("tls-certificate and tls-key are needed together");
    return;
  }
  auto read = http::TlsIdentity::read(config.tls_certificate, config.tls_key);
  if (auto* fault = std::get_if<std::string>(&read)) {
    result.faults.push_back("tls: " + *fault);
  } else {
    config.tls = std::get<0>(std::move(read));
  }
}

/// The file that flags or else environment name; "" where none is.
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
      result.faults.push_back("--" + name + " is no setting");
    }
  }
  if (result.config.body_limit > result.config.body_memory) {
    result.faults.push_back("body-limit is larger than body-memory: no such body could ever be taken");
  }
  if (result.config.link_lifetime > 0 && result.config.signing_keys.empty()) {
    result.faults.push_back("link-lifetime is set, but there are no signing-keys: links would hold for ever");
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
  for (const Setting& row : table()) object[row.name] = row.get(config);
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
