#include "core/generators/fractal/idle.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "core/generators/fractal/lattice.h"
#include "core/generators/idle.h"
#include "generated/params/fractal.h"

namespace seedmesh::fractal {
namespace {

/// The methods that read a parameter; those that all methods read are not listed.
struct Readers {
  std::string_view parameter;
  bool mrcm, frcm, escape;
};
constexpr Readers readers[] = {
    {"instructions", true, true, false}, {"element", true, true, false}, {"iterations", true, false, false},
    {"columns", true, true, false},      {"text", true, true, false},    {"surface", true, false, false},
    {"color", true, true, false},        {"palette", false, true, true}, {"points", false, true, false},
    {"drop", false, true, false},        {"cloud", false, true, false},  {"voxels", false, true, false},
    {"escape", false, false, true},
};

bool reads(const Readers& each, FractalMethod method) {
  switch (method) {
    case FractalMethod::frcm:
      return each.frcm;
    case FractalMethod::escape:
      return each.escape;
    default:
      return each.mrcm;
  }
}

/// "mrcm and frcm".
std::string methods_of(const Readers& each) {
  std::string text;
  for (const FractalMethod method : {FractalMethod::mrcm, FractalMethod::frcm, FractalMethod::escape}) {
    if (reads(each, method)) text.append(text.empty() ? "" : " and ").append(text_of(method));
  }
  return text;
}

bool is_word(const FractalParams& params) {
  return params.instructions.index() == 0 &&
         std::get<0>(params.instructions) == FractalInstructions::word_test;
}

bool is_cube(const FractalParams& params) {
  if (params.element.index() != 0) return false;
  const FractalElement name = std::get<0>(params.element);
  return name == FractalElement::cube || name == FractalElement::rainbow_cube;
}

void look_at_escape(const FractalParams& params, IdleParameters& idle) {
  if (params.escape.set != FractalSet::julia)
    idle.warn_of("/escape", {"constant"}, "it belongs to the set julia, and the set is mandelbrot");
}

void look_at_machine(const FractalParams& params, IdleParameters& idle) {
  if (params.stages.empty()) idle.warn_of("", {"columns"}, "there are no stages");
  if (!is_word(params)) idle.warn_of("", {"text"}, "only the instructions word_test write it");
  if (params.method != FractalMethod::mrcm) return;
  const bool is_merged = params.surface == FractalSurface::merged;
  idle.warn_if(is_merged && !(is_cube(params) && lattice_of(instructions_of(params))), "/surface",
               "the maps do not fill cells of a lattice with cubes, so that all is made of pieces");
  if (params.instructions.index() == 0) return;
  const std::vector<FractalMap>& maps = std::get<1>(params.instructions);
  for (std::size_t i = 0; i < maps.size(); ++i) {
    idle.warn_if(maps[i].probability.has_value(), "/instructions/" + std::to_string(i) + "/probability",
                 "it belongs to frcm, and the method is mrcm");
  }
}

void look_at_cloud(const FractalParams& params, IdleParameters& idle) {
  const std::string cloud(text_of(params.cloud));
  if (params.cloud != FractalCloud::elements)
    idle.warn_of("", {"element"}, "it belongs to the cloud elements, and the cloud is " + cloud);
  if (params.cloud == FractalCloud::points)
    idle.warn_of("", {"voxels", "color"},
                 "it belongs to the clouds elements and voxels, and the cloud is points");
}

}  // namespace

std::vector<Warning> idle_parameters(const FractalParams& params) {
  IdleParameters idle(write_fractal(params));
  for (const Readers& each : readers) {
    if (reads(each, params.method)) continue;
    idle.warn_of(
        "", {each.parameter},
        "it belongs to " + methods_of(each) + ", and the method is " + std::string(text_of(params.method)));
  }
  if (params.method == FractalMethod::escape) {
    look_at_escape(params, idle);
  } else {
    look_at_machine(params, idle);
    if (params.method == FractalMethod::frcm) look_at_cloud(params, idle);
  }
  return idle.take();
}

}  // namespace seedmesh::fractal
