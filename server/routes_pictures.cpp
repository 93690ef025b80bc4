/// GET /v1/models/{token}.webp and /v1/presets/{name}.webp: pictures of models.
#include "server/caching.h"
#include "server/negotiate.h"
#include "server/routes.h"

namespace seedmesh {
namespace {

/// Refuses what is left of a query.
http::Response refuse_keys(const RequestContext& call, const Overrides& rest) {
  std::vector<Issue> issues;
  for (const auto& [key, value] : rest) {
    issues.push_back({IssueKind::unknown_key, "/" + key.substr(0, 40),
                      "A picture of a permalink has the query keys size, view and ground."});
  }
  return refuse(call, problem_of({Code::invalid, std::move(issues)}));
}

}  // namespace

std::variant<PictureOptions, http::Response> read_options(const RequestContext& call, Overrides& query,
                                                          OtherQueryKeys rest) {
  Result<PictureOptions> picture = read_picture_options(query);
  if (!picture) return refuse(call, problem_of(picture.error()));
  if (rest == OtherQueryKeys::refused && !query.empty()) return refuse_keys(call, query);
  return *picture;
}

http::Response picture_response(RequestContext& call, const Request& request, const PictureOptions& picture,
                                Caching caching) {
  const std::string tag = tag_of(request.canonical() + '\n' + picture.text(), engine_version());
  http::Response response;
  response.set("Cache-Control", cache_control(call, caching));
  response.set("ETag", etag(tag, Coding::identity));
  if (matches(call.request.header("If-None-Match"), tag)) {
    response.status = 304;
    return response;
  }
  if (!wait_for_memory(call)) return refuse(call, too_much_in_flight(call.service));
  const auto asked = Clock::now();
  const Cache::Lookup answer = picture_of(call, request, picture);
  const auto found = Clock::now();
  if (const auto* refused = std::get_if<Problem>(&answer.outcome)) return refuse(call, *refused);
  const Cache::Entry entry = std::get<Cache::Entry>(answer.outcome);
  auto held = call.service.in_flight_memory.hold(entry->payload);
  if (!held) return refuse(call, too_much_in_flight(call.service));
  response.cache_use = answer.hit ? "hit" : "miss";
  response.type = entry->product.media_type;
  response.set("Content-Disposition", "inline; filename=\"" + request.name() + ".webp\"");
  response.set("Server-Timing", server_timing(call, response.cache_use, *entry, asked, found));
  response.set("Seedmesh-Triangles", std::to_string(entry->product.statistics.triangles));
  const std::uint64_t size = held->size();
  response.body = http::Slice{std::move(held), 0, size};
  return response;
}

}  // namespace seedmesh
