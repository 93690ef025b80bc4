#include "server/cors.h"

#include <algorithm>

namespace seedmesh {
namespace {

constexpr const char* sent_by_pages =
    "Accept, Authorization, Content-Type, If-None-Match, If-Range, Range, Traceparent, X-Api-Key, "
    "X-Request-Id";
constexpr const char* read_by_pages =
    "Content-Location, Content-Range, ETag, Retry-After, Seedmesh-Triangles, Seedmesh-Vertices, "
    "Seedmesh-Warnings, Server-Timing, Traceparent, X-Request-Id";
constexpr const char* remembered_for = "86400";

void vary_by_origin(http::Response& response) {
  for (auto& [name, value] : response.headers) {
    if (!http::same_name(name, "Vary")) continue;
    value += ", Origin";
    return;
  }
  response.set("Vary", "Origin");
}

}  // namespace

void allow_origin(const std::vector<std::string>& origins, const http::Request& request,
                  http::Response& response) {
  if (origins.empty()) return;
  const bool any = std::find(origins.begin(), origins.end(), "*") != origins.end();
  if (!any) vary_by_origin(response);
  const std::string origin = request.header("Origin");
  if (origin.empty()) return;
  if (!any && std::find(origins.begin(), origins.end(), origin) == origins.end()) return;
  response.set("Access-Control-Allow-Origin", any ? "*" : origin);
  if (request.method == "OPTIONS" && request.has_header("Access-Control-Request-Method")) {
    const std::string allowed = http::joined(response.headers, "Allow");
    response.set("Access-Control-Allow-Methods", allowed.empty() ? "GET, HEAD, POST, OPTIONS" : allowed);
    response.set("Access-Control-Allow-Headers", sent_by_pages);
    response.set("Access-Control-Max-Age", remembered_for);
    return;
  }
  response.set("Access-Control-Expose-Headers", read_by_pages);
  response.set("Timing-Allow-Origin", any ? "*" : origin);
  response.set("Cross-Origin-Resource-Policy", "cross-origin");
}

}  // namespace seedmesh
