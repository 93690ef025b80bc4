#include <gmock/gmock.h>

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <tuple>
#include <utility>

#include "core/schema/json.h"

namespace seedmesh {
namespace {

struct Refusal {
  Code code = Code::internal;
  Issue issue;
};

Refusal refusal_of(std::string_view text, const JsonLimits& limits = {}) {
  const Result<Json> value = parse_json(text, limits);
  if (value) {
    ADD_FAILURE() << shortened(text, 80) << " was taken";
    return {};
  }
  return {value.error().code, value.error().issues.front()};
}

Json parsed(std::string_view text) {
  const Result<Json> value = parse_json(text);
  if (!value) {
    ADD_FAILURE() << value.error().issues.front().message;
    return {};
  }
  return *value;
}

TEST(ParseJson, TakesEveryKindOfValue) {
  const Json value = parsed(R"( {"a": [1, -2, 2.5, true, false, null, "x\u00e9\n"], "b": {}} )");
  EXPECT_EQ(value, Json::parse(R"({"a":[1,-2,2.5,true,false,null,"xé\n"],"b":{}})"));
  EXPECT_EQ(parsed("7"), 7);
}

TEST(ParseJson, RefusesWhatIsNotJson) {
  for (const char* text : {"{",       "[1,]",     "{\"a\":1,}",  "{a:1}", "'x'",       "NaN",   "Infinity",
                           "-",       "01",       "1.",          ".5",    "+1",        "[1] 2", "// x\n1",
                           "\"\\x\"", "\"a\nb\"", "\"\\ud800\"", "tru",   "{\"a\" 1}", "\x01",  "1 1"}) {
    EXPECT_EQ(refusal_of(text).code, Code::malformed) << text;
  }
}

TEST(ParseJson, ReportsTheLineAndColumnOfASyntaxError) {
  const Issue issue = refusal_of("{\n  \"é\": x\n}").issue;
  EXPECT_EQ(issue.kind, IssueKind::syntax);
  EXPECT_EQ(issue.pointer, "");
  EXPECT_EQ(issue.line, 2);
  EXPECT_EQ(issue.column, 8);
  EXPECT_THAT(issue.message, testing::HasSubstr("found x, expected a value"));
}

struct Mistake {
  const char* text;
  int line, column;
  const char* found;
  const char* expected;
};

/// Mistakes of people who write JSON by hand, and of programs that write JavaScript, Python or JSON5.
TEST(ParseJson, SaysWhatWasFoundAndExpected) {
  for (const auto& [text, line, column, found, expected] : std::initializer_list<Mistake>{
           {"{\n  // note\n \"a\": 1}", 2, 3, "found \"/\"", "no comments"},
           {"{\"a\": 1} # note", 1, 10, "found \"#\"", "the end of the text; JSON has no comments"},
           {"{\"a\": 1,}", 1, 8, "found a comma before `}`", "none behind the last member"},
           {"[1, 2,\n]", 1, 6, "found a comma before `]`", "none behind the last value"},
           {"{'a': 1}", 1, 2, "found \"'\"", "only \" encloses names and texts"},
           {"{\"a\": 'b'}", 1, 7, "found \"'\"", "a value; only \" encloses"},
           {"{\u201Ca\u201D: 1}", 1, 2, "found \"\u201C\"", "only \" encloses"},
           {"{a: 1}", 1, 2, "found a,", "a name in double quotes"},
           {"{\"a\": 1, b: 2}", 1, 10, "found b,", "a name in double quotes"},
           {"{\"a\": oak}", 1, 7, "found oak,", "texts are in double quotes"},
           {"oak", 1, 1, "found oak,", "texts are in double quotes"},
           {"{\"a\": NaN}", 1, 7, "found NaN,", "a finite number"},
           {"[-Infinity]", 1, 2, "found -Infinity,", "a finite number"},
           {"{\"a\": True}", 1, 7, "found True,", "expected true"},
           {"{\"a\": None}", 1, 7, "found None,", "expected null"},
           {"[tru]", 1, 2, "found tru,", "expected a value"},
           {"{\"a\": 0x10}", 1, 7, "found 0x10,", "a number such as"},
           {"{\"a\": 01}", 1, 7, "found 01,", "a number such as"},
           {"{\"a\": +1}", 1, 7, "found +1,", "a number such as"},
           {"{\"a\": .5}", 1, 7, "found .5,", "a number such as"},
           {"{\"a\": 1.}", 1, 7, "found 1.,", "a number such as"},
           {"{\"a\": 1_000}", 1, 7, "found 1_000,", "a number such as"},
           {"{\"a\" 1}", 1, 6, "found 1,", "`:` and a value"},
           {"{\"a\": 1 \"b\": 2}", 1, 9, "found the text \"b\",", "`,` or `}`"},
           {"[1 2]", 1, 4, "found 2,", "`,` or `]`"},
           {"[1, 2", 1, 6, "found the end of the text", "`,` or `]`"},
           {"{\"a\"", 1, 5, "found the end of the text", "`:` and a value"},
           {"{", 1, 2, "found the end of the text", "a name in double quotes, or `}`"},
           {"{\"a\": \"b", 1, 7, "found a text in quotes without its end", "a closing \""},
           {"{\"a\": 1}{\"b\": 2}", 1, 9, "found \"{\"", "the end of the text"},
           {"{\u00A0\"a\": 1}", 1, 2, "no-break space", "a name in double quotes, or `}`"},
           {"{\"a\": \"b\nc\"}", 1, 9, "found a line break in a text", "expected \\n"},
           {"{\"a\": \"b\tc\"}", 1, 9, "found a tab in a text", "expected \\t"},
           {"{\"a\": \"b\\qc\"}", 1, 9, "found the escape \\q,", "\\n, \\r, \\t or \\u"},
           {"{\"a\": \"\\u12x4\"}", 1, 8, "found the escape \\u12x,", "four hexadecimal digits"}}) {
    const Refusal refusal = refusal_of(text);
    EXPECT_EQ(refusal.code, Code::malformed) << text;
    EXPECT_EQ(std::pair(refusal.issue.line, refusal.issue.column), std::pair(line, column)) << text;
    EXPECT_THAT(refusal.issue.message,
                testing::AllOf(testing::HasSubstr(found), testing::HasSubstr(expected)))
        << text;
  }
}

TEST(ParseJson, NamesEncodingsAndFilesThatAreNotJson) {
  using namespace std::string_view_literals;
  for (const auto& [bytes, name] :
       std::initializer_list<std::pair<std::string_view, const char*>>{{"\xFF\xFE{\0}\0"sv, "UTF-16"},
                                                                       {"\xFE\xFF\0{\0}"sv, "UTF-16"},
                                                                       {"{\0\"\0"sv, "UTF-16"},
                                                                       {"\0{\0}"sv, "UTF-16"},
                                                                       {"{\0\0\0}\0\0\0"sv, "UTF-32"},
                                                                       {"\x1F\x8B\x08\0"sv, "gzip"},
                                                                       {"glTF\x02\0\0\0"sv, "GLB"}}) {
    const Refusal refusal = refusal_of(bytes);
    EXPECT_EQ(refusal.code, Code::malformed);
    EXPECT_THAT(refusal.issue.message,
                testing::HasSubstr(std::string("found ") + name + ", expected JSON in UTF-8"));
  }
}

TEST(ParseJson, ReportsWhereAKeyIsGivenAgainAndWhereItNestsTooDeep) {
  const Issue twice = refusal_of("{\"b\": \"a\",\n \"a\": {\"a\": 1},\n  \"a\": 2}").issue;
  EXPECT_EQ(twice.kind, IssueKind::duplicate_key);
  EXPECT_EQ(std::pair(twice.line, twice.column), std::pair(3, 3));
  JsonLimits shallow;
  shallow.depth = 2;
  const Issue deep = refusal_of("{\"[\": [],\n \"b\": [[1]]}", shallow).issue;
  EXPECT_EQ(deep.kind, IssueKind::limit);
  EXPECT_EQ(std::pair(deep.line, deep.column), std::pair(2, 8));
}

TEST(ParseJson, NamesTheLoneHalfOfASurrogatePair) {
  for (const auto& [text, half, column] : std::initializer_list<std::tuple<const char*, const char*, int>>{
           {R"({"a": "x\ud800"})", R"("\ud800")", 9},
           {R"({"a": "\uDBFFxy"})", R"("\uDBFF")", 8},
           {R"({"a": "\ud83d\u0041"})", R"("\ud83d")", 8},
           {R"({"a": "\udc00"})", R"("\udc00")", 8}}) {
    const Issue issue = refusal_of(text).issue;
    EXPECT_EQ(issue.kind, IssueKind::syntax);
    EXPECT_EQ(issue.column, column) << text;
    EXPECT_THAT(issue.message, testing::AllOf(testing::HasSubstr(half), testing::HasSubstr("surrogate")))
        << text;
  }
  EXPECT_EQ(parsed(R"("\ud83d\ude00")"), "\U0001F600");
}

TEST(ParseJson, ReportsATextThatEndsTooEarly) {
  EXPECT_THAT(refusal_of("{\"a\":").issue.message,
              testing::HasSubstr("found the end of the text, expected a value"));
}

TEST(ParseJson, RefusesAnEmptyBody) {
  EXPECT_THAT(refusal_of("").issue.message, testing::HasSubstr("empty"));
  EXPECT_EQ(refusal_of(" \n\t").code, Code::malformed);
}

TEST(ParseJson, RefusesADuplicateMemberAtItsPointer) {
  EXPECT_EQ(refusal_of(R"({"a":1,"a":2})").issue.pointer, "/a");
  EXPECT_EQ(refusal_of(R"({"x":[0,{"b/c":1,"b/c":2}]})").issue.pointer, "/x/1/b~1c");
  EXPECT_EQ(parsed(R"([{"a":1},{"a":2}])").size(), 2U);
}

TEST(ParseJson, RefusesInvalidUtf8Everywhere) {
  for (const char* bytes :
       {"\xff", "\xc3", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe2\x82", "\x80"}) {
    EXPECT_EQ(refusal_of("\"" + std::string(bytes) + "\"").code, Code::malformed);
    EXPECT_EQ(refusal_of("[" + std::string(bytes) + "]").code, Code::malformed);
  }
  EXPECT_EQ(parsed("\"\xf0\x9f\x8c\xb1\""), "🌱");
}

TEST(ParseJson, TakesSixtyFourLevelsAndNotOneMore) {
  const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_TRUE(parse_json(nested(64)));
  EXPECT_EQ(refusal_of(nested(65)).issue.limit, (Limit{Resource::depth, 64, 65}));
}

TEST(ParseJson, SurvivesAHundredThousandOpenBrackets) {
  EXPECT_EQ(refusal_of(std::string(100'000, '[')).code, Code::malformed);
  std::string objects;
  for (int i = 0; i < 100'000; ++i) objects += "{\"a\":";
  EXPECT_EQ(refusal_of(objects).code, Code::malformed);
}

TEST(ParseJson, BoundsTheNumberOfValues) {
  EXPECT_EQ(refusal_of("[1,2,3]", {.values = 3}).code, Code::limit);
  EXPECT_TRUE(parse_json("[1,2]", {.values = 3}));
}

TEST(ParseJson, KeepsAllBitsOfAnInteger) {
  EXPECT_EQ(parsed("18446744073709551615").get<std::uint64_t>(), 18446744073709551615U);
  EXPECT_EQ(parsed("-9223372036854775808").get<std::int64_t>(), std::numeric_limits<std::int64_t>::min());
  EXPECT_TRUE(parsed("18446744073709551616").is_number_float());
}

TEST(ParseJson, RefusesANumberBeyondADoubleAtItsPointer) {
  const Refusal refusal = refusal_of(R"({"parameters":{"angle":[0,1e999]}})");
  EXPECT_EQ(refusal.code, Code::invalid);
  EXPECT_EQ(refusal.issue.pointer, "/parameters/angle/1");
  EXPECT_EQ(refusal.issue.kind, IssueKind::out_of_range);
  EXPECT_THAT(refusal.issue.message, testing::HasSubstr("1e999"));
  EXPECT_EQ(parsed("1e-999"), 0.0);
}

TEST(ParseJson, HasNoNegativeZero) {
  for (const char* text : {"-0", "-0.0", "-0e5", "-1e-999"}) {
    EXPECT_FALSE(std::signbit(parsed(text).get<double>())) << text;
  }
}

TEST(ParseJson, NamesTheMemberAfterAnObjectThatHasClosed) {
  EXPECT_EQ(refusal_of(R"({"a":{"b":{}},"c":[[],1e999]})").issue.pointer, "/c/1");
  EXPECT_EQ(refusal_of(R"([[{"k":[1e999]}]])").issue.pointer, "/0/0/k/0");
}

TEST(ParseJson, KeepsAllDigitsOfASeedThatADoubleWouldRound) {
  const auto seed = [](const std::string& text) { return parsed("{\"seed\":" + text + "}")["seed"]; };
  for (const char* text : {"9007199254740993.0", "9007199254740993e0", "900719925474099300e-2",
                           "0.9007199254740993e+16", "90071992547409.93E2"})
    EXPECT_EQ(seed(text), "9007199254740993") << text;
  EXPECT_EQ(seed("18446744073709551616"), "18446744073709551616");
  EXPECT_EQ(seed("-18446744073709551617"), "-18446744073709551617");
  EXPECT_EQ(seed("1e19"), "10000000000000000000");
  EXPECT_EQ(seed("18446744073709551615"), 18446744073709551615U);
  EXPECT_EQ(seed("1e3"), 1000.0);
  EXPECT_EQ(seed("1.5"), 1.5);
  EXPECT_EQ(seed("1e300"), 1e300);
  EXPECT_EQ(parsed("{\"size\":9007199254740993e0}")["size"], 9007199254740992.0);
}

}  // namespace
}  // namespace seedmesh
