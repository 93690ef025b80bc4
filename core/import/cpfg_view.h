#pragma once
/// The files beside an L-system of cpfg: the view file (`.v`), with angle, width and tropisms, and files of functions
/// (`.func`, `.fset`), which `func(n, x)` reads.
#include <map>
#include <string>

#include "core/import/foreign_text.h"

namespace seedmesh {

/// Puts the contents of the files into the parameters of the request. Without a view file, a warning lists
/// the values that such a file would set. `files` are texts by the name of the file. Errors and warnings name
/// the file.
void put_cpfg_files(const std::map<std::string, std::string>& files, Json& parameters, ForeignText& source);

}  // namespace seedmesh
