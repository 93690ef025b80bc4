#include "server/permalink.h"

#include <nlohmann/json.hpp>

#include "core/base/base64url.h"
#include "core/base/deflate.h"

namespace seedmesh {
namespace {

constexpr int deepest = 64;

Error malformed(std::string message) {
  return {Code::malformed, {{IssueKind::syntax, "", std::move(message)}}};
}

/// Reads a token in which `engine` is not the first member: parses the object, removes the member, and writes
/// the rest.
Result<Token> separate(const std::string& text) {
  bool deep = false;
  const auto watch_depth = [&](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    deep = deep || depth > deepest;
    return !deep;
  };
  nlohmann::json object = nlohmann::json::parse(text, watch_depth, false);
  if (deep || !object.is_object()) return malformed("The token does not contain a JSON object.");
  const auto engine = object.find("engine");
  if (engine == object.end()) return Token{std::nullopt, text};
  if (!engine->is_string()) return malformed("The token's engine is not a string.");
  Token token{engine->get<std::string>(), {}};
  object.erase(engine);
  token.request = object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  return token;
}

}  // namespace

Result<Token> read_token(std::string_view token, std::size_t limit) {
  const std::optional<std::string> packed = from_base64url(token);
  if (!packed || packed->empty()) return malformed("The token is not base64url.");
  const std::optional<std::string> text = inflate_raw(*packed, limit);
  if (!text) return malformed("The token cannot be decompressed.");
  // A token from write_token() can be split as text, because an engine version needs no escapes.
  const std::string_view start = R"({"engine":")";
  if (text->compare(0, start.size(), start) == 0) {
    const auto end = text->find_first_of("\"\\", start.size());
    if (end != std::string::npos && end + 1 < text->size() && text->compare(end, 2, "\",") == 0) {
      return Token{text->substr(start.size(), end - start.size()), "{" + text->substr(end + 2)};
    }
  }
  return separate(*text);
}

}  // namespace seedmesh
