#include "core/import/lparser.h"

#include "core/import/foreign_text.h"

namespace seedmesh {
namespace {

/// Whether the words are one number.
bool is_number(std::string_view words) {
  std::size_t at = 0;
  double number = 0;
  return take_number(words, at, words.size(), number) && at == words.size();
}

/// Whether the words are a command of Lparser's newer files (`recursion 12`). All of these files have this one.
bool is_recursion(std::string_view words) {
  constexpr std::string_view command = "recursion";
  if (!words.starts_with(command) || words.size() == command.size() || !is_blank(words[command.size()]))
    return false;
  const Line number = trimmed(words, {command.size(), words.size()});
  return is_number(words.substr(number.from, number.to - number.from));
}

}  // namespace

std::optional<std::size_t> start_of_lparser(std::string_view text) {
  constexpr std::size_t beginning = 8192;
  const std::string_view head = text.substr(0, beginning);
  std::optional<std::size_t> start;
  int numbers = 0;
  bool are_numbers = true;
  for (const Line& each : lines_of(head)) {
    const std::size_t comment = head.substr(each.from, each.to - each.from).find('#');
    const std::size_t end = comment == std::string_view::npos ? each.to : each.from + comment;
    const Line line = trimmed(head, {each.from, end});
    const std::string_view words = head.substr(line.from, line.to - line.from);
    if (words.empty()) continue;
    if (!start) start = line.from;
    if (is_recursion(words)) return start;
    are_numbers = are_numbers && is_number(words);
    if (are_numbers) ++numbers;
    // Older files begin with the recursion, the angle and the thickness.
    if (numbers == 3 && !are_numbers && words.size() > 2 && words[1] == '=') return start;
  }
  return std::nullopt;
}

}  // namespace seedmesh
