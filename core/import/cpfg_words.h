#pragma once
/// Modules of cpfg as modules of ours. cpfg knows symbols of one character alone: `@Gs`, `~l` and `?P` are
/// two or three modules there, which its turtle reads together, and one here.
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

  /// A word is written, a pattern looked for: its parameters are names.
  enum class Place { word, pattern };

  /// The modules of text[slice]. What has no counterpart is left out of words with a warning and a fault in
  /// patterns.
  TracedText modules(const TracedText& text, lsystem::Slice slice, Place place);

  /// An expression or statements: in cpfg a sign binds closer than `^`, which groups from the left.
  TracedText expression(const TracedText& text, lsystem::Slice slice) const;

  /// How many modules text[slice] has in our notation.
  static std::size_t count(const TracedText& text);

  /// Those that `~` places, by the character behind it, with the first place of each.
  const std::map<char, std::size_t>& surfaces() const { return surfaces_; }
  void add_surface(char symbol, std::size_t at) { surfaces_.emplace(symbol, at); }
  static std::string surface_name(char symbol);

  /// The symbols of more than one character that occur, such as `@v` and `~l`.
  const std::set<std::string>& longer() const { return longer_; }

  /// The symbols of a list of characters to ignore or consider. cpfg looks at single characters: a longer
  /// symbol counts where its first one does.
  std::string listed(std::string_view characters) const;

  /// Characters that are part of such a symbol, with the symbol.
  const std::map<char, std::string>& inside() const { return inside_; }

  void warn_once(std::size_t at, const std::string& symbol, const std::string& text);

 private:
  struct Module;
  Module read(const TracedText& text, std::size_t at, std::size_t to) const;
  void write(const Module& module, const TracedText& text, Place place, TracedText& out);
  void write_command(const Module& module, const TracedText& text, Place place, TracedText& out);
  void write_surface(const Module& module, const TracedText& text, TracedText& out);
  void write_query(const Module& module, const TracedText& text, Place place, TracedText& out);
  void write_curve(const Module& module, const TracedText& text, TracedText& out);
  void copy(const Module& module, const TracedText& text, Place place, TracedText& out);
  void copy_arguments(const Module& module, const TracedText& text, Place place, TracedText& out);
  void pad(const Module& module, const TracedText& text, Place place, TracedText& out);
  void leave_out(const Module& module, Place place, const std::string& why);

  ForeignText& source_;
  std::map<char, std::size_t> surfaces_;
  std::set<std::string> longer_;
  std::map<char, std::string> inside_;
  std::set<std::string> warned_;
  bool in_curve_ = false;  ///< of the word that is read
  int unnamed_ = 0;        ///< parameters that were added to patterns
};

}  // namespace seedmesh
