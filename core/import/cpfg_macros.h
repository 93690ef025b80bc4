#pragma once
/// The macros of a file of cpfg: #define NAME text and #define NAME(parameters) expression.
#include <map>
#include <string>
#include <vector>

#include "core/import/foreign_text.h"
#include "core/lang/expression.h"

namespace seedmesh {

class CpfgMacros {
 public:
  explicit CpfgMacros(ForeignText& source) : source_(source) {}

  /// Reads text[line], which begins with `#`.
  void define(std::string_view text, Line line);

  /// Tells expressions over numbers, functions and other such macros from texts. After the last define().
  void sort();

  /// `text`, which begins at `at`, with the macros that are texts replaced; `changed` tells whether there
  /// were any.
  std::string expanded(std::string_view text, std::size_t at, bool& changed);

  struct Expression {
    std::string name, text;  ///< of a function the whole definition
    std::size_t at = 0;
  };
  std::vector<Expression> constants() const;
  const std::vector<Expression>& functions() const { return functions_; }

 private:
  struct Macro {
    std::size_t at = 0;
    bool has_parameters = false;
    std::string parameters, body;
    bool is_expression = false;
  };
  void define_function(lang::Names& names, const std::string& name, const Macro& macro);

  ForeignText& source_;
  std::map<std::string, Macro> macros_;
  std::vector<Expression> functions_;
};

bool is_name_part(char c);

}  // namespace seedmesh
