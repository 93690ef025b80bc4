/// Routes that answer with a model: POST /v1/generate, GET /v1/models/{token}.{ext}, GET
/// /v1/presets/{name}[.{ext}].
#include <algorithm>
#include <cstdio>
#include <ctime>

#include "server/compress.h"
#include "server/http/head.h"
#include "server/negotiate.h"
#include "server/permalink.h"
#include "server/routes.h"

namespace seedmesh {
namespace {

constexpr std::size_t longest_location = 2'048;
constexpr std::uint64_t least_compressed = 1'024;
constexpr std::uint64_t most_compressed = 64U << 20U;
constexpr std::uint64_t most_opened =
    1U << 20U;  ///< of a token; its 8,000 characters hold a tenth of it at most
constexpr std::int64_t year = 31'536'000;

std::string milliseconds(std::string_view name, double duration) {
  char text[96];
  std::snprintf(text, sizeof(text), "%.*s;dur=%.3f", static_cast<int>(name.size()), name.data(), duration);
  return text;
}

/// What this answer cost: spans of a model from the cache were paid for by an earlier one.
std::string server_timing(const Call& call, std::string_view cache_use, const Made& made) {
  const bool is_made = cache_use == "miss";
  double total = std::chrono::duration<double, std::milli>(Clock::now() - call.request.arrived).count();
  std::string spans;
  for (const Product::Span& span : made.product.timing) {
    const double spent = is_made ? span.milliseconds : 0;
    spans += ", " + milliseconds(span.name, spent);
    total -= spent;
  }
  if (!is_made) spans += ", cache;desc=\"" + std::string(cache_use) + "\"";
  return milliseconds("parse", std::max(0.0, total)) + spans;
}

/// A coded form of a model. It is kept beside the model itself, so that it is made once.
Cache::Entry compressed(const Call& call, const Known& known, const Cache::Entry& plain, Coding coding) {
  const auto make = [&](const std::stop_token& stop) -> Cache::Outcome {
    auto made = std::make_shared<Made>(*plain);
    const auto work = [&](const Job::Options&) {
      auto payload = std::make_shared<Payload>();
      payload->add(encode(coding, plain->payload->pieces(), Effort::model));
      made->payload = std::move(payload);
    };
    if (auto refused = with_worker(call, stop, work)) return std::move(*refused);
    return Cache::Entry(std::move(made));
  };
  const Cache::Answer answer = call.service.cache.get(
      std::string(name_of(coding)) + " " + known.request.canonical(), call.request.gone, make);
  const Cache::Entry* entry = std::get_if<Cache::Entry>(&answer.outcome);
  return entry ? *entry : nullptr;
}

/// Applies a Range to a whole answer (RFC 9110 section 14), for models only: they are what is worth resuming.
void apply_range(const Call& call, http::Response& response, const std::string& validator) {
  auto& slice = std::get<http::Slice>(response.body);
  response.set("Accept-Ranges", "bytes");
  const std::string condition = call.request.header("If-Range");
  if (call.request.method != "GET" || (!condition.empty() && condition != validator)) return;
  ByteRange range;
  const std::string size = std::to_string(slice.length);
  switch (read_range(call.request.header("Range"), slice.length, range)) {
    case RangeKind::none:
      return;
    case RangeKind::unsatisfiable:
      response = refuse(call, problem(416, "The answer has " + size + " bytes."));
      response.set("Content-Range", "bytes */" + size);
      return;
    case RangeKind::one:
      response.status = 206;
      response.set("Content-Range",
                   "bytes " + std::to_string(range.first) + "-" + std::to_string(range.last) + "/" + size);
      slice.offset = range.first;
      slice.length = range.last - range.first + 1;
  }
}

void describe(http::Response& response, const Made& made) {
  const Statistics& statistics = made.product.statistics;
  response.set("Seedmesh-Triangles", std::to_string(statistics.triangles));
  response.set("Seedmesh-Vertices", std::to_string(statistics.vertices));
  response.set("Seedmesh-Warnings", std::to_string(statistics.warnings));
}

/// The permalink, where it fits in a URL.
void locate(const Call& call, http::Response& response, const std::string& token,
            std::string_view extension) {
  if (token.empty()) return;
  const std::string location = call.service.access.signed_for(call.grant, permalink(token, extension));
  if (!location.empty() && location.size() <= longest_location) response.set("Content-Location", location);
}

/// How long an answer may be kept, and by whom: what was shown to get it is not shown to a cache on the way.
enum class Kept { for_ever, checked };
std::string cache_control(const Call& call, Kept kept) {
  const Grant& grant = call.grant;
  const char* owner = grant.by == Grant::By::key ? "private" : "public";
  if (kept == Kept::checked) return grant.by == Grant::By::key ? "private, no-cache" : "no-cache";
  const std::int64_t left = grant.expires ? *grant.expires - std::time(nullptr) : year;
  return std::string(owner) + ", max-age=" + std::to_string(std::clamp<std::int64_t>(left, 0, year)) +
         ", immutable";
}

/// Vary of models: what was shown to get one is part of it where keys are asked for.
std::string varies(const Call& call, const char* fields) {
  return call.service.access.closed() ? std::string(fields) + ", Authorization, X-Api-Key" : fields;
}

/// A preset has no body: what an override asked for is told of at the override.
void point_at_overrides(const Overrides& overrides, std::vector<Issue>& issues) {
  for (Issue& issue : issues) {
    for (const auto& [key, value] : overrides) {
      std::string place = "/" + key;
      std::replace(place.begin(), place.end(), '.', '/');
      if (key != "seed" && !key.starts_with("output.")) place.insert(0, "/parameters");
      const bool is_inside = issue.pointer.starts_with(place) &&
                             (issue.pointer.size() == place.size() || issue.pointer[place.size()] == '/');
      if (!is_inside) continue;
      issue.pointer = "/" + key;
      break;
    }
  }
}

Problem pointed(const Call& call, Problem problem) {
  if (call.request.method == "POST") return problem;
  if (const std::optional<Overrides> overrides = read_query(call.query()))
    point_at_overrides(*overrides, problem.errors);
  return problem;
}

http::Response model_answer(Call& call, const Known& known, Kept kept) {
  const auto coding = choose_coding(call.request.header("Accept-Encoding"));
  if (!coding) return refuse(call, not_acceptable());
  const bool post = call.request.method == "POST";
  http::Response response;
  response.set("Cache-Control", cache_control(call, kept));
  response.set("Vary", varies(call, post ? "Accept, Accept-Encoding" : "Accept-Encoding"));
  if (!post && matches(call.request.header("If-None-Match"), known.tag)) {
    response.status = 304;
    response.set("ETag", etag(known.tag, *coding));
    locate(call, response, known.token.empty() ? token_of(known.request) : known.token,
           extension_of(known.request.format()));
    return response;
  }

  Cache::Answer answer = model_of(call, known, {});
  if (const auto* refused = std::get_if<Problem>(&answer.outcome))
    return refuse(call, pointed(call, *refused));
  const Cache::Entry entry = std::get<Cache::Entry>(answer.outcome);
  std::shared_ptr<const Payload> payload = entry->payload;
  Coding used = Coding::identity;
  if (*coding != Coding::identity && payload->size() >= least_compressed &&
      payload->size() <= most_compressed) {
    if (const Cache::Entry packed = compressed(call, known, entry, *coding)) {
      payload = packed->payload;
      used = *coding;
    }
  }
  response.cache_use = answer.hit ? "hit" : entry->shared ? "shared" : "miss";
  response.type = entry->product.media_type;
  response.set("ETag", etag(known.tag, used));
  if (used != Coding::identity) response.set("Content-Encoding", std::string(name_of(used)));
  response.set("Server-Timing", server_timing(call, response.cache_use, *entry));
  describe(response, *entry);
  locate(call, response, entry->token, entry->product.extension);
  const std::uint64_t size = payload->size();
  response.body = http::Slice{std::move(payload), 0, size};
  apply_range(call, response, etag(known.tag, used));
  return response;
}

/// "name.glb" -> "name", "glb".
std::pair<std::string, std::string> split_extension(const std::string& name) {
  const auto dot = name.rfind('.');
  if (dot == std::string::npos) return {name, ""};
  return {name.substr(0, dot), name.substr(dot + 1)};
}

bool is_extension(std::string_view text) {
  static constexpr std::string_view all[] = {"glb", "gltf", "zip", "png", "r16", "ply", "json"};
  return std::find(std::begin(all), std::end(all), text) != std::end(all);
}

std::string_view format_of(std::string_view extension) { return extension == "png" ? "png16" : extension; }

/// The request in the form that a URL's extension names.
Result<Request> in_form(const Request& request, std::string_view extension) {
  if (extension == "json" || extension_of(request.format()) == extension) return request;
  return with_format(request, format_of(extension));
}

/// Null where there is no such preset. What a query asks of the output may go with the form of the extension
/// alone.
std::optional<Result<Request>> preset_in_form(const Call& call, const std::string& name, Overrides overrides,
                                              std::string_view extension) {
  auto read = read_preset(name, overrides, call.service.config.limits);
  if (!read || *read || extension.empty() || extension == "json") return read;
  overrides.emplace_back("output.format", format_of(extension));
  return read_preset(name, overrides, call.service.config.limits);
}

http::Response redirect_to_own(const Call& call, const Request& request, const std::string& extension) {
  const std::string own = permalink(write_token(request.canonical(), engine_version()), extension);
  http::Response response;
  response.status = 307;
  response.set("Location", call.service.access.signed_until(call.grant, own));
  response.set("Cache-Control", "no-store");
  response.set("Vary", "Accept-Encoding");
  response.log_text = "token of another engine version";
  return response;
}

}  // namespace

http::Response post_generate(Call& call) {
  auto body = read_body(call);
  if (auto* refusal = std::get_if<http::Response>(&body)) return std::move(*refusal);
  const Known wanted = known(std::get<Request>(std::move(body)));
  // HTTP/1.0 has no body without a known length.
  if (call.request.minor == 1 && wants_events(call.request.header("Accept")))
    return generate_events(call, wanted);
  return model_answer(call, wanted, Kept::checked);
}

http::Response get_model(Call& call) {
  if (!call.query().empty())
    return refuse(call, problem_of({Code::invalid, {{"", "A permalink takes no query."}}}));
  const auto [text, extension] = split_extension(call.name);
  const std::string target(call.target());
  if (auto remembered = call.service.targets.find(target))
    return model_answer(call, *remembered, Kept::for_ever);
  if (!is_extension(extension))
    return refuse(call, problem(404, "A permalink ends with .glb, .gltf, .zip, .png, .r16, .ply or .json."));

  Result<Token> token = read_token(text, std::min(call.service.config.body_limit, most_opened));
  if (!token) return refuse(call, problem_of(token.error()));
  auto read = read_text(call, token->request);
  if (auto* refusal = std::get_if<http::Response>(&read)) return std::move(*refusal);
  const auto request = std::make_optional(std::get<Request>(std::move(read)));
  if (token->engine && *token->engine != engine_version()) return redirect_to_own(call, *request, extension);
  // A token without an engine may mean other bytes tomorrow.
  const Kept kept = token->engine ? Kept::for_ever : Kept::checked;
  if (extension == "json")
    return json_answer(call, request->canonical(), "application/json", cache_control(call, kept));
  Result<Request> formed = in_form(*request, extension);
  if (!formed) return refuse(call, problem_of(formed.error()));
  Known wanted = known(std::move(*formed));
  wanted.token = token_of(wanted.request);
  if (token->engine) call.service.targets.keep(target, wanted);
  return model_answer(call, wanted, kept);
}

http::Response get_preset(Call& call) {
  const auto [name, extension] = split_extension(call.name);
  const std::string target(call.target());
  if (auto remembered = call.service.targets.find(target))
    return model_answer(call, *remembered, Kept::checked);
  if (!extension.empty() && !is_extension(extension))
    return refuse(
        call,
        problem(404, "A preset's name ends with .glb, .gltf, .zip, .png, .r16, .ply or .json, or is alone."));
  const std::optional<Overrides> overrides = read_query(call.query());
  if (!overrides)
    return refuse(call, problem_of({Code::malformed, {{"", "The query has a malformed percent escape."}}}));
  auto read = preset_in_form(call, name, *overrides, extension);
  if (!read) return refuse(call, problem(404, no_preset(name)));
  if (!*read) return refuse(call, problem_of(read->error()));
  if (auto refusal = forbidden(call, **read)) return std::move(*refusal);
  if (extension.empty() || extension == "json") {
    return json_answer(call, overrides->empty() ? *preset_json(name) : (*read)->canonical());
  }
  Result<Request> formed = in_form(**read, extension);
  if (!formed) return refuse(call, pointed(call, problem_of(formed.error())));
  Known wanted = known(std::move(*formed));
  wanted.token = token_of(wanted.request);
  call.service.targets.keep(target, wanted);
  return model_answer(call, wanted, Kept::checked);
}

}  // namespace seedmesh
