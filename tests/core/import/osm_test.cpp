#include <gmock/gmock.h>

#include "core/base/rng.h"
#include "core/import/map_projection.h"
#include "core/import/map_values.h"
#include "tests/core/import/maps.h"

namespace seedmesh {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using Value = nlohmann::json;

const std::string house = tag("building", "house") + tag("height", "7") + tag("roof:shape", "hipped");

TEST(Osm, ReadsBuildingsOfXml) {
  OsmText osm;
  osm.way(osm.box(0, 0, 12, 8), house);
  const auto result = imported("osm", osm.text());
  ASSERT_TRUE(result) << reports(result)[0];
  const Value made = parameters_of(result)["buildings"][0];
  EXPECT_EQ(made["name"], "way/5");
  EXPECT_EQ(made["height"], 7);
  EXPECT_EQ(made["roof"]["shape"], "hipped");
  EXPECT_EQ(made["footprint"][0].size(), 4U);
}

TEST(Osm, JoinsTheWaysOfMultipolygons) {
  OsmText osm;
  const std::vector<int> outer = osm.box(0, 0, 30, 30), inner = osm.box(10, 10, 10, 10);
  // The outer ring in two ways of opposite directions.
  const int first = osm.way({outer[0], outer[1], outer[2]}, ""),
            second = osm.way({outer[0], outer[3], outer[2]}, "");
  const int hole = osm.way(inner, "");
  osm.multipolygon({first, second}, {hole}, house);
  const auto result = imported("osm", osm.text());
  ASSERT_TRUE(result) << reports(result)[0];
  const Value parameters = parameters_of(result);
  ASSERT_EQ(parameters["buildings"].size(), 1U);
  EXPECT_EQ(parameters["buildings"][0]["footprint"].size(), 2U);
}

TEST(Osm, TakesTheTagsOfTheOuterWayWhereTheRelationHasNone) {
  OsmText osm;
  const int outer = osm.way(osm.box(0, 0, 30, 30), house), inner = osm.way(osm.box(10, 10, 10, 10), "");
  osm.multipolygon({outer}, {inner}, "");
  const Value parameters = parameters_of(imported("osm", osm.text()));
  ASSERT_EQ(parameters["buildings"].size(), 1U);
  EXPECT_EQ(parameters["buildings"][0]["footprint"].size(), 2U);
}

TEST(Osm, ReadsTheJsonOfOverpassInBothForms) {
  const Value a = degrees_at(0, 0), b = degrees_at(12, 0), c = degrees_at(12, 8), d = degrees_at(0, 8);
  Value elements = Value::array(), geometry = Value::array(), ids = Value::array();
  int id = 1;
  for (const Value& p : {a, b, c, d}) {
    elements.push_back({{"type", "node"}, {"id", id}, {"lon", p[0]}, {"lat", p[1]}});
    geometry.push_back({{"lon", p[0]}, {"lat", p[1]}});
    ids.push_back(id++);
  }
  ids.push_back(1);
  geometry.push_back(geometry[0]);
  const Value tags = {{"building", "yes"}, {"height", "7"}};
  elements.push_back({{"type", "way"}, {"id", 9}, {"nodes", ids}, {"tags", tags}});
  const Value in_place = {
      {{"type", "way"}, {"id", 9}, {"nodes", ids}, {"geometry", geometry}, {"tags", tags}}};
  const auto with_nodes = imported("osm", Value{{"version", 0.6}, {"elements", elements}}.dump());
  const auto with_geometry = imported("", Value{{"version", 0.6}, {"elements", in_place}}.dump());
  ASSERT_TRUE(with_nodes) << reports(with_nodes)[0];
  ASSERT_TRUE(with_geometry) << reports(with_geometry)[0];
  EXPECT_EQ(parameters_of(with_nodes)["buildings"], parameters_of(with_geometry)["buildings"]);
  EXPECT_EQ(parameters_of(with_nodes)["buildings"][0]["name"], "way/9");
}

TEST(Osm, WarnsAtTheLineOfWhatItLeavesOut) {
  OsmText osm;
  std::vector<int> box = osm.box(0, 0, 12, 8);
  osm.way(box, house);
  box[2] = 4711;
  osm.way(box, house);
  const auto result = imported("osm", osm.text());
  ASSERT_TRUE(result);
  EXPECT_EQ(parameters_of(result)["buildings"].size(), 1U);
  EXPECT_THAT(reports(result),
              Contains(testing::MatchesRegex("8:[0-9]+ an area refers to nodes that the file lacks.*")));
}

TEST(Osm, LeavesOutTunnelsAndDeletedElements) {
  OsmText osm;
  osm.way(osm.box(0, 0, 12, 8), house);
  osm.way({osm.node(0, 20), osm.node(50, 20)}, tag("highway", "primary") + tag("tunnel", "yes"));
  std::string text = osm.text();
  const auto result = imported("osm", text);
  EXPECT_FALSE(parameters_of(result).contains("paths"));
  EXPECT_THAT(reports(result), Contains(HasSubstr("below the ground")));
  text.replace(text.find("<way id='5'"), 11, "<way id='5' action='delete'");
  EXPECT_THAT(reports(imported("osm", text)), Contains(HasSubstr("found no building")));
}

TEST(Osm, MakesTreesOfRows) {
  OsmText osm;
  osm.way({osm.node(0, 0), osm.node(80, 0)}, tag("natural", "tree_row"));
  const Value layers = parameters_of(imported("osm", osm.text()))["layers"];
  EXPECT_EQ(layers[0]["place"]["positions"].size(), 11U);
}

/// Areas of the rings of each building, outer rings first, in square metres.
std::vector<std::vector<double>> ring_areas(const Value& parameters) {
  std::vector<std::vector<double>> buildings;
  for (const Value& building : parameters.value("buildings", Value::array())) {
    std::vector<double> areas;
    for (const Value& ring : building["footprint"]) {
      double twice = 0;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Value &a = ring[i], &b = ring[(i + 1) % ring.size()];
        twice += a[0].get<double>() * b[1].get<double>() - a[1].get<double>() * b[0].get<double>();
      }
      areas.push_back(std::abs(twice) / 2);
    }
    buildings.push_back(std::move(areas));
  }
  return buildings;
}

const auto about = [](double area) { return testing::DoubleNear(area, 0.2); };

TEST(Osm, FindsTheHolesOfMultipolygonsWithoutRoles) {
  OsmText osm;
  // An island in a courtyard has a courtyard of its own.
  const int outer = osm.way(osm.box(0, 0, 40, 40), ""), court = osm.way(osm.box(5, 5, 30, 30), ""),
            island = osm.way(osm.box(10, 10, 20, 20), ""), inner = osm.way(osm.box(15, 15, 10, 10), "");
  osm.multipolygon({inner, outer, island, court}, {}, house);
  std::string text = osm.text();
  const std::string role = "role='outer'";
  for (std::size_t at = text.find(role); at != std::string::npos; at = text.find(role))
    text.replace(at, role.size(), "role=''");
  const Value parameters = parameters_of(imported("osm", text));
  EXPECT_THAT(ring_areas(parameters), testing::UnorderedElementsAre(ElementsAre(about(1600), about(900)),
                                                                    ElementsAre(about(400), about(100))));
}

TEST(Osm, GivesHolesToTheSmallestRingAround) {
  OsmText osm;
  const int outer = osm.way(osm.box(0, 0, 40, 40), ""), court = osm.way(osm.box(5, 5, 30, 30), ""),
            island = osm.way(osm.box(10, 10, 20, 20), ""), inner = osm.way(osm.box(15, 15, 10, 10), "");
  osm.multipolygon({outer, island}, {court, inner}, house);
  const auto result = imported("osm", osm.text());
  EXPECT_THAT(ring_areas(parameters_of(result)),
              ElementsAre(ElementsAre(about(1600), about(900)), ElementsAre(about(400), about(100))));
  EXPECT_THAT(reports(result), testing::Not(Contains(HasSubstr("courtyard"))));
}

TEST(Osm, CountsAnOuterWayWithAnotherKindOfBuildingOnce) {
  OsmText osm;
  const int outer = osm.way(osm.box(0, 0, 30, 30), tag("building", "yes") + tag("building:levels", "5")),
            inner = osm.way(osm.box(10, 10, 10, 10), "");
  osm.multipolygon({outer}, {inner}, tag("building", "apartments"));
  const Value parameters = parameters_of(imported("osm", osm.text()));
  ASSERT_EQ(parameters["buildings"].size(), 1U);
  EXPECT_EQ(parameters["buildings"][0]["height"], 15);
  EXPECT_EQ(parameters["buildings"][0]["footprint"].size(), 2U);
}

TEST(Osm, ReadsTheTagsOfRelationsOfBuildings) {
  OsmText osm;
  const int outline = osm.way(osm.box(0, 0, 30, 30), "");
  std::string text = osm.text();
  text.insert(text.find("</osm>"), "<relation id='99'><member type='way' role='outline' ref='" +
                                       std::to_string(outline) + "'/><tag k='type' v='building'/>" + house +
                                       "</relation>\n");
  const Value parameters = parameters_of(imported("osm", text));
  ASSERT_EQ(parameters["buildings"].size(), 1U);
  EXPECT_EQ(parameters["buildings"][0]["height"], 7);
}

TEST(Osm, TakesCentersOfOverpassForPositions) {
  // `out center` gives a position, but no outline: that is enough for a tree, and not for a building.
  const auto result = imported("osm", R"({"elements": [
    {"type": "way", "id": 1, "tags": {"building": "yes"}, "center": {"lat": 47, "lon": 8}, "nodes": [1, 2, 3, 1]},
    {"type": "way", "id": 2, "tags": {"natural": "tree"}, "center": {"lat": 47.001, "lon": 8}},
    {"type": "relation", "id": 3, "tags": {"type": "multipolygon", "building": "yes"},
     "center": {"lat": 47.0005, "lon": 8}, "members": [{"type": "way", "ref": 9, "role": "outer"}]},
    {"type": "way", "id": 4, "tags": {"highway": "path"}, "center": {"lat": 1, "lon": 1},
     "geometry": [{"lat": 47, "lon": 8}, {"lat": 47.001, "lon": 8}]}]})");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_THAT(reports(result), testing::Contains(testing::HasSubstr("a centre (`out center`)")));
  const nlohmann::json parameters = nlohmann::json::parse(result->request.canonical()).at("parameters");
  EXPECT_FALSE(parameters.contains("buildings"));
  EXPECT_EQ(parameters.at("paths").size(), 1u);
  EXPECT_EQ(parameters.at("layers").size(), 1u) << "the tree";
}

TEST(Osm, JoinsElementsThatOverpassWritesTwice) {
  OsmText osm;
  const std::vector<int> box = osm.box(0, 0, 12, 8);
  const int way = osm.way(box, "");
  std::string text = osm.text();
  const auto result = [&](bool skeleton_first) {
    const std::string tagged = "<way id='" + std::to_string(way) + "'>" + house + "</way>\n";
    std::string whole = text;
    whole.insert(skeleton_first ? whole.find("</osm>") : whole.find("<node"), tagged);
    return parameters_of(imported("osm", whole));
  };
  for (const bool skeleton_first : {false, true}) {
    const Value parameters = result(skeleton_first);
    ASSERT_EQ(parameters["buildings"].size(), 1U) << skeleton_first;
    EXPECT_EQ(parameters["buildings"][0]["height"], 7);
  }
}

TEST(Osm, LeavesOutNodesWithoutAPosition) {
  OsmText osm;
  osm.way(osm.box(0, 0, 12, 8), house);
  std::string text = osm.text();
  text.insert(text.find("<node"), "<node id='77'><tag k='natural' v='tree'/></node>\n");
  const auto result = imported("osm", text);
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_THAT(reports(result), Contains(HasSubstr("3:2 a node without a position is left out")));
}

TEST(Osm, PutsTheOriginIntoTheMiddleOfAllBounds) {
  OsmText osm;
  osm.way(osm.box(0, 0, 12, 8), house);
  std::string text = osm.text();
  text.insert(text.find("<node"),
              "<bounds minlat='48.09' minlon='11.49' maxlat='48.1' maxlon='11.5'/>\n"
              "<bounds minlat='48.1' minlon='11.5' maxlat='48.13' maxlon='11.53'/>\n");
  const Value origin = parameters_of(imported("osm", text))["georeference"];
  EXPECT_NEAR(origin["latitude"].get<double>(), 48.11, 1e-9);
  EXPECT_NEAR(origin["longitude"].get<double>(), 11.51, 1e-9);
}

TEST(Osm, StripsAByteOrderMark) {
  OsmText osm;
  osm.way(osm.box(0, 0, 12, 8), house);
  ASSERT_TRUE(imported("", "\xEF\xBB\xBF" + osm.text()));
}

TEST(Osm, RefusesBrokenXmlAtItsLine) {
  EXPECT_THAT(reports(imported("osm", "<osm>\n<node id='1'\n</osm>")),
              ElementsAre(HasSubstr("this is no XML")));
  EXPECT_THAT(reports(imported("osm", "<kml/>")), ElementsAre(HasSubstr("expected the element <osm>")));
  EXPECT_THAT(reports(imported(
                  "osm", "<osm>\n<node id='x' lon='1' lat='1'/>\n<node id='2' lon='1' lat='91'/></osm>")),
              ElementsAre(HasSubstr("2:2 found no number in the attribute \"id\""),
                          HasSubstr("3:2 found a position that is not on Earth")));
}

/// Files that are cut, joined and changed at random are refused in words, or become a request that is read again.
TEST(Osm, SurvivesChangedFiles) {
  OsmText osm;
  const std::vector<int> outer = osm.box(0, 0, 30, 30), inner = osm.box(10, 10, 10, 10);
  osm.multipolygon({osm.way(outer, ""), osm.way({outer[0], outer[1]}, tag("highway", "primary"))},
                   {osm.way(inner, "")}, house);
  osm.node(3, 3, tag("natural", "tree"));
  const std::string json = collection_of({feature_of({{"building", "yes"}, {"roof:shape", "dome"}},
                                                     {box_of(0, 0, 9, 9), box_of(3, 3, 2, 2)}),
                                          feature_of({{"natural", "water"}}, {box_of(30, 0, 9, 9)})})
                               .dump();
  const std::string files[] = {osm.text(), json};
  std::size_t accepted = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    Rng rng = Rng::of_seed(seed).at("changed files");
    std::string text = files[seed % 2];
    const std::uint32_t changes = 1 + rng.below(4);
    for (std::uint32_t i = 0; i < changes; ++i) {
      const std::size_t at = rng.below(static_cast<std::uint32_t>(text.size()));
      const std::size_t from = rng.below(static_cast<std::uint32_t>(text.size())), count = rng.below(40);
      switch (rng.below(4)) {
        case 0:
          text[at] = static_cast<char>('0' + rng.below(10));
          break;
        case 1:
          text.erase(at, count);
          break;
        case 2:
          text.insert(at, text.substr(from, count));
          break;
        default:
          text[at] = "-.e<>\"'{}[],: "[rng.below(15)];
      }
      if (text.empty()) text = " ";
    }
    const auto result = imported(seed % 2 == 0 ? "osm" : "geojson", text);
    if (!result) {
      ASSERT_FALSE(result.error().issues.empty());
      for (const Issue& issue : result.error().issues)
        ASSERT_FALSE(issue.message.empty() || issue.pointer.starts_with("/parameters"))
            << issue.pointer << issue.message << text;
      continue;
    }
    ++accepted;
    ASSERT_TRUE(read_request(result->request.canonical(), Limits{})) << text;
  }
  EXPECT_GT(accepted, 300U);
}

TEST(TransverseMercator, AgreesWithPublishedFigures) {
  // The quarter of a meridian of WGS 84 to 45 degrees, and UTM's easting of zone 31's border on the equator.
  EXPECT_NEAR(TransverseMercator(0, 0).forward({0, 45}).y, 4984944.378, 0.001);
  EXPECT_NEAR(TransverseMercator(3, 0).forward({6, 0}).x * 0.9996 + 500000, 833978.557, 0.001);
  EXPECT_NEAR(TransverseMercator(179.9, 10).forward({-179.9, 10}).x,
              -TransverseMercator(-179.9, 10).forward({179.9, 10}).x, 1e-6);
}

TEST(MapValues, ReadsLengthsDirectionsAndColours) {
  EXPECT_DOUBLE_EQ(*map_length("12.5"), 12.5);
  EXPECT_DOUBLE_EQ(*map_length("7 m"), 7);
  EXPECT_DOUBLE_EQ(*map_length("40'6\""), 40.5 * 0.3048);
  EXPECT_DOUBLE_EQ(*map_length("10 ft"), 3.048);
  EXPECT_FALSE(map_length("high"));
  EXPECT_FALSE(map_length("12;14"));
  EXPECT_DOUBLE_EQ(*map_length("12,5"), 12.5);
  EXPECT_DOUBLE_EQ(*map_length("7,25 m."), 7.25);
  EXPECT_DOUBLE_EQ(*map_length("~10"), 10);
  EXPECT_FALSE(map_length("1,200"));
  EXPECT_FALSE(map_number("2-3"));
  EXPECT_DOUBLE_EQ(*map_number("2;3"), 2);
  EXPECT_DOUBLE_EQ(*map_direction("north-east"), 45);
  EXPECT_DOUBLE_EQ(*map_direction("WNW"), 292.5);
  EXPECT_DOUBLE_EQ(*map_direction("135"), 135);
  EXPECT_FALSE(map_direction("up"));
  EXPECT_EQ(*map_color("RoyalBlue"), "#4169e1");
  EXPECT_EQ(*map_color("#AbC"), "#aabbcc");
  EXPECT_EQ(*map_color("c0ffee"), "#c0ffee");
  EXPECT_EQ(*map_color("rgb(240, 10, 0)"), "#f00a00");
  EXPECT_FALSE(map_color("rgb(240, 10)"));
  EXPECT_FALSE(map_color("rgb(256,1,1)"));
  EXPECT_FALSE(map_color("#12345"));
}

std::string overpass_file(const std::string& between, const std::string& second) {
  return R"({"version": 0.6, "osm3s": {"copyright": "\"elements\": ["}, "elements": [)" + between +
         R"({"type": "way", "id": 1, "tags": {"building": "yes", "height": "4"}, "geometry": [{"lon": 0, "lat": 0},)"
         R"({"lon": 0.001, "lat": 0}, {"lon": 0.001, "lat": 0.001}, {"lon": 0, "lat": 0}]},)"
         "\n  " +
         second + R"(], "bounds": {"minlon": 0, "minlat": 0, "maxlon": 0.004, "maxlat": 0.004}})";
}

TEST(Osm, ReadsTheElementsOfLargeOverpassFilesOneByOne) {
  const std::string second =
      R"({"type": "node", "id": 2, "lon": 0.002, "lat": 0.001, "tags": {"natural": "tree", "note": "]}\"{"}})";
  const std::string blanks(1'200'000, ' ');
  const auto small = imported("osm", overpass_file("", second)),
             large = imported("osm", overpass_file(blanks, second));
  ASSERT_TRUE(small) << reports(small)[0];
  ASSERT_TRUE(large) << reports(large)[0];
  EXPECT_EQ(parameters_of(large), parameters_of(small));
  EXPECT_EQ(reports(large), reports(small));
  for (const std::string wrong :
       {R"({"type": "node", "a": 1, "a": 2})", R"({"type": "node", "id": 3, "lon": 200, "lat": 1})",
        R"({"type": "way", "id": 1e999})", R"({"type": "way"})", "7", "{", "{}]"}) {
    const auto one = imported("osm", overpass_file("", wrong)),
               other = imported("osm", overpass_file(blanks, wrong));
    ASSERT_FALSE(one) << wrong;
    ASSERT_FALSE(other) << wrong;
    EXPECT_EQ(reports(other), reports(one)) << wrong;
    EXPECT_EQ(other.error().issues[0].pointer, one.error().issues[0].pointer) << wrong;
  }
}

TEST(Osm, ReadsMoreValuesOfOverpassThanARequestMayHave) {
  // 440,000 nodes of 5 values, whose ways are four houses.
  std::string text = R"({"elements": [)";
  for (int id = 1; id <= 440'000; ++id) {
    const Value p = degrees_at(id % 4 == 2 || id % 4 == 3 ? 8 : 0, id % 4 == 3 || id % 4 == 0 ? 6 : 0);
    text += R"({"type":"node","id":)" + std::to_string(id) + R"(,"lon":)" + p[0].dump() + R"(,"lat":)" +
            p[1].dump() + "},";
  }
  for (int way = 0; way < 4; ++way) {
    const int first = 4 * way + 1;
    text +=
        std::string(way == 0 ? "" : ",") + R"({"type":"way","id":)" + std::to_string(way) + R"(,"nodes":[)";
    for (const int node : {first, first + 1, first + 2, first + 3}) text += std::to_string(node) + ",";
    text += std::to_string(first) + R"(],"tags":{"building":"yes"}})";
  }
  const auto result = imported("osm", text + "]}");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result)["buildings"].size(), 4U);
}

}  // namespace
}  // namespace seedmesh
