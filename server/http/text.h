#pragma once
/// Small operations on text that several readers of header fields, URLs and settings share.
#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace seedmesh::http {

/// Whether the texts are equal without regard to the case of ASCII letters, as for field names and media types.
bool equals_ignoring_case(std::string_view a, std::string_view b);

/// Returns the text without spaces and tabs at both ends.
std::string_view trimmed(std::string_view text);

/// Removes everything up to and including the first `separator` from `rest`. Returns the trimmed part before
/// it, or all of `rest` where there is no separator.
std::string_view take_part(std::string_view& rest, char separator);

/// How percent_decode() reads a plus sign: as itself, or as a space as in form data.
enum class PlusSign { literal, space };
/// Decodes %xx. Returns nothing if an escape is malformed.
std::optional<std::string> percent_decode(std::string_view text, PlusSign plus = PlusSign::literal);

/// Returns two lower-case hexadecimal digits for each byte.
std::string hex(std::string_view bytes);

/// Returns 16 hexadecimal digits that are unique in this process and never all zero. The first one is
/// random, and each following one can be computed from the one before. An id is therefore not a secret.
std::string random_id();

/// Parses a number. Returns nothing if the text is not exactly one number, or if the number is out of range.
template <class Number>
std::optional<Number> parse_number(std::string_view text) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace seedmesh::http
