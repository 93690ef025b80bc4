#include <gmock/gmock.h>

#include <initializer_list>

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

/// Forms in which the two kinds of files resemble each other.
TEST(Import, TellsEntriesOfFractintFromNodesOfHoudini) {
  EXPECT_EQ(read_as("; curves\nDragon { angle 8\naxiom FX\nF=\ny=+FX--FY+\nx=-FX++FY-\n}\n"), "fractint");
  EXPECT_EQ(read_as("Koch { axiom=F--F--F\nF=F-F++F-F\nangle=6 }\n"), "fractint");
  EXPECT_EQ(read_as("axiom = FFFA\nrule1 = A=[&FA]////[&FA]\ngenerations = 5\nangle = 28\n"), "houdini");
  EXPECT_EQ(read_as("Axiom: A\nA=FA\n"), "houdini");
  EXPECT_EQ(read_as("Premise: A\nRule 1: A=F[+{F-F}.]\nRule 2: B={\nAngle = 30\nAxiom = A\n"),
            "read as houdini: found a second premise");
  EXPECT_THAT(read_as("lsystem1 {\n Axiom = A\n Angle = 30\n Generations = 4\n Rule1 = A=FA\n}\n"),
              StartsWith("read as houdini: "));
}

TEST(Import, NamesFilesThatHaveNoReader) {
  using testing::AllOf, testing::ElementsAre, testing::HasSubstr;
  using namespace std::string_view_literals;
  struct Other {
    std::string_view text;
    const char *place, *name;
  };
  for (const auto& [text, place, name] : std::initializer_list<Other>{
           {"<?xml version=\"1.0\"?>\n<kml xmlns=\"http://www.opengis.net/kml/2.2\"/>", "2:1 ", "a KML file"},
           {"<?xml version=\"1.0\"?><gpx version=\"1.1\"/>", "1:22 ", "a GPX file"},
           {"{\"type\": \"Topology\", \"objects\": {}, \"arcs\": []}", "1:10 ", "TopoJSON"},
           {"{\"type\": \"CityJSON\", \"version\": \"1.1\"}", "1:10 ", "CityJSON"},
           {"/* a house */\nversion \"2023.1\"\n@StartRule\nLot --> extrude(3) A\n", "2:1 ",
            "a rule file of CityEngine"},
           {"ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n3 4\n", "1:1 ", "an ASCII grid"},
           {"opadd -n lsystem l1\nopparm l1 premise ( A )\n", "1:1 ", "a script of Houdini"},
           {"{\"preset\": \"oak\"}", "1:1 ", "a request of Seedmesh"},
           {"{\"generator\": \"tree\"}", "1:1 ", "a request of Seedmesh"},
           {"\x1F\x8B\x08"sv, "1:1 ", "gzip"},
           {"\0\0\0\x0D\x0A\x09OSMHeader\x18"sv, "1:1 ", "OpenStreetMap PBF"}}) {
    EXPECT_THAT(reports(imported("", text)), ElementsAre(AllOf(StartsWith(place), HasSubstr(name)))) << text;
  }
  const char* overpass_turbo = R"({"type": "FeatureCollection", "generator": "overpass-ide", "features": [
    {"type": "Feature", "properties": {"natural": "tree"}, "geometry": {"type": "Point", "coordinates": [13, 52]}}]})";
  EXPECT_EQ(read_as(overpass_turbo), "geojson");
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
