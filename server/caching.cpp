#include "server/caching.h"

#include <algorithm>
#include <ctime>

namespace seedmesh {

std::string cache_control(const RequestContext& call, Caching caching) {
  constexpr std::int64_t year = 31'536'000;
  const Grant& grant = call.grant;
  const char* owner = grant.by == Grant::By::key ? "private" : "public";
  if (caching == Caching::revalidate) return grant.by == Grant::By::key ? "private, no-cache" : "no-cache";
  const std::int64_t left = grant.expires ? *grant.expires - std::time(nullptr) : year;
  return std::string(owner) + ", max-age=" + std::to_string(std::clamp<std::int64_t>(left, 0, year)) +
         ", immutable";
}

std::string varies(const RequestContext& call, const char* fields) {
  return call.service.access.closed() ? std::string(fields) + ", Authorization, X-Api-Key" : fields;
}

}  // namespace seedmesh
