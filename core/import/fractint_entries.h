#pragma once
/// The entries of a file of Fractint's L-systems.
#include <string>
#include <vector>

#include "core/import/foreign_text.h"

namespace seedmesh {

struct FractintEntry {
  std::string name;
  std::size_t name_at = 0;
  std::vector<Line> lines;  ///< without comments and blanks at their ends
};

/// Text between entries that is no comment is a fault, as is a brace that lacks its partner.
std::vector<FractintEntry> fractint_entries(ForeignText& source);

}  // namespace seedmesh
