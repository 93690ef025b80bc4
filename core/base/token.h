#pragma once
/// Permalinks: URLs that contain a whole request. token = base64url(raw deflate(canonical JSON with `engine`)).
/// Any replica can answer one.
#include <cstddef>
#include <string>
#include <string_view>

namespace seedmesh {

constexpr std::size_t longest_token = 8'000;  ///< a longer one does not fit into a URL

/// The token of a canonical request, which is the text of a JSON object. An engine version needs no escapes.
std::string write_token(std::string_view canonical, std::string_view engine);

/// "/v1/models/<token>.<extension>"
std::string permalink(std::string_view token, std::string_view extension);

}  // namespace seedmesh
