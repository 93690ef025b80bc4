#pragma once
/// Names in the expressions of a Houdini L-System: the variables of the node. HoudiniArities writes the rules that
/// symbols with several numbers of parameters need.
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include "core/import/foreign_text.h"

namespace seedmesh {

class HoudiniNames {
 public:
  /// The predecessor and contexts of the rule that is read; their parameters hide variables. `has_position`: x, y and z
  /// are parameters, too.
  void begin_rule(std::string_view head, bool has_position) {
    formal_ = head;
    has_position_ = has_position;
  }
  void end_rule() { begin_rule({}, false); }

  /// Notes the names of an expression at byte `at` of the file.
  void note(std::string_view text, std::size_t at);
  /// Returns the arguments with `i`, the index of a module in its successor, replaced by its value.
  std::string with_index(const std::string& arguments, std::size_t index) const;

  /// Adds the variables of the node to the parameters: t counts generations, and T is `gravity`. Other
  /// variables become 0, with a warning.
  void put(double gravity, Json& parameters, ForeignText& source) const;

 private:
  bool is_formal(std::string_view name) const;

  std::string_view formal_;
  bool has_position_ = false;
  std::map<std::string, std::size_t> names_;  ///< with the first offset of each
};

/// The numbers of parameters with which F, H, f, h and g occur.
class HoudiniArities {
 public:
  void note(char symbol, const std::string& arguments);
  /// Returns interpretation rules for H, which is half of F, and for F(l,w,s,d), which has its own width.
  Json interpretation() const;

 private:
  std::set<std::pair<char, std::size_t>> arities_;
};

}  // namespace seedmesh
