/// One document a line on standard input: "<schema> <JSON>". One verdict a line on standard output, as JSON:
/// {"pointers": [of each fault], "canonical": text, "stable": whether the canonical text reads and writes as
/// itself}.
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "generated/params/fractal.h"
#include "generated/params/lsystem.h"
#include "generated/params/output.h"
#include "generated/params/request.h"
#include "generated/params/scene.h"
#include "generated/params/terrain.h"
#include "generated/params/tree.h"

namespace seedmesh {
namespace {

template <auto read, auto write>
Json verdict(const Json& document) {
  IssueList faults;
  const auto params = read(document, "", faults);
  Json pointers = Json::array();
  for (const Issue& issue : faults.issues()) pointers.push_back(issue.pointer);
  const std::string canonical = canonical_text(write(params));
  IssueList none;
  const auto again = read(*parse_json(canonical), "", none);
  const bool stable =
      !faults.empty() || (none.empty() && again == params && canonical_text(write(again)) == canonical);
  return {{"pointers", pointers}, {"canonical", canonical}, {"stable", stable}};
}

struct Row {
  std::string_view name;
  Json (*judge)(const Json& document);
};

constexpr Row rows[] = {
    {"lsystem", verdict<read_lsystem, write_lsystem>}, {"tree", verdict<read_tree, write_tree>},
    {"fractal", verdict<read_fractal, write_fractal>}, {"terrain", verdict<read_terrain, write_terrain>},
    {"scene", verdict<read_scene, write_scene>},       {"output", verdict<read_output, write_output>},
    {"request", verdict<read_request, write_request>}};

Json judged(const std::string& line) {
  const std::size_t blank = line.find(' ');
  const Result<Json> document = parse_json(std::string_view(line).substr(blank + 1));
  if (!document)
    return {{"pointers", {document.error().issues.front().pointer}}, {"canonical", ""}, {"stable", true}};
  for (const Row& row : rows) {
    if (row.name == line.substr(0, blank)) return row.judge(*document);
  }
  return {{"unknown", line.substr(0, blank)}};
}

}  // namespace
}  // namespace seedmesh

int main() {
  std::ios::sync_with_stdio(false);
  for (std::string line; std::getline(std::cin, line);) std::cout << seedmesh::judged(line).dump() << "\n";
  return std::cin.bad() ? 1 : 0;
}
