/// Reads species of Arbaro (Wolfram Diestel): XML with one element for each parameter,
///
///   <arbaro> <species name="birch"> <param name="Shape" value="7"/> ... </species> </arbaro>
///
/// Parameters that are not given have Arbaro's defaults.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>

#include "core/import/formats.h"
#include "core/import/weber_penn_species.h"
#include "core/lang/lexer.h"

namespace seedmesh {
namespace {

constexpr const char* names[] = {
    "Shape",          "Levels",        "Scale",          "ScaleV",       "BaseSize",   "Ratio",
    "RatioPower",     "Flare",         "Lobes",          "LobeDepth",    "Leaves",     "LeafDistrib",
    "LeafScale",      "LeafScaleX",    "LeafBend",       "AttractionUp", "PruneRatio", "PruneWidth",
    "PruneWidthPeak", "PrunePowerLow", "PrunePowerHigh", "0Scale",       "0ScaleV",    "0BaseSplits",
    "0Branches",      "0BranchDist"};
constexpr const char* of_levels[] = {"Length",      "LengthV",  "Taper", "SegSplits", "SplitAngle",
                                     "SplitAngleV", "CurveRes", "Curve", "CurveBack", "CurveV"};
constexpr const char* of_branches[] = {"DownAngle", "DownAngleV", "Rotate",
                                       "RotateV",   "Branches",   "BranchDist"};
/// Parameters without an effect here, with the values that have none in Arbaro either.
struct Idle {
  const char* name;
  double value;
};
constexpr Idle idle[] = {{"ZScale", 1},     {"ZScaleV", 0},     {"LeafStemLen", 0.5}, {"Smooth", 0.5},
                         {"0DownAngle", 0}, {"0DownAngleV", 0}, {"0Rotate", 0},       {"0RotateV", 0}};

bool contains(std::span<const char* const> list, std::string_view name) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

bool is_known(const std::string& name) {
  if (contains(names, name)) return true;
  if (name.size() < 2 || name[0] < '0' || name[0] > '3') return false;
  const std::string rest = name.substr(1);
  return contains(of_levels, rest) || (name[0] != '0' && contains(of_branches, rest));
}

void set_defaults(WeberPennSpecies& species) {
  const std::pair<const char*, double> tree[] = {{"Shape", 0},
                                                 {"Levels", 3},
                                                 {"Scale", 10},
                                                 {"ScaleV", 0},
                                                 {"BaseSize", 0.25},
                                                 {"Ratio", 0.05},
                                                 {"RatioPower", 1},
                                                 {"Flare", 0.5},
                                                 {"Lobes", 0},
                                                 {"LobeDepth", 0},
                                                 {"Leaves", 0},
                                                 {"LeafDistrib", 4},
                                                 {"LeafScale", 0.2},
                                                 {"LeafScaleX", 0.5},
                                                 {"LeafBend", 0.3},
                                                 {"AttractionUp", 0},
                                                 {"PruneRatio", 0},
                                                 {"PruneWidth", 0.5},
                                                 {"PruneWidthPeak", 0.5},
                                                 {"PrunePowerLow", 0.5},
                                                 {"PrunePowerHigh", 0.5},
                                                 {"0Scale", 1},
                                                 {"0ScaleV", 0},
                                                 {"0BaseSplits", 0}};
  for (const auto& [name, value] : tree) species.set_default(name, value);
  const int curve_res[] = {3, 3, 1, 1}, branches[] = {1, 10, 5, 5};
  for (int level = 0; level < 4; ++level) {
    const std::string n = std::to_string(level);
    const bool is_trunk = level == 0;
    for (const char* each : of_levels) {
      const std::string_view name = each;
      const double value = name == "Length"     ? (is_trunk ? 1 : 0.5)
                           : name == "Taper"    ? 1
                           : name == "CurveRes" ? curve_res[level]
                                                : 0;
      species.set_default(n + each, value);
    }
    if (!is_trunk) {
      for (const char* each : {"DownAngleV", "RotateV"}) species.set_default(n + each, 0);
      species.set_default(n + "DownAngle", 30);
      species.set_default(n + "Rotate", 120);
      species.set_default(n + "Branches", branches[level]);
      species.set_default(n + "BranchDist", 1);
    }
  }
}

class ArbaroReader {
 public:
  explicit ArbaroReader(ForeignText& source) : source_(source), text_(source.text()), species_(source) {}

  Imported read() {
    for (std::size_t at = text_.find('<'); at < text_.size(); at = text_.find('<', at)) {
      if (text_.substr(at, 4) == "<!--") {
        at = std::min(text_.find("-->", at), text_.size());
        continue;
      }
      const std::size_t end = text_.find('>', at);
      if (end == std::string_view::npos) {
        source_.report(at, "found `<` without its `>`");
        break;
      }
      element({at, end});
      at = end;
    }
    if (species_count_ == 0) source_.report(0, "found no species; expected `<species name=\"...\">`");
    set_defaults(species_);
    Imported imported = species_.made(0);
    apply_leaf_quality(imported.request["parameters"]);
    imported.request["parameters"]["leaf"] = {{"shape", leaf_}};
    imported.request["parameters"]["counting"] = "arbaro";
    return imported;
  }

 private:
  /// Arbaro makes only this share of the leaves, and makes them larger, so that their area is the same.
  void apply_leaf_quality(Json& parameters) {
    if (leaf_quality_ == 1) return;
    const double leaves = parameters["Leaves"].get<double>() * leaf_quality_;
    const double whole = leaves < 0 ? std::ceil(leaves - 0.5) : std::floor(leaves + 0.5);
    if (std::abs(whole - leaves) > 1e-9)
      source_.warn(leaf_quality_at_, "`Leaves` times `LeafQuality` is rounded to a whole number here");
    parameters["Leaves"] = static_cast<std::int64_t>(std::clamp(whole, -1e9, 1e9));
    parameters["LeafScale"] = parameters["LeafScale"].get<double>() / std::sqrt(leaf_quality_);
  }

  /// The value of an attribute, and where it begins; nullopt without it.
  std::optional<Line> attribute(Line element, std::string_view name) const {
    const std::string_view inside = text_.substr(element.from, element.to - element.from);
    for (std::size_t at = inside.find(name); at != std::string_view::npos; at = inside.find(name, at + 1)) {
      std::size_t quote = at + name.size();
      while (quote < inside.size() && is_blank(inside[quote])) ++quote;
      if (quote == inside.size() || inside[quote] != '=' || at == 0 || !is_blank(inside[at - 1])) continue;
      ++quote;
      while (quote < inside.size() && is_blank(inside[quote])) ++quote;
      if (quote == inside.size() || (inside[quote] != '"' && inside[quote] != '\'')) continue;
      const std::size_t close = inside.find(inside[quote], quote + 1);
      if (close == std::string_view::npos) return std::nullopt;
      return Line{element.from + quote + 1, element.from + close};
    }
    return std::nullopt;
  }

  void element(Line line) {
    std::size_t end = line.from + 1;
    while (end < line.to && (is_letter(text_[end]) || text_[end] == '?' || text_[end] == '/')) ++end;
    const std::string_view name = text_.substr(line.from + 1, end - line.from - 1);
    if (name == "species" && ++species_count_ == 2)
      source_.report(line.from, "found a second species, expected one");
    if (name != "param") return;
    const std::optional<Line> parameter = attribute(line, "name"), value = attribute(line, "value");
    if (!parameter || !value) {
      source_.report(line.from, "expected `<param name=\"...\" value=\"...\"/>`");
      return;
    }
    set(std::string(text_.substr(parameter->from, parameter->to - parameter->from)), parameter->from, *value);
  }

  void set(const std::string& name, std::size_t at, Line value) {
    const std::string_view text = text_.substr(value.from, value.to - value.from);
    double number = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
    const bool is_number = !text.empty() && read.ec == std::errc() && read.ptr == text.data() + text.size();
    if (name == "LeafShape") return set_leaf(text, is_number ? number : 0, value.from);
    if (name == "Species") return;
    if (name == "BarkTexture" || name.starts_with("LeafTexture")) {
      source_.warn(value.from, "`" + name + "` belongs to an image that does not exist here");
      return;
    }
    if (!is_number || !std::isfinite(number)) {
      source_.report(value.from, "found " + lang::in_quotes(text) + ", expected a number");
      return;
    }
    if (name == "LeafQuality") {
      if (number > 0 && number <= 1) {
        leaf_quality_ = number;
      } else {
        source_.report(value.from,
                       "found " + std::string(text) + ", expected a number above 0 and at most 1");
      }
      leaf_quality_at_ = value.from;
      return;
    }
    for (const Idle& each : idle) {
      if (name != each.name) continue;
      if (number != each.value) source_.warn(value.from, "`" + name + "` has no counterpart");
      return;
    }
    if (!is_known(name)) {
      source_.report(at, lang::in_quotes(name) + " is no parameter of Arbaro", IssueKind::unknown_key);
      return;
    }
    if (number > 1 && name.ends_with("BranchDist") && name[0] != '0') {
      source_.warn(value.from, "limbs are distributed over at most one segment here");
      number = 1;
    }
    if (constexpr double most_lobes = 16; name == "Lobes" && number > most_lobes) {
      source_.warn(value.from, "a trunk has at most 16 ribs here");
      number = most_lobes;
    }
    species_.set(name, number, value.from);
  }

  /// The shapes are discs of two to nine corners and spheres.
  void set_leaf(std::string_view text, double number, std::size_t at) {
    if (text == "0" || text == "disc" || text == "disc1") return;
    if (text == "sphere" || text == "box" || number >= 9) source_.warn(at, "leaves are flat in Seedmesh");
    if (text == "disc3" || number == 3 || text == "triangle") leaf_ = "cordate";
    if (text == "disc4" || number == 4 || text == "square") leaf_ = "kite";
  }

  ForeignText& source_;
  std::string_view text_;
  WeberPennSpecies species_;
  std::string leaf_ = "simple";
  int species_count_ = 0;
  double leaf_quality_ = 1;
  std::size_t leaf_quality_at_ = 0;
};

}  // namespace

int marks_of_arbaro(std::string_view text) {
  int marks = 0;
  if (text.find("<arbaro") != std::string_view::npos) marks += 8;
  if (text.find("<species") != std::string_view::npos) marks += 4;
  return marks;
}

Result<Imported> import_arbaro(std::string_view text, const ImportOptions& options) {
  if (std::optional<Error> error = entry_error(options, "a file of Arbaro contains one species"))
    return *std::move(error);
  ForeignText source(text);
  Imported imported = ArbaroReader(source).read();
  return source.finish(std::move(imported));
}

}  // namespace seedmesh
