#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <vector>

#include "core/base/rng.h"
#include "core/schema/json.h"

namespace seedmesh {
namespace {

TEST(NumberText, IsWhatEcmascriptPrints) {
  struct Row {
    double number;
    const char* text;
  };
  // Taken from `String(x)` of a JavaScript engine.
  const Row rows[] = {{0, "0"},
                      {-0.0, "0"},
                      {1, "1"},
                      {-1, "-1"},
                      {25.7, "25.7"},
                      {0.1, "0.1"},
                      {0.1 + 0.2, "0.30000000000000004"},
                      {100, "100"},
                      {1e20, "100000000000000000000"},
                      {123456789012345680000.0, "123456789012345680000"},
                      {1e21, "1e+21"},
                      {1.5e21, "1.5e+21"},
                      {-1.7976931348623157e308, "-1.7976931348623157e+308"},
                      {0.000001, "0.000001"},
                      {0.00000123, "0.00000123"},
                      {1e-7, "1e-7"},
                      {1.23e-7, "1.23e-7"},
                      {5e-324, "5e-324"},
                      {9007199254740993.0, "9007199254740992"},
                      {123.456, "123.456"},
                      {1.0 / 3, "0.3333333333333333"}};
  for (const Row& row : rows) EXPECT_EQ(number_text(row.number), row.text);
}

TEST(NumberText, ReadsBackAsTheSameDouble) {
  Rng rng = Rng::of_seed(1);
  int finite = 0;
  while (finite < 20'000) {
    const std::uint64_t bits = rng.next();
    double number = 0;
    std::memcpy(&number, &bits, sizeof number);
    if (!std::isfinite(number)) continue;
    ++finite;
    ASSERT_EQ(std::strtod(number_text(number).c_str(), nullptr), number);
  }
}

TEST(CanonicalText, SortsMembersAndLeavesNoSpace) {
  EXPECT_EQ(
      canonical_text(Json::parse(R"( { "b" : [ 1.0 , 2.50 , null ] , "a" : { "z" : true , "Z" : "x" } } )")),
      R"({"a":{"Z":"x","z":true},"b":[1,2.5,null]})");
}

TEST(CanonicalText, WritesNullForWhatIsNoNumber) {
  const double infinite = std::numeric_limits<double>::infinity();
  EXPECT_EQ(canonical_text(Json::array({infinite, -infinite, infinite - infinite, 1.5})),
            "[null,null,null,1.5]");
}

TEST(CanonicalText, EscapesOnlyWhatMustBe) {
  EXPECT_EQ(canonical_text(Json("a\"b\\c/d\n\t\b\f\r\x01\x1f é🌱")),
            "\"a\\\"b\\\\c/d\\n\\t\\b\\f\\r\\u0001\\u001f é🌱\"");
}

TEST(CanonicalText, ReadsBackAsTheSameValue) {
  const Json value = Json::parse(R"({"a":[0.1,-5,18446744073709551615,"\u0000"],"":{}})");
  EXPECT_EQ(*parse_json(canonical_text(value)), value);
}

/// The examples of RFC 7396, appendix A.
TEST(MergePatch, DoesWhatTheRfcShows) {
  const char* rows[][3] = {{R"({"a":"b"})", R"({"a":"c"})", R"({"a":"c"})"},
                           {R"({"a":"b"})", R"({"b":"c"})", R"({"a":"b","b":"c"})"},
                           {R"({"a":"b"})", R"({"a":null})", R"({})"},
                           {R"({"a":"b","b":"c"})", R"({"a":null})", R"({"b":"c"})"},
                           {R"({"a":["b"]})", R"({"a":"c"})", R"({"a":"c"})"},
                           {R"({"a":"c"})", R"({"a":["b"]})", R"({"a":["b"]})"},
                           {R"({"a":{"b":"c"}})", R"({"a":{"b":"d","c":null}})", R"({"a":{"b":"d"}})"},
                           {R"({"a":[{"b":"c"}]})", R"({"a":[1]})", R"({"a":[1]})"},
                           {R"(["a","b"])", R"(["c","d"])", R"(["c","d"])"},
                           {R"({"a":"b"})", R"(["c"])", R"(["c"])"},
                           {R"({"a":"foo"})", R"(null)", R"(null)"},
                           {R"({"a":"foo"})", R"("bar")", R"("bar")"},
                           {R"({"e":null})", R"({"a":1})", R"({"e":null,"a":1})"},
                           {R"([1,2])", R"({"a":"b","c":null})", R"({"a":"b"})"},
                           {R"({})", R"({"a":{"bb":{"ccc":null}}})", R"({"a":{"bb":{}}})"}};
  for (const auto& [target, patch, result] : rows) {
    Json value = Json::parse(target);
    merge_patch(value, Json::parse(patch));
    EXPECT_EQ(value, Json::parse(result)) << target << " + " << patch;
  }
}

TEST(CanonicalText, LetsTheCallerEndTheWork) {
  // 20,000 numbers are more than four times 4,096 values.
  const Json numbers = Json(std::vector<int>(20'000, 7));
  int calls = 0;
  EXPECT_EQ(canonical_text(numbers, [&] { ++calls; }), canonical_text(numbers));
  EXPECT_EQ(calls, 4);
  calls = 0;
  const auto end_at_second = [&] {
    if (++calls == 2) throw std::runtime_error("stopped");
  };
  EXPECT_THROW(canonical_text(numbers, end_at_second), std::runtime_error);
  EXPECT_EQ(calls, 2);
}

TEST(PointerToken, EscapesTildeAndSlash) {
  EXPECT_EQ(pointer_token("plain"), "/plain");
  EXPECT_EQ(pointer_token("a/b~c"), "/a~1b~0c");
  EXPECT_EQ(pointer_token(""), "/");
}

TEST(Shortened, CutsBetweenCharacters) {
  EXPECT_EQ(shortened("äöü", 3), "äöü");
  EXPECT_EQ(shortened("äöü", 2), "äö…");
  EXPECT_EQ(shortened("", 2), "");
}

}  // namespace
}  // namespace seedmesh
