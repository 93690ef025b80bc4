/// Extracts of maps: parts that a server left out, objects that do not exist, and files that are not maps.
#include <gmock/gmock.h>

#include "tests/core/import/maps.h"

namespace seedmesh {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;
using Value = nlohmann::json;

Value points_at(const std::vector<std::pair<double, double>>& places) {
  Value points = Value::array();
  for (const auto& [east, north] : places) {
    const Value p = degrees_at(east, north);
    points.push_back({{"lon", p[0]}, {"lat", p[1]}});
  }
  return points;
}

const std::vector<std::pair<double, double>> house_ring{{0, 0}, {12, 0}, {12, 8}, {0, 8}, {0, 0}};

Result<ImportedRequest> imported_elements(const Value& elements, const Value& remark = nullptr) {
  Value file = {{"version", 0.6}, {"osm3s", Value::object()}, {"elements", elements}};
  if (!remark.is_null()) file["remark"] = remark;
  return imported("", file.dump());
}

TEST(MapExtracts, ReportQueriesThatTheServerStopped) {
  const Value house = {{"type", "way"},
                       {"id", 9},
                       {"geometry", points_at(house_ring)},
                       {"tags", {{"building", "yes"}, {"height", "7"}}}};
  EXPECT_THAT(reports(imported_elements(Value::array({house}), "runtime error: Query timed out")),
              ElementsAre(AllOf(HasSubstr("not complete"), HasSubstr("Query timed out"))));
  EXPECT_THAT(reports(imported_elements(Value::array(), "runtime error: Query timed out")),
              ElementsAre(HasSubstr("the server stopped the query before it found anything: runtime error")));

  OsmText osm;
  osm.way(osm.box(0, 0, 12, 8), tag("building", "yes") + tag("height", "7"));
  std::string text = osm.text();
  text.insert(text.find("</osm>"), "<remark> runtime error: out of memory </remark>\n");
  EXPECT_THAT(reports(imported("", text)),
              ElementsAre(AllOf(StartsWith("8:2"), HasSubstr("not complete: runtime error: out of memory"))));
}

TEST(MapExtracts, EndLinesWherePointsAreMissing) {
  // 10 m, a gap, and 20 m. The box of the query has cut out the middle.
  Value line = points_at({{0, 0}, {10, 0}, {40, 0}, {60, 0}});
  line.insert(line.begin() + 2, nullptr);
  const auto result = imported_elements(
      {{{"type", "way"}, {"id", 1}, {"geometry", line}, {"tags", {{"highway", "residential"}}}}});
  ASSERT_TRUE(result) << reports(result)[0];
  const Value paths = parameters_of(result)["paths"];
  ASSERT_EQ(paths.size(), 2U);
  const auto length = [](const Value& path) {
    return path["points"].back()[0].get<double>() - path["points"][0][0].get<double>();
  };
  EXPECT_NEAR(length(paths[0]), 10, 0.01);
  EXPECT_NEAR(length(paths[1]), 20, 0.01);
  EXPECT_THAT(reports(result), ElementsAre(HasSubstr("it ends there")));
}

TEST(MapExtracts, LeaveOutAreasOfWhichPointsAreMissing) {
  Value cut = points_at(house_ring);
  cut[2] = nullptr;
  const Value whole = points_at({{50, 0}, {60, 0}, {60, 10}, {50, 0}});
  const Value tags = {{"building", "yes"}, {"height", "7"}};
  const auto result = imported_elements({{{"type", "way"}, {"id", 1}, {"geometry", cut}, {"tags", tags}},
                                         {{"type", "way"}, {"id", 2}, {"geometry", whole}, {"tags", tags}}});
  ASSERT_TRUE(result) << reports(result)[0];
  ASSERT_EQ(parameters_of(result)["buildings"].size(), 1U);
  EXPECT_EQ(parameters_of(result)["buildings"][0]["name"], "way/2");
  EXPECT_THAT(reports(result), ElementsAre(HasSubstr("an area refers to nodes that the file lacks")));
}

TEST(MapExtracts, TakeOutlinesOfBuildingsFromTheirRelations) {
  const Value outline = {
      {"type", "way"}, {"ref", 8}, {"role", "outline"}, {"geometry", points_at(house_ring)}};
  const Value tags = {{"type", "building"}, {"building", "yes"}, {"height", "30"}};
  const Value relation = {
      {"type", "relation"}, {"id", 6}, {"members", Value::array({outline})}, {"tags", tags}};
  const auto result = imported_elements(Value::array({relation}));
  ASSERT_TRUE(result) << reports(result)[0];
  ASSERT_EQ(parameters_of(result)["buildings"].size(), 1U);
  EXPECT_EQ(parameters_of(result)["buildings"][0]["height"], 30);
}

TEST(MapExtracts, RefuseListsOfChanges) {
  EXPECT_THAT(reports(imported(
                  "", "<?xml version='1.0'?>\n<osmChange version='0.6'><create></create></osmChange>\n")),
              ElementsAre(AllOf(StartsWith("2:2"), HasSubstr("a list of changes"))));
}

TEST(MapExtracts, LeaveOutBuildingsThatDoNotExist) {
  const Value house = feature_of({{"building", "yes"}, {"height", 9}}, {box_of(0, 0, 20, 10)});
  std::vector<Value> features{house};
  double east = 30;
  for (const char* name :
       {"demolished:building", "razed:building", "removed:building", "proposed:building"}) {
    features.push_back(feature_of({{name, "yes"}}, {box_of(east, 0, 20, 10)}));
    east += 30;
  }
  features.push_back(feature_of({{"building", "proposed"}}, {box_of(east, 0, 20, 10)}));
  features.push_back(feature_of({{"disused:building", "yes"}}, {box_of(east + 30, 0, 20, 10)}));
  const auto result = imported_map(collection_of(features));
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result)["buildings"].size(), 2U);
  EXPECT_THAT(reports(result), Contains(AllOf(HasSubstr("others (4)"), HasSubstr("building=proposed (1)"))));
}

TEST(MapExtracts, LeaveOutDistrictsWithoutATag) {
  // 1.21 and 0.81 square kilometres.
  const auto result =
      imported_map(collection_of({feature_of({{"name", "Old Town"}}, {box_of(0, 0, 1100, 1100)}),
                                  feature_of({{"name", "hall"}}, {box_of(1200, 0, 900, 900)})}));
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result)["buildings"].size(), 1U);
  EXPECT_THAT(reports(result), Contains(HasSubstr("more than a square kilometre")));
}

TEST(MapExtracts, ReadNumbersOfFloorsByTheirNames) {
  EXPECT_EQ(building_of({{"Floor", 5}})["height"], 15);
  EXPECT_EQ(building_of({{"FLOOR_NUM", "12"}})["height"], 36);
  EXPECT_EQ(building_of({{"Hoehe", 7.5}})["height"], 7.5);
  EXPECT_EQ(building_of({{"building", "yes"}, {"est_height", "14"}})["height"], 14);
}

TEST(MapExtracts, WarnOfWidthsThatCannotBeRead) {
  OsmText osm;
  osm.way({osm.node(0, 0), osm.node(50, 0)}, tag("highway", "primary") + tag("lanes", "two"));
  EXPECT_THAT(reports(imported("osm", osm.text())), ElementsAre(HasSubstr("\"two\" is no value of lanes")));
}

TEST(MapExtracts, WarnsOfAltitudesOnce) {
  const auto town = [](double altitude) {
    nlohmann::json ring = nlohmann::json::array();
    for (const auto& [x, y] : {std::pair{10.0, 50.0}, {10.001, 50.0}, {10.001, 50.001}, {10.0, 50.0}})
      ring.push_back({x, y, altitude});
    return nlohmann::json{{"type", "Feature"},
                          {"properties", {{"building", "yes"}, {"height", 9}}},
                          {"geometry", {{"type", "Polygon"}, {"coordinates", {ring}}}}}
        .dump();
  };
  EXPECT_THAT(
      reports(imported("geojson", town(310))),
      testing::ElementsAre(testing::HasSubstr("altitudes of positions are left out; the map is flat")));
  EXPECT_THAT(reports(imported("geojson", town(0))), testing::IsEmpty());
}

}  // namespace
}  // namespace seedmesh
