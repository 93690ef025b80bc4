#include "server/settings.h"

#include <algorithm>

#include "server/http/text.h"

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
    const auto value = http::parse_number<std::uint64_t>(given);
    if (!value || *value < low || *value > high) {
      return "must be a whole number from " + std::to_string(low) + " to " + std::to_string(high);
    }
    at(config, member) = static_cast<Value>(*value);
    return {};
  };
  return {std::move(name), std::move(text), set, getter(member), false, "NUMBER"};
}

Setting real(std::string name, std::string text, double Config::*member, double low, double high,
             std::string unit = "SECONDS") {
  const auto set = [=](Config& config, std::string_view given) -> std::string {
    const auto value = http::parse_number<double>(given);
    if (!value || !(*value >= low && *value <= high)) {
      return "must be a number from " + Json(low).dump() + " to " + Json(high).dump();
    }
    at(config, member) = *value;
    return {};
  };
  return {std::move(name), std::move(text), set, getter(member), false, std::move(unit)};
}

/// A number of bytes, such as "65536", "512KiB", "64MiB" or "2GiB".
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
    const auto value = http::parse_number<std::uint64_t>(given);
    if (!value || *value > (high >> shift) || (*value << shift) < low) {
      return "must be a number of bytes from " + std::to_string(low) + " to 1024GiB, such as 64MiB";
    }
    at(config, member) = *value << shift;
    return {};
  };
  return {std::move(name), std::move(text), set, getter(member), false, "BYTES"};
}

std::string set_host(Config& config, std::string_view given) {
  const auto valid = [](char c) { return c > 0x20 && c < 0x7F && c != '/'; };
  if (given.empty() || !std::all_of(given.begin(), given.end(), valid))
    return "must be an address or a host name";
  config.host = given;
  return {};
}

Setting file(std::string name, std::string text, std::string Config::*member) {
  const auto set = [=](Config& config, std::string_view given) -> std::string {
    config.*member = given;
    return {};
  };
  return {std::move(name), std::move(text), set, getter(member), false, "FILE"};
}

/// A list or an address with a parser of its own. The text may be in a file: "@/run/secrets/keys".
template <class Value, class Read>
Setting text(std::string name, std::string help, Value Config::*member, Read read,
             std::function<Json(const Config&)> get) {
  const auto set = [=](Config& config, std::string_view given) -> std::string {
    std::string whole;
    if (!read_indirect(given, whole)) return "refers to a file that cannot be read";
    return read(whole, config.*member);
  };
  return {std::move(name), std::move(help), set, std::move(get)};
}

/// The names of a list of secrets, for --print-config.
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
      {"host", "Address at which the service listens.", set_host,
       [](const Config& c) { return Json(c.host); }},
      count("port", "Port at which the service listens; 0 selects any free port.", &Config::port, 0, 65'535),
      count("threads", "Largest number of concurrent generations, and of threads of one generation.",
            &Config::threads, 1, 1'024),
      count("queue", "Requests that may wait for a worker; a further request receives 429.", &Config::queue,
            0, 100'000),
      count("connections", "Open connections; a further connection receives 503.", &Config::connections, 1,
            100'000),
      real("time-limit", "Seconds for one request, including the time in the queue.", &Config::time_limit,
           0.01, 86'400),
      real("head-timeout", "Seconds in which the head of a request has to arrive.", &Config::head_timeout, 1,
           3'600),
      real("body-timeout", "Seconds in which the body of a request has to arrive.", &Config::body_timeout, 1,
           3'600),
      real("idle-timeout", "Seconds that a connection may be idle.", &Config::idle_timeout, 1, 3'600),
      real("write-timeout",
           "Seconds in which a client has to read the next 64 KiB of a response, or all that remains.",
           &Config::write_timeout, 1, 3'600),
      real("min-rate", "Bytes per second that a client has to read of a large response; 0 means no limit.",
           &Config::min_rate, 0, 1e9, "NUMBER"),
      real("min-rate-grace", "Seconds that a response may wait for its client before min-rate applies.",
           &Config::min_rate_grace, 0, 3'600),
      real("drain-delay", "Seconds between SIGTERM and the end of listening; /readyz returns 503 in between.",
           &Config::drain_delay, 0, 3'600),
      bytes("body-limit", "Bytes of the largest request body.", &Config::body_limit, 1'024),
      bytes("body-memory", "Bytes of all request bodies together; a further body receives 503.",
            &Config::body_memory, 1'024),
      bytes("memory-in-flight",
            "Bytes of responses that are being sent; a further request waits up to 2 seconds, then receives "
            "503.",
            &Config::memory_in_flight, 1U << 20U),
      bytes("compress-from", "Bytes of the smallest model that is compressed.", &Config::compress_from, 0),
      yes_or_no("plain-for-private", "Send models uncompressed to loopback and private addresses.",
                &Config::plain_for_private),
      bytes("cache-bytes", "Bytes of finished models in memory; 0 keeps none.", &Config::cache_bytes, 0),
      bytes("texture-bytes", "Bytes of textures in memory; 0 keeps none.", &Config::texture_bytes, 0),
      bytes("world-bytes", "Bytes of memory for data that tiles of worlds share.", &Config::world_bytes, 0),
      {"log-level", "Log level: debug, info, warn, error or off.", set_log_level,
       [](const Config& c) { return Json(c.log_level); }},
      text("api-keys", "API keys as name:SHA-256[:rate[:concurrency]], ...; @path reads them from a file.",
           &Config::api_keys, read_api_keys, hidden(&Config::api_keys, &ApiKey::name)),
      real("key-rate", "Requests per second of one API key; 0 means no limit.", &Config::key_rate, 0, 1e6,
           "NUMBER"),
      count("key-concurrency", "Concurrent requests of one API key; 0 means no limit.",
            &Config::key_concurrency, 0, 100'000),
      text("signing-keys",
           "Keys for signed URLs as id:hex, ...; the first signs, all verify; @path reads a file.",
           &Config::signing_keys, read_signing_keys, hidden(&Config::signing_keys, &SigningKey::id)),
      real("link-lifetime", "Seconds that signed permalinks are valid; 0 means no end.",
           &Config::link_lifetime, 0, 1e10),
      yes_or_no("only-presets", "Make only presets, with any seed and output.", &Config::only_presets),
      text("generators", "Allowed generators; an empty list allows all.", &Config::generators,
           read_generators, getter(&Config::generators)),
      text("cors-origins", "Origins whose pages may read responses, or *.", &Config::cors_origins,
           read_origins, getter(&Config::cors_origins)),
      text("redis-url", "Shared cache: redis://[user:password@]host[:port][/database] or unix:///path.",
           &Config::redis, read_redis_address,
           [](const Config& c) { return Json(c.redis ? shown_address(*c.redis) : ""); }),
      real("redis-timeout", "Seconds for one command to the shared cache.", &Config::redis_timeout, 0.001,
           10),
      real("redis-lifetime", "Seconds that the shared cache keeps a model.", &Config::redis_lifetime, 1, 1e9),
      bytes("redis-value", "Bytes of the largest model in the shared cache.", &Config::redis_value, 1'024),
      file("tls-certificate", "PEM file with the certificate and its chain; enables HTTPS.",
           &Config::tls_certificate),
      file("tls-key", "PEM file with the private key of the certificate.", &Config::tls_key),
      count("max-modules", "Modules that one request may derive.", &Limits::modules, 1, 1'000'000'000'000),
      count("max-shapes", "Shapes that one request may derive.", &Limits::shapes, 1, 1'000'000'000'000),
      count("max-triangles", "Triangles that one request may make.", &Limits::triangles, 1, 4'000'000'000),
      bytes("max-output", "Bytes of one response.", &Limits::output_bytes, 1'024),
      bytes("max-memory", "Bytes of memory for the work of one request.", &Limits::memory_bytes, 1U << 20U),
      count("max-iterations", "Iterations that one request may have.", &Limits::iterations, 0, 1'000'000),
      count("max-bracket-depth", "Largest depth of brackets in a derivation.", &Limits::bracket_depth, 1,
            1'000'000),
      count("max-expression-depth", "Largest depth of an expression.", &Limits::expression_depth, 1, 1'000),
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
