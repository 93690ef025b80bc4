#pragma once
/// Puts rule files that import each other into one list of tokens. Names of an imported file get its prefix: the rule
/// `Roof` of a file imported as `r` becomes `r.Roof`, the name that other files use.
///
/// An attribute of the importing file replaces that of the same name in the imported file, unless the import
/// protects it. An import can also set values of attributes and redefine extension rules (CGA reference,
/// import). `alias.Rule -->` in the importing file replaces a rule of the imported one.
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/generators/building/rule_text.h"
#include "core/lang/lexer.h"

namespace seedmesh::building {

struct LoadedTokens {
  std::vector<lang::Token> tokens;  ///< tokens of the main file and of what it imports; the last is the end
  std::set<std::string> texts;      ///< texts that tokens with a prefix refer to
  std::string start;                ///< the rule marked with `start` in the main file
  /// Prefixes of files that the request does not have, each ending with a dot.
  std::vector<std::string> missing;
  std::vector<lang::TextError> warnings;
  bool has_imports = false;
};

/// `plain` is the joined text without comments. `style` selects one of the styles of the main file; empty: Default.
LoadedTokens load_files(const RuleText& files, std::string_view plain, std::string_view style,
                        std::vector<lang::TextError>& errors);

}  // namespace seedmesh::building
