/// Trees that proctree's editor and programs like it have saved: a JSON object of the 22 parameters by their
/// published names, the form of listing 2.1 of Hutsko's thesis (2022).
#include <algorithm>

#include "core/generators/registry.h"
#include "core/import/formats.h"

namespace seedmesh {

Result<Imported> import_proctree(std::string_view text, const ImportOptions&) {
  Result<Json> file = parse_json(text);
  if (!file) return std::move(file).error();
  if (!file->is_object())
    return Error{Code::invalid, {{"", "expected an object of proctree's parameters", 0, 0}}};
  std::vector<Issue> issues;
  bool has_any = false;
  for (const auto& [name, value] : file->items()) {
    const bool is_known = name.size() > 1 && name[0] == 'm' && name[1] >= 'A' && name[1] <= 'Z';
    has_any = has_any || is_known;
    if (!is_known)
      issues.push_back(
          {pointer_token(name), "\"" + shortened(name, 40) + "\" is no parameter of proctree", 0, 0});
  }
  if (!has_any) issues.push_back({"", "found none of proctree's parameters (mSeed, mLevels, ...)", 0, 0});
  Json parameters = std::move(*file);
  const Generator* tree = find_generator("tree");
  Faults faults;
  Json known = Json::object();
  for (const auto& [name, value] : parameters.items()) {
    if (name[0] == 'm') known[name] = value;
  }
  const Generator::Params read = tree->read(known, "", faults, {});
  for (Issue& issue : faults.take()) issues.push_back(std::move(issue));
  for (Issue& issue : tree->check(read, Limits{})) issues.push_back(std::move(issue));
  if (!issues.empty()) return Error{Code::invalid, std::move(issues)};
  known["model"] = "proctree";
  Imported imported;
  imported.request = {{"generator", "tree"}, {"parameters", std::move(known)}};
  imported.warnings.push_back(
      {"", "chance is drawn by place here: the tree is like the saved one, not the same", 0, 0});
  return imported;
}

}  // namespace seedmesh
