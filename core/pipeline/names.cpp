#include "core/pipeline/names.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>

#include "core/base/token.h"
#include "core/gltf/content_names.h"
#include "core/pipeline.h"
#include "core/schema/presets.h"

namespace seedmesh {
namespace {

/// The canonical request without seed, format and name.
std::string essence(Request::Body body) {
  body.seed = 0;
  body.output.name.reset();
  body.output.format = OutputFormat::glb;
  return canonical_request(body);
}

struct KnownPreset {
  std::once_flag once;
  std::string essence;
  std::uint64_t seed = 0;
};

/// What a request has to be in order to be called by the preset's name. Read at the first use.
const KnownPreset& known_preset(const std::string& name) {
  static std::map<std::string, KnownPreset, std::less<>> all = [] {
    std::map<std::string, KnownPreset, std::less<>> presets;
    for (const std::string_view each : preset_names()) presets.try_emplace(std::string(each));
    return presets;
  }();
  KnownPreset& preset = all.find(name)->second;
  std::call_once(preset.once, [&] {
    Result<Request::Body> body =
        read_parts(preset_requests().find(name)->second.request, Job(0, Job::Options{}));
    if (!body) return;  // a test makes every preset
    preset.seed = body->seed;
    preset.essence = essence(*std::move(body));
  });
  return preset;
}

bool is_of_preset(const Request::Body& body) {
  if (!body.output.name) return false;
  const auto preset = preset_requests().find(*body.output.name);
  return preset != preset_requests().end() &&
         preset->second.request.at("generator").get_ref<const std::string&>() == body.generator->name;
}

/// The canonical request with its seed, without format and name.
std::string hash_of(const Request::Body& body, const std::string& essential) {
  return gltf::short_hash(std::to_string(body.seed) + essential);
}

}  // namespace

std::string model_name(const Request::Body& body) {
  if (body.output.name && !is_of_preset(body)) return *body.output.name;
  const std::string own = essence(body);
  if (!body.output.name) return std::string(body.generator->name) + '_' + hash_of(body, own);
  const KnownPreset& preset = known_preset(*body.output.name);
  if (own != preset.essence) return *body.output.name + '_' + hash_of(body, own);
  return body.seed == preset.seed ? *body.output.name : *body.output.name + '_' + std::to_string(body.seed);
}

std::string name_stem(const Request::Body& body) {
  return body.output.name.value_or(std::string(body.generator->name));
}

std::vector<Extra> provenance(const Request& request) {
  std::vector<Extra> origin;
  const auto add = [&origin](const char* name, const std::string& text) {
    origin.push_back({name, canonical_text(Json(text))});
  };
  add("engine", std::string(engine_version()));
  add("generator", std::string(request.generator()));
  add("seed", std::to_string(request.seed()));
  if (is_of_preset(request.body())) add("preset", *request.body().output.name);
  const std::string& canonical = request.canonical();
  if (canonical.size() > longest_written_request) {
    add("request_hash", gltf::long_hash(canonical));
    return origin;
  }
  add("request", canonical);
  const std::string token = write_token(canonical, engine_version());
  if (token.size() <= longest_token)
    add("permalink", permalink(token, format_named(request.format()).extension));
  return origin;
}

void add_to_root(Model& model, const std::vector<Extra>& origin) {
  const auto root = std::ranges::find_if(model.nodes, [](const Node& node) {
    return node.parent < 0 && node.collision == CollisionShape::none;
  });
  if (root == model.nodes.end()) return;
  for (const Extra& extra : origin) {
    const bool is_known =
        std::ranges::any_of(root->extras, [&](const Extra& own) { return own.name == extra.name; });
    if (!is_known) root->extras.push_back(extra);
  }
}

}  // namespace seedmesh
