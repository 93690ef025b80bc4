#pragma once
/// How caches may use the responses of models and tiles.
#include <string>

#include "server/service.h"

namespace seedmesh {

/// Whether a cache may use a response as it is (`immutable`) or has to revalidate it first.
enum class Caching { immutable, revalidate };

/// Returns the Cache-Control field. A response to an API key is private, because caches do not check keys.
std::string cache_control(const RequestContext& call, Caching caching);

/// Returns the Vary field: `fields`, and also Authorization and X-Api-Key if the service requires a key or a signature.
std::string varies(const RequestContext& call, const char* fields);

}  // namespace seedmesh
