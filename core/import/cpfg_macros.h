#pragma once
/// The macros of a file of cpfg: #define NAME text and #define NAME(parameters) text. A macro whose text is an
/// operand becomes a constant or a function of the request. Every other macro is expanded as text.
#include <map>
#include <string>
#include <vector>

#include "core/import/foreign_text.h"
#include "core/import/traced_text.h"
#include "core/lang/expression.h"

namespace seedmesh {

class CpfgMacros {
 public:
  explicit CpfgMacros(ForeignText& source) : source_(source) {}

  /// Reads a line that begins with `#`.
  void define(std::string_view text, Line line);

  bool knows(const std::string& name) const { return macros_.contains(name); }
  void undefine(const std::string& name) { macros_.erase(name); }

  /// Decides which macros are constants or functions. Call it after the last define().
  void sort();

  /// Returns `text` with its macros expanded, except for constants and for functions whose arguments are single
  /// operands. Reports an error and returns an empty text if macros contain themselves or the result is too long.
  TracedText expanded(const TracedText& text);

  struct Expression {
    std::string name, text;  ///< for a function: its whole definition
    std::size_t at = 0;
  };
  std::vector<Expression> constants();
  std::vector<Expression> functions();

 private:
  struct Macro {
    std::size_t at = 0;
    bool has_parameters = false;
    std::vector<std::string> parameters;
    std::string parameter_list, body;
    bool is_value = false;  ///< a constant or a function of the request
  };
  bool parses(lang::Names& names, const Macro& macro) const;
  TracedText expand(const TracedText& text, int depth);
  bool expand_call(const std::string& name, const Macro& macro, const TracedText& text, std::size_t& at,
                   int depth, TracedText& out);
  TracedText pasted(const Macro& macro, const std::vector<TracedText>& arguments, std::size_t from) const;
  void stop(std::size_t at, const char* why);

  ForeignText& source_;
  std::map<std::string, Macro> macros_;
  std::size_t spent_ = 0;  ///< bytes written by the current expansion
  bool is_stopped_ = false;
};

bool is_name_part(char c);

}  // namespace seedmesh
