#include "server/cors.h"

#include <algorithm>

#include "server/http/text.h"

namespace seedmesh {
namespace {

constexpr const char* allowed_fields =
    "Accept, Authorization, Content-Type, If-None-Match, If-Range, MCP-Protocol-Version, Mcp-Method, "
    "Mcp-Name, Range, Traceparent, X-Api-Key, X-Request-Id";
constexpr const char* exposed_fields =
    "Content-Disposition, Content-Location, Content-Range, ETag, Retry-After, Seedmesh-Triangles, "
    "Seedmesh-Vertices, Seedmesh-Warnings, Server-Timing, Traceparent, X-Request-Id";
constexpr const char* max_age_seconds = "86400";

void vary_by_origin(http::Response& response) {
  for (auto& [name, value] : response.headers) {
    if (!http::equals_ignoring_case(name, "Vary")) continue;
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
  // The answer to all origins does not vary, so that a cache may give one page what another program asked for.
  if (!any && std::find(origins.begin(), origins.end(), origin) == origins.end()) return;
  if (http::field_count(response.headers, "Access-Control-Allow-Origin") == 0)
    response.set("Access-Control-Allow-Origin", any ? "*" : origin);
  if (request.method == "OPTIONS" && request.has_header("Access-Control-Request-Method")) {
    const std::string allowed = http::field_value(response.headers, "Allow");
    response.set("Access-Control-Allow-Methods", allowed.empty() ? "GET, HEAD, POST, OPTIONS" : allowed);
    response.set("Access-Control-Allow-Headers", allowed_fields);
    response.set("Access-Control-Max-Age", max_age_seconds);
    return;
  }
  response.set("Access-Control-Expose-Headers", exposed_fields);
  response.set("Timing-Allow-Origin", any ? "*" : origin);
  response.set("Cross-Origin-Resource-Policy", "cross-origin");
}

}  // namespace seedmesh
