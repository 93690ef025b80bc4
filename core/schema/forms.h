#pragma once
/// The patterns that a schema may use. Each is known by its regular expression, which other validators run,
/// and tested here by a function: no regular expression of a schema is ever run by this program.
#include <string_view>

namespace seedmesh::schema {

struct Form {
  std::string_view pattern;   ///< as it stands in a schema
  std::string_view name;      ///< the C++ name in namespace forms
  std::string_view expected;  ///< "a colour such as #8c6b4f"
  bool (*accepts)(std::string_view text);
};

namespace forms {
extern const Form color;        ///< #rrggbb
extern const Form name;         ///< a letter or _, then letters, digits, _
extern const Form preset_name;  ///< small letters, digits, - and _
extern const Form digits;       ///< 1 to 20 decimal digits
}  // namespace forms

/// The form of a pattern, null where no form has it.
const Form* find_form(std::string_view pattern);

}  // namespace seedmesh::schema
