/// Reads species of tree-gen (Charlie Hewitt, "Procedural generation of tree models for use in computer graphics", 2017)
/// and presets of Blender's Sapling: a dictionary of Python, alone or as `params = { ... }`,
///
///   {'shape': 7, 'g_scale': 13, 'branches': [0, 50, 30, 10], ...}      tree-gen
///   {'shape': '7', 'scale': 13.0, 'branches': (0, 50, 30, 10), ...}     Sapling
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <span>

#include "core/import/dictionary.h"
#include "core/import/formats.h"
#include "core/import/weber_penn_species.h"
#include "core/lang/lexer.h"

namespace seedmesh {
namespace {

/// A number of the dictionary and its position.
struct Member {
  double value = 0;
  std::size_t at = 0;
};

struct Row {
  const char* theirs;
  const char* ours;
};
constexpr Row of_tree[] = {{"shape", "Shape"},
                           {"levels", "Levels"},
                           {"g_scale", "Scale"},
                           {"scale", "Scale"},
                           {"g_scale_v", "ScaleV"},
                           {"scaleV", "ScaleV"},
                           {"ratio", "Ratio"},
                           {"ratio_power", "RatioPower"},
                           {"ratioPower", "RatioPower"},
                           {"flare", "Flare"},
                           {"base_splits", "0BaseSplits"},
                           {"baseSplits", "0BaseSplits"},
                           {"leaf_blos_num", "Leaves"},
                           {"leaves", "Leaves"},
                           {"leaf_scale", "LeafScale"},
                           {"leafScale", "LeafScale"},
                           {"leaf_scale_x", "LeafScaleX"},
                           {"leafScaleX", "LeafScaleX"},
                           {"leaf_bend", "LeafBend"},
                           {"bend", "LeafBend"},
                           {"prune_ratio", "PruneRatio"},
                           {"pruneRatio", "PruneRatio"},
                           {"prune_width", "PruneWidth"},
                           {"pruneWidth", "PruneWidth"},
                           {"prune_width_peak", "PruneWidthPeak"},
                           {"pruneWidthPeak", "PruneWidthPeak"},
                           {"prune_power_low", "PrunePowerLow"},
                           {"prunePowerLow", "PrunePowerLow"},
                           {"prune_power_high", "PrunePowerHigh"},
                           {"prunePowerHigh", "PrunePowerHigh"},
                           {"scale0", "0Scale"},
                           {"scaleV0", "0ScaleV"}};
constexpr Row of_levels[] = {
    {"length", "Length"},         {"length_v", "LengthV"},          {"taper", "Taper"},
    {"seg_splits", "SegSplits"},  {"segSplits", "SegSplits"},       {"split_angle", "SplitAngle"},
    {"splitAngle", "SplitAngle"}, {"split_angle_v", "SplitAngleV"}, {"splitAngleV", "SplitAngleV"},
    {"curve_res", "CurveRes"},    {"curveRes", "CurveRes"},         {"curve", "Curve"},
    {"curve_back", "CurveBack"},  {"curveBack", "CurveBack"},       {"curve_v", "CurveV"},
    {"curveV", "CurveV"}};
constexpr Row of_branches[] = {
    {"down_angle", "DownAngle"},  {"downAngle", "DownAngle"}, {"down_angle_v", "DownAngleV"},
    {"downAngleV", "DownAngleV"}, {"rotate", "Rotate"},       {"rotate_v", "RotateV"},
    {"rotateV", "RotateV"},       {"branches", "Branches"},   {"branch_dist", "Whorl"}};
/// What does not change the tree: how it is shown and saved, and flowers, whose rate alone decides.
constexpr const char* silent[] = {
    "bevel",         "bevelRes", "resU",      "handleType", "showLeaves",  "makeMesh",       "armAnim",
    "previewArm",    "useArm",   "chooseSet", "presetName", "limitImport", "overwrite",      "blossom_shape",
    "blossom_scale", "prune",    "closeTip",  "leaf_name",  "name",        "useOldDownAngle"};
/// Factors and exponents of which 1 changes nothing.
constexpr const char* neutral_at_one[] = {"radius_mod", "radiusTweak", "rootFlare", "branchDist"};
/// Names that only Sapling has.
constexpr const char* of_sapling[] = {"ratioPower", "curveRes",  "baseSize",
                                      "scaleV",     "downAngle", "handleType"};
/// The shapes of leaves by tree-gen's numbers.
constexpr std::array<const char*, 11> leaf_shapes = {"simple", "simple",  "willow", "cordate",
                                                     "maple",  "palmate", "lobed",  "lobed",
                                                     "simple", "simple",  "kite"};

const char* find(std::span<const Row> rows, std::string_view name) {
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.theirs == name; });
  return found == rows.end() ? nullptr : found->ours;
}

/// Sapling's crown of its own (`customShape`) at the position `r` from the base, 0, to the top, 1, of the crown: lengths at
/// the base, in the middle and at the top, and as third number the position of the middle.
double custom_crown(const std::array<double, 4>& custom, double r) {
  if (r >= custom[2]) {
    const double share = custom[2] < 1 ? (r - custom[2]) / (1 - custom[2]) : 1;
    return custom[1] + share * share * (custom[3] - custom[1]);
  }
  const double left = 1 - r / custom[2];
  return custom[0] + (1 - left * left) * (custom[1] - custom[0]);
}

/// The crown shapes of Weber and Penn but those of a sphere, whose ratio is 1 at the base of the crown.
double crown_of(int shape, double ratio) {
  switch (shape) {
    case 0:
      return 0.2 + 0.8 * ratio;
    case 3:
      return 1;
    case 4:
      return 0.5 + 0.5 * ratio;
    case 5:
      return ratio <= 0.7 ? ratio / 0.7 : (1 - ratio) / 0.3;
    case 6:
      return 1 - 0.8 * ratio;
    default:
      return ratio <= 0.7 ? 0.5 + 0.5 * ratio / 0.7 : 0.5 + 0.5 * (1 - ratio) / 0.3;
  }
}

class TreeGenReader {
 public:
  explicit TreeGenReader(ForeignText& source) : source_(source), species_(source) {}

  Imported read() {
    const std::vector<DictionaryEntry> entries = read_dictionary(source_);
    for (const DictionaryEntry& each : entries) {
      names_.insert(each.name);
      if (each.name == "prune" && !each.numbers.empty()) prunes_ = each.numbers[0] != 0;
    }
    is_sapling_ = std::any_of(std::begin(of_sapling), std::end(of_sapling),
                              [&](const char* name) { return names_.contains(name); });
    if (is_sapling_ && !names_.contains("prune")) prunes_ = false;
    for (const DictionaryEntry& each : entries) {
      if (!(is_sapling_ && is_of_sapling(each))) entry(each);
    }
    if (is_sapling_) set_sapling(entries);
    if (!names_.contains("shape")) source_.report(0, "found no member `shape`, which every species has");
    set_defaults();
    Imported imported = species_.made(seed_);
    if (is_sapling_) imported.request["parameters"]["counting"] = "sapling";
    if (!leaf_.empty()) imported.request["parameters"]["leaf"] = {{"shape", leaf_}};
    if (names_.contains("showLeaves") && !shows_leaves_)
      imported.request["parameters"]["leaf"] = {{"build", "none"}};
    return imported;
  }

 private:
  void entry(const DictionaryEntry& each) {
    const bool is_single = !each.is_list && each.numbers.size() == 1;
    if (const char* ours = find(of_tree, each.name); ours && is_single) {
      const bool is_off = each.name == "pruneRatio" && !prunes_;
      return species_.set(ours, is_off ? 0 : each.numbers[0], each.at[0]);
    }
    if (const char* ours = find(of_levels, each.name); ours && each.is_list) return set_levels(each, ours, 0);
    if (const char* ours = find(of_branches, each.name); ours && each.is_list)
      return set_levels(each, ours, 1);
    if (each.name == "base_size") {
      base_size(each);
    } else if (each.name == "floor_splits" && is_single) {
      set_trunks(each.numbers[0] + 1, each.at[0]);
    } else if (each.name == "leafDist" && is_single && each.numbers[0] >= 0 && each.numbers[0] <= 7) {
      species_.set("LeafDistrib", each.numbers[0], each.at[0]);
    } else if (each.name == "leaf_shape" && is_single) {
      leaf_ = leaf_shape_of(each.numbers[0], leaf_shapes);
    } else if ((each.name == "tropism" || each.name == "attractUp") && !each.numbers.empty()) {
      const std::size_t last = each.name == "tropism" ? each.numbers.size() - 1
                                                      : std::min<std::size_t>(each.numbers.size() - 1, 2);
      species_.set("AttractionUp", each.numbers[last], each.at[last]);
      if (each.name == "tropism" && each.numbers.size() == 3 &&
          (each.numbers[0] != 0 || each.numbers[1] != 0))
        source_.warn(each.name_at, "limbs bend up or down only, not sideways");
    } else if (each.name == "seed" && is_single && each.numbers[0] >= 0) {
      seed_ = static_cast<std::uint64_t>(std::min(each.numbers[0], 9e15));
    } else if (each.name == "showLeaves" && is_single) {
      shows_leaves_ = each.numbers[0] != 0;
    } else if (changes_the_tree(each)) {
      source_.warn(each.name_at, lang::in_quotes(shortened(each.name, 40)) + " has no counterpart");
    }
  }

  void set_levels(const DictionaryEntry& each, const std::string& ours, std::size_t first) {
    if (ours == "Branches" && !is_sapling_ && !each.numbers.empty() && each.numbers[0] > 1)
      set_trunks(each.numbers[0], each.at[0]);
    for (std::size_t i = first; i < each.numbers.size() && i < 4; ++i) {
      double value = each.numbers[i];
      // 0: alternate limbs; 1: pairs; n: whorls of n + 1; between them, the number is rounded here.
      if (ours == "Whorl") value = std::floor(std::clamp(value, 0.0, 40.0) + 0.5) + 1;
      species_.set(std::to_string(i) + ours, value, each.at[i]);
    }
  }

  static bool changes_the_tree(const DictionaryEntry& each) {
    const auto is_in = [&](const auto& names) {
      return std::find(std::begin(names), std::end(names), each.name) != std::end(names);
    };
    const double neutral = is_in(neutral_at_one) ? 1 : 0;
    return !is_in(silent) && std::any_of(each.numbers.begin(), each.numbers.end(),
                                         [neutral](double x) { return x != neutral; });
  }

  void base_size(const DictionaryEntry& each) {
    for (std::size_t i = 0; i < each.numbers.size() && i < 4; ++i)
      species_.set(i == 0 ? "BaseSize" : std::to_string(i) + "BaseSize", each.numbers[i], each.at[i]);
  }

  /// Members that set_sapling() reads.
  static bool is_of_sapling(const DictionaryEntry& each) {
    constexpr const char* names[] = {"baseSize",    "baseSize_s", "downAngle",     "downAngleV",
                                     "customShape", "lengthV",    "leafDownAngle", "leafDownAngleV",
                                     "leafRotate",  "leafRotateV"};
    return std::find(std::begin(names), std::end(names), each.name) != std::end(names);
  }

  void set_sapling(const std::vector<DictionaryEntry>& entries) {
    const auto member = [&](std::string_view name, std::size_t i) -> std::optional<Member> {
      const auto found = std::ranges::find(entries, name, &DictionaryEntry::name);
      if (found == entries.end() || i >= found->numbers.size()) return std::nullopt;
      return Member{found->numbers[i], found->at[i]};
    };
    const int levels = static_cast<int>(std::clamp(species_.value("Levels", 3), 0.0, 9.0));
    if (species_.value("Shape", 0) == 8) {
      std::array<double, 4> custom = {0.5, 1, 0.3, 0.5};
      for (std::size_t i = 0; i < 4; ++i) {
        if (const auto number = member("customShape", i)) custom[i] = std::clamp(number->value, 0.0, 1.0);
      }
      const auto shape = member("shape", 0);
      set_crown(custom, shape ? shape->at : 0);
    }
    // Each level has the share `baseSize_s` of the base of the level before, and the last level has none.
    if (auto base = member("baseSize", 0)) {
      species_.set("BaseSize", base->value, base->at);
      const std::optional<Member> factor = member("baseSize_s", 0);
      for (int level = 1; factor && level + 1 < levels && level < 4; ++level) {
        base->value *= factor->value;
        species_.set(std::to_string(level) + "BaseSize", base->value, factor->at);
      }
    }
    // The variation of lengths is a share of the length.
    for (std::size_t level = 0; level < 4; ++level) {
      if (const auto spread = member("lengthV", level)) {
        const auto length = member("length", level);
        species_.set(std::to_string(level) + "LengthV", spread->value * (length ? length->value : 1),
                     spread->at);
      }
    }
    const auto is_old = member("useOldDownAngle", 0);
    for (int level = 1; level < 4; ++level) {
      const bool is_of_leaves = level == levels && names_.contains("leafDownAngle");
      const std::size_t i = is_of_leaves ? 0 : static_cast<std::size_t>(level);
      const std::string n = std::to_string(level);
      set_down_angles(n, member(is_of_leaves ? "leafDownAngle" : "downAngle", i),
                      member(is_of_leaves ? "leafDownAngleV" : "downAngleV", i),
                      is_of_leaves || (is_old && is_old->value == 0));
      if (!is_of_leaves) continue;
      if (const auto turn = member("leafRotate", 0)) species_.replace(n + "Rotate", turn->value, turn->at);
      if (const auto spread = member("leafRotateV", 0))
        species_.replace(n + "RotateV", spread->value, spread->at);
    }
  }

  /// The crown shape that is most similar to one of Sapling's own, with the factor between them.
  void set_crown(const std::array<double, 4>& custom, std::size_t at) {
    double best = -1, factor = 1;
    int nearest = 7;
    for (const int shape : {0, 3, 4, 5, 6, 7}) {
      double both = 0, own = 0, theirs = 0;
      for (int i = 0; i < 100; ++i) {
        const double r = (i + 0.5) / 100, a = custom_crown(custom, r), b = crown_of(shape, 1 - r);
        both += a * b;
        own += b * b;
        theirs += a * a;
      }
      const double likeness = theirs > 0 ? both * both / (own * theirs) : 0;
      if (likeness <= best) continue;
      best = likeness;
      factor = both / own;
      nearest = shape;
    }
    species_.replace("Shape", nearest, at);
    species_.replace("1Length", factor * species_.value("1Length", 0.3), at);
    source_.warn(at, "shape 8 of Sapling is `customShape`; the most similar shape is used, which is " +
                         std::to_string(nearest));
  }

  /// Newer versions of Sapling have other signs: a negative variation is random, and a positive one is subtracted
  /// toward the tip of the parent. Weber and Penn's formula goes from D + |V| at the base to D - 0.6 |V| at the tip.
  void set_down_angles(const std::string& level, std::optional<Member> down, std::optional<Member> variation,
                       bool is_new) {
    if (is_new && variation && variation->value < 0) {
      variation->value = -variation->value;
    } else if (is_new && variation) {
      variation->value /= -1.6;
      if (down) down->value += variation->value;
    }
    if (down) species_.set(level + "DownAngle", down->value, down->at);
    if (variation) species_.set(level + "DownAngleV", variation->value, variation->at);
  }

  void set_trunks(double count, std::size_t at) {
    trunks_ = count;
    trunks_at_ = at;
  }

  void set_defaults() {
    species_.set_default("Lobes", 0);
    species_.set_default("LeafBend", 0);
    if (is_sapling_) {
      species_.set_default("LeafDistrib", 6);
      species_.set_default("AttractionUp", 0);
      species_.set_default("Flare", 0);
    } else {
      species_.set_default("BaseSize", 0.3);
      for (const char* name : {"1BaseSize", "2BaseSize", "3BaseSize"}) species_.set_default(name, 0.02);
      species_.set_default("0CurveRes", 5);
      if (species_.value("0SegSplits", 0) != 0 || species_.value("0BaseSplits", 0) != 0) {
        species_.set_default("0SplitAngle", 40);
        species_.set_default("0SplitAngleV", 5);
      }
    }
    if (trunks_ <= 1) return;
    // Trunks stand within a circle, whose radius follows from their number and thickness.
    species_.set("0Branches", trunks_, trunks_at_);
    const double thickness = std::max(0.0, species_.value("Scale", 13) * species_.value("Ratio", 0.015));
    species_.set_default("0BranchDist", std::sqrt(std::min(trunks_, 1e3) / 2.5 * std::min(thickness, 1e3)));
  }

  ForeignText& source_;
  WeberPennSpecies species_;
  std::set<std::string> names_;
  std::uint64_t seed_ = 0;
  bool shows_leaves_ = true, prunes_ = true, is_sapling_ = false;
  double trunks_ = 1;
  std::size_t trunks_at_ = 0;
  std::string leaf_;
};

}  // namespace

int marks_of_tree_gen(std::string_view text) {
  int marks = 0;
  for (const char* each :
       {"'g_scale'", "'ratio_power'", "'leaf_blos_num'", "'ratioPower'", "'curveRes'", "'branches'",
        "'curve_res'", "\"g_scale\"", "\"curve_res\"", "\"ratioPower\"", "\"curveRes\""}) {
    if (text.find(each) != std::string_view::npos) marks += 4;
  }
  return marks;
}

Result<Imported> import_tree_gen(std::string_view text, const ImportOptions& options) {
  if (std::optional<Error> error = entry_error(options, "a file of tree-gen or Sapling contains one species"))
    return *std::move(error);
  ForeignText source(text);
  Imported imported = TreeGenReader(source).read();
  return source.finish(std::move(imported));
}

}  // namespace seedmesh
