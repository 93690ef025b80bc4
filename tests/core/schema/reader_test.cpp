#include "core/schema/reader.h"

#include "generated/params/lsystem.h"
#include "generated/params/output.h"
#include "generated/params/tiny.h"
#include "tests/core/schema/support.h"

namespace seedmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Reader, GivesMissingMembersTheirDeissues) {
  const auto read = reading<read_lsystem>(R"({"axiom":"F"})");
  EXPECT_THAT(read.issues, IsEmpty());
  EXPECT_EQ(read.params.axiom, "F");
  EXPECT_EQ(read.params.iterations, 1);
  EXPECT_EQ(read.params.angle.pitch, 45);
  EXPECT_EQ(read.params.width.value, 0.1);
  EXPECT_EQ(read.params.style, LsystemParams::Style::tubes);
  EXPECT_FALSE(read.params.alphabet.has_value());
}

TEST(Reader, FindsEveryErrorAtOnce) {
  const auto read = reading<read_lsystem>(
      R"({"productions":"F","iterations":-1,"angel":3,"sides":2.5,"angle":"wide","style":"tube","width":null,
          "materials":[{"color":"red"},{"colour":"#ffffff"}],"constants":{"1x":2,"y":[]},"alphabet":{}})");
  EXPECT_THAT(read.pointers(),
              testing::UnorderedElementsAre("", "/productions", "/iterations", "/angel", "/sides", "/angle",
                                            "/style", "/width", "/materials/0/color", "/materials/1/colour",
                                            "/constants/1x", "/constants/y", "/alphabet"));
}

TEST(Reader, StatesWhatItFoundAndWhatItExpected) {
  const auto message = [](const char* text) { return reading<read_lsystem>(text).issues.front().message; };
  EXPECT_EQ(message(R"({"axiom":"F","iterations":-1})"), "found -1, expected an integer from 0 to 1000");
  EXPECT_EQ(message(R"({"axiom":"F","iterations":2.5})"), "found 2.5, expected an integer from 0 to 1000");
  EXPECT_EQ(message(R"({"axiom":"F","angle":"wide"})"),
            "found the text \"wide\", expected a number or an object");
  EXPECT_EQ(message(R"({"axiom":"F","style":"tube"})"),
            "found the text \"tube\", expected one of tubes, lines; did you mean \"tubes\"?");
  EXPECT_EQ(message(R"({"axiom":"F","materials":[{"color":"red"}]})"),
            "found the text \"red\", expected a colour such as #8c6b4f");
  EXPECT_EQ(message(R"({"axiom":"F","productions":{}})"), "found an object, expected a list");
  EXPECT_EQ(message(R"({"axiom":""})"), "found 0 characters, expected at least 1 character");
  EXPECT_EQ(message("{}"), "\"axiom\" is missing");
  EXPECT_EQ(message("[]"), "found an empty list, expected an object");
}

TEST(Reader, RecognizesGeojsonInPlaceOfAnObjectOfParameters) {
  const auto read = reading<read_lsystem>(
      R"({"axiom":"F","weather":{"type":"Polygon","coordinates":[]},"angle":{"type":"Feature","geometry":null}})");
  EXPECT_THAT(read.pointers(), testing::UnorderedElementsAre("/weather", "/angle"));
  for (const Issue& issue : read.issues) {
    EXPECT_EQ(issue.kind, IssueKind::wrong_type);
    EXPECT_THAT(issue.message,
                testing::ContainsRegex("found GeoJSON .(Polygon|Feature)., expected an object with "
                                       "members of (wind|yaw)"));
  }
}

TEST(Reader, NamesThePresetThatIsGivenAsAChoice) {
  const auto message = [](const char* text) { return reading<read_lsystem>(text).issues.front().message; };
  EXPECT_EQ(message(R"({"axiom":"F","style":"oak"})"),
            "found the text \"oak\", expected one of tubes, lines; there is a preset of this name, as in "
            "{\"preset\": \"oak\"}");
  EXPECT_EQ(message(R"({"axiom":"F","style":"velvet"})"),
            "found the text \"velvet\", expected one of tubes, lines");
}

TEST(Reader, GivesEachErrorItsKind) {
  const auto kind = [](const char* text) { return reading<read_lsystem>(text).issues.front().kind; };
  EXPECT_EQ(kind(R"({"axiom":"F","iterations":-1})"), IssueKind::out_of_range);
  EXPECT_EQ(kind(R"({"axiom":"F","iterations":2.5})"), IssueKind::wrong_type);
  EXPECT_EQ(kind(R"({"axiom":"F","iterations":"2"})"), IssueKind::wrong_type);
  EXPECT_EQ(kind(R"({"axiom":"F","angle":"wide"})"), IssueKind::wrong_type);
  EXPECT_EQ(kind(R"({"axiom":"F","style":"tube"})"), IssueKind::invalid_value);
  EXPECT_EQ(kind(R"({"axiom":"F","style":3})"), IssueKind::wrong_type);
  EXPECT_EQ(kind(R"({"axiom":"F","materials":[{"color":"red"}]})"), IssueKind::invalid_value);
  EXPECT_EQ(kind(R"({"axiom":"F","productions":{}})"), IssueKind::wrong_type);
  EXPECT_EQ(kind(R"({"axiom":""})"), IssueKind::out_of_range);
  EXPECT_EQ(kind(R"({"axiom":"F","angel":3})"), IssueKind::unknown_key);
  EXPECT_EQ(kind("{}"), IssueKind::missing);
  EXPECT_EQ(kind("[]"), IssueKind::wrong_type);
}

TEST(Reader, NamesTheOtherTypesBesideAWord) {
  EXPECT_EQ(reading<read_output>(R"({"textures":"512"})").issues.front().message,
            "found the text \"512\", expected an integer from 16 to 4096 or one of none, links");
}

TEST(Reader, ReportsAMissingOuterListOnce) {
  const auto flat = reading<read_lsystem>(R"({"axiom":"F","contours":[[0,0],[1,0],[0,1]]})");
  EXPECT_THAT(flat.pointers(), ElementsAre("/contours"));
  EXPECT_EQ(flat.issues.front().message,
            "found lists of numbers, expected one list more around them: each entry is a contour, and each "
            "entry of that a point, as in [[[0, 0], …]]");
  EXPECT_THAT(reading<read_lsystem>(R"({"axiom":"F","contours":[[[0,0],[1,0],[0,1]]]})").pointers(),
              testing::IsEmpty());
}

TEST(Reader, SuggestsTheNearestMember) {
  EXPECT_EQ(reading<read_lsystem>(R"({"axiom":"F","angel":3})").issues.front().message,
            "\"angel\" is not known here; did you mean \"angle\"?");
  EXPECT_THAT(reading<read_output>(R"({"qqqqqqqqqqqq":3})").issues.front().message,
              HasSubstr("known are format"));
}

TEST(Reader, ListsKnownMembersOnceForAllUnknownOnes) {
  const auto issues = reading<read_output>(R"({"pppppppppppp":1,"qqqqqqqqqqqq":3,"varants":2})").issues;
  ASSERT_EQ(issues.size(), 3U);
  EXPECT_THAT(issues[0].message, HasSubstr("known are format"));
  EXPECT_EQ(issues[1].message, "\"qqqqqqqqqqqq\" is not known here");
  EXPECT_EQ(issues[2].message, "\"varants\" is not known here; did you mean \"variants\"?");
}

TEST(Reader, KeepsTheIndexesOfAListWithABadEntry) {
  const auto read = reading<read_lsystem>(R"({"axiom":"F","productions":["a",5,"c"]})");
  EXPECT_THAT(read.pointers(), ElementsAre("/productions/1"));
  EXPECT_THAT(read.params.productions, ElementsAre("a", "", "c"));
}

TEST(Reader, KeepsTheKeyOfABadEntry) {
  const auto read = reading<read_lsystem>(R"({"axiom":"F","constants":{"a":true,"b":2,"c":"a*b"}})");
  EXPECT_THAT(read.pointers(), ElementsAre("/constants/a"));
  ASSERT_EQ(read.params.constants.size(), 3U);
  EXPECT_EQ(std::get<double>(read.params.constants.at("a")), 0);
  EXPECT_EQ(std::get<double>(read.params.constants.at("b")), 2);
  EXPECT_EQ(std::get<std::string>(read.params.constants.at("c")), "a*b");
}

TEST(Reader, TakesOneNumberForThree) {
  EXPECT_EQ(reading<read_lsystem>(R"({"axiom":"F","angle":20})").params.angle,
            (LsystemParams::Angle{.yaw = 20, .pitch = 20, .roll = 20, .spread = 0}));
  EXPECT_EQ(reading<read_lsystem>(R"({"axiom":"F","angle":{"yaw":20,"spread":2}})").params.angle,
            (LsystemParams::Angle{.yaw = 20, .pitch = 45, .roll = 45, .spread = 2}));
}

TEST(Reader, TakesAWholeNumberHoweverItIsWritten) {
  EXPECT_EQ(reading<read_lsystem>(R"({"axiom":"F","iterations":5.0})").params.iterations, 5);
  EXPECT_EQ(reading<read_lsystem>(R"({"axiom":"F","iterations":1e2})").params.iterations, 100);
}

TEST(Reader, CountsCharactersNotBytes) {
  const std::string hundred = [] {
    std::string text;
    for (int i = 0; i < 100; ++i) text += "é";
    return text;
  }();
  const auto with_name = [](const std::string& name) {
    return reading<read_lsystem>(R"({"axiom":"F","materials":[{"color":"#000000","name":")" + name + "\"}]}");
  };
  EXPECT_THAT(with_name(hundred).issues, IsEmpty());
  EXPECT_THAT(with_name(hundred + "é").pointers(), ElementsAre("/materials/0/name"));
}

TEST(Reader, KeepsAHostileBodyShort) {
  std::string text = R"({"axiom":"F","productions":[0)";
  for (int i = 1; i < 10'000; ++i) text += ",0";
  const auto read = reading<read_lsystem>(text + "]}");
  EXPECT_EQ(read.issues.size(), IssueList::most + 1);
  EXPECT_EQ(read.issues.back().kind, IssueKind::truncated_list);
  EXPECT_EQ(read.issues.back().unlisted, 9900U);
  EXPECT_EQ(read.params.productions.size(), 10'000U);
}

TEST(Reader, ReadsNoMoreEntriesThanThereMayBe) {
  std::string text = R"({"axiom":"F","materials":[{"color":"#000000"})";
  for (int i = 0; i < 256; ++i) text += R"(,{"color":"#000000"})";
  const auto read = reading<read_lsystem>(text + "]}");
  EXPECT_THAT(read.pointers(), ElementsAre("/materials"));
  EXPECT_EQ(read.issues.front().message, "found 257 entries, expected at most 256 entries");
  EXPECT_EQ(read.params.materials.size(), 256U);
}

TEST(Reader, ReadsEveryKindOfParameter) {
  const auto read = reading<read_tiny>(
      R"({"mood":"wild","visible":false,"size":[3,2,1],"class":"b_2","count":9007199254740991,"shape":[1,2],
          "tint":"#FFaa00","reach":{"far":9},"places":{"a-b":-5},"note":"","frame":{"depth":0.5}})");
  EXPECT_THAT(read.issues, IsEmpty());
  EXPECT_EQ(read.params.mood, TinyParams::Mood::wild);
  EXPECT_FALSE(read.params.visible);
  EXPECT_THAT(read.params.size, ElementsAre(3, 2, 1));
  EXPECT_EQ(read.params.class_name, "b_2");
  EXPECT_EQ(read.params.count, 9007199254740991);
  EXPECT_THAT(std::get<1>(read.params.shape), ElementsAre(1, 2));
  EXPECT_EQ(read.params.tint, (Color{255, 170, 0}));
  EXPECT_EQ(read.params.reach, (TinyParams::Reach{.near = 3, .far = 9, .blur = 0}));
  EXPECT_EQ(read.params.places.at("a-b"), -5);
  EXPECT_EQ(read.params.note, "");
  EXPECT_EQ(read.params.frame->depth, 0.5);
}

TEST(Reader, ChecksEveryKindOfParameter) {
  const auto read = reading<read_tiny>(
      R"({"mood":3,"visible":0,"size":[1,0,11],"class":"2b","count":-1,"shape":{},"tint":"#12345","reach":-1,
          "places":{"A":1,"b":6,"c":0},"note":7,"frame":{}})");
  EXPECT_THAT(read.pointers(),
              testing::UnorderedElementsAre("/mood", "/visible", "/size/1", "/size/2", "/class", "/count",
                                            "/shape", "/tint", "/reach", "/places", "/places/A", "/places/b",
                                            "/note", "/frame"));
  EXPECT_THAT(reading<read_tiny>(R"({"mood":"calm","size":[1,2]})").issues.front().message,
              "found 2 entries, expected 3 entries");
}

TEST(IssueList, CoversAValueAndEverythingInsideIt) {
  IssueList issues;
  issues.add({IssueKind::invalid_value, "/a/b", "bad"});
  issues.add_missing("/a", "c", "gone");
  EXPECT_TRUE(issues.covers("/a/b"));
  EXPECT_TRUE(issues.covers("/a/b/0"));
  EXPECT_TRUE(issues.covers("/a/c"));
  EXPECT_FALSE(issues.covers("/a"));
  EXPECT_FALSE(issues.covers("/a/bc"));
}

}  // namespace
}  // namespace seedmesh
