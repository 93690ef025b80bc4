#include "core/generators/tree/idle.h"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/generators/tree/looks.h"
#include "core/generators/tree/weber_penn_shape.h"
#include "generated/params/tree.h"

namespace seedmesh::tree {
namespace {

using Names = std::initializer_list<std::string_view>;

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

class Finder {
 public:
  explicit Finder(const TreeParams& params) : params_(params), given_(write_tree(params)) {}

  std::vector<Warning> run() && {
    look_at_models();
    look_at_leaf();
    look_at_bark();
    if (given_.contains("mature_age") && !params_.age) warn("/mature_age", "there is no `age`");
    if (params_.roots.count == 0) warn_of("/roots", {"length", "thickness", "depth"}, "`count` is 0");
    switch (params_.model) {
      case TreeModel::weber_penn:
        look_at_weber_penn();
        break;
      case TreeModel::proctree:
        if (params_.mTreeSteps == 0)
          warn_of("", {"mClimbRate", "mTrunkKink", "mTwistRate", "mTaperRate"}, "`mTreeSteps` is 0");
        break;
      case TreeModel::sculpt:
        look_at_sculpt();
        break;
    }
    return std::move(warnings_);
  }

 private:
  void warn(std::string pointer, const std::string& reason) {
    warnings_.push_back({std::move(pointer), "has no effect: " + reason, 0, 0});
  }

  /// Those of the names that stand in the object at `pointer`.
  void warn_of(const std::string& pointer, Names names, const std::string& reason) {
    const Json::json_pointer at(pointer);
    if (!given_.contains(at)) return;
    const Json& object = given_.at(at);
    for (const std::string_view name : names) {
      if (object.contains(name)) warn(pointer + "/" + std::string(name), reason);
    }
  }

  void look_at_models() {
    const auto model = static_cast<Owner>(params_.model);
    for (const auto& [name, value] : given_.items()) {
      const Owner owner = owner_of(name);
      if (owner != Owner::all && owner != model)
        warn("/" + name, "it belongs to the model " + std::string(text_of(static_cast<TreeModel>(owner))) +
                             ", and the model is " + std::string(text_of(params_.model)));
    }
    if (given_.contains("sides") && params_.model == TreeModel::proctree)
      warn("/sides", "the model proctree takes mSegments");
  }

  /// Why there is no leaf in any season; empty where there are some.
  std::string why_bare() const {
    if (params_.leaf.build == TreeBuild::none) return "the build of leaves is none";
    if (params_.model == TreeModel::weber_penn && params_.Leaves == 0) return "`Leaves` is 0";
    if (params_.model == TreeModel::sculpt && params_.sculpt.leaves == 0) return "`sculpt.leaves` is 0";
    return "";
  }

  void look_at_leaf() {
    if (!given_.contains("leaf")) return;
    if (const std::string bare = why_bare(); !bare.empty()) {
      for (const auto& [name, value] : given_["leaf"].items()) {
        if (name != "build") warn("/leaf/" + name, bare);
      }
      return;
    }
    const TreeBuild build = build_of(params_);
    if (build == TreeBuild::card || build == TreeBuild::cross)
      warn_of("/leaf", {"fold", "droop", "coarseness"},
              "it belongs to the builds curved, mesh, twig and bunch, and the build is " +
                  std::string(text_of(build)));
    if (!params_.leaf.images.color.empty()) {
      warn_of("/leaf", {"picture", "color", "autumn"}, "the image `leaf.images.color` takes its place");
    } else if (params_.leaf.evergreen) {
      warn_of("/leaf", {"autumn"}, "evergreen leaves keep their colour");
    }
    look_at_images("/leaf/images", params_.leaf.images);
  }

  void look_at_bark() {
    if (!params_.bark_images.color.empty()) {
      warn_of("", {"bark", "bark_color", "bark_seed"}, "the image `bark_images.color` takes its place");
    } else if (params_.bark == TreeBark::none) {
      warn_of("", {"bark_seed"}, "the bark none has no picture");
    }
    look_at_images("/bark_images", params_.bark_images);
  }

  template <class Images>
  void look_at_images(const std::string& pointer, const Images& images) {
    if (images.cut_out && !has_any(images)) warn(pointer + "/cut_out", "there is no image");
  }

  void look_at_weber_penn() {
    look_at_levels();
    look_at_splits();
    if (params_.Levels == 1)
      warn_of("", {"Shape", "RatioPower", "PruneRatio"}, "`Levels` is 1: the trunk has no limbs");
    if (params_.Leaves == 0) warn_of("", {"LeafScale", "LeafScaleX", "LeafBend"}, "`Leaves` is 0");
    if (params_.Lobes == 0) warn_of("", {"LobeDepth"}, "`Lobes` is 0");
    if (params_.LobeDepth == 0) warn_of("", {"Lobes"}, "`LobeDepth` is 0");
    if (params_.Levels < 3) warn_of("", {"AttractionUp"}, "it bends limbs of level 2, from `Levels` 3 on");
    if (params_.PruneRatio == 0) {
      warn_of("", {"PruneWidth"}, "`PruneRatio` is 0");
      if (params_.crown_shape != 8)
        warn_of("", {"PruneWidthPeak", "PrunePowerLow", "PrunePowerHigh"},
                "`PruneRatio` is 0 and `Shape` is not 8");
    }
    if (params_.sway.wind == 0 && params_.sway.gust == 0)
      warn_of("/sway", {"time"}, "`wind` and `gust` are 0");
  }

  /// Level n of limbs is there from Levels n + 1 on; one before it, its angles are those of the leaves.
  void look_at_levels() {
    for (const auto& [name, value] : given_.items()) {
      if (!is_digit(name[0])) continue;
      const int level = name[0] - '0';
      const std::string_view what = std::string_view(name).substr(1);
      const bool is_of_leaves = what.starts_with("DownAngle") || what.starts_with("Rotate");
      if (level < params_.Levels || (level == params_.Levels && is_of_leaves)) continue;
      warn("/" + name, "`Levels` is " + std::to_string(params_.Levels) + ", and limbs of level " +
                           std::to_string(level) + " are there from " + std::to_string(level + 1) + " on");
    }
  }

  /// The trunk divides at its base too.
  void look_at_splits() {
    const auto levels = weber_penn_levels(params_);
    for (int i = 0; i < std::min<int>(params_.Levels, static_cast<int>(levels.size())); ++i) {
      const std::string level = std::to_string(i);
      if (levels[static_cast<std::size_t>(i)].seg_splits > 0 || (i == 0 && params_.base_splits > 0)) continue;
      const std::string reason =
          i == 0 ? "`0SegSplits` and `0BaseSplits` are 0" : "`" + level + "SegSplits` is 0";
      warn_of("", {level + "SplitAngle", level + "SplitAngleV"}, reason);
    }
  }

  void look_at_sculpt() {
    const TreeSculpt& sculpt = params_.sculpt;
    if (sculpt.leaves == 0)
      warn_of("/sculpt", {"leaf_length", "leaf_width", "leaf_angle"}, "`sculpt.leaves` is 0");
    for (std::size_t i = 0; i < sculpt.level.size(); ++i) {
      const std::string pointer = "/sculpt/level/" + std::to_string(i);
      if (i >= static_cast<std::size_t>(sculpt.levels)) {
        warn(pointer, "`sculpt.levels` is " + std::to_string(sculpt.levels));
      } else if (sculpt.level[i].shape != TreeShape::lathe) {
        warn_of(
            pointer, {"profile"},
            "it belongs to the shape lathe, and the shape is " + std::string(text_of(sculpt.level[i].shape)));
      }
    }
  }

  const TreeParams& params_;
  const Json given_;
  std::vector<Warning> warnings_;
};

}  // namespace

std::vector<Warning> idle_parameters(const TreeParams& params) { return Finder(params).run(); }

}  // namespace seedmesh::tree
