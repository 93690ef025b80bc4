#include "core/import/import.h"

#include "core/import/formats.h"

namespace seedmesh {
namespace {

constexpr ImportFormat rows[] = {
    {"cpfg", "cpfg .l", "An L-system with its decomposition, homomorphism and macros.", "text/plain",
     cpfg_without_comments, marks_of_cpfg, import_cpfg},
    {"fractint", "Fractint .l", "An entry becomes an L-system in the plane.", "text/plain",
     fractint_without_comments, marks_of_fractint, import_fractint},
    {"houdini", "Houdini L-System node", "Parameters and rules, with exchanged turns converted.",
     "text/plain", nullptr, marks_of_houdini, import_houdini},
    {"shapeml", "ShapeML .shp", "A grammar becomes a building with the same rules.", "text/plain", nullptr,
     marks_of_shapeml, import_shapeml},
    {"proctree", "proctree JSON", "Its 22 parameters become a tree of the model proctree.",
     "application/json", nullptr, marks_of_proctree, import_proctree},
    {"ez_tree", "ez-tree JSON", "Its options become a tree of the model ez_tree.", "application/json",
     nullptr, marks_of_ez_tree, import_ez_tree},
    {"geojson", "GeoJSON map", "Footprints, streets, water, green areas and trees become a scene.",
     "application/json", nullptr, marks_of_geojson, import_geojson},
    {"osm", "OpenStreetMap XML or Overpass JSON",
     "Buildings, streets, water, green areas and trees become a scene.", "application/xml", nullptr,
     marks_of_osm, import_osm},
    {"arbaro", "Arbaro XML", "A species becomes a tree of the model weber_penn.", "application/xml", nullptr,
     marks_of_arbaro, import_arbaro},
    {"tree_gen", "tree-gen or Sapling preset", "A species becomes a tree of the model weber_penn.",
     "text/plain", nullptr, marks_of_tree_gen, import_tree_gen},
};

}  // namespace

std::span<const ImportFormat> import_formats() { return rows; }

const ImportFormat* find_import_format(std::string_view name) {
  for (const ImportFormat& row : rows) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

const ImportFormat* likeliest_format(std::string_view text) {
  const ImportFormat* likeliest = nullptr;
  int most = 0;
  for (const ImportFormat& row : rows) {
    const int score = row.score(text);
    if (score <= most) continue;
    most = score;
    likeliest = &row;
  }
  return likeliest;
}

}  // namespace seedmesh
