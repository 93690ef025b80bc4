/// Maps: the first byte chooses GeoJSON or OpenStreetMap, the rest is the file. It is refused with positions inside the
/// file, or becomes a request that is read again and whose buildings are closed. Objects that are parsed one by one, as in large
/// files, are those of the whole file.
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string_view>

#include "core/geom/polygon/massing.h"
#include "core/import/import.h"
#include "core/import/listed_objects.h"
#include "core/pipeline.h"

namespace seedmesh {
namespace {

void check_listed(std::string_view text, std::string_view name) {
  const std::optional<ListedObjects> listed = listed_objects(text, name);
  if (!listed) return;
  const Result<Json> whole = parse_json(text, {});
  if (!whole) return;
  const Json& list = whole->at(std::string(name));
  if (list.size() != listed->texts.size()) std::abort();
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Result<Json> one = parse_listed(text, *listed, i, nullptr);
    if (!one || *one != list[i]) std::abort();
  }
}

}  // namespace
}  // namespace seedmesh

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace seedmesh;
  if (size == 0) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  check_listed(text, data[0] % 2 == 0 ? "features" : "elements");
  const Limits limits;
  const Result<ImportedRequest> result =
      import_request({data[0] % 2 == 0 ? "geojson" : "osm", "", text}, limits);
  if (!result) {
    for (const Issue& issue : result.error().issues) {
      if (issue.message.empty() || issue.line < 0 || issue.pointer.starts_with("/parameters")) std::abort();
    }
    return 0;
  }
  if (!read_request(result->request.canonical(), limits)) std::abort();
  const nlohmann::json request = nlohmann::json::parse(result->request.canonical());
  for (const nlohmann::json& building :
       request.at("parameters").value("buildings", nlohmann::json::array())) {
    std::vector<PlanRing> rings;
    for (const nlohmann::json& ring : building.at("footprint")) {
      rings.emplace_back();
      for (const nlohmann::json& p : ring) rings.back().emplace_back(p[0].get<double>(), -p[1].get<double>());
    }
    MassOptions options;
    options.roof = static_cast<MassRoof>(data[0] / 2 % mass_roof_names.size());
    options.roof_height = options.roof == MassRoof::flat ? 0 : 2;
    if (!is_closed(mass_of(read_plan(std::move(rings)), options, Job(0, Job::Options{})))) std::abort();
  }
  return 0;
}
