/// Trees of proctree (Paul Brunt, 2012) and of programs like it: a JSON object of its 22 parameters, by the
/// names of proctree.js, such as "levels", or by those of the C++ translation, such as "mLevels", which are
/// also those of listing 2.1 of Hutsko's thesis (2022) and ours.
#include <algorithm>
#include <array>
#include <map>

#include "core/generators/registry.h"
#include "core/import/formats.h"
#include "core/schema/nearest.h"

namespace seedmesh {
namespace {

constexpr std::array<std::string_view, 22> parameters = {
    "mSeed",
    "mSegments",
    "mLevels",
    "mVMultiplier",
    "mTwigScale",
    "mInitialBranchLength",
    "mLengthFalloffFactor",
    "mLengthFalloffPower",
    "mClumpMax",
    "mClumpMin",
    "mBranchFactor",
    "mDropAmount",
    "mGrowAmount",
    "mSweepAmount",
    "mMaxRadius",
    "mClimbRate",
    "mTrunkKink",
    "mTreeSteps",
    "mTaperRate",
    "mRadiusFalloffRate",
    "mTwistRate",
    "mTrunkLength",
};
// Their twigs are pictures that fill a part of their squares; our bunches of leaves fill them. As the
// presets.
constexpr double leaf_size = 0.6;
constexpr std::array<std::string_view, 2> materials = {"trunkMaterial", "twigMaterial"};

/// "levels" for "mLevels". proctree.js writes one of them in its own way.
std::string name_in_js(std::string_view parameter) {
  if (parameter == "mInitialBranchLength") return "initalBranchLength";
  std::string name(parameter.substr(1));
  if (name[0] >= 'A' && name[0] <= 'Z') name[0] = static_cast<char>(name[0] - 'A' + 'a');
  return name;
}

/// Our names by theirs.
std::map<std::string, std::string_view, std::less<>> known_names() {
  std::map<std::string, std::string_view, std::less<>> names;
  for (const std::string_view parameter : parameters) {
    names.emplace(parameter, parameter);
    names.emplace(name_in_js(parameter), parameter);
  }
  names.emplace("initialBranchLength", "mInitialBranchLength");
  return names;
}

/// What a name that is not known may have meant, in the file's own way of writing.
std::string unknown_name(const std::string& name) {
  const auto names = known_names();
  std::vector<std::string_view> words(materials.begin(), materials.end());
  for (const auto& [known, parameter] : names) words.push_back(known);
  const std::string_view nearest = schema::nearest_word(name, words);
  const std::string message = "\"" + shortened(name, 40) + "\" is no parameter of proctree";
  return nearest.empty() ? message : message + "; did you mean \"" + std::string(nearest) + "\"?";
}

}  // namespace

int marks_of_proctree(std::string_view text) {
  const Result<Json> file = parse_json(text);
  if (!file || !file->is_object()) return 0;
  const auto names = known_names();
  int marks = 0;
  for (const auto& [name, value] : file->items()) marks += names.count(name) != 0 ? 2 : 0;
  return marks;
}

Result<Imported> import_proctree(std::string_view text, const ImportOptions& options) {
  if (!options.entry.empty()) {
    return Error{Code::invalid, {{"/entry", "a file of proctree holds one tree; expected no entry"}}};
  }
  Result<Json> file = parse_json(text);
  if (!file) return std::move(file).error();
  if (!file->is_object())
    return Error{Code::invalid, {{"", "expected an object of proctree's parameters", 0, 0}}};
  const auto names = known_names();
  std::vector<Issue> issues;
  Imported imported;
  Json known = Json::object();
  std::map<std::string, std::string> theirs;  // pointers into the file by pointers to our names
  for (const auto& [name, value] : file->items()) {
    const auto found = names.find(name);
    if (found != names.end()) {
      const std::string ours(found->second);
      if (!theirs.emplace("/" + ours, pointer_token(name)).second)
        issues.push_back({pointer_token(name), "found a second value of " + ours, 0, 0});
      known[ours] = value;
    } else if (std::find(materials.begin(), materials.end(), name) != materials.end()) {
      imported.warnings.push_back({"",
                                   "\"" + name +
                                       "\" names a picture that nobody has here; `bark` and `leaf` "
                                       "choose what the tree wears",
                                   0, 0});
    } else {
      issues.push_back({pointer_token(name), unknown_name(name), 0, 0});
    }
  }
  if (known.empty()) issues.push_back({"", "found none of proctree's parameters (seed, levels, ...)", 0, 0});
  const Generator* tree = find_generator("tree");
  Faults faults;
  const Generator::Params read = tree->read(known, "", faults, {});
  std::vector<Issue> found = faults.take();
  for (Issue& issue : tree->check(read, Limits{})) found.push_back(std::move(issue));
  for (Issue& issue : found) {
    const auto pointer = theirs.find(issue.pointer);
    if (pointer != theirs.end()) issue.pointer = pointer->second;
    issues.push_back(std::move(issue));
  }
  if (!issues.empty()) return Error{Code::invalid, std::move(issues)};
  known["model"] = "proctree";
  known["leaf"] = {{"size", leaf_size}};
  imported.request = {{"generator", "tree"}, {"parameters", std::move(known)}};
  imported.warnings.push_back(
      {"", "chance is drawn by place here: the tree is like the saved one, not the same", 0, 0});
  return imported;
}

}  // namespace seedmesh
