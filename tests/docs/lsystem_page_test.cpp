/// docs/lsystem.md against what it describes: the turtle's table of symbols and the shipped presets.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/generators/lsystem/commands.h"

namespace seedmesh::lsystem {
namespace {

namespace fs = std::filesystem;

/// The rows of the table whose first heading is `heading`, without heading and rule.
std::vector<std::string> table_rows(const std::string& heading) {
  std::ifstream page(SEEDMESH_SOURCE_DIR "/docs/lsystem.md");
  std::vector<std::string> rows;
  bool inside = false;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("| " + heading + " |", 0) == 0) {
      inside = true;
    } else if (inside && line.rfind("| ---", 0) != 0) {
      if (line.empty()) return rows;
      rows.push_back(line);
    }
  }
  return rows;
}

/// A bar inside a Markdown table needs a backslash.
std::string in_table(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c;
  }
  return out;
}

TEST(LsystemPage, HasOneRowForEverySymbolOfTheTurtle) {
  std::vector<std::string> expected;
  for (const CommandRow& row : commands()) {
    expected.push_back("| `" + in_table(row.symbol) + std::string(row.parameters) + "` | " +
                       in_table(row.text) + " |");
  }
  EXPECT_EQ(table_rows("symbol"), expected);
}

TEST(LsystemPage, HasOneRowForEveryPreset) {
  std::set<std::string> expected;
  for (const auto& file : fs::directory_iterator(SEEDMESH_SOURCE_DIR "/api_schema/presets/lsystem")) {
    const auto preset = nlohmann::json::parse(std::ifstream(file.path()));
    std::string row =
        "| `" + file.path().stem().string() + "` | " + preset.at("title").get<std::string>() + " | ";
    bool first = true;
    for (const std::string tag : preset.at("tags")) {
      row += (first ? "" : ", ") + tag;
      first = false;
    }
    expected.insert(row + " |");
  }
  const std::vector<std::string> rows = table_rows("name");
  EXPECT_EQ(rows.size(), expected.size());
  EXPECT_EQ(std::set<std::string>(rows.begin(), rows.end()), expected);
}

}  // namespace
}  // namespace seedmesh::lsystem
