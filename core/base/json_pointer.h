#pragma once
/// JSON Pointers (RFC 6901), which name the values of a request in errors.
#include <string>
#include <string_view>

namespace seedmesh {

/// Returns one reference token with its leading slash: "a/b" gives "/a~1b".
std::string pointer_token(std::string_view key);

}  // namespace seedmesh
