#pragma once
/// A walk over tokens that survives faults: where the parser is, what went wrong so far, and how to get back
/// on the road.
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/lang/lexer.h"

namespace seedmesh::lang {

/// What keeps a parser from going on.
enum class Damage {
  none,
  local,  ///< the next bracket or comma of the open call saves it
  total,  ///< the expression is over
};

class Reader {
 public:
  /// Brackets, calls, signs and powers inside each other beyond `max_depth` are a fault.
  Reader(std::span<const Token> tokens, std::size_t at, std::uint32_t max_depth);

  std::size_t at() const { return at_; }
  const Token& token(std::size_t ahead = 0) const {
    return at_ + ahead < tokens_.size() ? tokens_[at_ + ahead] : end_;
  }
  bool is_here(std::string_view symbol) const { return is_symbol(token(), symbol); }
  void advance(std::size_t count = 1) { at_ += count; }

  /// Tells a fault and goes on. Of several faults in a row at one place only the first is told: the others
  /// follow from it.
  void fault(const Token& where, std::string message);
  /// Tells that something else was expected at this token.
  void break_off(const std::string& expected);
  /// Tells a fault that ends the whole expression.
  void give_up(const Token& where, std::string message);
  bool is_sound() const { return damage_ == Damage::none; }
  bool has_faults() const { return !faults_.empty(); }

  /// False, and the end, where it goes too deep at this token. After true comes leave().
  bool enter();
  void leave() { --depth_; }
  std::uint32_t room() const { return max_depth_ - depth_; }  ///< how much deeper it may go

  enum class Until { bracket, bracket_or_comma };
  /// After local damage: goes to the `)` (or comma) of the brackets that are open now; if there is one, all
  /// is well again.
  void recover(Until until);
  /// After damage: goes to the first token that another parser may make sense of; see Program::parse.
  void skip_to_end_of_damage();

  /// What the expression begins with or what it has just read, for "expected ... after".
  std::string place_for_message() const;

  /// In the order of the text.
  std::vector<Fault> take_faults();

 private:
  std::span<const Token> tokens_;
  std::size_t at_, first_;
  std::uint32_t max_depth_, depth_ = 0;
  Damage damage_ = Damage::none;
  std::vector<Fault> faults_;
  Token end_;
};

}  // namespace seedmesh::lang
