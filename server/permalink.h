#pragma once
/// Reads the tokens of permalinks (core/base/token.h).
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/base/token.h"

namespace seedmesh {

struct Token {
  std::optional<std::string> engine;  ///< the engine version; a token written by hand may have none
  std::string request;                ///< JSON of the request, without `engine`
};

/// Reads a token. Code::malformed where it is not base64url of one deflate stream of a JSON object, or
/// decompresses to more than `limit` bytes.
Result<Token> read_token(std::string_view token, std::size_t limit);

}  // namespace seedmesh
