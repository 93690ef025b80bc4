#pragma once
/// The members of ImportFormat for each format, one format in each file: its reader, and for some formats a
/// function that removes comments. A function marks_of_... is the member `score`. import.cpp lists all of
/// them.
#include "core/import/import.h"

namespace seedmesh {

Result<Imported> import_arbaro(std::string_view text, const ImportOptions& options);    // arbaro.cpp
Result<Imported> import_cpfg(std::string_view text, const ImportOptions& options);      // cpfg.cpp
Result<Imported> import_ez_tree(std::string_view text, const ImportOptions& options);   // ez_tree.cpp
Result<Imported> import_fractint(std::string_view text, const ImportOptions& options);  // fractint.cpp
Result<Imported> import_geojson(std::string_view text, const ImportOptions& options);   // geojson.cpp
Result<Imported> import_houdini(std::string_view text, const ImportOptions& options);   // houdini.cpp
Result<Imported> import_osm(std::string_view text, const ImportOptions& options);       // osm.cpp
Result<Imported> import_proctree(std::string_view text, const ImportOptions& options);  // proctree.cpp
Result<Imported> import_shapeml(std::string_view text, const ImportOptions& options);   // shapeml.cpp
Result<Imported> import_tree_gen(std::string_view text, const ImportOptions& options);  // tree_gen.cpp

std::string cpfg_without_comments(std::string_view text);
std::string fractint_without_comments(std::string_view text);

int marks_of_arbaro(std::string_view text);
int marks_of_cpfg(std::string_view text);
int marks_of_ez_tree(std::string_view text);
int marks_of_fractint(std::string_view text);
int marks_of_geojson(std::string_view text);
int marks_of_houdini(std::string_view text);
int marks_of_osm(std::string_view text);
int marks_of_proctree(std::string_view text);
int marks_of_shapeml(std::string_view text);
int marks_of_tree_gen(std::string_view text);

}  // namespace seedmesh
