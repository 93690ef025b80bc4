#pragma once
/// The macros of a file of cpfg: #define NAME text and #define NAME(parameters) text. The preprocessor pastes
/// text; what gives the same as a constant or a function of a request becomes one.
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

  /// Reads text[line], which begins with `#`.
  void define(std::string_view text, Line line);

  /// Tells constants and functions from texts. After the last define().
  void sort();

  /// `text` with the macros pasted that are texts, and functions where an argument is more than one operand.
  /// Empty, with a fault, where they contain themselves or become too long.
  TracedText expanded(const TracedText& text);

  struct Expression {
    std::string name, text;  ///< of a function the whole definition
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
    bool is_value = false;  ///< a constant or a function: a request can say it
  };
  bool parses(lang::Names& names, const Macro& macro) const;
  TracedText expand(const TracedText& text, int depth);
  bool expand_call(const std::string& name, const Macro& macro, const TracedText& text, std::size_t& at,
                   int depth, TracedText& out);
  TracedText pasted(const Macro& macro, const std::vector<TracedText>& arguments, std::size_t from) const;
  void stop(std::size_t at, const char* why);

  ForeignText& source_;
  std::map<std::string, Macro> macros_;
  std::size_t spent_ = 0;  ///< bytes written for the text that is expanded
  bool is_stopped_ = false;
};

bool is_name_part(char c);

}  // namespace seedmesh
