/// The notation of L-systems and all that runs behind it: the first line of the input is the axiom, the
/// others are productions; empty lines go on to interpretation rules, decomposition rules, a table,
/// functions, declared modules. Under small limits every input ends soon, in a refusal or in a model of
/// finite numbers.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "core/generators/lsystem/lsystem.h"
#include "generated/params/lsystem.h"
#include "tests/support/context.h"

namespace {

using namespace seedmesh;

Job::Options small() {
  Job::Options options;
  options.limits.modules = 20'000;
  options.limits.triangles = 200'000;
  options.limits.memory_bytes = std::uint64_t{256} << 20U;
  options.limits.bracket_depth = 100;
  return options;
}

std::string_view take_line(std::string_view& text) {
  const std::size_t end = text.find('\n');
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return line;
}

LsystemParams params_of(std::string_view text) {
  LsystemParams params;
  params.iterations = 4;
  params.constants = {{"k", 0.5}, {"n", "k * 2 + 1"}};
  params.ignore = "+-";
  params.interpretation_depth = 3;
  params.decomposition_depth = 4;
  params.ring = text.size() % 2 == 1;
  params.axiom = take_line(text);
  LsystemTable table;
  std::vector<std::string>* const lists[] = {&params.productions,   &params.interpretation,
                                             &params.decomposition, &table.productions,
                                             &params.functions,     &params.modules};
  std::size_t list = 0;
  while (!text.empty()) {
    const std::string_view line = take_line(text);
    if (line.empty()) {
      list = (list + 1) % std::size(lists);
    } else {
      lists[list]->emplace_back(line);
    }
  }
  if (!table.productions.empty()) params.tables = {table, {}};
  return params;
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
  const LsystemParams params = params_of({reinterpret_cast<const char*>(data), size});
  Job job(size, small());
  const bool sound = lsystem::check(params, job.limits()).empty();
  try {
    const Result<Model> model = lsystem::generate(params, context_of(job));
    if (model && (!sound || !finite(*model))) std::abort();
    if (!model && sound) std::abort();
  } catch (const Stop&) {
    // A limit is exceeded, which the pipeline reports to the client.
  }
  return 0;
}
