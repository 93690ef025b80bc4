#pragma once
/// The entries of an L-system file of Fractint.
#include <string>
#include <vector>

#include "core/import/foreign_text.h"

namespace seedmesh {

struct FractintEntry {
  std::string name;
  std::size_t name_at = 0;
  std::vector<Line> lines;  ///< without comments and blanks at their ends
};

/// Returns the entries of a file. Reports text between entries that is not a comment, and braces without a partner.
std::vector<FractintEntry> fractint_entries(ForeignText& source);

}  // namespace seedmesh
