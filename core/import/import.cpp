#include "core/import/import.h"

#include "core/import/formats.h"

namespace seedmesh {
namespace {

constexpr ImportFormat rows[] = {
    {"cpfg", "cpfg .l", "An L-system with its decomposition, homomorphism and macros.", "text/plain",
     cpfg_without_comments, marks_of_cpfg, import_cpfg},
    {"fractint", "Fractint .l", "An entry becomes an L-system in the plane.", "text/plain",
     fractint_without_comments, marks_of_fractint, import_fractint},
    {"houdini", "Houdini L-System node", "Parameters and rules, with what Houdini flips flipped back.",
     "text/plain", nullptr, marks_of_houdini, import_houdini},
    {"proctree", "proctree JSON", "Its 22 parameters become a tree of the model proctree.",
     "application/json", nullptr, marks_of_proctree, import_proctree},
    {"ez_tree", "ez-tree JSON", "Its options become a tree of the model weber_penn.", "application/json",
     nullptr, marks_of_ez_tree, import_ez_tree},
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
    const int marks = row.marks(text);
    if (marks <= most) continue;
    most = marks;
    likeliest = &row;
  }
  return likeliest;
}

}  // namespace seedmesh
