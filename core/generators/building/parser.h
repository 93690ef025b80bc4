#pragma once
/// The state of the reader of rules, and how its functions move through the tokens. Rules may share a line,
/// so that only an arrow shows that a name begins a rule: statements are recognised by looking ahead. All
/// errors are collected.
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/generators/building/syntax.h"
#include "core/generators/building/tokens.h"

namespace seedmesh::building {

/// The greatest number of distinct queries to other shapes in the rules.
constexpr std::uint32_t most_queries = 32;
/// The greatest number of parameters of a rule or a function.
constexpr std::size_t most_parameters = 32;

/// A value of with(...), which is found once for each call.
struct LocalValue {
  std::string_view name;
  std::size_t from = 0, to = 0;  ///< tokens of the value
};

/// The state of the search for the attributes that a value needs.
enum class Progress : std::uint8_t { untouched, in_progress, done };

/// A function of the rules: name(a, b) = value.
struct RuleFunction {
  std::vector<std::string_view> parameters;
  std::vector<LocalValue> locals;
  std::size_t from = 0, to = 0;          ///< tokens of the body
  Progress order = Progress::untouched;  ///< progress of sorting the attributes that its body needs
  std::size_t owner = 0;                 ///< the attribute that needs it, while in progress
};

/// An attribute or a constant, as declared.
struct Declaration {
  std::string name;
  std::size_t from = 0, to = 0;  ///< tokens of the value
  Progress state = Progress::untouched;
  std::vector<std::size_t> annotations;  ///< tokens of their names
};

struct Parser {
  Parser(const RuleText& text, std::string_view style, Grammar& grammar, std::vector<lang::TextError>& found);

  Grammar& grammar;
  std::vector<lang::TextError>& errors;
  Tokens tokens;
  std::size_t at = 0;  ///< the next token
  int depth = 0;       ///< open brackets
  std::map<std::string, std::uint32_t, std::less<>> symbols, words;
  std::map<std::string, RuleFunction, std::less<>> functions;
  std::vector<Declaration> declarations;
  std::map<std::string, std::size_t, std::less<>> declared;
  std::vector<std::string> attribute_order;  ///< attributes; those that others need come first
  std::set<std::string> made_texts;          ///< texts of tokens that are not in the rules
  lang::Names names;
  std::set<std::string, std::less<>> symbols_with_rules;
  std::uint32_t start = none;  ///< the symbol after @StartRule
  std::size_t last_error = static_cast<std::size_t>(-1);
  std::size_t written = 0;  ///< tokens of all expressions, with functions written out
  std::map<std::string, bool, std::less<>> text_signs, tree_signs;  ///< see tree_need.cpp
  /// Indices into Grammar::functions, by name.
  std::map<std::string, std::uint32_t, std::less<>> function_trees;
};

/// Returns the next token.
inline const lang::Token& here(const Parser& p) { return p.tokens.at(p.at); }
inline bool is_here(const Parser& p, std::string_view symbol) { return p.tokens.is(p.at, symbol); }
inline std::uint32_t offset_here(const Parser& p) { return static_cast<std::uint32_t>(here(p).offset); }

/// Skips the next token if it is this symbol, and returns whether it is.
bool take(Parser& p, std::string_view symbol);
/// Skips the next token if it is this symbol. Otherwise adds an error that states after what the symbol was
/// expected.
void expect(Parser& p, std::string_view symbol, std::string_view after);

/// Adds an error at a token: one for each token, and at most lang::max_errors.
void add_error(Parser& p, const lang::Token& token, std::string message, IssueKind kind = IssueKind::syntax);
/// Adds the error that the next token is not what the rules need.
void add_unexpected(Parser& p, std::string_view expected);
/// Adds the error that a word that was just read is not what the operation needs.
void add_wrong_word(Parser& p, std::string_view word, std::string_view expected);
void add_warning(Parser& p, std::uint32_t offset, std::string message);

/// Counts an opened bracket. Returns false and adds an error if brackets are nested too deep.
bool enter_bracket(Parser& p, const lang::Token& token);

/// Returns the token behind the head of a rule or function: its name at `i`, its parameters, and `with (name :=
/// value)`.
std::size_t behind_head(const Parser& p, std::size_t i);
/// Whether `name := ` begins at a token, as in with(...).
bool begins_local(const Parser& p, std::size_t i);
/// Whether a rule or any statement begins at a token.
bool begins_rule(const Parser& p, std::size_t i);
bool begins_statement(const Parser& p, std::size_t i);

/// Returns the index of a symbol or word in the grammar. A new one is added.
std::uint32_t symbol_index(Parser& p, std::string_view name, std::uint32_t offset);
std::uint32_t word_index(Parser& p, std::string_view word);

/// Appends rows to a table of the grammar, and sets `first` and `count` to their range.
template <class Row>
void append_rows(std::vector<Row>& table, const std::vector<Row>& rows, std::uint32_t& first,
                 std::uint32_t& count) {
  first = static_cast<std::uint32_t>(table.size());
  count = static_cast<std::uint32_t>(rows.size());
  table.insert(table.end(), rows.begin(), rows.end());
}

}  // namespace seedmesh::building
