#pragma once
/// The reader of rules, for the sources of this folder: tokens once cut, statements told apart by looking
/// ahead (rules may share a line, so only an arrow shows that a name begins one), faults gathered.
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/generators/building/operations.h"
#include "core/lang/lexer.h"

namespace seedmesh::building {

/// A text with its comments blanked and the signs ≥ ≤ ≠ as >= <= !=, cut into tokens, with the partner of
/// every bracket.
class Tokens {
 public:
  Tokens(std::string_view text, std::vector<lang::Fault>& faults);
  const lang::Token& at(std::size_t i) const { return tokens_[i < tokens_.size() ? i : tokens_.size() - 1]; }
  bool is(std::size_t i, std::string_view symbol) const { return lang::is_symbol(at(i), symbol); }
  bool is_name(std::size_t i, std::string_view name) const {
    return at(i).kind == lang::TokenKind::name && at(i).text == name;
  }
  bool is_arrow(std::size_t i) const { return is(i, "-->") || is(i, "~>") || is(i, "->"); }
  bool is_end(std::size_t i) const { return at(i).kind == lang::TokenKind::end; }
  std::size_t end() const { return tokens_.size() - 1; }
  int line_of(std::size_t offset) const { return place_of(text_, offset).line; }
  /// Of an opening bracket: its partner, or the end.
  std::size_t partner(std::size_t i) const { return partner_[i]; }
  /// The token behind the expression that begins at i; i where none does.
  std::size_t behind_expression(std::size_t i) const;

 private:
  std::size_t behind_operand(std::size_t i) const;

  std::string text_;  ///< as plain() makes it; tokens point into it
  std::vector<lang::Token> tokens_;
  std::vector<std::size_t> partner_;
};

/// Different questions to other shapes that rules may ask.
constexpr std::uint32_t most_queries = 32;

class Parser {
 public:
  Parser(std::string_view text, Grammar& grammar, std::vector<lang::Fault>& faults);
  void parse(std::string_view start);

 private:
  struct Function {
    std::vector<std::string_view> parameters;
    std::size_t from = 0, to = 0;  ///< tokens of the body
  };
  struct Declaration {
    std::string name;
    std::size_t from = 0, to = 0;
    std::uint32_t attribute = 0;
    int state = 0;  ///< 0 untouched, 1 on the way, 2 done
  };
  /// An expression being written out with functions and queries put in.
  struct Writing {
    std::vector<lang::Token> out;
    Value* value = nullptr;
    int depth = 0;
    bool is_broken = false;
  };
  using Replacements = std::vector<std::pair<std::string_view, std::vector<lang::Token>>>;

  // Statements (parse_rules.cpp)
  bool begins_rule(std::size_t i) const;
  bool begins_statement(std::size_t i) const;
  void survey();  ///< finds functions, attributes and which symbols have rules
  std::size_t survey_definition(std::size_t i, bool is_constant, bool is_attribute);
  void settle_attributes();
  void settle_attribute(std::size_t declaration);
  void check_range(Attribute& attribute, const std::vector<std::size_t>& notes);
  void rule(std::int32_t priority);
  std::uint32_t alternatives_2006(const Value& condition);
  void finish(std::string_view start);
  void check_weights();
  void settle_endless(const Symbol& symbol);
  void check_reach(const Symbol& symbol);
  void warn(std::uint32_t offset, std::string message);

  // Successors (parse_steps.cpp)
  std::uint32_t body();
  void choices(std::vector<Choice>& out);
  Choice successor();
  bool ends_successor() const;
  bool step(std::vector<Step>& out);
  void symbol_step(std::vector<Step>& out);
  void operation_step(const OperationRow& row, std::vector<Step>& out);
  bool arguments(const OperationRow& row, std::vector<Argument>& out, Step& step, std::vector<Part>& cells);
  Argument argument(char kind);
  Argument word_argument();
  Argument slope();
  void settle_axis(const OperationRow& row, Step& step, const std::vector<Argument>& arguments);
  void settle_texture_axis(Step& step, const std::vector<Argument>& arguments);
  void cells(std::vector<Part>& out, bool have_bodies);
  void fill_bodies(std::vector<Part>& cells, const std::vector<std::uint32_t>& bodies, std::size_t& next);
  void selectors(std::vector<Part>& out);
  void old_selectors(Step& step, const std::vector<Argument>& arguments, std::vector<Part>& out);
  void add_parts(Step& step, const std::vector<Part>& parts);
  bool enter(const lang::Token& token);

  // Values (values.cpp)
  Value value();
  Value value_of(std::size_t from, std::size_t to);
  std::size_t behind_value(std::size_t i) const;
  void write(Writing& writing, std::size_t from, std::size_t to, const Replacements& replacements);
  void write_tokens(Writing& writing, std::span<const lang::Token> tokens, const Replacements& replacements);
  std::size_t write_call(Writing& writing, std::span<const lang::Token> tokens, std::size_t i,
                         const Function& function, const Replacements& replacements);
  std::size_t write_query(Writing& writing, std::span<const lang::Token> tokens, std::size_t i,
                          std::string_view dotted);
  std::size_t write_choice(Writing& writing, std::span<const lang::Token> tokens,
                           const Replacements& replacements);
  lang::Token made(lang::TokenKind kind, std::string_view text, const lang::Token& place);
  std::uint32_t query_named(Query::Kind kind, std::string target);

  const lang::Token& here() const { return tokens_.at(at_); }
  bool is_here(std::string_view symbol) const { return tokens_.is(at_, symbol); }
  bool take(std::string_view symbol);
  void expect(std::string_view symbol, std::string_view after);
  void fault(const lang::Token& token, std::string message);
  std::uint32_t offset_here() const { return static_cast<std::uint32_t>(here().offset); }
  std::uint32_t symbol_of(std::string_view name, std::uint32_t offset);
  std::uint32_t word_of(std::string_view word);

  Grammar& grammar_;
  std::vector<lang::Fault>& faults_;
  Tokens tokens_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::map<std::string, std::uint32_t, std::less<>> symbols_, words_;
  std::map<std::string, Function, std::less<>> functions_;
  std::vector<Declaration> declarations_;
  std::map<std::string, std::size_t, std::less<>> declared_;
  std::vector<std::vector<std::size_t>> notes_;  ///< of each declaration: its annotations
  std::set<std::string> kept_;                   ///< texts that made tokens point to
  lang::Names names_;
  std::set<std::string, std::less<>> symbols_with_rules_;
  std::uint32_t start_ = none;
  std::size_t last_fault_ = static_cast<std::size_t>(-1);
  std::size_t written_ = 0;                   ///< tokens of all expressions, functions written out
  std::vector<std::string> attribute_order_;  ///< those that others need first
};

}  // namespace seedmesh::building
