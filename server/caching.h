#pragma once
/// How caches may use the responses of models and tiles.
#include <string>

#include "server/service.h"

namespace seedmesh {

/// As immutable, or after revalidation.
enum class Caching { immutable, revalidate };

/// The Cache-Control field. A response to an API key is private, because caches do not check keys.
std::string cache_control(const Call& call, Caching caching);

/// The Vary field; with the credentials on a closed service.
std::string varies(const Call& call, const char* fields);

}  // namespace seedmesh
