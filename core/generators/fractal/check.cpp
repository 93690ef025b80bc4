#include "core/generators/fractal/check.h"

#include <string>

#include "core/generators/fractal/element.h"
#include "core/gltf/read/read.h"

namespace seedmesh::fractal {

void check_stages(const FractalParams& params, std::vector<Issue>& issues) {
  for (std::size_t i = 0; i < params.stages.size(); ++i) {
    const std::string pointer = "/stages/" + std::to_string(i);
    if (params.method == FractalMethod::mrcm && params.stages[i] > 1000) {
      issues.emplace_back(IssueKind::out_of_range, pointer,
                          "found " + std::to_string(params.stages[i]) + " rounds, expected at most 1000");
    }
    if (params.method == FractalMethod::frcm && params.stages[i] < 1) {
      issues.emplace_back(IssueKind::out_of_range, pointer, "found 0 points, expected at least 1");
    }
    if (params.method == FractalMethod::escape) {
      issues.emplace_back(conflict_with({"method"}), pointer,
                          "found a stage, but method \"escape\" has none");
    }
  }
}

void check_element(const FractalParams& params, std::vector<Issue>& issues) {
  if (is_named(params, FractalElement::plate)) {
    const bool snowflake = params.instructions.index() == 0 &&
                           std::get<0>(params.instructions) == FractalInstructions::koch_snowflake;
    if (!snowflake || params.method != FractalMethod::mrcm) {
      issues.emplace_back(conflict_with({"method", "instructions"}), "/element",
                          "found \"plate\", which is the area inside the koch_snowflake of mrcm");
    }
  }
  if (is_named(params, FractalElement::plate) && params.smallest > 0) {
    issues.emplace_back(conflict_with({"element"}), "/smallest",
                        "found a smallest piece, but a \"plate\" is one area and has no pieces");
  }
  if (params.element.index() == 0) return;
  const FractalElementObject& given = std::get<1>(params.element);
  if (given.model.has_value() == given.glb.has_value()) {
    issues.emplace_back(conflict_with({"model", "glb"}), "/element",
                        std::string("found ") + (given.model ? "both" : "neither") +
                            " of \"model\" and \"glb\", expected one of them");
  } else if (given.glb && !is_glb_uri(*given.glb)) {
    issues.emplace_back(IssueKind::invalid_value, "/element/glb",
                        "expected a GLB as \"data:model/gltf-binary;base64,…\"");
  }
}

}  // namespace seedmesh::fractal
