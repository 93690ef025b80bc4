#include "server/redis_address.h"

#include <algorithm>

#include "server/http/text.h"

namespace seedmesh {
namespace {

constexpr const char* form = "must be redis://[user:password@]host[:port][/database] or unix:///path";

bool read_number(std::string_view text, int most, int& value) {
  const auto number = http::parse_number<int>(text);
  value = number.value_or(-1);
  return value >= 0 && value <= most;
}

bool take_prefix(std::string_view& text, std::string_view prefix) {
  if (text.substr(0, prefix.size()) != prefix) return false;
  text.remove_prefix(prefix.size());
  return true;
}

bool read_unix(std::string_view rest, RedisAddress& address) {
  const auto question = std::min(rest.find('?'), rest.size());
  address.path = rest.substr(0, question);
  rest.remove_prefix(question);
  if (!rest.empty() && (!take_prefix(rest, "?db=") || !read_number(rest, 1'000'000, address.database)))
    return false;
  return address.path.size() > 1 && address.path.front() == '/';
}

bool read_credentials(std::string_view text, RedisAddress& address) {
  const auto colon = text.find(':');
  if (colon == std::string_view::npos) return false;
  auto user = http::percent_decode(text.substr(0, colon)),
       password = http::percent_decode(text.substr(colon + 1));
  if (!user || !password) return false;
  address.user = std::move(*user);
  address.password = std::move(*password);
  return true;
}

bool read_host(std::string_view text, RedisAddress& address) {
  if (take_prefix(text, "[")) {  // an IPv6 address
    const auto end = text.find(']');
    if (end == std::string_view::npos) return false;
    address.host = text.substr(0, end);
    text.remove_prefix(end + 1);
  } else {
    const auto colon = std::min(text.find(':'), text.size());
    address.host = text.substr(0, colon);
    text.remove_prefix(colon);
  }
  if (!text.empty() && (!take_prefix(text, ":") || !read_number(text, 65'535, address.port))) return false;
  return !address.host.empty() && address.port > 0;
}

}  // namespace

std::string read_redis_address(std::string_view text, std::optional<RedisAddress>& address) {
  address.reset();
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.remove_suffix(1);  // of a file
  if (text.empty()) return {};
  RedisAddress read;
  if (take_prefix(text, "unix://")) {
    if (!read_unix(text, read)) return form;
  } else if (take_prefix(text, "redis://")) {
    if (const auto at = text.rfind('@'); at != std::string_view::npos) {
      if (!read_credentials(text.substr(0, at), read)) return form;
      text.remove_prefix(at + 1);
    }
    const auto slash = std::min(text.find('/'), text.size());
    const std::string_view database = text.substr(std::min(slash + 1, text.size()));
    if (!read_host(text.substr(0, slash), read)) return form;
    if (!database.empty() && !read_number(database, 1'000'000, read.database)) return form;
  } else {
    return form;
  }
  address = std::move(read);
  return {};
}

std::string shown_address(const RedisAddress& address) {
  const std::string database = std::to_string(address.database);
  if (!address.path.empty()) return "unix://" + address.path + "?db=" + database;
  const bool v6 = address.host.find(':') != std::string::npos;
  return "redis://" + (v6 ? "[" + address.host + "]" : address.host) + ":" + std::to_string(address.port) +
         "/" + database;
}

}  // namespace seedmesh
