/// Routes that answer with a model: POST /v1/generate, GET /v1/models/{token}.{ext}, GET
/// /v1/presets/{name}[.{ext}].
#include <algorithm>
#include <cstdio>

#include "core/pipeline/world.h"
#include "server/caching.h"
#include "server/coded_body.h"
#include "server/negotiate.h"
#include "server/permalink.h"
#include "server/routes.h"

namespace seedmesh {
namespace {

constexpr std::size_t longest_location = 2'048;
constexpr std::uint64_t largest_token_text = 1U << 20U;  ///< bytes of a decompressed token
// "token.proctree.json" is the request as a file of this program.
constexpr std::string_view saved_programs[] = {"proctree", "proctree_js"};

std::string milliseconds(std::string_view name, double duration) {
  char text[96];
  std::snprintf(text, sizeof(text), "%.*s;dur=%.3f", static_cast<int>(name.size()), name.data(), duration);
  return text;
}

/// Applies a Range field to a whole response (RFC 9110 section 14). Only models support ranges.
void apply_range(const RequestContext& call, http::Response& response, const std::string& validator) {
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
      response = refuse(call, problem(416, "The whole response has " + size + " bytes."));
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

void describe(http::Response& response, const CachedModel& made) {
  const Statistics& statistics = made.product.statistics;
  response.set("Seedmesh-Triangles", std::to_string(statistics.triangles));
  response.set("Seedmesh-Vertices", std::to_string(statistics.vertices));
  response.set("Seedmesh-Warnings", std::to_string(statistics.warnings));
}

/// Adds the permalink as Content-Location, where it is not too long.
void add_location(const RequestContext& call, http::Response& response, const std::string& token,
                  std::string_view extension) {
  if (token.empty()) return;
  const std::string location = call.service.access.signed_for(call.grant, permalink(token, extension));
  if (!location.empty() && location.size() <= longest_location) response.set("Content-Location", location);
}

/// The name under which `curl -OJ` and browsers save the response.
void name_file(http::Response& response, const Request& request, std::string_view extension) {
  response.set("Content-Disposition",
               "inline; filename=\"" + request.name() + '.' + std::string(extension) + '"');
}

/// Replaces pointers into the parameters by pointers to the keys of the query that set them.
void point_at_overrides(const Overrides& overrides, std::vector<Issue>& issues) {
  for (Issue& issue : issues) {
    for (const auto& [key, value] : overrides) {
      std::string target = "/" + key;
      std::replace(target.begin(), target.end(), '.', '/');
      if (key != "seed" && !key.starts_with("output.")) target.insert(0, "/parameters");
      const bool is_inside = (issue.pointer + "/").starts_with(target + "/");
      if (!is_inside) continue;
      issue.pointer = "/" + key;
      break;
    }
  }
}

Problem pointed(const RequestContext& call, Problem problem) {
  if (call.request.method == "POST") return problem;
  if (const std::optional<Overrides> overrides = read_query(call.query()))
    point_at_overrides(*overrides, problem.errors);
  return problem;
}

http::Response model_answer(RequestContext& call, const TaggedRequest& wanted, Caching caching) {
  const auto coding = choose_coding(call.request.header("Accept-Encoding"));
  if (!coding) return refuse(call, not_acceptable());
  const bool post = call.request.method == "POST";
  http::Response response;
  response.set("Cache-Control", cache_control(call, caching));
  response.set("Vary", varies(call, post ? "Accept, Accept-Encoding" : "Accept-Encoding"));
  if (!post && matches(call.request.header("If-None-Match"), wanted.tag)) {
    response.status = 304;
    response.set("ETag", etag(wanted.tag, *coding));
    add_location(call, response, wanted.token.empty() ? token_of(wanted.request) : wanted.token,
                 format_named(wanted.request.format()).extension);
    return response;
  }

  if (!wait_for_memory(call)) return refuse(call, too_much_in_flight(call.service));
  const auto asked = Clock::now();
  Cache::Lookup answer = model_of(call, wanted, {});
  if (const auto* refused = std::get_if<Problem>(&answer.outcome))
    return refuse(call, pointed(call, *refused));
  const auto found = Clock::now();
  const Cache::Entry entry = std::get<Cache::Entry>(answer.outcome);
  std::optional<CodedBody> coded = coded_body(call, wanted, entry, *coding);
  if (!coded) return refuse(call, too_much_in_flight(call.service));
  response.cache_use = answer.hit ? "hit" : entry->shared ? "shared" : "miss";
  response.type = entry->product.media_type;
  response.set("ETag", etag(wanted.tag, coded->used));
  if (coded->used != Coding::identity) response.set("Content-Encoding", std::string(name_of(coded->used)));
  response.set("Server-Timing", server_timing(call, response.cache_use, *entry, asked, found));
  describe(response, *entry);
  name_file(response, wanted.request, entry->product.extension);
  add_location(call, response, entry->token, entry->product.extension);
  if (auto* stream = std::get_if<http::Stream>(&coded->body)) {
    response.body = std::move(*stream);
  } else {
    response.body = std::get<http::Slice>(std::move(coded->body));
    if (coded->used == Coding::identity) apply_range(call, response, etag(wanted.tag, coded->used));
  }
  return response;
}

/// "name.glb" -> "name", "glb".
std::pair<std::string, std::string> split_extension(const std::string& name) {
  const auto dot = name.rfind('.');
  if (dot == std::string::npos) return {name, ""};
  return {name.substr(0, dot), name.substr(dot + 1)};
}

constexpr std::string_view picture_extension = "webp";

bool is_extension(std::string_view text) {
  return text == "json" || text == picture_extension || format_with_extension(text) != nullptr;
}

/// The request in the format that the extension of a URL names.
Result<Request> in_format(const Request& request, std::string_view extension) {
  if (extension == "json" || format_named(request.format()).extension == extension) return request;
  return with_format(request, format_with_extension(extension)->name);
}

/// A preset with overrides; nothing where there is no such preset. Overrides of the output may be valid only in
/// the format of the extension, so an error leads to a second attempt with that format.
std::optional<Result<Request>> preset_in_format(const RequestContext& call, const std::string& name,
                                                Overrides overrides, std::string_view extension) {
  auto read = read_preset(name, overrides, call.service.config.limits);
  if (!read || *read || extension.empty() || extension == "json") return read;
  overrides.emplace_back("output.format", format_with_extension(extension)->name);
  return read_preset(name, overrides, call.service.config.limits);
}

/// Adds where the picture is, which a request for .png of a model without maps most likely means.
Error with_picture(Error error, const std::string& name, std::string_view extension) {
  if (extension != "png") return error;
  for (Issue& issue : error.issues) {
    if (issue.kind == IssueKind::not_available)
      issue.message +=
          "; a picture of the model is /v1/presets/" + name + '.' + std::string(picture_extension);
  }
  return error;
}

http::Response picture_of_permalink(RequestContext& call, const Request& request, Caching caching) {
  auto query = parse_query(call);
  if (auto* refusal = std::get_if<http::Response>(&query)) return std::move(*refusal);
  auto picture = read_options(call, std::get<Overrides>(query), OtherQueryKeys::refused);
  if (auto* refusal = std::get_if<http::Response>(&picture)) return std::move(*refusal);
  return picture_response(call, request, std::get<PictureOptions>(picture), caching);
}

http::Response picture_of_preset(RequestContext& call, const std::string& name, Overrides query) {
  auto picture = read_options(call, query, OtherQueryKeys::kept);
  if (auto* refusal = std::get_if<http::Response>(&picture)) return std::move(*refusal);
  auto read = read_preset(name, query, call.service.config.limits);
  if (!read) return refuse(call, problem(404, no_preset(name)));
  if (!*read) return refuse(call, problem_of(read->error()));
  if (auto refusal = check_allowed(call, **read)) return std::move(*refusal);
  return picture_response(call, **read, std::get<PictureOptions>(picture), Caching::revalidate);
}

http::Response redirect_to_own(const RequestContext& call, const Request& request,
                               const std::string& extension) {
  std::string own = permalink(write_token(request.canonical(), engine_version()), extension);
  if (extension == picture_extension && !call.query().empty()) own.append("?").append(call.query());
  http::Response response;
  response.status = 307;
  response.set("Location", call.service.access.signed_until(call.grant, own));
  response.set("Cache-Control", "no-store");
  response.set("Vary", "Accept-Encoding");
  response.log_text = "token of another engine version";
  return response;
}

}  // namespace

std::string server_timing(const RequestContext& call, std::string_view cache_use, const CachedModel& made,
                          Clock::time_point asked, Clock::time_point found) {
  const auto between = [](Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double, std::milli>(to - from).count();
  };
  const auto now = Clock::now();
  double wait = between(asked, found);
  std::string text = milliseconds("parse", between(call.request.arrived, asked));
  if (cache_use == "miss") {
    for (const Product::Span& span : made.product.timing) {
      text += ", " + milliseconds(span.name, span.milliseconds);
      wait -= span.milliseconds;
    }
  } else {
    text += ", cache;desc=\"" + std::string(cache_use) + "\"";
  }
  text += ", " + milliseconds("wait", std::max(0.0, wait));
  text += ", " + milliseconds("compress", between(found, now));
  return text + ", " + milliseconds("total", between(call.request.arrived, now));
}

http::Response post_generate(RequestContext& call) {
  auto body = read_body(call);
  if (auto* refusal = std::get_if<http::Response>(&body)) return std::move(*refusal);
  if (is_world(std::get<Request>(body))) return post_world(call, std::get<Request>(body));
  const TaggedRequest wanted = tagged(std::get<Request>(std::move(body)));
  // HTTP/1.0 has no chunked bodies.
  if (call.request.minor == 1 && wants_events(call.request.header("Accept")))
    return generate_events(call, wanted);
  return model_answer(call, wanted, Caching::revalidate);
}

/// The program behind the last point of "token.proctree"; empty if there is none.
static std::string_view saved_program_of(std::string_view text) {
  for (const std::string_view program : saved_programs) {
    if (text.size() > program.size() && text.ends_with(program) &&
        text[text.size() - program.size() - 1] == '.')
      return program;
  }
  return {};
}

/// The request as a file of another program.
static http::Response saved_file(RequestContext& call, const Request& request, std::string_view program,
                                 Caching caching) {
  Job::Options options;
  options.limits = call.service.config.limits;
  Result<ExportedFile> file = export_request(request, program, options);
  if (!file) return refuse(call, problem_of(file.error()));
  http::Response response =
      json_response(call, std::move(file->text), "application/json", cache_control(call, caching));
  response.set("Seedmesh-Warnings", std::to_string(file->warnings.size()));
  return response;
}

http::Response get_model(RequestContext& call) {
  if (!call.query().empty() && !call.name.ends_with(".webp")) {
    return refuse(call,
                  problem_of({Code::invalid, {{IssueKind::unknown_key, "", "A permalink has no query."}}}));
  }
  auto [text, extension] = split_extension(call.name);
  const std::string_view program = extension == "json" ? saved_program_of(text) : std::string_view();
  if (!program.empty()) text.resize(text.size() - program.size() - 1);
  const std::string target(call.target());
  if (auto remembered = call.service.targets.find(target))
    return model_answer(call, *remembered, Caching::immutable);
  if (!is_extension(extension)) {
    return refuse(call,
                  problem(404, "A permalink ends with " + output_extension_list({"json", "webp"}) + "."));
  }

  Result<Token> token = read_token(text, std::min(call.service.config.body_limit, largest_token_text));
  if (!token) return refuse(call, problem_of(token.error()));
  auto read = read_text(call, token->request);
  if (auto* refusal = std::get_if<http::Response>(&read)) return std::move(*refusal);
  const auto request = std::make_optional(std::get<Request>(std::move(read)));
  if (token->engine && *token->engine != engine_version())
    return redirect_to_own(call, *request, program.empty() ? extension : std::string(program) + ".json");
  // Without an engine version, a later version may answer with other bytes.
  const Caching caching = token->engine ? Caching::immutable : Caching::revalidate;
  if (extension == picture_extension) return picture_of_permalink(call, *request, caching);
  if (!program.empty()) return saved_file(call, *request, program, caching);
  if (extension == "json") {
    http::Response response =
        json_response(call, request->canonical(), "application/json", cache_control(call, caching));
    name_file(response, *request, extension);
    return response;
  }
  Result<Request> formatted = in_format(*request, extension);
  if (!formatted) return refuse(call, problem_of(formatted.error()));
  TaggedRequest wanted = tagged(std::move(*formatted));
  wanted.token = token_of(wanted.request);
  if (token->engine) call.service.targets.insert(target, wanted);
  return model_answer(call, wanted, caching);
}

http::Response get_preset(RequestContext& call) {
  const auto [name, extension] = split_extension(call.name);
  const std::string target(call.target());
  if (auto remembered = call.service.targets.find(target))
    return model_answer(call, *remembered, Caching::revalidate);
  if (!extension.empty() && !is_extension(extension)) {
    return refuse(call, problem(404, "The name of a preset ends with " +
                                         output_extension_list({"json", "webp"}) + ", or has no extension."));
  }
  auto query = parse_query(call);
  if (auto* refusal = std::get_if<http::Response>(&query)) return std::move(*refusal);
  const Overrides overrides = std::get<Overrides>(std::move(query));
  if (extension == picture_extension) return picture_of_preset(call, name, overrides);
  auto read = preset_in_format(call, name, overrides, extension);
  if (!read) return refuse(call, problem(404, no_preset(name)));
  if (!*read) return refuse(call, problem_of(read->error()));
  if (auto refusal = check_allowed(call, **read)) return std::move(*refusal);
  if (extension.empty() || extension == "json") {
    return json_response(call, overrides.empty() ? *preset_json(name) : (*read)->canonical());
  }
  Result<Request> formatted = in_format(**read, extension);
  if (!formatted)
    return refuse(call, pointed(call, problem_of(with_picture(formatted.error(), name, extension))));
  TaggedRequest wanted = tagged(std::move(*formatted));
  wanted.token = token_of(wanted.request);
  call.service.targets.insert(target, wanted);
  return model_answer(call, wanted, Caching::revalidate);
}

}  // namespace seedmesh
