/// Reads trees of proctree (Paul Brunt, 2012) and of programs like it: a JSON object with its 22 parameters. Names are
/// those of proctree.js, such as "levels", or of its C++ translation, such as "mLevels". The latter are also the names
/// of listing 2.1 of Hutsko's thesis (2022) and of the schema.
#include <algorithm>
#include <array>
#include <map>

#include "core/base/math.h"
#include "core/generators/tree/tree.h"
#include "core/import/foreign_text.h"
#include "core/import/formats.h"
#include "core/import/proctree_file.h"
#include "core/schema/color.h"
#include "core/schema/nearest.h"
#include "generated/params/tree.h"

namespace seedmesh {
namespace {

struct Parameter {
  std::string_view name;
  double value;  ///< in proctree.js and its translation, where a file lacks the parameter
};
constexpr std::array<Parameter, 22> parameters{{
    {"mSeed", 10},
    {"mSegments", 6},
    {"mLevels", 3},
    {"mVMultiplier", 0.2},
    {"mTwigScale", 2},
    {"mInitialBranchLength", 0.85},
    {"mLengthFalloffFactor", 0.85},
    {"mLengthFalloffPower", 1},
    {"mClumpMax", 0.8},
    {"mClumpMin", 0.5},
    {"mBranchFactor", 2},
    {"mDropAmount", 0},
    {"mGrowAmount", 0},
    {"mSweepAmount", 0},
    {"mMaxRadius", 0.25},
    {"mClimbRate", 1.5},
    {"mTrunkKink", 0},
    {"mTreeSteps", 2},
    {"mTaperRate", 0.95},
    {"mRadiusFalloffRate", 0.6},
    {"mTwistRate", 13},
    {"mTrunkLength", 2.5},
}};
constexpr std::array<std::string_view, 2> materials = {"trunkMaterial", "twigMaterial"};
// Colours of pages that show such trees with three.js: 0x9d7362 as a number, or a text.
constexpr std::array<std::string_view, 2> colors = {"treeColor", "twigColor"};
// The state of the random sequence, which proctree.js sets to the seed.
constexpr std::string_view state = "rseed";

/// The names of the schema by all names in files.
std::map<std::string, std::string_view, std::less<>> known_names() {
  std::map<std::string, std::string_view, std::less<>> names;
  for (const Parameter& parameter : parameters) {
    names.emplace(parameter.name, parameter.name);
    names.emplace(proctree_js_name(parameter.name), parameter.name);
  }
  names.emplace("initialBranchLength", "mInitialBranchLength");
  return names;
}

/// The text of a colour; empty if the value is none.
std::string color_text(const Json& value) {
  if (value.is_string()) return color_of(value.get<std::string>()) ? value.get<std::string>() : std::string();
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > 0xffffff) return {};
  const auto number = value.get<std::uint32_t>();
  const auto channel = [&](unsigned shift) { return static_cast<std::uint8_t>(number >> shift & 255U); };
  return text_of(Color{channel(16), channel(8), channel(0)});
}

/// Whole numbers stay whole numbers.
Json number_of(double value) {
  const auto whole = math::to_int32(value);
  return whole == value ? Json(whole) : Json(value);
}

/// The message for an unknown name, with a hint.
std::string unknown_name(const std::string& name) {
  const auto names = known_names();
  std::vector<std::string_view> words(materials.begin(), materials.end());
  for (const auto& [known, parameter] : names) words.push_back(known);
  const std::string_view nearest = schema::nearest_word(name, words);
  const std::string message = "\"" + shortened(name, 40) + "\" is not a parameter of proctree";
  return nearest.empty() ? message : message + "; did you mean \"" + std::string(nearest) + "\"?";
}

}  // namespace

int marks_of_proctree(std::string_view text) {
  if (text.size() > largest_tree_file) return 0;
  const Result<Json> file = parse_json(text);
  if (!file || !file->is_object()) return 0;
  if (file->contains("generator") || file->contains("preset")) return 0;  // a request, which can have a seed
  const auto names = known_names();
  int marks = 0;
  for (const auto& [name, value] : file->items()) marks += names.count(name) != 0 ? 2 : 0;
  return marks;
}

Result<Imported> import_proctree(std::string_view text, const ImportOptions& options) {
  if (std::optional<Error> error = entry_error(options, "a file of proctree contains one tree"))
    return *std::move(error);
  Result<Json> file = parse_json(text);
  if (!file) return std::move(file).error();
  if (!file->is_object())
    return Error{Code::invalid, {{IssueKind::wrong_type, "", "expected an object of proctree's parameters"}}};
  const auto names = known_names();
  std::vector<Issue> issues;
  Imported imported;
  Json known = Json::object();
  std::string bark, leaf;
  std::map<std::string, std::string> theirs;  // pointers into the file by pointers into the parameters
  for (const auto& [name, value] : file->items()) {
    const auto found = names.find(name);
    if (found != names.end()) {
      const std::string ours(found->second);
      if (!theirs.emplace("/" + ours, pointer_token(name)).second)
        issues.emplace_back(IssueKind::duplicate_key, pointer_token(name), "found a second value of " + ours);
      known[ours] = value;
    } else if (std::find(colors.begin(), colors.end(), name) != colors.end()) {
      const std::string color = color_text(value);
      if (color.empty()) {
        issues.emplace_back(IssueKind::invalid_value, pointer_token(name),
                            "expected a colour as a number or \"#rrggbb\"");
      }
      (name == colors[0] ? bark : leaf) = color;
    } else if (name == state) {
      continue;
    } else if (std::find(materials.begin(), materials.end(), name) != materials.end()) {
      imported.warnings.push_back(
          {"",
           "\"" + name + "\" names an image that does not exist here; `bark` and `leaf` choose the materials",
           0, 0});
    } else {
      issues.emplace_back(IssueKind::unknown_key, pointer_token(name), unknown_name(name));
    }
  }
  if (known.empty())
    issues.emplace_back(IssueKind::missing, "", "found none of proctree's parameters (seed, levels, ...)");
  for (const Parameter& parameter : parameters) {
    const std::string ours(parameter.name);
    if (!known.contains(ours)) known[ours] = number_of(parameter.value);
  }
  IssueList issue_list;
  const TreeParams read = read_tree(known, "", issue_list);
  std::vector<Issue> found = issue_list.take();
  for (Issue& issue : tree::check(read, Limits{})) found.push_back(std::move(issue));
  for (Issue& issue : found) {
    const auto pointer = theirs.find(issue.pointer);
    if (pointer != theirs.end()) issue.pointer = pointer->second;
    issues.push_back(std::move(issue));
  }
  if (!issues.empty()) return Error{Code::invalid, std::move(issues)};
  known["model"] = "proctree";
  known["sequence"] = "original";
  // One square with an image of a twig for each square of proctree, and of its size.
  known["leaf"] = {{"build", "twig"}};
  if (!leaf.empty()) known["leaf"]["color"] = leaf;
  if (!bark.empty()) known["bark_color"] = bark;
  imported.request = {{"generator", "tree"}, {"seed", read.mSeed}, {"parameters", std::move(known)}};
  return imported;
}

}  // namespace seedmesh
