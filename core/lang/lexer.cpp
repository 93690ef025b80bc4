#include "core/lang/lexer.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>

namespace seedmesh::lang {
namespace {

// The functions of <cctype> depend on the locale.
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_name_start(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_name_part(char c) { return is_name_start(c) || is_digit(c); }
bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
bool is_sign(char c) { return c > ' ' && c < '\x7F' && !is_name_part(c); }

/// Longest first, so that the first match is the token.
constexpr std::array<std::string_view, 11> long_symbols = {"-->", "==", "!=", "<=", ">=", "&&",
                                                           "||",  "->", "~>", "<<", ">>"};
constexpr std::array<std::string_view, 2> arrows = {"\u2192", "\u27F6"};
constexpr std::string_view no_break_space = "\u00A0";

/// Typographic characters, and the ASCII characters that they replace.
struct Lookalike {
  std::string_view found, meant;
};
constexpr std::array<Lookalike, 9> lookalikes = {{{"\u2212", "-"},
                                                  {"\u2013", "-"},
                                                  {"\u00D7", "*"},
                                                  {"\u00B7", "*"},
                                                  {"\u00F7", "/"},
                                                  {"\u2264", "<="},
                                                  {"\u2265", ">="},
                                                  {"\u2260", "!="},
                                                  {"\u2032", "'"}}};

/// The bytes of the first code point of `text`, 0 if it is not valid UTF-8.
std::size_t character_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xC2 ? 0
                             : lead < 0xE0 ? 2
                             : lead < 0xF0 ? 3
                             : lead < 0xF5 ? 4
                                           : 0;
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80U) return 0;
  }
  return length;
}

/// Whether a number beyond the range of a double is too large, not too small. `text` consists of digits, a point
/// and an exponent, so that the sign of the decimal exponent decides.
bool is_too_large(std::string_view text) {
  const std::size_t mark = text.find_first_of("eE");
  const std::string_view digits = text.substr(0, mark);
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::size_t first = digits.find_first_of("123456789");
  if (first == std::string_view::npos) return false;
  const auto magnitude = static_cast<long long>(point) - static_cast<long long>(first);
  if (mark == std::string_view::npos) return magnitude > 0;

  std::string_view exponent = text.substr(mark + 1);
  if (exponent.front() == '+') exponent.remove_prefix(1);
  long long power = 0;
  const auto [end, error] = std::from_chars(exponent.data(), exponent.data() + exponent.size(), power);
  if (error == std::errc::result_out_of_range) return exponent.front() != '-';
  return power > -magnitude;
}

/// The number of four hexadecimal digits; -1 for any other text.
std::int32_t code_unit(std::string_view digits) {
  std::int32_t unit = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), unit, 16);
  return digits.size() == 4 && error == std::errc() && end == digits.data() + 4 && unit >= 0 ? unit : -1;
}

/// Appends a character of the basic plane. Halves of surrogate pairs become the replacement character.
void add_utf8(std::string& text, std::uint32_t unit) {
  if (unit >= 0xD800 && unit < 0xE000) unit = 0xFFFD;
  if (unit < 0x80) {
    text += static_cast<char>(unit);
    return;
  }
  if (unit < 0x800) {
    text += static_cast<char>(0xC0U | unit >> 6U);
  } else {
    text += static_cast<char>(0xE0U | unit >> 12U);
    text += static_cast<char>(0x80U | (unit >> 6U & 0x3FU));
  }
  text += static_cast<char>(0x80U | (unit & 0x3FU));
}

class Lexer {
 public:
  Lexer(std::string_view text, std::size_t from, std::size_t to, std::vector<TextError>& errors)
      : text_(text.substr(0, to)), at_(from), errors_(errors), errors_before_(errors.size()) {}

  std::vector<Token> read() {
    while (skip_space()) {
      if (tokens_.size() >= max_tokens || errors_.size() - errors_before_ >= max_errors - 2) {
        report(at_, "too many tokens or errors: the rest of the text was not read");
        break;
      }
      read_one();
    }
    tokens_.push_back({TokenKind::end, {}, text_.size(), 0, 0});
    return std::move(tokens_);
  }

 private:
  std::string_view rest() const { return text_.substr(at_); }
  void report(std::size_t offset, std::string message) { errors_.push_back({offset, std::move(message)}); }

  void add(TokenKind kind, std::size_t length) {
    tokens_.push_back({kind, text_.substr(at_, length), at_, length, 0});
    at_ += length;
  }

  /// False at the end of the text.
  bool skip_space() {
    while (at_ < text_.size()) {
      if (is_space(text_[at_])) {
        ++at_;
      } else if (rest().starts_with(no_break_space)) {
        at_ += no_break_space.size();
      } else {
        return true;
      }
    }
    return false;
  }

  void read_one() {
    const char c = text_[at_];
    const bool point_and_digit = c == '.' && at_ + 1 < text_.size() && is_digit(text_[at_ + 1]);
    if (is_digit(c) || point_and_digit) return read_number();
    if (is_name_start(c)) return read_name();
    if (c == '"') return read_string();
    if (is_sign(c)) return read_symbol();
    read_foreign();
  }

  void read_number() {
    double value = 0;
    const std::string_view source = rest();
    const auto [end, error] = std::from_chars(source.data(), source.data() + source.size(), value);
    const auto length = static_cast<std::size_t>(end - source.data());
    if (error == std::errc::result_out_of_range) {
      value = 0;  // the nearest value of a number that is too small
      if (is_too_large(source.substr(0, length))) {
        report(at_, "the number " + in_quotes(source.substr(0, length)) +
                        " is too large: the largest is about 1.8e308");
      }
    }
    add(TokenKind::number, length);
    tokens_.back().number = value;
  }

  void read_name() {
    std::size_t end = at_ + 1;
    while (end < text_.size() && is_name_part(text_[end])) ++end;
    add(TokenKind::name, end - at_);
  }

  void read_string() {
    const std::size_t open = at_;
    std::size_t end = open + 1;
    std::size_t bad_escape = 0;  // only the first of a string is reported
    while (end < text_.size() && text_[end] != '"' && text_[end] != '\n') {
      if (text_[end] == '\\' && end + 1 < text_.size() && text_[end + 1] != '\n') {
        const bool known = std::string_view("\"\\nt").find(text_[end + 1]) != std::string_view::npos ||
                           (text_[end + 1] == 'u' && code_unit(text_.substr(end + 2, 4)) >= 0);
        if (!known && bad_escape == 0) bad_escape = end;
        ++end;
      }
      ++end;
    }
    const bool closed = end < text_.size() && text_[end] == '"';
    if (!closed) report(open, "the string that opens here is not closed on its line");
    if (bad_escape > 0) report(bad_escape, R"(unknown escape in a string: there are \" \\ \n \t \u0000)");
    tokens_.push_back(
        {TokenKind::string, text_.substr(open + 1, end - open - 1), open, end + (closed ? 1 : 0) - open, 0});
    at_ = end + (closed ? 1 : 0);
  }

  void read_symbol() {
    const std::string_view source = rest();
    const auto* const found =
        std::find_if(long_symbols.begin(), long_symbols.end(),
                     [&](std::string_view symbol) { return source.starts_with(symbol); });
    add(TokenKind::symbol, found == long_symbols.end() ? 1 : found->size());
  }

  /// Arrows are symbols. Every other character beyond ASCII, and every control character, is an error.
  void read_foreign() {
    const std::string_view source = rest();
    for (const std::string_view arrow : arrows) {
      if (source.starts_with(arrow)) {
        add(TokenKind::symbol, arrow.size());
        tokens_.back().text = "->";
        return;
      }
    }
    const std::size_t length = character_length(source);
    const auto byte = static_cast<unsigned char>(source.front());
    if (length == 0 || byte < 0x80) {
      report(at_, "unexpected byte " + std::to_string(int{byte}) + ", which is not part of a text");
      ++at_;
      return;
    }
    const std::string_view character = source.substr(0, length);
    std::string message = "unexpected character " + in_quotes(character);
    for (const Lookalike& pair : lookalikes) {
      if (pair.found == character) message += "; write " + in_quotes(pair.meant);
    }
    report(at_, std::move(message));
    at_ += length;
  }

  std::string_view text_;
  std::size_t at_;
  std::vector<TextError>& errors_;
  std::size_t errors_before_;
  std::vector<Token> tokens_;
};

}  // namespace

std::vector<Token> tokenize(std::string_view text, std::size_t from, std::size_t to,
                            std::vector<TextError>& errors) {
  assert(from <= to && to <= text.size());
  return Lexer(text, from, to, errors).read();
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string shown;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text.substr(i));
    if (i + length > longest) return "`" + shown + "...`";
    const bool is_shown = length > 1 || (length == 1 && text[i] >= ' ' && text[i] != '\x7F');
    shown += is_shown ? text.substr(i, length) : "?";  // a message is valid UTF-8 even if the text is not
    i += std::max<std::size_t>(length, 1);
  }
  return "`" + shown + "`";
}

std::string in_quotes(const Token& token) {
  if (token.kind == TokenKind::end) return "the end";
  if (token.kind == TokenKind::string) return "the string " + in_quotes(token.text);
  return in_quotes(token.text);
}

std::string string_value(const Token& token) {
  std::string value;
  for (std::size_t i = 0; i < token.text.size(); ++i) {
    const char c = token.text[i];
    if (c != '\\' || i + 1 == token.text.size()) {
      value += c;
    } else {
      const char escaped = token.text[++i];
      const std::int32_t unit = escaped == 'u' ? code_unit(token.text.substr(i + 1, 4)) : -1;
      if (unit >= 0) {
        add_utf8(value, static_cast<std::uint32_t>(unit));
        i += 4;
      } else {
        value += escaped == 'n' ? '\n' : escaped == 't' ? '\t' : escaped;
      }
    }
  }
  return value;
}

}  // namespace seedmesh::lang
