#include "core/import/listed_objects.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace seedmesh {
namespace {

bool is_blank_byte(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

/// Moves through a JSON text. Positions at its end mean that the text has an error.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  std::size_t at = 0;

  bool is_end() const { return at >= text_.size(); }
  void skip_blanks() {
    while (at < text_.size() && is_blank_byte(text_[at])) ++at;
  }
  bool take(char c) {
    skip_blanks();
    if (is_end() || text_[at] != c) return false;
    ++at;
    return true;
  }
  /// The inside of the string that begins here, with its escapes.
  std::string_view string() {
    const std::size_t from = ++at;
    while (at < text_.size() && text_[at] != '"') at += text_[at] == '\\' ? 2 : 1;
    if (is_end()) {
      at = text_.size();
      return {};
    }
    return text_.substr(from, at++ - from);
  }
  /// Skips an object, a list, a string or a plain value.
  void value() {
    skip_blanks();
    int depth = 0;
    while (at < text_.size()) {
      const char c = text_[at];
      if (c == '"') {
        string();
        if (depth == 0) return;
        continue;
      }
      if ((c == ',' || c == '}' || c == ']') && depth == 0) return;
      ++at;
      if (c == '{' || c == '[') ++depth;
      if ((c == '}' || c == ']') && --depth == 0) return;
    }
  }

 private:
  std::string_view text_;
};

/// The objects of a list, from behind its bracket. False: it has other members or an error.
bool take_objects(std::string_view text, Scanner& scanner, std::vector<std::string_view>& out) {
  if (scanner.take(']')) return true;
  do {
    scanner.skip_blanks();
    const std::size_t from = scanner.at;
    if (scanner.is_end() || text[from] != '{') return false;
    scanner.value();
    out.push_back(text.substr(from, scanner.at - from));
  } while (scanner.take(','));
  return scanner.take(']');
}

}  // namespace

std::optional<ListedObjects> listed_objects(std::string_view text, std::string_view name) {
  ListedObjects out;
  out.name = name;
  Scanner scanner(text);
  bool has_list = false;
  if (!scanner.take('{')) return std::nullopt;
  do {
    scanner.skip_blanks();
    if (scanner.is_end() || text[scanner.at] != '"') return std::nullopt;
    const std::string_view key = scanner.string();
    if (!scanner.take(':')) return std::nullopt;
    if (key != name) {
      scanner.value();
      continue;
    }
    if (std::exchange(has_list, true) || !scanner.take('[')) return std::nullopt;
    out.shell = text.substr(0, scanner.at);
    if (!take_objects(text, scanner, out.texts)) return std::nullopt;
    out.shell += text.substr(scanner.at - 1);
  } while (scanner.take(','));
  if (!has_list) return std::nullopt;
  return out;
}

Result<Json> parse_listed(std::string_view text, const ListedObjects& objects, std::size_t index,
                          const Job* job) {
  const std::string_view one = objects.texts[index];
  Result<Json> object = parse_json(one, {.job = job});
  if (object) return object;
  Error error = std::move(object).error();
  const TextPosition start = text_position(text, static_cast<std::size_t>(one.data() - text.data()));
  for (Issue& issue : error.issues) {
    if (issue.line == 1) issue.column += start.column - 1;
    if (issue.line > 0) issue.line += start.line - 1;
    if (issue.pointer.starts_with('/'))
      issue.pointer.insert(0, "/" + std::string(objects.name) + "/" + std::to_string(index));
  }
  return error;
}

}  // namespace seedmesh
