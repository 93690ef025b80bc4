#include "server/keys.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <optional>

#include "core/pipeline.h"

namespace seedmesh {
namespace {

constexpr std::size_t digest_size = 32;
constexpr std::size_t shortest_secret = 16;

bool is_name(std::string_view text) {
  const auto sound = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' ||
           c == '_' || c == '.';
  };
  return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), sound);
}

/// Cuts `rest` at the next colon and gives the part before it.
std::string_view take(std::string_view& rest) {
  const auto end = std::min(rest.find(':'), rest.size());
  const std::string_view part = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return part;
}

template <class Number>
bool read_number(std::string_view text, Number low, Number high, Number& value) {
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  return fault == std::errc() && end == text.data() + text.size() && value >= low && value <= high;
}

/// "" or the fault of one API key.
std::string read_api_key(std::string_view element, ApiKey& key) {
  if (element.find(':') == std::string_view::npos) return "must be name:SHA-256";  // it may be a key itself
  key.name = take(element);
  if (!is_name(key.name)) return "has a name that is not of letters, digits, - _ and .";
  const auto digest = from_hex(take(element));
  if (!digest || digest->size() != digest_size)
    return "must give the SHA-256 of " + key.name + " in 64 hexadecimal digits";
  key.digest = *digest;
  if (!element.empty() && !read_number(take(element), 0.0, 1e6, key.rate))
    return "must give " + key.name + " a rate from 0 to 1000000 requests a second";
  if (!element.empty() && !read_number(take(element), 0, 100'000, key.concurrency))
    return "must let " + key.name + " have from 0 to 100000 requests at once";
  if (!element.empty()) return "has more than name, SHA-256, rate and concurrency for " + key.name;
  return {};
}

template <class Item>
bool has_twice(const std::vector<Item>& items, std::string Item::*name) {
  std::vector<std::string> names;
  for (const Item& item : items) names.push_back(item.*name);
  std::sort(names.begin(), names.end());
  return std::adjacent_find(names.begin(), names.end()) != names.end();
}

/// scheme://host[:port] and nothing after it, as browsers send it.
bool is_origin(std::string_view text) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (text.substr(0, scheme.size()) != scheme) continue;
    const std::string_view host = text.substr(scheme.size());
    const auto sound = [](char c) {
      return c > 0x20 && c < 0x7F && std::string_view("/?#@*,\"").find(c) == std::string_view::npos;
    };
    return !host.empty() && std::all_of(host.begin(), host.end(), sound);
  }
  return false;
}

}  // namespace

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
    if (std::string fault = read_api_key(element, key); !fault.empty()) return fault;
    keys.push_back(std::move(key));
  }
  return has_twice(keys, &ApiKey::name) ? "has two keys of one name" : "";
}

std::string read_signing_keys(std::string_view text, std::vector<SigningKey>& keys) {
  keys.clear();
  for (const std::string& element : list_elements(text)) {
    std::string_view rest = element;
    if (rest.find(':') == std::string_view::npos) return "must be id:hex";  // it may be a secret itself
    SigningKey key;
    key.id = take(rest);
    if (!is_name(key.id)) return "has an id that is not of letters, digits, - _ and .";
    const auto secret = from_hex(rest);
    if (!secret || secret->size() < shortest_secret)
      return "must give key " + key.id + " at least 32 hexadecimal digits";
    key.secret = *secret;
    keys.push_back(std::move(key));
  }
  return has_twice(keys, &SigningKey::id) ? "has two keys of one id" : "";
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
    for (const std::string_view each : known) all += (all.empty() ? "" : ", ") + std::string(each);
    return "names \"" + name + "\", which is no generator; there are " + all;
  }
  return {};
}

}  // namespace seedmesh
