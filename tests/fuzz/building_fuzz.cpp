/// The notations of buildings and all that runs behind them: the input is the rules, or where it begins with
/// a brace the parameters as JSON (for shape grammars). Under small limits every input ends soon, in a
/// refusal or in a model of finite numbers.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "core/generators/building/building.h"
#include "generated/params/building.h"
#include "tests/support/context.h"

namespace {

using namespace seedmesh;

Job::Options small() {
  Job::Options options;
  options.limits.shapes = 20'000;
  options.limits.triangles = 200'000;
  options.limits.memory_bytes = std::uint64_t{256} << 20U;
  return options;
}

bool finite(const Model& model) {
  for (const MeshGroup& group : model.meshes) {
    for (const Primitive& primitive : group.primitives) {
      for (const glm::vec3& at : primitive.mesh.position) {
        if (!std::isfinite(at.x) || !std::isfinite(at.y) || !std::isfinite(at.z)) return false;
      }
    }
  }
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  BuildingParams params;
  if (text.starts_with('{')) {
    const Result<Json> json = parse_json(text);
    if (!json) return 0;
    IssueList faults;
    params = read_building(*json, "", faults);
    // Requests inside and images are the business of other targets.
    if (!faults.empty() || !params.assets.empty() || !params.materials.empty()) return 0;
    if (!params.iterations || *params.iterations > 8) params.iterations = 8;
  } else {
    params.rules = text;
    params.size = {10, size % 2 == 0 ? 0.0 : 6.0, 8};
    if (size % 3 == 0) params.footprint = {{{0, 0}, {8, 0}, {8, 3}, {3, 3}, {3, 8}, {0, 8}}};
    if (size % 5 == 0) params.iterations = 5;
    params.derivation.mode = size % 7 == 0 ? BuildingMode::sequential : BuildingMode::parallel;
  }
  Job job(size, small());
  Demand demand;
  demand.lods = size % 4 == 0 ? 3 : 1;
  demand.collision = size % 3 == 0 ? CollisionNames::plain : CollisionNames::none;
  const bool sound = building::check(params, job.limits()).empty();
  try {
    const Result<Model> model = building::generate(params, context_of(job, demand));
    if (model && (!sound || !finite(*model))) std::abort();
    if (!model && sound) std::abort();
    if (sound && size % 2 == 0 && !building::appraise(params, context_of(job, demand))) std::abort();
  } catch (const Stop&) {
    // A limit, or an error that is found only while the grammar runs. The pipeline reports it to the client.
  }
  return 0;
}
