#pragma once
/// The text patterns that a schema may use. Other validators run the regular expression; this program tests
/// the text with a function instead, so that no regular expression is ever evaluated here.
#include <string_view>

namespace seedmesh::schema {

struct Form {
  std::string_view pattern;   ///< the regular expression, exactly as schemas write it
  std::string_view name;      ///< its name in namespace forms
  std::string_view expected;  ///< for messages: "a colour such as #8c6b4f"
  bool (*accepts)(std::string_view text);
};

namespace forms {
extern const Form color;        ///< #rrggbb
extern const Form name;         ///< a letter or _, then letters, digits, _
extern const Form preset_name;  ///< lower-case letters, digits, - and _
extern const Form model_name;   ///< 1 to 64 letters, digits, - and _
extern const Form digits;       ///< 1 to 20 decimal digits
}  // namespace forms

/// Returns the form with this pattern; null if there is none.
const Form* find_form(std::string_view pattern);

}  // namespace seedmesh::schema
