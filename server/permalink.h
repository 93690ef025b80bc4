#pragma once
/// Whole requests in a URL: token = base64url(raw deflate(canonical JSON with `engine`)). Any replica can
/// open one.
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace seedmesh {

struct Token {
  std::optional<std::string>
      engine;           ///< the engine version that made it; a token written by hand may have none
  std::string request;  ///< JSON of the request, without `engine`
};

/// `canonical` is an object as text.
std::string write_token(std::string_view canonical, std::string_view engine);

/// Code::malformed where it is not base64url of one deflate stream of a JSON object, or opens to more than
/// `most` bytes.
Result<Token> read_token(std::string_view token, std::size_t most);

/// "/v1/models/<token>.<extension>"
std::string permalink(std::string_view token, std::string_view extension);

}  // namespace seedmesh
