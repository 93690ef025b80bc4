#pragma once
/// What the preprocessor does to a file of cpfg before its macros.
#include <string>

#include "core/import/foreign_text.h"

namespace seedmesh {

/// The text without comments and with lines joined where a backslash ends one; every byte keeps its place.
/// `//` begins a comment at the beginning of a line or between blanks; elsewhere it is two rolls, for cpfg's
/// own preprocessor knows no such comments.
std::string cpfg_without_comments(ForeignText& source);

/// Whether text[line], without blanks at its ends, is `#` and a word of the preprocessor; elsewhere # is a
/// module.
bool is_cpfg_directive(std::string_view text, Line line);

/// Whether the line has the arrow of a production.
bool has_cpfg_arrow(std::string_view line);

}  // namespace seedmesh
