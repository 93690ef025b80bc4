#include "core/schema/forms.h"

#include <algorithm>

#include "core/schema/color.h"

namespace seedmesh::schema {
namespace {

// The functions of <cctype> depend on the locale.
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_small(char c) { return c >= 'a' && c <= 'z'; }
bool is_letter(char c) { return is_small(c) || (c >= 'A' && c <= 'Z'); }

bool is_color(std::string_view text) { return color_of(text).has_value(); }

bool is_name(std::string_view text) {
  return !text.empty() && !is_digit(text[0]) &&
         std::ranges::all_of(text, [](char c) { return is_letter(c) || is_digit(c) || c == '_'; });
}

bool is_preset_name(std::string_view text) {
  return !text.empty() &&
         std::ranges::all_of(text, [](char c) { return is_small(c) || is_digit(c) || c == '_' || c == '-'; });
}

bool is_model_name(std::string_view text) {
  return !text.empty() && text.size() <= 64 && std::ranges::all_of(text, [](char c) {
    return is_letter(c) || is_digit(c) || c == '_' || c == '-';
  });
}

bool is_digits(std::string_view text) {
  return !text.empty() && text.size() <= 20 && std::ranges::all_of(text, is_digit);
}

}  // namespace

namespace forms {
const Form color = {"^#[0-9a-fA-F]{6}$", "color", "a colour such as #8c6b4f", is_color};
const Form name = {"^[A-Za-z_][A-Za-z0-9_]*$", "name",
                   "a name of letters, digits and _ that does not begin with a digit", is_name};
const Form preset_name = {"^[a-z0-9_-]+$", "preset_name", "a name of lower-case letters, digits, - and _",
                          is_preset_name};
const Form model_name = {"^[A-Za-z0-9_-]{1,64}$", "model_name", "1 to 64 letters, digits, - and _",
                         is_model_name};
const Form digits = {"^[0-9]{1,20}$", "digits", "1 to 20 decimal digits", is_digits};
}  // namespace forms

const Form* find_form(std::string_view pattern) {
  for (const Form* form :
       {&forms::color, &forms::name, &forms::preset_name, &forms::model_name, &forms::digits}) {
    if (form->pattern == pattern) return form;
  }
  return nullptr;
}

}  // namespace seedmesh::schema
