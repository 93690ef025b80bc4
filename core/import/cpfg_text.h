#pragma once
/// The steps of cpfg's preprocessor before macros.
#include <string>

#include "core/import/foreign_text.h"

namespace seedmesh {

/// The text with blanks for comments and for backslashes at line ends. Every byte keeps its offset. `//` begins a
/// comment at the beginning of a line or between blanks; elsewhere it is two rolls, because cpfg itself has no such
/// comments.
std::string cpfg_without_comments(ForeignText& source);

/// Whether the trimmed line is `#` and a word of the preprocessor. Elsewhere # is a module.
bool is_cpfg_directive(std::string_view text, Line line);

/// Whether the line has the arrow of a production.
bool has_cpfg_arrow(std::string_view line);

}  // namespace seedmesh
