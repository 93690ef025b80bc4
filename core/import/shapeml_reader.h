#pragma once
/// The reader of ShapeML: its rules in the notation of CityEngine.
#include <map>
#include <set>

#include "core/import/shapeml_text.h"

namespace seedmesh {

/// A rule: tokens of its head and of its body between the braces.
struct ShapemlRule {
  std::size_t name = 0, parameters = 0;  ///< tokens; parameters: of the bracket, or 0
  std::size_t weight = 0, weight_end = 0, condition = 0, condition_end = 0;
  std::size_t body = 0, body_end = 0;
};

class ShapemlReader : private ShapemlText {
 public:
  explicit ShapemlReader(ForeignText& source) : ShapemlText(source) {}
  Imported read();

 private:
  friend class ShapemlPattern;

  /// Declares a function of shapeml_functions().
  void need(const char* function) { needed_.insert(function); }
  /// Warns once if the file uses `index`.
  void warn_of_index(std::size_t i, const char* message);
  std::size_t statement(std::size_t i);
  /// rule Name(parameters) : weight :: condition = { body }
  void head(std::size_t i, std::size_t end);
  /// The `=` before the braces of a rule.
  std::size_t body_sign(std::size_t i, std::size_t end) const;
  /// All rules of a name as cases, and those of one condition as percentages.
  void write_rule(const std::string& name);
  bool is_type(std::size_t k) const;
  void write_choices(const std::vector<ShapemlRule>& rules);
  double weight_of(const ShapemlRule& rule);
  void operations(std::size_t from, std::size_t to, int depth);
  /// Operations, and the end of a shape that they do not name.
  void whole(std::size_t from, std::size_t to, int depth);
  /// repeat(n, { ... }): a rule of its own, with the parameters of the rule around it
  void repeat(std::size_t i, const std::vector<std::pair<std::size_t, std::size_t>>& given, int depth);
  /// extrudeWorld(0, 1, 0, height)
  void extrude_world(std::size_t i, const std::vector<std::pair<std::size_t, std::size_t>>& given);
  void step(std::size_t i, int depth);
  void write_all(const std::vector<std::pair<std::size_t, std::size_t>>& given);
  /// Writes a row of the table with the arguments in the place of $1, $2 and $*.
  void write_as(std::size_t i, std::string_view rules,
                const std::vector<std::pair<std::size_t, std::size_t>>& given);
  /// scale(f), scale(x, y, z) and the same about the centre
  void scale(std::size_t i, const std::vector<std::pair<std::size_t, std::size_t>>& given);
  /// set("name", value): an attribute of the rules
  void set(std::size_t i, const std::vector<std::pair<std::size_t, std::size_t>>& given);
  /// Operations in braces. `index` becomes the value of `index` in them.
  void block(const std::pair<std::size_t, std::size_t>& given, int depth, std::string_view index);
  void split(std::size_t i, const std::vector<std::pair<std::size_t, std::size_t>>& given, int depth);
  /// splitX("s(f)s", size, { ... }, ...); see shapeml_pattern.cpp
  void pattern(std::size_t i, const std::string& signs,
               const std::vector<std::pair<std::size_t, std::size_t>>& given, int depth);

  TracedText rules_, repeated_;   ///< repeated_: rules of repeat()
  std::string parameters_;        ///< names of the parameters of the current rule, each behind a comma
  int repeats_ = 0;               ///< rules of repeat()
  bool ends_with_shape_ = false;  ///< of the last operations
  std::map<std::string, std::vector<ShapemlRule>> by_name_;
  std::vector<std::string> order_;
  std::set<std::string, std::less<>> warned_;
  std::set<std::string> leaves_;  ///< that `hide` can make invisible
};

}  // namespace seedmesh
