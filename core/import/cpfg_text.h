#pragma once
/// The part of cpfg's preprocessor that runs before macro expansion.
#include <string>

#include "core/import/foreign_text.h"

namespace seedmesh {

/// Returns the text with comments replaced by blanks. Backslashes at line ends, together with their line ends,
/// are replaced too, so that continued lines are joined. Every byte keeps its offset. `//` begins a comment at
/// the beginning of a line or between blanks; elsewhere it is two modules `/` (roll right), because cpfg itself
/// has no such comments.
std::string cpfg_without_comments(ForeignText& source);

/// Whether the trimmed line is a directive. It is one if it is `#` and a known word, or if it has `#`
/// directly before another word and has no arrow. In other lines, # is a module.
bool is_cpfg_directive(std::string_view text, Line line);

/// Whether the line has the arrow of a production.
bool has_cpfg_arrow(std::string_view line);

}  // namespace seedmesh
