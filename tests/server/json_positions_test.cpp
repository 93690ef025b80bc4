#include "server/json_positions.h"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <random>

namespace seedmesh {
namespace {

/// Writes random JSON and notes where each value begins, by its pointer.
class Writer {
 public:
  explicit Writer(unsigned seed) : random_(seed) { value("", 0); }

  std::string text;
  std::map<std::string, TextPosition> begins;

 private:
  unsigned draw(unsigned count) { return static_cast<unsigned>(random_() % count); }

  void put(const std::string& part, int columns) {
    text += part;
    column_ += columns;
  }

  void space() {
    for (unsigned i = draw(3); i > 0; --i) {
      if (draw(4) == 0) {
        text += '\n';
        ++line_, column_ = 1;
      } else {
        put(draw(2) == 0 ? " " : "\t", 1);
      }
    }
  }

  /// A string with escapes, quotation marks and letters of several bytes; the key of its pointer comes back.
  std::string string(const std::string& begin) {
    struct Piece {
      const char *json, *pointer;
      int columns;
    };
    constexpr Piece pieces[] = {{"a", "a", 1},      {"/", "~1", 1},     {"~", "~0", 1},
                                {R"(\")", "\"", 2}, {R"(\\)", "\\", 2}, {R"(\u00e9)", "é", 6},
                                {"ß", "ß", 1},      {"]}", "]}", 2},    {"𝄞", "𝄞", 1}};
    std::string token = begin;
    put('"' + begin, 1 + static_cast<int>(begin.size()));
    for (unsigned i = draw(4); i > 0; --i) {
      const Piece& piece = pieces[draw(std::size(pieces))];
      put(piece.json, piece.columns);
      token += piece.pointer;
    }
    put("\"", 1);
    return token;
  }

  void value(const std::string& pointer, int depth) {
    space();
    begins[pointer] = {line_, column_};
    const unsigned kind = draw(depth > 4 ? 3 : 5);
    if (kind == 0) {
      put("-12.5e3", 7);
    } else if (kind == 1) {
      put("null", 4);
    } else if (kind == 2) {
      string("");
    } else {
      const bool is_object = kind == 3;
      put(is_object ? "{" : "[", 1);
      const unsigned count = draw(4);
      for (unsigned i = 0; i < count; ++i) {
        if (i > 0) put(",", 1);
        space();
        std::string token = std::to_string(i);
        if (is_object) {
          token = string(token);
          space();
          put(":", 1);
        }
        value(pointer + "/" + token, depth + 1);
      }
      space();
      put(is_object ? "}" : "]", 1);
    }
    space();
  }

  std::mt19937 random_;
  int line_ = 1, column_ = 1;
};

TEST(JsonPositions, KnowWhereEachValueOfRandomTextsBegins) {
  std::size_t values = 0;
  for (unsigned seed = 0; seed < 60'000; ++seed) {
    const Writer written(seed);
    ASSERT_TRUE(nlohmann::json::accept(written.text)) << written.text;
    const JsonPositions positions(written.text);
    ASSERT_FALSE(positions.duplicate());
    for (const auto& [pointer, begin] : written.begins) {
      ASSERT_TRUE(positions.contains(pointer)) << pointer << " of " << written.text;
      const TextPosition found = positions.of(pointer);
      ASSERT_EQ(found.line, begin.line) << pointer << " of " << written.text;
      ASSERT_EQ(found.column, begin.column) << pointer << " of " << written.text;
    }
    values += written.begins.size();
  }
  EXPECT_GT(values, 100'000U);
}

TEST(JsonPositions, GiveTheObjectOfAMissingMember) {
  const std::string text = "{\n \"a\": {\"b\": 1}}";
  const JsonPositions positions(text);
  EXPECT_FALSE(positions.contains("/a/c"));
  EXPECT_EQ(positions.of("/a/c/d").line, 2);
  EXPECT_EQ(positions.of("/a/c/d").column, 7);
  EXPECT_EQ(positions.of("/z").column, 1);
}

TEST(JsonPositions, NameTheSecondOfTwoEqualKeys) {
  const std::string text = "{\"a\": {\"é\": 1,\n  \"\\u00e9\": 2}, \"b\": 1}";
  const JsonPositions positions(text);
  ASSERT_TRUE(positions.duplicate());
  EXPECT_EQ(positions.duplicate()->key, "é");
  EXPECT_EQ(positions.duplicate()->position.line, 2);
  EXPECT_EQ(positions.duplicate()->position.column, 3);
}

}  // namespace
}  // namespace seedmesh
