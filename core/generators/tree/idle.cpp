#include "core/generators/tree/idle.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

#include "core/generators/idle.h"
#include "core/generators/tree/looks.h"
#include "core/generators/tree/weber_penn_shape.h"
#include "generated/params/tree.h"

namespace seedmesh::tree {
namespace {

/// The model that a parameter belongs to, or all.
enum class Owner { weber_penn, proctree, sculpt, all };
static_assert(static_cast<int>(TreeModel::sculpt) == static_cast<int>(Owner::sculpt));

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_capital(char c) { return c >= 'A' && c <= 'Z'; }

Owner owner_of(std::string_view name) {
  if (name == "sculpt") return Owner::sculpt;
  if (name == "sway") return Owner::weber_penn;
  if (name[0] == 'm' && name.size() > 1 && is_capital(name[1])) return Owner::proctree;
  return is_digit(name[0]) || is_capital(name[0]) ? Owner::weber_penn : Owner::all;
}

template <class Images>
bool has_any(const Images& images) {
  return !images.color.empty() || !images.normal.empty() || !images.surface.empty();
}

void look_at_models(const TreeParams& params, IdleParameters& idle) {
  const auto model = static_cast<Owner>(params.model);
  for (const auto& [name, value] : idle.given().items()) {
    const Owner owner = owner_of(name);
    if (owner != Owner::all && owner != model)
      idle.warn("/" + name, "it belongs to the model " + std::string(text_of(static_cast<TreeModel>(owner))) +
                                ", and the model is " + std::string(text_of(params.model)));
  }
  if (params.model == TreeModel::proctree) idle.warn_of("", {"sides"}, "the model proctree takes mSegments");
}

/// Why there is no leaf in any season; empty where there are some.
std::string why_bare(const TreeParams& params) {
  if (params.leaf.build == TreeBuild::none) return "the build of leaves is none";
  if (params.model == TreeModel::weber_penn && params.Leaves == 0) return "`Leaves` is 0";
  if (params.model == TreeModel::sculpt && params.sculpt.leaves == 0) return "`sculpt.leaves` is 0";
  return "";
}

template <class Images>
void look_at_images(const std::string& pointer, const Images& images, IdleParameters& idle) {
  idle.warn_if(images.cut_out && !has_any(images), pointer + "/cut_out", "there is no image");
}

void look_at_leaf(const TreeParams& params, IdleParameters& idle) {
  if (!idle.given().contains("leaf")) return;
  if (const std::string bare = why_bare(params); !bare.empty()) {
    for (const auto& [name, value] : idle.given()["leaf"].items()) {
      if (name != "build") idle.warn("/leaf/" + name, bare);
    }
    return;
  }
  const TreeBuild build = build_of(params);
  if (build == TreeBuild::card || build == TreeBuild::cross)
    idle.warn_of("/leaf", {"fold", "droop", "coarseness"},
                 "it belongs to the builds curved, mesh, twig and bunch, and the build is " +
                     std::string(text_of(build)));
  if (!params.leaf.images.color.empty()) {
    idle.warn_of("/leaf", {"picture", "color", "autumn"}, "the image `leaf.images.color` takes its place");
  } else if (params.leaf.evergreen) {
    idle.warn_of("/leaf", {"autumn"}, "evergreen leaves keep their colour");
  }
  look_at_images("/leaf/images", params.leaf.images, idle);
}

void look_at_bark(const TreeParams& params, IdleParameters& idle) {
  if (!params.bark_images.color.empty()) {
    idle.warn_of("", {"bark", "bark_color", "bark_seed"}, "the image `bark_images.color` takes its place");
  } else if (params.bark == TreeBark::none) {
    idle.warn_of("", {"bark_seed"}, "the bark none has no picture");
  }
  look_at_images("/bark_images", params.bark_images, idle);
}

/// Level n of limbs is there from Levels n + 1 on; one before it, its angles are those of the leaves.
void look_at_levels(const TreeParams& params, IdleParameters& idle) {
  for (const auto& [name, value] : idle.given().items()) {
    if (!is_digit(name[0])) continue;
    const int level = name[0] - '0';
    const std::string_view what = std::string_view(name).substr(1);
    const bool is_of_leaves = what.starts_with("DownAngle") || what.starts_with("Rotate");
    if (level < params.Levels || (level == params.Levels && is_of_leaves)) continue;
    idle.warn("/" + name, "`Levels` is " + std::to_string(params.Levels) + ", and limbs of level " +
                              std::to_string(level) + " are there from " + std::to_string(level + 1) + " on");
  }
}

/// The trunk divides at its base too.
void look_at_splits(const TreeParams& params, IdleParameters& idle) {
  const auto levels = weber_penn_levels(params);
  for (int i = 0; i < std::min<int>(params.Levels, static_cast<int>(levels.size())); ++i) {
    const std::string level = std::to_string(i);
    if (levels[static_cast<std::size_t>(i)].seg_splits > 0 || (i == 0 && params.base_splits > 0)) continue;
    const std::string reason =
        i == 0 ? "`0SegSplits` and `0BaseSplits` are 0" : "`" + level + "SegSplits` is 0";
    idle.warn_of("", {level + "SplitAngle", level + "SplitAngleV"}, reason);
  }
}

void look_at_weber_penn(const TreeParams& params, IdleParameters& idle) {
  look_at_levels(params, idle);
  look_at_splits(params, idle);
  if (params.Levels == 1)
    idle.warn_of("", {"Shape", "RatioPower", "PruneRatio"}, "`Levels` is 1: the trunk has no limbs");
  if (params.Leaves == 0) idle.warn_of("", {"LeafScale", "LeafScaleX", "LeafBend"}, "`Leaves` is 0");
  if (params.Lobes == 0) idle.warn_of("", {"LobeDepth"}, "`Lobes` is 0");
  if (params.LobeDepth == 0) idle.warn_of("", {"Lobes"}, "`LobeDepth` is 0");
  if (params.Levels < 3) idle.warn_of("", {"AttractionUp"}, "it bends limbs of level 2, from `Levels` 3 on");
  if (params.PruneRatio == 0) {
    idle.warn_of("", {"PruneWidth"}, "`PruneRatio` is 0");
    if (params.crown_shape != 8)
      idle.warn_of("", {"PruneWidthPeak", "PrunePowerLow", "PrunePowerHigh"},
                   "`PruneRatio` is 0 and `Shape` is not 8");
  }
  if (params.sway.wind == 0 && params.sway.gust == 0)
    idle.warn_of("/sway", {"time"}, "`wind` and `gust` are 0");
}

void look_at_sculpt(const TreeParams& params, IdleParameters& idle) {
  const TreeSculpt& sculpt = params.sculpt;
  if (sculpt.leaves == 0)
    idle.warn_of("/sculpt", {"leaf_length", "leaf_width", "leaf_angle"}, "`sculpt.leaves` is 0");
  for (std::size_t i = 0; i < sculpt.level.size(); ++i) {
    const std::string pointer = "/sculpt/level/" + std::to_string(i);
    if (i >= static_cast<std::size_t>(sculpt.levels)) {
      idle.warn(pointer, "`sculpt.levels` is " + std::to_string(sculpt.levels));
    } else if (sculpt.level[i].shape != TreeShape::lathe) {
      idle.warn_of(
          pointer, {"profile"},
          "it belongs to the shape lathe, and the shape is " + std::string(text_of(sculpt.level[i].shape)));
    }
  }
}

}  // namespace

std::vector<Warning> idle_parameters(const TreeParams& params) {
  IdleParameters idle(write_tree(params));
  look_at_models(params, idle);
  look_at_leaf(params, idle);
  look_at_bark(params, idle);
  if (!params.age) idle.warn_of("", {"mature_age"}, "there is no `age`");
  if (params.roots.count == 0) idle.warn_of("/roots", {"length", "thickness", "depth"}, "`count` is 0");
  switch (params.model) {
    case TreeModel::weber_penn:
      look_at_weber_penn(params, idle);
      break;
    case TreeModel::proctree:
      if (params.mTreeSteps == 0)
        idle.warn_of("", {"mClimbRate", "mTrunkKink", "mTwistRate", "mTaperRate"}, "`mTreeSteps` is 0");
      break;
    case TreeModel::sculpt:
      look_at_sculpt(params, idle);
      break;
  }
  return idle.take();
}

}  // namespace seedmesh::tree
