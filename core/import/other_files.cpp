#include "core/import/other_files.h"

namespace seedmesh {
namespace {

constexpr std::string_view to_geojson = "convert it to GeoJSON, for example with ogr2ogr";
constexpr std::string_view to_rules =
    "rules of CityEngine need no import: they are `rules` of the generator building";
constexpr std::string_view to_terrain =
    "elevation data is `image.data` of the generator terrain, as a GeoTIFF or raw samples";

/// Where the words of a format have to stand.
enum class Where { anywhere, line_start, beginning };

struct Row {
  std::string_view words, name, advice;
  Where where = Where::anywhere;
  char first = '\0';  ///< the first character of the text, if only texts with it are of this format
};

constexpr Row rows[] = {
    {"<kml", "a KML file", to_geojson, Where::anywhere, '<'},
    {"<gpx", "a GPX file", to_geojson, Where::anywhere, '<'},
    {"<gml:", "a GML file", to_geojson, Where::anywhere, '<'},
    {"CityModel", "a CityGML file", to_geojson, Where::anywhere, '<'},
    {"\"Topology\"", "TopoJSON", to_geojson, Where::anywhere, '{'},
    {"\"CityJSON\"", "CityJSON", to_geojson, Where::anywhere, '{'},
    {"version \"20", "a rule file of CityEngine", to_rules, Where::line_start},
    {"@StartRule", "a rule file of CityEngine", to_rules, Where::line_start},
    {"opadd ", "a script of Houdini", "save the parameters of the node, one on each line: Premise: A",
     Where::line_start},
    {"opparm ", "a script of Houdini", "save the parameters of the node, one on each line: Premise: A",
     Where::line_start},
    {"ncols ", "an ASCII grid", to_terrain, Where::beginning},
    {"NCOLS ", "an ASCII grid", to_terrain, Where::beginning},
    {"DSAA", "a Surfer grid", to_terrain, Where::beginning},
    {"ISO-10303-21", "an IFC or STEP file", "export its footprints as GeoJSON", Where::beginning},
};

std::size_t find(std::string_view text, const Row& row) {
  for (std::size_t at = text.find(row.words); at != std::string_view::npos;
       at = text.find(row.words, at + 1)) {
    const bool is_line_start = at == 0 || text[at - 1] == '\n';
    if (row.where == Where::anywhere || (row.where == Where::line_start && is_line_start) || at == 0)
      return at;
  }
  return std::string_view::npos;
}

}  // namespace

std::optional<OtherFile> other_file(std::string_view text) {
  constexpr std::size_t beginning = 8192;
  const std::string_view head = text.substr(0, beginning);
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return std::nullopt;
  for (const Row& row : rows) {
    if (row.first != '\0' && head[first] != row.first) continue;
    if (const std::size_t at = find(head, row); at != std::string_view::npos)
      return OtherFile{row.name, row.advice, at};
  }
  return std::nullopt;
}

}  // namespace seedmesh
