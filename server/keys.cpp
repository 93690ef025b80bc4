#include "server/keys.h"

#include <algorithm>
#include <fstream>
#include <iterator>

#include "core/pipeline.h"
#include "server/http/text.h"

namespace seedmesh {
namespace {

constexpr std::size_t digest_size = 32;
constexpr std::size_t shortest_secret = 16;

template <class Number>
bool read_number(std::string_view text, Number low, Number high, Number& value) {
  const auto number = http::parse_number<Number>(text);
  if (number) value = *number;
  return number && value >= low && value <= high;
}

/// Parses one API key. Returns "" or an error message.
std::string read_api_key(std::string_view element, ApiKey& key) {
  if (element.find(':') == std::string_view::npos)
    return "must have the form name:SHA-256";  // the text may be a key
  key.name = http::take_part(element, ':');
  if (!is_key_name(key.name)) return "has a name with characters other than letters, digits, - _ and .";
  const auto digest = from_hex(http::take_part(element, ':'));
  if (!digest || digest->size() != digest_size)
    return "must give the SHA-256 of " + key.name + " in 64 hexadecimal digits";
  key.digest = *digest;
  if (!element.empty() && !read_number(http::take_part(element, ':'), 0.0, 1e6, key.rate))
    return "must give " + key.name + " a rate from 0 to 1000000 requests per second";
  if (!element.empty() && !read_number(http::take_part(element, ':'), 0, 100'000, key.concurrency))
    return "must give " + key.name + " a concurrency from 0 to 100000 requests";
  if (!element.empty()) return "has more parts than name, SHA-256, rate and concurrency for " + key.name;
  return {};
}

template <class Item>
bool has_duplicate(const std::vector<Item>& items, std::string Item::*name) {
  std::vector<std::string> names;
  names.reserve(items.size());
  for (const Item& item : items) names.push_back(item.*name);
  std::sort(names.begin(), names.end());
  return std::adjacent_find(names.begin(), names.end()) != names.end();
}

/// Whether the text is scheme://host[:port] without a path, as browsers send it.
bool is_origin(std::string_view text) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (text.substr(0, scheme.size()) != scheme) continue;
    const std::string_view host = text.substr(scheme.size());
    const auto valid = [](char c) {
      return c > 0x20 && c < 0x7F && std::string_view("/?#@*,\"").find(c) == std::string_view::npos;
    };
    return !host.empty() && std::all_of(host.begin(), host.end(), valid);
  }
  return false;
}

}  // namespace

bool is_key_name(std::string_view text) {
  const auto valid = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' ||
           c == '_' || c == '.';
  };
  return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), valid);
}

std::vector<std::string> list_elements(std::string_view text) {
  std::vector<std::string> elements;
  while (!text.empty()) {
    const auto end = std::min(text.find_first_of(", \t\r\n#"), text.size());
    if (end > 0) elements.emplace_back(text.substr(0, end));
    if (end < text.size() && text[end] == '#') {
      text.remove_prefix(std::min(text.find('\n'), text.size()));
    } else {
      text.remove_prefix(std::min(end + 1, text.size()));
    }
  }
  return elements;
}

bool read_indirect(std::string_view given, std::string& text) {
  text = given;
  if (given.empty() || given.front() != '@') return true;
  std::ifstream file{std::string(given.substr(1)), std::ios::binary};
  text.assign(std::istreambuf_iterator<char>(file), {});
  return file.good() || file.eof();
}

std::string read_api_keys(std::string_view text, std::vector<ApiKey>& keys) {
  keys.clear();
  for (const std::string& element : list_elements(text)) {
    ApiKey key;
    if (std::string error = read_api_key(element, key); !error.empty()) return error;
    keys.push_back(std::move(key));
  }
  return has_duplicate(keys, &ApiKey::name) ? "contains two keys with the same name" : "";
}

std::string read_signing_keys(std::string_view text, std::vector<SigningKey>& keys) {
  keys.clear();
  for (const std::string& element : list_elements(text)) {
    std::string_view rest = element;
    if (rest.find(':') == std::string_view::npos)
      return "must have the form id:hex";  // the text may be a secret
    SigningKey key;
    key.id = http::take_part(rest, ':');
    if (!is_key_name(key.id)) return "has an id with characters other than letters, digits, - _ and .";
    const auto secret = from_hex(rest);
    if (!secret || secret->size() < shortest_secret)
      return "must give key " + key.id + " at least 32 hexadecimal digits";
    key.secret = *secret;
    keys.push_back(std::move(key));
  }
  return has_duplicate(keys, &SigningKey::id) ? "contains two keys with the same id" : "";
}

std::string read_origins(std::string_view text, std::vector<std::string>& origins) {
  origins = list_elements(text);
  for (const std::string& origin : origins) {
    if (origin != "*" && !is_origin(origin)) return "must be * or origins such as https://example.org";
  }
  return {};
}

std::string read_generators(std::string_view text, std::vector<std::string>& generators) {
  generators = list_elements(text);
  const std::vector<std::string_view> known = generator_names();
  for (const std::string& name : generators) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    std::string all;
    for (const std::string_view each : known) {
      if (!all.empty()) all += ", ";
      all += each;
    }
    return "contains \"" + name + "\", which is not a generator; the generators are " + all;
  }
  return {};
}

}  // namespace seedmesh
