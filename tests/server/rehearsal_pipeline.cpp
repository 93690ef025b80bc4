/// A pipeline that makes no models: its requests say how long they take, how large the answer is and how they
/// end, so that the tests of the server can ask for a slow, a large or a failing generation. Generator
/// "rehearsal":
///   {"generator": "rehearsal", "seed": 1, "parameters": {"milliseconds": 50, "bytes": 1000, "end":
///   "product"}}
/// With `blocked`, the work begins with this number of milliseconds without a look at stop and deadline.
/// `end` is product, limit, internal or throw; it reports `progress` steps in between. With `bits`, each byte has
/// this number of random bits, so that compression saves (8 - bits) / 8 of the answer.
#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "core/pipeline.h"
#include "core/pipeline/world.h"

namespace seedmesh {

struct Request::Body {
  std::string canonical, format;
  std::uint64_t seed = 0;
  int milliseconds = 0, blocked = 0, progress = 0, bits = 0;
  std::size_t bytes = 1'000;
  std::string end = "product";
};

namespace {

using Json = nlohmann::json;

constexpr std::string_view preset_text = R"({"generator":"rehearsal","parameters":{"bytes":2000},"seed":5})";

Request request_of(const Json& json) {
  auto body = std::make_shared<Request::Body>();
  const Json parameters = json.value("parameters", Json::object());
  body->canonical = json.dump();
  body->format = json.value("output", Json::object()).value("format", "glb");
  body->seed = json.value("seed", std::uint64_t{0});
  body->milliseconds = parameters.value("milliseconds", 0);
  body->blocked = parameters.value("blocked", 0);
  body->progress = parameters.value("progress", 0);
  body->bytes = parameters.value("bytes", std::size_t{1'000});
  body->bits = parameters.value("bits", 0);
  body->end = parameters.value("end", "product");
  return Request(std::move(body));
}

Error invalid(std::string pointer, std::string message) {
  return {Code::invalid, {{IssueKind::invalid_value, std::move(pointer), std::move(message)}}};
}

/// Sleeps in small steps, looking at stop and deadline as real work does.
void work(const Request::Body& body, const Job& job) {
  if (body.blocked > 0) std::this_thread::sleep_for(std::chrono::milliseconds(body.blocked));
  const int steps = body.progress > 0 ? body.progress : 1;
  for (int step = 0; step < steps; ++step) {
    if (body.progress > 0) job.progress("mesh", static_cast<double>(step) / steps);
    const auto until = Job::Clock::now() + std::chrono::milliseconds(body.milliseconds / steps);
    while (Job::Clock::now() < until) {
      job.check();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  if (body.end == "limit")
    job.refuse(limit_issue({Resource::output_bytes, 1, 2}, "It would pass a limit.", "/parameters/bytes"));
  if (body.end == "throw") throw std::runtime_error("a secret of the inside");
}

/// A pattern of 23 letters, or random bits (xorshift64, Marsaglia 2003).
std::string bytes_of(const Request::Body& body) {
  std::string bytes(body.bytes, '\0');
  std::uint64_t state = body.seed + 88'172'645'463'325'252U;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    state ^= state << 13U, state ^= state >> 7U, state ^= state << 17U;
    bytes[i] = static_cast<char>(body.bits > 0 ? state >> 20U & ((1U << body.bits) - 1U)
                                               : 'a' + (i * i + body.seed) % 23);
  }
  return bytes;
}

}  // namespace

std::string_view Request::generator() const { return "rehearsal"; }
std::string_view Request::format() const { return body_->format; }
const std::string& Request::canonical() const { return body_->canonical; }
std::uint64_t Request::seed() const { return body_->seed; }
const std::string& Request::name() const {
  static const std::string name = "rehearsal";
  return name;
}

Result<Request> read_request(std::string_view json, const Job::Options&) {
  const Json object = Json::parse(json, nullptr, false);
  if (object.is_discarded())
    return Error{Code::malformed, {{IssueKind::syntax, "", "The body is not JSON."}}};
  if (!object.is_object() || !object.contains("generator")) return invalid("", "generator is missing.");
  if (object["generator"] != "rehearsal") return invalid("/generator", "There is no such generator.");
  if (object.contains("engine")) return invalid("/engine", "There is no such field.");
  return request_of(object);
}

Result<Request> read_request(std::string_view json, const Limits& limits) {
  Job::Options options;
  options.limits = limits;
  return read_request(json, options);
}

std::optional<Result<Request>> read_preset(std::string_view name, const Overrides& overrides,
                                           const Limits& limits) {
  if (name != "small") return std::nullopt;
  Json object = Json::parse(preset_text);
  for (const auto& [key, value] : overrides) {
    const Json parsed = Json::parse(value, nullptr, false);
    if (key == "seed") {
      object["seed"] = parsed;
    } else if (key == "bytes" || key == "milliseconds") {
      object["parameters"][key] = parsed;
    } else {
      return Result<Request>(invalid("/" + key, "There is no such parameter."));
    }
  }
  return read_request(object.dump(), limits);
}

Result<Request> with_format(const Request& request, std::string_view format) {
  if (format != "glb" && format != "gltf" && format != "zip")
    return invalid("/output/format", "There is no such form.");
  Json object = Json::parse(request.canonical());
  object.erase("output");
  if (format != "glb") object["output"] = {{"format", format}};
  return request_of(object);
}

Result<Product> produce(const Request& request, const Job::Options& options, TextureStore*) {
  const Request::Body& body = request.body();
  try {
    work(body, Job(body.seed, options));
  } catch (const Stop& stop) {
    return Error{stop.code(), {stop.issue()}};
  }
  if (body.end == "internal")
    return Error{Code::internal, {{IssueKind::internal, "", "a secret of the inside"}}};
  Product product;
  const std::string bytes = bytes_of(body);
  const std::size_t half = bytes.size() / 2;
  product.payload.add(bytes.substr(0, half));
  product.payload.add(bytes.substr(half));
  product.extension = body.format;
  product.media_type = body.format == "gltf"  ? "model/gltf+json"
                       : body.format == "zip" ? "application/zip"
                                              : "model/gltf-binary";
  product.statistics = {12, 24, 0};
  product.timing = {{"derive", 0.1}, {"mesh", 0.2}, {"encode", 0.3}};
  return product;
}

Result<std::string> derive(const Request& request, const Job::Options& options) {
  try {
    work(request.body(), Job(request.seed(), options));
  } catch (const Stop& stop) {
    return Error{stop.code(), {stop.issue()}};
  }
  return std::string(R"({"warnings":[]})");
}

Result<std::string> validate(const Request&, const Job::Options&) {
  return std::string(R"({"valid":true,"warnings":[],"estimate":{"triangles":12,"bytes":1000,"exact":true}})");
}

Result<std::shared_ptr<const Image>> make_texture(std::string_view, const Job::Options&, TextureStore*) {
  return Error{Code::invalid, {{IssueKind::not_available, "", "this pipeline has no textures"}}};
}
Result<ImportedRequest> import_request(const ImportInput&, const Job::Options&) {
  return invalid("/format", "There is no such format.");
}
std::vector<ImportFormatInfo> import_format_list() { return {}; }
std::string_view likely_import_format(std::string_view) { return {}; }
Result<ExportedFile> export_request(const Request&, std::string_view, const Job::Options&) {
  return invalid("/parameters/model", "Letters are no trees.");
}

// No request has a picture.
std::string PictureOptions::text() const { return {}; }
Result<PictureOptions> read_picture_options(Overrides&) { return PictureOptions{}; }
Result<Product> draw_picture(const Request&, const PictureOptions&, const Job::Options&, TextureStore*) {
  return invalid("/output", "There are no pictures.");
}

// No request is a world.
class WorldMemory {};
struct OpenWorld::Body {};
static Error no_world() {
  return {Code::invalid, {{IssueKind::not_available, "/generator", "There are no worlds."}}};
}
std::shared_ptr<WorldMemory> make_world_memory(std::uint64_t) { return nullptr; }
int OpenWorld::levels() const { return 0; }
double OpenWorld::extent() const { return 0; }
bool is_world(const Request&) { return false; }
// The pipeline keeps the memory.
// NOLINTNEXTLINE(performance-unnecessary-value-param)
Result<OpenWorld> open_world(const Request&, std::shared_ptr<WorldMemory>) { return no_world(); }
std::optional<Error> output_error_of_tiles(const Request&) { return std::nullopt; }
TileRange tiles_in(const OpenWorld&, int, const WorldBox&) { return {}; }
Result<std::string> world_tileset(const OpenWorld&, const TileAddress&, std::string_view, const Job::Options&,
                                  const WorldPart*) {
  return no_world();
}
Result<std::string> world_implicit(const OpenWorld&, std::string_view, const Job::Options&) {
  return no_world();
}
Result<std::string> world_subtree(const OpenWorld&, const TileAddress&, const Job::Options&) {
  return no_world();
}
Result<std::string> world_tile(const OpenWorld&, const TileAddress&, const Job::Options&) {
  return no_world();
}
Result<std::optional<WorldFile>> world_file(const OpenWorld&, std::string_view, const Job::Options&) {
  return no_world();
}
Result<WorldBox> read_world_box(const OpenWorld&, std::string_view, double) { return no_world(); }
Result<std::string> world_map(const OpenWorld&, const WorldBox&, WorldHeights, const Job::Options&) {
  return no_world();
}

const std::vector<PresetInfo>& presets() {
  static const std::vector<PresetInfo> all = {
      {"small", "rehearsal", "Small", "Two thousand letters.", {"test"}}};
  return all;
}
std::string no_preset(std::string_view) { return "There is no preset of this name."; }
std::string no_schema(std::string_view) { return "There is no schema of this name."; }
std::string_view nearest_name(std::string_view name, std::span<const std::string_view> names) {
  const auto same = std::find(names.begin(), names.end(), name);
  return same == names.end() ? std::string_view() : *same;
}

std::optional<std::string> preset_json(std::string_view name) {
  if (name != "small") return std::nullopt;
  return std::string(preset_text);
}
std::optional<std::string_view> schema_json(std::string_view name) {
  if (name != "request") return std::nullopt;
  return R"({"title":"Request","type":"object","properties":{"seed":{"type":"integer","default":0,"description":"<seed>"}}})";
}
std::vector<std::string_view> schema_names() { return {"request"}; }
std::string vocabulary_json() { return R"({"symbols":[]})"; }
std::string_view openapi_json() {
  return R"({"openapi":"3.1.0","info":{"title":"Rehearsal","version":"1"},"paths":{"/v1/generate":{"post":{"summary":"Makes."}}}})";
}
std::vector<std::string_view> generator_names() { return {"rehearsal"}; }
std::string_view engine_version() { return "rehearsal-1"; }
std::string_view program_version() { return "0.0.0"; }

}  // namespace seedmesh
