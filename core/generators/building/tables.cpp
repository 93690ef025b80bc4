#include "core/generators/building/tables.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace seedmesh::building {
namespace {

std::string_view stem_of(std::string_view path) {
  if (const std::size_t slash = path.find_last_of('/'); slash != std::string_view::npos)
    path.remove_prefix(slash + 1);
  return path.substr(0, path.find_last_of('.'));
}

char separator_of(std::string_view first_line) {
  for (const char each : {';', '\t'}) {
    if (first_line.find(each) != std::string_view::npos) return each;
  }
  return ',';
}

double number_of_cell(const std::string& cell) {
  double value = 0;
  const std::size_t first = cell.find_first_not_of(" +");
  if (first == std::string::npos) return 0;
  std::from_chars(cell.data() + first, cell.data() + cell.size(), value);
  return std::isfinite(value) ? value : 0;
}

}  // namespace

const std::string& table_text(Evaluation& at, std::string_view path) {
  const std::map<std::string, std::string>* const tables = at.d.task.tables;
  if (tables != nullptr) {
    for (const auto& [name, text] : *tables) {
      if (name == path) return text;
    }
    for (const auto& [name, text] : *tables) {
      if (stem_of(name) == stem_of(path)) return text;
    }
  }
  const std::string message = "the request has no table " + lang::in_quotes(path) + "; give it in \"tables\"";
  if (!at.d.grammar.is_cityengine) reject(at, message);
  warn(at.d, at.offset, message + "; it is empty here");
  static const std::string empty;
  return empty;
}

std::vector<std::vector<std::string>> cells_of_table(std::string_view text) {
  std::vector<std::vector<std::string>> rows;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  const char separator = separator_of(text.substr(0, text.find('\n')));
  std::size_t i = 0;
  while (i < text.size()) {
    std::vector<std::string>& row = rows.emplace_back(1);
    bool is_quoted = false;
    for (; i < text.size(); ++i) {
      const char c = text[i];
      if (c == '"' && is_quoted && i + 1 < text.size() && text[i + 1] == '"') {
        row.back() += '"';
        ++i;
      } else if (c == '"') {
        is_quoted = !is_quoted;
      } else if (!is_quoted && c == '\n') {
        break;
      } else if (!is_quoted && c == separator) {
        row.emplace_back();
      } else if (c != '\r') {
        row.back() += c;
      }
    }
    ++i;
    if (row.size() == 1 && row[0].empty()) rows.pop_back();
  }
  return rows;
}

ValueArray read_table(Evaluation& at, std::string_view path, TableCells cells) {
  const std::vector<std::vector<std::string>> rows = cells_of_table(table_text(at, path));
  std::size_t columns = 0;
  for (const auto& row : rows) columns = std::max(columns, row.size());
  if (columns * rows.size() > 100'000) reject(at, "the table has more than 100,000 cells");
  ValueArray out;
  out.columns = static_cast<std::uint32_t>(columns);
  for (const auto& row : rows) {
    for (std::size_t c = 0; c < columns; ++c) {
      const std::string cell = c < row.size() ? row[c] : std::string();
      out.values.push_back(cells == TableCells::texts ? text_value(at, cell)
                                                      : number_value(number_of_cell(cell)));
    }
  }
  return out;
}

}  // namespace seedmesh::building
