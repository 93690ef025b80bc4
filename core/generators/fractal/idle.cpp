#include "core/generators/fractal/idle.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/generators/fractal/lattice.h"
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

class Finder {
 public:
  explicit Finder(const FractalParams& params) : params_(params), given_(write_fractal(params)) {}

  std::vector<Warning> run() && {
    for (const Readers& each : readers) {
      if (given_.contains(each.parameter) && !reads(each, params_.method)) {
        warn("/" + std::string(each.parameter), "it belongs to " + methods_of(each) + ", and the method is " +
                                                    std::string(text_of(params_.method)));
      }
    }
    if (params_.method == FractalMethod::escape) {
      look_at_escape();
    } else {
      look_at_machine();
      if (params_.method == FractalMethod::frcm) look_at_cloud();
    }
    return std::move(warnings_);
  }

 private:
  void warn(std::string pointer, const std::string& reason) {
    warnings_.push_back({std::move(pointer), "has no effect: " + reason, 0, 0});
  }

  void look_at_escape() {
    const bool is_julia = params_.escape.set == FractalSet::julia;
    if (!is_julia && given_.contains("escape") && given_["escape"].contains("constant"))
      warn("/escape/constant", "it belongs to the set julia, and the set is mandelbrot");
  }

  void look_at_machine() {
    if (given_.contains("columns") && params_.stages.empty()) warn("/columns", "there are no stages");
    if (given_.contains("text") && !is_word(params_))
      warn("/text", "only the instructions word_test write it");
    if (params_.method != FractalMethod::mrcm) return;
    if (params_.surface == FractalSurface::merged &&
        !(is_cube(params_) && lattice_of(instructions_of(params_))))
      warn("/surface", "the maps do not fill cells of a lattice with cubes, so that all is made of pieces");
    if (params_.instructions.index() == 0) return;
    const std::vector<FractalMap>& maps = std::get<1>(params_.instructions);
    for (std::size_t i = 0; i < maps.size(); ++i) {
      if (maps[i].probability)
        warn("/instructions/" + std::to_string(i) + "/probability",
             "it belongs to frcm, and the method is mrcm");
    }
  }

  void look_at_cloud() {
    const std::string cloud(text_of(params_.cloud));
    if (given_.contains("element") && params_.cloud != FractalCloud::elements)
      warn("/element", "it belongs to the cloud elements, and the cloud is " + cloud);
    if (params_.cloud != FractalCloud::points) return;
    for (const char* name : {"voxels", "color"}) {
      if (given_.contains(name))
        warn("/" + std::string(name),
             "it belongs to the clouds elements and voxels, and the cloud is points");
    }
  }

  const FractalParams& params_;
  const Json given_;
  std::vector<Warning> warnings_;
};

}  // namespace

std::vector<Warning> idle_parameters(const FractalParams& params) { return Finder(params).run(); }

}  // namespace seedmesh::fractal
