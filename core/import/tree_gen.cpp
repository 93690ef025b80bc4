/// Reads species of tree-gen (Charlie Hewitt, "Procedural generation of tree models for use in computer graphics", 2017)
/// and presets of Blender's Sapling: a dictionary of Python, alone or as `params = { ... }`,
///
///   {'shape': 7, 'g_scale': 13, 'branches': [0, 50, 30, 10], ...}      tree-gen
///   {'shape': '7', 'scale': 13.0, 'branches': (0, 50, 30, 10), ...}     Sapling
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <set>
#include <span>

#include "core/import/formats.h"
#include "core/import/weber_penn_species.h"
#include "core/lang/lexer.h"

namespace seedmesh {
namespace {

constexpr std::size_t most_values = 10'000;

/// A value of the dictionary: numbers (True is 1), one without brackets.
struct Entry {
  std::string name;
  std::size_t name_at = 0;
  std::vector<double> numbers;
  std::vector<std::size_t> at;  ///< of the numbers
  bool is_list = false;
};

/// Reads the dictionary. Texts count as the number that they hold, or as nothing.
class DictionaryReader {
 public:
  explicit DictionaryReader(ForeignText& source) : source_(source), text_(source.text()) {}

  std::vector<Entry> read() {
    std::vector<Entry> entries;
    at_ = open_of_dictionary();
    if (at_ == text_.size()) {
      source_.report(0, "found no dictionary; expected `{'shape': 7, ...}`");
      return entries;
    }
    ++at_;
    for (skip(); at_ < text_.size() && text_[at_] != '}' && entries.size() < most_values; skip()) {
      Entry entry;
      entry.name_at = at_;
      const std::optional<std::string> name = quoted();
      skip();
      if (!name || at_ == text_.size() || text_[at_] != ':') {
        source_.report(entry.name_at, "expected a name in quotes and a colon, such as `'shape': 7`");
        return entries;
      }
      ++at_;
      entry.name = *name;
      if (!value(entry)) return entries;
      entries.push_back(std::move(entry));
      skip();
      if (at_ < text_.size() && text_[at_] == ',') ++at_;
    }
    if (at_ >= text_.size()) source_.report(text_.size(), "found `{` without its `}`");
    return entries;
  }

 private:
  /// The first brace outside of texts and comments.
  std::size_t open_of_dictionary() {
    at_ = 0;
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '{') return at_;
      if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (c == '"' || c == '\'') {
        if (!quoted()) ++at_;
      } else {
        ++at_;
      }
    }
    return at_;
  }

  void skip() {
    while (at_ < text_.size() && (is_blank(text_[at_]) || text_[at_] == '#')) {
      if (text_[at_] == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else {
        ++at_;
      }
    }
  }

  /// A text in one or three quotes of either kind.
  std::optional<std::string> quoted() {
    if (at_ == text_.size() || (text_[at_] != '"' && text_[at_] != '\'')) return std::nullopt;
    const std::string three(3, text_[at_]);
    const std::string mark = text_.substr(at_, 3) == three ? three : three.substr(0, 1);
    const std::size_t end = text_.find(mark, at_ + mark.size());
    if (end == std::string_view::npos) return std::nullopt;
    const std::string inside(text_.substr(at_ + mark.size(), end - at_ - mark.size()));
    at_ = end + mark.size();
    return inside;
  }

  bool value(Entry& entry) {
    skip();
    const char open = at_ < text_.size() ? text_[at_] : ' ';
    entry.is_list = open == '[' || open == '(';
    if (!entry.is_list) return number(entry);
    const char close = open == '[' ? ']' : ')';
    ++at_;
    for (skip(); at_ < text_.size() && text_[at_] != close && entry.numbers.size() < most_values; skip()) {
      if (!number(entry)) return false;
      skip();
      if (at_ < text_.size() && text_[at_] == ',') ++at_;
    }
    if (at_ == text_.size()) source_.report(entry.name_at, "found a list without its end");
    ++at_;
    return at_ <= text_.size();
  }

  bool number(Entry& entry) {
    const std::size_t begin = at_;
    std::string word;
    if (std::optional<std::string> text = quoted()) {
      word = *text;
    } else {
      while (at_ < text_.size() && (is_letter(text_[at_]) || is_digit(text_[at_]) || text_[at_] == '.' ||
                                    text_[at_] == '-' || text_[at_] == '+' || text_[at_] == '_'))
        ++at_;
      word = text_.substr(begin, at_ - begin);
      if (word.empty()) {
        source_.report(begin, "expected a number, a text or a list");
        return false;
      }
    }
    double found = word == "True" ? 1 : 0;
    const bool is_word =
        word == "True" || word == "False" || word == "None" || text_[begin] == '\'' || text_[begin] == '"';
    const auto read = std::from_chars(word.data(), word.data() + word.size(), found);
    if (!is_word && (read.ec != std::errc() || !std::isfinite(found))) {
      source_.report(begin, "found " + lang::in_quotes(word) + ", expected a number");
      return false;
    }
    entry.numbers.push_back(std::isfinite(found) ? found : 0);
    entry.at.push_back(begin);
    return true;
  }

  ForeignText& source_;
  std::string_view text_;
  std::size_t at_ = 0;
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
constexpr Row of_levels[] = {{"length", "Length"},
                             {"length_v", "LengthV"},
                             {"lengthV", "LengthV"},
                             {"taper", "Taper"},
                             {"seg_splits", "SegSplits"},
                             {"segSplits", "SegSplits"},
                             {"split_angle", "SplitAngle"},
                             {"splitAngle", "SplitAngle"},
                             {"split_angle_v", "SplitAngleV"},
                             {"splitAngleV", "SplitAngleV"},
                             {"curve_res", "CurveRes"},
                             {"curveRes", "CurveRes"},
                             {"curve", "Curve"},
                             {"curve_back", "CurveBack"},
                             {"curveBack", "CurveBack"},
                             {"curve_v", "CurveV"},
                             {"curveV", "CurveV"}};
constexpr Row of_branches[] = {
    {"down_angle", "DownAngle"},  {"downAngle", "DownAngle"}, {"down_angle_v", "DownAngleV"},
    {"downAngleV", "DownAngleV"}, {"rotate", "Rotate"},       {"rotate_v", "RotateV"},
    {"rotateV", "RotateV"},       {"branches", "Branches"},   {"branch_dist", "Whorl"}};
/// What does not change the tree: how it is shown and saved, and flowers, whose rate alone decides.
constexpr const char* silent[] = {"bevel",      "bevelRes",    "resU",       "handleType",    "showLeaves",
                                  "makeMesh",   "armAnim",     "previewArm", "useArm",        "chooseSet",
                                  "presetName", "limitImport", "overwrite",  "blossom_shape", "blossom_scale",
                                  "prune",      "closeTip",    "leaf_name",  "name"};
/// The shapes of leaves by tree-gen's numbers.
constexpr std::array<const char*, 11> leaf_shapes = {"simple", "simple",  "willow", "cordate",
                                                     "maple",  "palmate", "lobed",  "lobed",
                                                     "simple", "simple",  "kite"};

const char* find(std::span<const Row> rows, std::string_view name) {
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return row.theirs == name; });
  return found == rows.end() ? nullptr : found->ours;
}

class TreeGenReader {
 public:
  explicit TreeGenReader(ForeignText& source) : source_(source), species_(source) {}

  Imported read() {
    const std::vector<Entry> entries = DictionaryReader(source_).read();
    for (const Entry& each : entries) {
      names_.insert(each.name);
      if (each.name == "prune" && !each.numbers.empty()) prunes_ = each.numbers[0] != 0;
    }
    for (const Entry& each : entries) entry(each);
    if (!names_.contains("shape")) source_.report(0, "found no member `shape`, which every species has");
    set_defaults();
    Imported imported = species_.made(seed_);
    if (!leaf_.empty()) imported.request["parameters"]["leaf"] = {{"shape", leaf_}};
    if (names_.contains("showLeaves") && !shows_leaves_)
      imported.request["parameters"]["leaf"] = {{"build", "none"}};
    return imported;
  }

 private:
  void entry(const Entry& each) {
    const bool is_single = !each.is_list && each.numbers.size() == 1;
    if (const char* ours = find(of_tree, each.name); ours && is_single) {
      const bool is_off = each.name == "pruneRatio" && !prunes_;
      return species_.set(ours, is_off ? 0 : each.numbers[0], each.at[0]);
    }
    if (const char* ours = find(of_levels, each.name); ours && each.is_list) return set_levels(each, ours, 0);
    if (const char* ours = find(of_branches, each.name); ours && each.is_list)
      return set_levels(each, ours, 1);
    if (each.name == "base_size" || each.name == "baseSize" || each.name == "baseSize_s") {
      base_size(each);
    } else if (each.name == "floor_splits" && is_single) {
      set_trunks(each.numbers[0] + 1, each.at[0]);
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
    } else if (std::find(std::begin(silent), std::end(silent), each.name) == std::end(silent) &&
               std::any_of(each.numbers.begin(), each.numbers.end(), [](double x) { return x != 0; })) {
      source_.warn(each.name_at, lang::in_quotes(shortened(each.name, 40)) + " has no counterpart");
    }
  }

  void set_levels(const Entry& each, const std::string& ours, std::size_t first) {
    if (ours == "Branches" && !each.numbers.empty() && each.numbers[0] > 1)
      set_trunks(each.numbers[0], each.at[0]);
    for (std::size_t i = first; i < each.numbers.size() && i < 4; ++i) {
      double value = each.numbers[i];
      // 0: alternate limbs; 1: pairs; n: whorls of n + 1; between them, the number is rounded here.
      if (ours == "Whorl") value = std::floor(std::clamp(value, 0.0, 40.0) + 0.5) + 1;
      species_.set(std::to_string(i) + ours, value, each.at[i]);
    }
  }

  void base_size(const Entry& each) {
    for (std::size_t i = 0; i < each.numbers.size() && i < 4; ++i) {
      const std::size_t level = each.name == "baseSize_s" ? 1 : i;
      species_.set(level == 0 ? "BaseSize" : std::to_string(level) + "BaseSize", each.numbers[i], each.at[i]);
    }
  }

  void set_trunks(double count, std::size_t at) {
    trunks_ = count;
    trunks_at_ = at;
  }

  void set_defaults() {
    species_.set_default("Lobes", 0);
    if (trunks_ <= 1) return set_flare();
    // Trunks stand within a circle, whose radius follows from their number and thickness.
    species_.set("0Branches", trunks_, trunks_at_);
    const double thickness = std::max(0.0, species_.value("Scale", 13) * species_.value("Ratio", 0.015));
    species_.set_default("0BranchDist", std::sqrt(std::min(trunks_, 1e3) / 2.5 * std::min(thickness, 1e3)));
    set_flare();
  }

  /// Sapling's trees have none.
  void set_flare() {
    if (!names_.contains("flare")) species_.set_default("Flare", 0);
  }

  ForeignText& source_;
  WeberPennSpecies species_;
  std::set<std::string> names_;
  std::uint64_t seed_ = 0;
  bool shows_leaves_ = true, prunes_ = true;
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
