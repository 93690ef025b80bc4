#pragma once
/// Permalinks: URLs that contain a whole request. token = base64url(raw deflate(canonical JSON with `engine`)).
/// Any replica can answer a permalink, because a permalink refers to no stored state.
#include <cstddef>
#include <string>
#include <string_view>

namespace seedmesh {

constexpr std::size_t longest_token = 8'000;  ///< in characters; a longer token gets no permalink

/// Returns the token of a canonical request, which is the text of a JSON object. `engine` must contain no character
/// that JSON escapes.
std::string write_token(std::string_view canonical, std::string_view engine);

/// Returns "/v1/models/<token>.<extension>".
std::string permalink(std::string_view token, std::string_view extension);

}  // namespace seedmesh
