#pragma once
/// Permalinks: URLs that contain a whole request. token = base64url(raw deflate(canonical JSON with `engine`)).
/// Any replica can answer one.
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace seedmesh {

struct Token {
  std::optional<std::string> engine;  ///< the engine version; a token written by hand may have none
  std::string request;                ///< JSON of the request, without `engine`
};

/// The token of a canonical request, which is the text of a JSON object.
std::string write_token(std::string_view canonical, std::string_view engine);

/// Reads a token. Code::malformed where it is not base64url of one deflate stream of a JSON object, or
/// decompresses to more than `limit` bytes.
Result<Token> read_token(std::string_view token, std::size_t limit);

/// "/v1/models/<token>.<extension>"
std::string permalink(std::string_view token, std::string_view extension);

}  // namespace seedmesh
