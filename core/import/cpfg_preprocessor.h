#pragma once
/// The lines of a cpfg file that begin with `#`, as the preprocessor of C reads them: #define, #undef, and
/// the conditional directives #if, #ifdef, #ifndef, #elif, #else, #endif.
#include <string>

#include "core/import/cpfg_macros.h"
#include "core/import/foreign_text.h"

namespace seedmesh {

/// Defines the macros of `text`, and replaces lines that a condition excludes by blanks. Reports an error for
/// an #include whose file is not given, and for a condition without #endif.
void preprocess_cpfg(ForeignText& source, std::string& text, CpfgMacros& macros);

}  // namespace seedmesh
