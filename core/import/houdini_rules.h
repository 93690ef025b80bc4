#pragma once
/// The parts of rules of a Houdini L-System, and the position of the turtle in their expressions.
#include <cstddef>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "core/import/foreign_text.h"

namespace seedmesh {

/// [left <] center [> right] [: condition] = successor [: weight]. An absent part has `from` equal to `to`.
struct HoudiniRule {
  Line head;  ///< left, center and right
  Line left, center, right, condition, successor, weight;
  std::size_t equals = 0;  ///< offset of the `=`; line.to if there is none, and then all parts are empty
  bool has_left = false, has_right = false;
};

/// Returns the offset of the = of a rule, outside of parentheses and comparisons; line.to if there is none.
std::size_t houdini_equals(std::string_view text, Line line);
HoudiniRule houdini_rule(std::string_view text, Line line);

/// The variables x, y and z are the position of the turtle. Here a query `?P` before a module receives it, and is the
/// left context of its rules:
///
///   A : y > 2 = B    becomes    ?P(x,y,z) < A : y > 2 -> B    with ?P(0,0,0)A where A is written
///
/// Queries would separate neighbouring modules, so in an L-System with contexts x, y and z stay constants.
class HoudiniPositions {
 public:
  HoudiniPositions() = default;
  HoudiniPositions(std::string_view text, const std::vector<Line>& rules);

  /// Whether a query stands before modules of this symbol.
  bool has(char symbol) const { return counts_.contains(symbol); }
  /// Whether a rule reads the position.
  bool reads(std::string_view text, const HoudiniRule& rule) const;
  /// Adds rules that write a new query before each module that is not rewritten, and remove the query of the
  /// previous step.
  void put(Json& parameters) const;

 private:
  std::map<char, std::set<std::size_t>>
      counts_;  ///< symbols, with the numbers of parameters that may stay as they are
};

}  // namespace seedmesh
