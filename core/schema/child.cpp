#include "core/schema/child.h"

#include "core/schema/forms.h"
#include "core/schema/nearest.h"
#include "core/schema/presets.h"
#include "core/schema/reader.h"
#include "core/schema/writer.h"

namespace seedmesh::schema {
namespace {

constexpr std::string_view known_members[] = {"generator", "parameters", "preset", "seed"};

void refuse_unknown_preset(const Place& place) {
  const auto at = place.member("preset");
  if (!at) return;
  const std::size_t faults_before = place.faults().issues().size();
  std::string name;
  read_text(*at, {.form = &forms::preset_name}, name);
  if (place.faults().issues().size() != faults_before || preset_requests().contains(name)) return;
  at->fault(unknown_word("preset", name, preset_names()));
}

/// The request as it stands there, its preset under it.
Json merged_request(const Place& place) {
  Json merged = with_preset(place.value());
  merged.erase("preset");
  merged.erase("output");  // of the preset: what comes back is the outer request's business
  return merged;
}

}  // namespace

void read_child(const Place& place, Child& out) {
  if (!check_members(place, known_members, {})) return;
  refuse_unknown_preset(place);
  const Json merged = merged_request(place);
  const std::string pointer = place.pointer();
  const Place inner(merged, pointer, place.faults());
  if (const auto at = inner.member("generator")) {
    read_text(*at, {}, out.generator);
  } else if (!place.value().contains("preset")) {
    place.faults().add_missing(place.pointer(), "generator",
                               "\"generator\" is missing, and no \"preset\" tells it");
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
