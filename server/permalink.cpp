#include "server/permalink.h"

#include <array>
#include <nlohmann/json.hpp>

#include "server/compress.h"

namespace seedmesh {
namespace {

constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
constexpr int deepest = 64;

std::string base64url(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() * 4 + 2) / 3);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char byte : bytes) {
    bits = (bits << 8U) | static_cast<unsigned char>(byte);
    for (count += 8; count >= 6; count -= 6)
      text.push_back(alphabet[(bits >> static_cast<unsigned>(count - 6)) & 63U]);
  }
  if (count > 0) text.push_back(alphabet[(bits << static_cast<unsigned>(6 - count)) & 63U]);
  return text;
}

/// Strict: no padding, no other characters, and no bits that are left over, so that a token has one spelling.
std::optional<std::string> bytes_of(std::string_view text) {
  static const auto values = [] {
    std::array<signed char, 256> table{};
    table.fill(-1);
    for (std::size_t i = 0; i < alphabet.size(); ++i) {
      table[static_cast<unsigned char>(alphabet[i])] = static_cast<signed char>(i);
    }
    return table;
  }();
  std::string bytes;
  bytes.reserve(text.size() * 3 / 4);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int value = values[static_cast<unsigned char>(c)];
    if (value < 0) return std::nullopt;
    bits = (bits << 6U) | static_cast<std::uint32_t>(value);
    count += 6;
    if (count >= 8) {
      count -= 8;
      bytes.push_back(static_cast<char>((bits >> static_cast<unsigned>(count)) & 255U));
    }
  }
  if (count == 6 || (bits & ((1U << static_cast<unsigned>(count)) - 1U)) != 0) return std::nullopt;
  return bytes;
}

Error malformed(std::string message) { return {Code::malformed, {{"", std::move(message)}}}; }

/// For tokens whose `engine` is not where ours stands: reads the object, takes the member out, writes the
/// rest again.
Result<Token> separate(const std::string& text) {
  bool deep = false;
  const auto watch_depth = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    deep = deep || depth > deepest;
    return !deep;
  };
  nlohmann::json object = nlohmann::json::parse(text, watch_depth, false);
  if (deep || !object.is_object()) return malformed("The token does not hold a JSON object.");
  const auto engine = object.find("engine");
  if (engine == object.end()) return Token{std::nullopt, text};
  if (!engine->is_string()) return malformed("The token's engine is not a string.");
  Token token{engine->get<std::string>(), {}};
  object.erase(engine);
  token.request = object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return token;
}

}  // namespace

std::string write_token(std::string_view canonical, std::string_view engine) {
  assert(canonical.size() >= 2 && canonical.front() == '{');
  std::string text = R"({"engine":)" + nlohmann::json(engine).dump();
  if (canonical[1] != '}') text += ',';
  text += canonical.substr(1);
  return base64url(deflate_raw(text));
}

Result<Token> read_token(std::string_view token, std::size_t most) {
  const std::optional<std::string> packed = bytes_of(token);
  if (!packed || packed->empty()) return malformed("The token is not base64url.");
  const std::optional<std::string> text = inflate_raw(*packed, most);
  if (!text) return malformed("The token does not open.");
  // What write_token wrote can be taken apart as text: an engine version has nothing to escape.
  const std::string_view start = R"({"engine":")";
  if (text->compare(0, start.size(), start) == 0) {
    const auto end = text->find_first_of("\"\\", start.size());
    if (end != std::string::npos && end + 1 < text->size() && text->compare(end, 2, "\",") == 0) {
      return Token{text->substr(start.size(), end - start.size()), "{" + text->substr(end + 2)};
    }
  }
  return separate(*text);
}

std::string permalink(std::string_view token, std::string_view extension) {
  std::string url = "/v1/models/";
  url += token;
  url += '.';
  url += extension;
  return url;
}

}  // namespace seedmesh
