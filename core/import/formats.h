#pragma once
/// The readers of the formats, one a file; import.cpp has their rows.
#include "core/import/import.h"

namespace seedmesh {

Result<Imported> import_cpfg(std::string_view text, const ImportOptions& options);      // cpfg.cpp
Result<Imported> import_ez_tree(std::string_view text, const ImportOptions& options);   // ez_tree.cpp
Result<Imported> import_fractint(std::string_view text, const ImportOptions& options);  // fractint.cpp
Result<Imported> import_houdini(std::string_view text, const ImportOptions& options);   // houdini.cpp
Result<Imported> import_proctree(std::string_view text, const ImportOptions& options);  // proctree.cpp

std::string cpfg_without_comments(std::string_view text);
std::string fractint_without_comments(std::string_view text);

int marks_of_cpfg(std::string_view text);
int marks_of_ez_tree(std::string_view text);
int marks_of_fractint(std::string_view text);
int marks_of_houdini(std::string_view text);
int marks_of_proctree(std::string_view text);

}  // namespace seedmesh
