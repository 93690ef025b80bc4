#include <gmock/gmock.h>

#include "tests/core/import/support.h"

namespace seedmesh {
namespace {

using testing::StartsWith;

/// The format that a text is read as where none is named.
std::string read_as(std::string_view text) {
  const auto result = imported("", text);
  if (!result) return result.error().issues[0].message;
  return nlohmann::json::parse(result->answer).at("format").get<std::string>();
}

TEST(Import, FindsTheFormatByTheContentOfTheFile) {
  EXPECT_EQ(read_as("Lsystem: 1\nderivation length: 2\nAxiom: F\nF --> FF\nendlsystem\n"), "cpfg");
  EXPECT_EQ(read_as("; curves\nKoch {\n angle=6;\n axiom F\n F=F+F\n}\n"), "fractint");
  EXPECT_EQ(read_as("Premise: A\nRule 1: A=FA\nAngle: 30\n"), "houdini");
  EXPECT_EQ(read_as("A\nA=FA\n"), "houdini");
  EXPECT_EQ(read_as(R"({"seed": 1, "levels": 4, "maxRadius": 0.1})"), "proctree");
  EXPECT_EQ(read_as(R"({"mLevels": 4})"), "proctree");
  EXPECT_EQ(read_as(R"({"seed": 1, "type": "deciduous", "branch": {"levels": 2}})"), "ez_tree");
}

TEST(Import, ReportsTheErrorOfTheLikeliestFormat) {
  EXPECT_THAT(read_as("Lsystem: 1\nderivation length: 2\nAxiom: F\nF --> F(\n"),
              StartsWith("read as cpfg: found `(`"));
  EXPECT_THAT(read_as("A {\n angle 6\n axiom F\n}\nB {\n angle 6\n axiom F\n}\n"),
              StartsWith("read as fractint: the file contains several"));
  EXPECT_THAT(read_as("Premise: A\nA=F(\n"), StartsWith("read as houdini: found `(`"));
  EXPECT_THAT(read_as(R"({"seed": 1, "levels": 40})"), StartsWith("read as proctree: "));
  EXPECT_THAT(read_as(R"({"branch": {"levels": 40}})"), StartsWith("read as ez_tree: "));
  EXPECT_THAT(read_as("dear all"), StartsWith("found no keywords of a known format"));
  EXPECT_THAT(read_as("{"), StartsWith("found no keywords of a known format"));
}

TEST(Import, NamesLparserWhoseRulesResembleThoseOfOtherFormats) {
  using testing::AllOf, testing::ElementsAre, testing::HasSubstr;
  const std::string older = "# a twig\n12 # recursion\n22.5\n40\n#\n%A # axiom\nA=F[+A]-A\n@\n";
  EXPECT_THAT(reports(imported("", older)), ElementsAre(AllOf(StartsWith("2:1 "), HasSubstr("Lparser"))));
  const std::string newer = "# a twig\n\n angle 20\nrecursion 8\nthickness 60\naxiom FA\nrule A = F'!A\n";
  EXPECT_THAT(reports(imported("", newer)), ElementsAre(AllOf(StartsWith("3:2 "), HasSubstr("Lparser"))));
  EXPECT_EQ(read_as("# a twig\nPremise: A\nA=FA\n"), "houdini");
  EXPECT_EQ(read_as("Recursion {\n angle 6\n axiom F\n}\n"), "fractint");
}

TEST(Import, AcceptsAnyEncodingOfComments) {
  EXPECT_TRUE(imported("fractint", "{ by Gr\x8Fnbaum }\nE { ; \x8F\n angle 4\n axiom F\n}\n"));
  EXPECT_TRUE(imported("", "/* v\xE9g\xE9tal */\nLsystem: 1\nderivation length: 1\nAxiom: F // \xE9\n"));
  const auto name = imported("fractint", "Gr\x8Fn { ; \x8F\n angle 4\n axiom F\n}\n");
  ASSERT_FALSE(name);
  EXPECT_EQ(name.error().code, Code::malformed);
  EXPECT_FALSE(imported("proctree", "{\"mLevels\": 4, \"\xE9\": 1}"));
}

TEST(Import, ReportsThatAFileIsUtf16) {
  using namespace std::string_literals;
  const std::string text = "{'shape': 7, 'g_scale': 9}";
  std::string little, big;
  for (const char c : text) {
    little += {c, '\0'};
    big += {'\0', c};
  }
  for (const std::string& each : {"\xFF\xFE" + little, "\xFE\xFF" + big, little, big})
    EXPECT_THAT(read_as(each), StartsWith("found text in UTF-16, expected UTF-8"));
}

TEST(Import, ReadsLinesThatEndInACarriageReturn) {
  for (const char* end : {"\r", "\r\n"}) {
    std::string koch = "Koch {\n Angle 6\n Axiom F--F--F\n F=F+F--F+F\n}\n",
                node = "Premise: A\nRule 1: A=FA\n";
    for (std::string* text : {&koch, &node}) {
      for (std::size_t at = 0; (at = text->find('\n', at)) != std::string::npos;
           at += std::string(end).size())
        text->replace(at, 1, end);
    }
    EXPECT_EQ(read_as(koch), "fractint");
    const auto result = imported("houdini", node);
    ASSERT_TRUE(result);
    EXPECT_EQ(parameters_of(result).at("productions").size(), 1U);
    EXPECT_THAT(reports(imported("houdini", "Premise: A" + std::string(end) + "A=F(")),
                testing::Contains(StartsWith("2:4 ")));
  }
}

TEST(Import, ReportsWarningsOfTheRequestBeforeItIsMade) {
  const auto result = imported("cpfg", "Lsystem: 1\nderivation length: 500\nAxiom: F\nF --> FFF\n");
  ASSERT_TRUE(result);
  EXPECT_THAT(reports(result),
              testing::Contains(testing::HasSubstr("the imported request would be refused: ")));
}

}  // namespace
}  // namespace seedmesh
