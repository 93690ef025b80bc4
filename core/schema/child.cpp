#include "core/schema/child.h"

#include "core/schema/forms.h"
#include "core/schema/nearest.h"
#include "core/schema/presets.h"
#include "core/schema/reader.h"
#include "core/schema/writer.h"

namespace seedmesh::schema {
namespace {

constexpr std::string_view known_members[] = {"generator", "parameters", "preset", "seed"};

void refuse_unknown_preset(const Location& location) {
  const auto at = location.member("preset");
  if (!at) return;
  const std::size_t issues_before = location.issue_list().issues().size();
  std::string name;
  read_text(*at, {.form = &forms::preset_name}, name);
  if (location.issue_list().issues().size() != issues_before || preset_requests().contains(name)) return;
  at->report(IssueKind::unknown_name, unknown_word("preset", name, preset_names()));
}

/// The inner request merged over its preset.
Json merged_request(const Location& location) {
  Json merged = with_preset(location.value());
  merged.erase("preset");
  merged.erase("output");  // the outer request decides on the output
  return merged;
}

}  // namespace

void read_child(const Location& location, Child& out) {
  if (location.value().is_string())
    return location.expected("an object, such as {\"preset\": \"oak\"} or one with \"generator\"");
  if (!check_members(location, known_members, {})) return;
  refuse_unknown_preset(location);
  const Json merged = merged_request(location);
  const std::string pointer = location.pointer();
  const Location inner(merged, pointer, location.issue_list());
  if (const auto at = inner.member("generator")) {
    const std::size_t issues_before = location.issue_list().issues().size();
    read_text(*at, {}, out.generator);
    // An empty name means elsewhere that an error has been reported.
    if (out.generator.empty() && location.issue_list().issues().size() == issues_before)
      at->report(IssueKind::unknown_name, "found an empty text, expected the name of a generator");
  } else if (!location.value().contains("preset")) {
    location.issue_list().add_missing(location.pointer(), "generator",
                                      "\"generator\" is missing, and there is no \"preset\" that names one");
  }
  if (const auto at = inner.member("seed")) read_seed(*at, out.seed.emplace());
  if (const auto at = inner.member("parameters")) {
    if (at->kind() == JsonKind::object) {
      out.parameters = canonical_text(at->value());
    } else {
      at->expected("an object");
      out.generator.clear();
    }
  }
}

Json write_child(const Child& child) {
  Json json = {{"generator", child.generator}};
  if (child.seed) json["seed"] = write_seed(*child.seed);
  Json parameters = Json::parse(child.parameters);
  if (!parameters.empty()) json["parameters"] = std::move(parameters);
  return json;
}

}  // namespace seedmesh::schema
