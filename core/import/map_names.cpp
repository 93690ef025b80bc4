// Names that files of footprints give to heights, levels, roofs and colours: Overture Maps, OSM Buildings, vector tiles,
// open data of cities, and shape files, whose names have ten characters.
#include "core/import/map_names.h"

#include <array>
#include <string>

#include "core/import/foreign_text.h"

namespace seedmesh {
namespace {

struct Row {
  std::string_view plain;  ///< in lower case without signs between words
  FootprintName known;
};

// The roof heights of New York are in feet.
constexpr std::array<Row, 79> rows{{
    {"building", {"building", ""}},
    {"color", {"building:colour", ""}},
    {"colour", {"building:colour", ""}},
    {"wallcolor", {"building:colour", ""}},
    {"facadecolor", {"building:colour", ""}},
    {"buildingcolor", {"building:colour", ""}},
    {"buildingcolour", {"building:colour", ""}},
    {"buildingco", {"building:colour", ""}},
    {"levels", {"building:levels", ""}},
    {"numfloors", {"building:levels", ""}},
    {"floors", {"building:levels", ""}},
    {"stories", {"building:levels", ""}},
    {"buildinglevels", {"building:levels", ""}},
    {"storeys", {"building:levels", ""}},
    {"numberoffloors", {"building:levels", ""}},
    {"floorcount", {"building:levels", ""}},
    {"nofloors", {"building:levels", ""}},
    {"nostoreys", {"building:levels", ""}},
    {"nostories", {"building:levels", ""}},
    {"numstoreys", {"building:levels", ""}},
    {"numstories", {"building:levels", ""}},
    {"storeysaboveground", {"building:levels", ""}},
    {"floorsaboveground", {"building:levels", ""}},
    {"floor", {"building:levels", ""}},
    {"floornum", {"building:levels", ""}},
    {"floorsnum", {"building:levels", ""}},
    {"storey", {"building:levels", ""}},
    {"story", {"building:levels", ""}},
    {"geschosse", {"building:levels", ""}},
    {"anzahlgeschosse", {"building:levels", ""}},
    {"nbetages", {"building:levels", ""}},
    {"nombredetages", {"building:levels", ""}},
    {"buildingl", {"building:levels", ""}},
    {"buildingle", {"building:levels", ""}},
    {"material", {"building:material", ""}},
    {"wallmaterial", {"building:material", ""}},
    {"facadematerial", {"building:material", ""}},
    {"buildingmaterial", {"building:material", ""}},
    {"buildingma", {"building:material", ""}},
    {"minlevel", {"building:min_level", ""}},
    {"minfloor", {"building:min_level", ""}},
    {"buildingminlevel", {"building:min_level", ""}},
    {"buildingpart", {"building:part", ""}},
    {"buildingid", {"building:part", ""}},
    {"renderheight", {"height", ""}},
    {"buildingheight", {"height", ""}},
    {"measuredheight", {"height", ""}},
    {"heightm", {"height", ""}},
    {"height", {"height", ""}},
    {"heightmetres", {"height", ""}},
    {"heightmeters", {"height", ""}},
    {"bldgheight", {"height", ""}},
    {"bldght", {"height", ""}},
    {"buildinghe", {"height", ""}},
    {"hauteur", {"height", ""}},
    {"hoehe", {"height", ""}},
    {"altura", {"height", ""}},
    {"altezza", {"height", ""}},
    {"estheight", {"height", ""}},
    {"heightroof", {"height", " ft"}},
    {"leaftype", {"leaf_type", ""}},
    {"minheight", {"min_height", ""}},
    {"renderminheight", {"min_height", ""}},
    {"baseheight", {"min_height", ""}},
    {"roofangle", {"roof:angle", ""}},
    {"roofcolor", {"roof:colour", ""}},
    {"roofcolour", {"roof:colour", ""}},
    {"roofcolou", {"roof:colour", ""}},
    {"roofdirection", {"roof:direction", ""}},
    {"roofdirect", {"roof:direction", ""}},
    {"roofheight", {"roof:height", ""}},
    {"roofheigh", {"roof:height", ""}},
    {"rooflevels", {"roof:levels", ""}},
    {"roofmaterial", {"roof:material", ""}},
    {"roofmateri", {"roof:material", ""}},
    {"rooforientation", {"roof:orientation", ""}},
    {"rooforient", {"roof:orientation", ""}},
    {"roofshape", {"roof:shape", ""}},
    {"rooftype", {"roof:shape", ""}},
}};

}  // namespace

std::vector<FootprintName> footprint_names(std::string_view name) {
  std::string plain = lower(name);
  std::erase_if(plain, [](char c) { return c == ':' || c == '_' || c == '-' || c == ' ' || c == '.'; });
  std::vector<FootprintName> found;
  for (const Row& row : rows) {
    if (row.plain == plain) found.push_back(row.known);
  }
  return found;
}

}  // namespace seedmesh
