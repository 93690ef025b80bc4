#include "server/settings.h"

#include <algorithm>
#include <cmath>

namespace seedmesh {
namespace {

using Json = nlohmann::ordered_json;

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

}  // namespace

const std::vector<Setting>& setting_rows() {
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
  const auto& rows = setting_rows();
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const Setting& row) { return row.name == name; });
  return found == rows.end() ? nullptr : &*found;
}

}  // namespace seedmesh
