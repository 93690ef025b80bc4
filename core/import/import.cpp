#include "core/import/import.h"

#include "core/import/formats.h"

namespace seedmesh {
namespace {

constexpr ImportFormat rows[] = {
    {"cpfg", "cpfg .l", "An L-system with its decomposition, homomorphism and macros.", "text/plain",
     import_cpfg},
    {"fractint", "Fractint .l", "An entry becomes an L-system in the plane.", "text/plain", import_fractint},
    {"houdini", "Houdini L-System node", "Parameters and rules, with what Houdini flips flipped back.",
     "text/plain", import_houdini},
    {"proctree", "proctree JSON", "Its 22 parameters become a tree of the model proctree.",
     "application/json", import_proctree},
    {"ez_tree", "ez-tree JSON", "Its options become a tree of the model weber_penn.", "application/json",
     import_ez_tree},
};

}  // namespace

std::span<const ImportFormat> import_formats() { return rows; }

const ImportFormat* find_import_format(std::string_view name) {
  for (const ImportFormat& row : rows) {
    if (row.name == name) return &row;
  }
  return nullptr;
}

}  // namespace seedmesh
