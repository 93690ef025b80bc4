/// GET /v1/textures/{name}: a generated texture that models with `output.textures: "links"` name.
#include "server/routes.h"

namespace seedmesh {
namespace {

constexpr std::string_view extension = ".png";
constexpr std::size_t longest_name = 120;
constexpr const char* forever = "public, max-age=31536000, immutable";
constexpr const char* forever_private = "private, max-age=31536000, immutable";

http::Response redirect_to_own(const std::string& name) {
  http::Response response;
  response.status = 307;
  response.set("Location",
               "/v1/textures/" + std::string(engine_version()) + "." + name + std::string(extension));
  response.set("Cache-Control", "no-store");
  response.log_text = "texture of another engine version";
  return response;
}

}  // namespace

http::Response get_texture(RequestContext& call) {
  const auto dot = call.name.find('.');
  if (call.name.size() > longest_name || !call.name.ends_with(extension) || dot == std::string::npos ||
      dot + extension.size() >= call.name.size()) {
    return refuse(call, problem(404, "A texture is named as engine.kind.seed.size.channel.png."));
  }
  const std::string engine = call.name.substr(0, dot);
  const std::string name = call.name.substr(dot + 1, call.name.size() - dot - 1 - extension.size());
  if (engine != engine_version()) return redirect_to_own(name);

  // The name states all that the bytes depend on.
  const std::string tag = '"' + call.name + '"';
  const bool has_key = call.grant.by == Grant::By::key;
  http::Response response;
  response.set("Cache-Control", has_key ? forever_private : forever);
  response.set("ETag", tag);
  if (matches(call.request.header("If-None-Match"), call.name)) {
    response.status = 304;
    return response;
  }
  std::shared_ptr<const Image> image;
  std::optional<Problem> refused;
  const auto work = [&](const Job::Options& options) {
    Result<std::shared_ptr<const Image>> made = make_texture(name, options, &call.service.textures);
    if (made) {
      image = *std::move(made);
    } else {
      refused = made.error().code == Code::invalid ? problem(404, made.error().issues.front().message)
                                                   : problem_of(made.error());
    }
  };
  if (auto busy = with_worker(call, call.request.disconnect_token(), work)) return refuse(call, *busy);
  if (refused) return refuse(call, *refused);
  auto payload = std::make_shared<Payload>();
  payload->add(image, std::as_bytes(std::span(image->bytes)));
  const std::uint64_t size = payload->size();
  response.type = image->mime;
  response.body = http::Slice{std::move(payload), 0, size};
  return response;
}

}  // namespace seedmesh
