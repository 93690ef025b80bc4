#pragma once
/// The declarations of a rule file as ranges of tokens, before names get prefixes; see load_files.h.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/generators/building/rule_text.h"
#include "core/lang/lexer.h"

namespace seedmesh::building {

/// A declaration of a file: an attribute, a constant, a function or a rule, with its annotations.
struct Statement {
  enum class Kind : std::uint8_t { definition, rule, import, style, other };
  Kind kind = Kind::other;
  std::size_t first = 0, last = 0;  ///< tokens
  std::size_t name = 0;             ///< token of its name
  std::size_t name_end = 0;  ///< the token after its name; a name with dots replaces a rule of an import
  std::size_t value = 0;     ///< token of the value of an attribute; 0 for other declarations
  bool is_start = false, is_extension = false;
  bool has_start_note = false;  ///< whether the annotation @StartRule is before it

  bool is_foreign() const { return name_end > name + 1; }  ///< a rule of an imported file
};

/// The tokens of one file and of the files that it includes, and the partner of each bracket.
struct RuleTokens {
  std::vector<lang::Token> tokens;
  std::vector<std::size_t> partner;
  std::vector<std::size_t> included;  ///< first tokens of the included files

  const lang::Token& at(std::size_t i) const { return tokens[i < tokens.size() ? i : tokens.size() - 1]; }
  bool is(std::size_t i, std::string_view symbol) const { return lang::is_symbol(at(i), symbol); }
  bool is_own(const Statement& each) const { return included.empty() || each.first < included.front(); }
};

bool is_name(const lang::Token& token, std::string_view text);

/// Whether a token follows the one before it without a blank.
bool touches(const RuleTokens& file, std::size_t i);

/// Returns the tokens of one file of the joined text without comments. Adds errors of the lexer to `errors`.
RuleTokens read_tokens(std::string_view plain, const RuleText::Part& part,
                       std::vector<lang::TextError>& errors);

/// Finds the partners of brackets again, after tokens were added.
void match_brackets(RuleTokens& file);

std::vector<Statement> statements_of(const RuleTokens& file);

/// Returns the path of `import "file.cga"` or `import file.cga`, which have no name for a prefix. Empty for other
/// statements.
std::string included_path(const RuleTokens& file, const Statement& each);

/// Removes definitions and rules of included files whose names an earlier file declares, too.
void drop_replaced(const RuleTokens& file, std::vector<Statement>& statements);

}  // namespace seedmesh::building
