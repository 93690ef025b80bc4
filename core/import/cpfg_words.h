#pragma once
/// Converts modules of cpfg. A symbol of cpfg has one character. `@Gs`, `~l` and `?P` are two or three
/// modules there, which its turtle reads together. Here each of them is one module.
#include <map>
#include <set>
#include <string>
#include <string_view>

#include "core/generators/lsystem/notation.h"
#include "core/import/foreign_text.h"
#include "core/import/traced_text.h"

namespace seedmesh {

class CpfgWords {
 public:
  explicit CpfgWords(ForeignText& source) : source_(source) {}

  /// A word is written; a pattern is matched, and its parameters are names.
  enum class Role { word, pattern };

  /// Returns the modules of text[slice]. A module without a counterpart is left out of a word, with a warning; in a
  /// pattern it is an error.
  TracedText modules(const TracedText& text, lsystem::Slice slice, Role role);

  /// Converts an expression or statements to our notation. In cpfg a sign binds closer than `^`, which is left
  /// associative, and `a ? b : c` selects a value.
  TracedText expression(const TracedText& text, lsystem::Slice slice) const;

  /// Returns the number of modules in our notation.
  static std::size_t count(const TracedText& text);

  /// Returns the surfaces that `~` places, by their character, with the first offset of each.
  const std::map<char, std::size_t>& surfaces() const { return surfaces_; }
  void add_surface(char symbol, std::size_t at) { surfaces_.emplace(symbol, at); }
  static std::string surface_name(char symbol);

  /// Returns the circles and spheres that occur, by the name of their surface: `_o`, `_c` and `_O`.
  const std::map<std::string, std::size_t, std::less<>>& rounds() const { return rounds_; }

  /// Returns the symbols of more than one character that occur, such as `@v` and `~l`.
  const std::set<std::string>& longer() const { return longer_; }

  /// Returns the symbols for the parameters `ignore` and `consider`, from a list of characters. cpfg compares
  /// single characters, so a longer symbol belongs to the list if its first character does.
  std::string listed(std::string_view characters) const;

  /// Returns the characters after the first one in symbols of more than one character, each with its symbol.
  const std::map<char, std::string>& inside() const { return inside_; }

  void warn_once(std::size_t at, const std::string& symbol, const std::string& text);

 private:
  static TracedText powers(const TracedText& text, lsystem::Slice slice);
  struct Module;
  Module read(const TracedText& text, std::size_t at, std::size_t to) const;
  void write(const Module& module, const TracedText& text, Role role, TracedText& out);
  void write_command(const Module& module, const TracedText& text, Role role, TracedText& out);
  void write_round(const Module& module, std::string_view surface, const TracedText& text, TracedText& out);
  void write_surface(const Module& module, const TracedText& text, TracedText& out);
  void write_query(const Module& module, const TracedText& text, Role role, TracedText& out);
  void write_curve(const Module& module, const TracedText& text, TracedText& out);
  void copy(const Module& module, const TracedText& text, Role role, TracedText& out);
  void copy_arguments(const Module& module, const TracedText& text, Role role, TracedText& out);
  void pad(const Module& module, const TracedText& text, Role role, TracedText& out);
  void leave_out(const Module& module, Role role, const std::string& why);

  ForeignText& source_;
  std::map<char, std::size_t> surfaces_;
  std::map<std::string, std::size_t, std::less<>> rounds_;
  std::set<std::string> longer_;
  std::map<char, std::string> inside_;
  std::set<std::string> warned_;
  bool in_curve_ = false;  ///< in the word that is being read
  int unnamed_ = 0;        ///< number of parameters that were added to patterns
};

}  // namespace seedmesh
