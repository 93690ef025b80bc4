#include <gmock/gmock.h>

#include "tests/core/import/maps.h"

namespace seedmesh {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Value = nlohmann::json;

TEST(GeoJson, PutsFootprintsIntoLocalMetres) {
  const auto result = imported_map(
      collection_of({feature_of({{"building", "yes"}, {"height", 9}}, {box_of(-10, -5, 20, 10)})}));
  ASSERT_TRUE(result);
  const Value parameters = parameters_of(result);
  const Value& ring = parameters["buildings"][0]["footprint"][0];
  ASSERT_EQ(ring.size(), 4U);
  // The origin has five digits, so that it is up to half a metre from the middle. East and south.
  const double x = ring[0][0], z = ring[0][1];
  EXPECT_NEAR(x, -10, 0.6);
  EXPECT_NEAR(z, 5, 0.6);
  for (const Value& p : ring) {
    const double dx = p[0].get<double>() - x, dz = p[1].get<double>() - z;
    EXPECT_NEAR(std::min(std::abs(dx), std::abs(dx - 20)), 0, 0.002);
    EXPECT_NEAR(std::min(std::abs(dz), std::abs(dz + 10)), 0, 0.002);
  }
  EXPECT_EQ(parameters["georeference"]["latitude"], 48.1);
  EXPECT_EQ(parameters["georeference"]["longitude"], 11.5);
  EXPECT_THAT(parameters["georeference"]["projection"].get<std::string>(),
              HasSubstr("+proj=tmerc +lat_0=48.1"));
  EXPECT_EQ(parameters["buildings"][0]["height"], 9);
}

TEST(GeoJson, ReadsHeightsAndRoofsOfSimple3DBuildings) {
  Value made = building_of(
      {{"building", "house"}, {"building:levels", "2"}, {"roof:shape", "gabled"}, {"roof:height", "2.5"}});
  EXPECT_EQ(made["height"], 8.5) << made;
  EXPECT_EQ(made["roof"]["shape"], "gabled");
  EXPECT_EQ(made["roof"]["height"], 2.5);
  made = building_of({{"building", "yes"},
                      {"height", "40 ft"},
                      {"min_height", "3"},
                      {"roof:shape", "half-hipped"},
                      {"roof:angle", "45"}});
  EXPECT_EQ(made["height"], 12.192);
  EXPECT_EQ(made["base"], 3);
  EXPECT_EQ(made["roof"]["shape"], "half_hipped");
  EXPECT_NEAR(made["roof"]["height"].get<double>(), 5, 0.01);  // half of the width of 10 m
  made = building_of({{"building", "yes"},
                      {"height", 12},
                      {"roof:shape", "skillion"},
                      {"roof:height", 2},
                      {"roof:direction", "SSW"}});
  EXPECT_EQ(made["roof"]["direction"], 202.5);
  made = building_of({{"building", "yes"}, {"building:levels", 3}, {"building:min_level", 1}});
  EXPECT_EQ(made["height"], 9);
  EXPECT_EQ(made["base"], 3);
}

TEST(GeoJson, AcceptsEveryRoofShape) {
  for (const char* shape : {"skillion", "gabled", "half-hipped", "gambrel", "saltbox", "round", "hipped",
                            "mansard", "pyramidal", "dome", "onion"}) {
    const Value made = building_of({{"building", "yes"}, {"height", 12}, {"roof:shape", shape}});
    std::string ours = shape;
    std::replace(ours.begin(), ours.end(), '-', '_');
    EXPECT_EQ(made["roof"]["shape"], ours) << made;
  }
  const auto other = imported_map(
      collection_of({feature_of({{"building", "yes"}, {"roof:shape", "butterfly"}}, {box_of(0, 0, 9, 9)})}));
  EXPECT_THAT(reports(other),
              Contains(HasSubstr("roof:shape=butterfly has no counterpart; the roof is flat")));
}

TEST(GeoJson, ReadsColoursAndMaterials) {
  Value made = building_of({{"building", "yes"}, {"building:colour", "light_blue"}, {"roof:colour", "#f00"}});
  EXPECT_EQ(made["color"], "#add8e6");
  EXPECT_EQ(made["roof"]["color"], "#ff0000");
  made = building_of({{"building", "yes"}, {"building:material", "glass"}, {"roof:material", "slate"}});
  EXPECT_EQ(made["material"], "glass");
  EXPECT_EQ(made["roof"]["color"], "#565c63");
  const auto odd = imported_map(collection_of(
      {feature_of({{"building", "yes"}, {"building:colour", "brownish"}}, {box_of(0, 0, 9, 9)})}));
  EXPECT_THAT(reports(odd), Contains(HasSubstr("\"brownish\" is no colour of CSS")));
}

TEST(GeoJson, ReadsTheNamesOfFilesOfFootprints) {
  const Value made = building_of(
      {{"render_height", 14}, {"minHeight", 2}, {"roofShape", "hipped"}, {"facade_color", "#123456"}});
  EXPECT_EQ(made["height"], 14) << made;
  EXPECT_EQ(made["base"], 2);
  EXPECT_EQ(made["roof"]["shape"], "hipped");
  EXPECT_EQ(made["color"], "#123456");
}

TEST(GeoJson, TakesCourtyardsAndSeveralPolygons) {
  const Value feature = {
      {"type", "Feature"},
      {"id", "relation/7"},
      {"properties", {{"building", "yes"}}},
      {"geometry",
       {{"type", "MultiPolygon"},
        {"coordinates", {{box_of(0, 0, 30, 30), box_of(10, 10, 10, 10)}, {box_of(50, 0, 10, 10)}}}}}};
  const auto result = imported_map(collection_of({feature}));
  const Value parameters = parameters_of(result);
  ASSERT_EQ(parameters["buildings"].size(), 2U);
  EXPECT_EQ(parameters["buildings"][0]["footprint"].size(), 2U);
  EXPECT_EQ(parameters["buildings"][0]["name"], "relation/7");
}

TEST(GeoJson, PutsPartsInPlaceOfTheirBuilding) {
  const auto result = imported_map(collection_of(
      {feature_of({{"building", "yes"}, {"height", 30}, {"building:colour", "red"}}, {box_of(0, 0, 20, 20)}),
       feature_of({{"building:part", "yes"}, {"height", 10}}, {box_of(0, 0, 20, 10)}),
       feature_of({{"building:part", "yes"}, {"height", 30}, {"min_height", 10}}, {box_of(0, 10, 20, 10)})}));
  const Value parameters = parameters_of(result);
  ASSERT_EQ(parameters["buildings"].size(), 2U);
  EXPECT_EQ(parameters["buildings"][0]["height"], 10);
  EXPECT_EQ(parameters["buildings"][0]["color"], "#ff0000");
  EXPECT_EQ(parameters["buildings"][1]["base"], 10);
  EXPECT_THAT(reports(result), testing::Not(Contains(HasSubstr("less than 90 %"))));
}

TEST(GeoJson, MakesStreetsWaterGreenAndTrees) {
  const Value street = {
      {"type", "Feature"},
      {"properties", {{"highway", "residential"}, {"lanes", "2"}}},
      {"geometry", {{"type", "LineString"}, {"coordinates", {degrees_at(0, 0), degrees_at(100, 0)}}}}};
  const Value tree = {{"type", "Feature"},
                      {"properties", {{"natural", "tree"}, {"leaf_type", "needleleaved"}, {"height", "24"}}},
                      {"geometry", {{"type", "Point"}, {"coordinates", degrees_at(10, 10)}}}};
  const auto result = imported_map(
      collection_of({feature_of({{"natural", "water"}}, {box_of(0, 20, 30, 30)}),
                     feature_of({{"leisure", "park"}}, {box_of(40, 20, 30, 30)}), street, tree}));
  const Value parameters = parameters_of(result);
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters["paths"][0]["width"], 6.5);
  // Water lies on top of the park, whatever their order in the file.
  EXPECT_EQ(parameters["areas"][0]["name"], "grass");
  EXPECT_EQ(parameters["areas"][1]["name"], "water");
  EXPECT_EQ(parameters["layers"][0]["name"], "needleleaved");
  EXPECT_EQ(parameters["layers"][0]["place"]["positions"][0]["scale"], 2);
}

TEST(GeoJson, ListsWhatHasNoCounterpart) {
  const auto result =
      imported_map(collection_of({feature_of({{"building", "yes"}, {"height", 5}}, {box_of(0, 0, 9, 9)}),
                                  feature_of({{"landuse", "residential"}}, {box_of(0, 0, 90, 90)}),
                                  feature_of({{"landuse", "residential"}}, {box_of(90, 0, 90, 90)})}));
  EXPECT_THAT(reports(result),
              Contains(HasSubstr("features without a counterpart are left out: landuse=residential (2)")));
}

TEST(GeoJson, RepairsOutlinesThatTouchThemselves) {
  // A figure of eight that touches itself in one point, and a courtyard that touches the outer wall.
  const auto eight = imported_map(collection_of(
      {feature_of({{"building", "yes"}},
                  {ring_of({{0, 0}, {10, 0}, {10, 10}, {20, 10}, {20, 20}, {10, 20}, {10, 10}, {0, 10}})})}));
  EXPECT_EQ(parameters_of(eight)["buildings"].size(), 2U);
  const auto court = imported_map(collection_of(
      {feature_of({{"building", "yes"}}, {box_of(0, 0, 20, 20), ring_of({{0, 0}, {10, 4}, {4, 10}})})}));
  EXPECT_EQ(parameters_of(court)["buildings"][0]["footprint"].size(), 2U);
}

/// Areas of the outer rings of all buildings, in square metres.
std::vector<double> outer_areas(const Result<ImportedRequest>& result) {
  std::vector<double> areas;
  const Value parameters = parameters_of(result);
  for (const Value& building : parameters["buildings"]) {
    const Value& ring = building["footprint"][0];
    double twice = 0;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Value &a = ring[i], &b = ring[(i + 1) % ring.size()];
      twice += a[0].get<double>() * b[1].get<double>() - a[1].get<double>() * b[0].get<double>();
    }
    areas.push_back(std::abs(twice) / 2);
  }
  return areas;
}

TEST(GeoJson, DividesOutlinesThatCrossThemselves) {
  // The edges y = x and y = 7 - 0.7 x cross at x = 7 / 1.7.
  const auto crossing = imported_map(
      collection_of({feature_of({{"building", "yes"}}, {ring_of({{0, 0}, {10, 10}, {10, 0}, {0, 7}})})}));
  constexpr double x = 7 / 1.7;
  EXPECT_THAT(outer_areas(crossing),
              testing::UnorderedElementsAre(testing::DoubleNear(7 * x / 2, 0.05),
                                            testing::DoubleNear(10 * (10 - x) / 2, 0.05)));
  EXPECT_THAT(reports(crossing), Contains(HasSubstr("a footprint crosses itself; it is divided")));
  // A wall that is drawn over the opposite wall: the flap of 1 m behind it is a part of its own.
  const auto flap = imported_map(collection_of(
      {feature_of({{"building", "yes"}},
                  {ring_of({{0, 0}, {20, 0}, {20, 10}, {12, 10}, {12, -1}, {8, -1}, {8, 10}, {0, 10}})})}));
  EXPECT_THAT(outer_areas(flap),
              testing::UnorderedElementsAre(testing::DoubleNear(80, 0.2), testing::DoubleNear(80, 0.2),
                                            testing::DoubleNear(4, 0.1)));
}

TEST(GeoJson, DividesAnOutlineWhoseLoopsCancelOut) {
  const auto bow = imported_map(
      collection_of({feature_of({{"building", "yes"}}, {ring_of({{0, 0}, {10, 10}, {10, 0}, {0, 10}})})}));
  EXPECT_THAT(outer_areas(bow), ElementsAre(testing::DoubleNear(25, 0.1), testing::DoubleNear(25, 0.1)));
}

TEST(GeoJson, KeepsBothLoopsOfARingThatTouchesItself) {
  // The two triangles have opposite directions.
  const auto both = imported_map(collection_of(
      {feature_of({{"building", "yes"}}, {ring_of({{0, 0}, {10, 0}, {5, 5}, {0, 10}, {10, 10}, {5, 5}})})}));
  EXPECT_THAT(outer_areas(both), ElementsAre(testing::DoubleNear(25, 0.1), testing::DoubleNear(25, 0.1)));
}

TEST(GeoJson, ReadsNamesInEveryCaseAndOfShapeFiles) {
  EXPECT_EQ(building_of({{"HEIGHT", 21}})["height"], 21);
  EXPECT_EQ(building_of({{"Height", "21 m"}})["height"], 21);
  EXPECT_EQ(building_of({{"heightroof", "100"}})["height"], 30.48);  // feet
  EXPECT_EQ(building_of({{"hauteur", 15.5}, {"nombre_d_etages", 5}})["height"], 15.5);
  for (const char* name :
       {"storeys", "building_l", "numberOfFloors", "FLOOR_COUNT", "nb_etages", "no_storeys"})
    EXPECT_EQ(building_of({{name, 5}})["height"], 15) << name;
  EXPECT_EQ(building_of({{"tags", {{"Height", 12}}}, {"type", "way"}})["height"], 12);
  EXPECT_EQ(building_of({{"height", 9}, {"roof_shape", "Half Hipped"}})["roof"]["shape"], "half_hipped");
}

TEST(GeoJson, ReadsTheKindOfAFeatureFromOneProperty) {
  const Value line = {
      {"type", "Feature"},
      {"properties", {{"fclass", "residential"}}},
      {"geometry", {{"type", "LineString"}, {"coordinates", {degrees_at(0, 0), degrees_at(99, 0)}}}}};
  const Value parameters = parameters_of(imported_map(
      collection_of({feature_of({{"fclass", "park"}}, {box_of(0, 0, 9, 9)}),
                     feature_of({{"subtype", "water"}, {"class", "pond"}}, {box_of(20, 0, 9, 9)}),
                     feature_of({{"class", "stadium"}}, {box_of(40, 0, 9, 9)}),
                     feature_of({{"class", "grass"}, {"height", 4}}, {box_of(60, 0, 9, 9)}), line})));
  ASSERT_EQ(parameters["areas"].size(), 2U);
  EXPECT_EQ(parameters["areas"][0]["name"], "grass");
  EXPECT_EQ(parameters["areas"][1]["name"], "water");
  EXPECT_EQ(parameters["buildings"].size(), 2U);
  EXPECT_EQ(parameters["paths"].size(), 1U);
}

TEST(GeoJson, ReadsFeaturesAsLines) {
  const std::string first = feature_of({{"height", 5}}, {box_of(0, 0, 9, 9)}).dump(),
                    second = feature_of({{"height", 7}}, {box_of(20, 0, 9, 9)}).dump();
  for (const std::string& text :
       {first + "\n" + second + "\n", first + "\r\n\r\n" + second, "\x1e" + first + "\n\x1e" + second + "\n",
        "\xEF\xBB\xBF" + first + "\n" + second}) {
    const auto result = imported("", text);
    ASSERT_TRUE(result) << reports(result)[0];
    EXPECT_EQ(parameters_of(result)["buildings"].size(), 2U);
  }
  const auto broken = imported("geojson", first + "\n" + second.substr(0, 30) + "\n");
  ASSERT_FALSE(broken);
  EXPECT_EQ(broken.error().issues[0].line, 2);
}

TEST(GeoJson, TakesGeometriesWithoutCoordinates) {
  const auto result =
      imported_map(collection_of({feature_of({{"height", 5}}, {box_of(0, 0, 9, 9)}),
                                  feature_of({}, Value::array()),
                                  {{"type", "Feature"},
                                   {"properties", nullptr},
                                   {"geometry", {{"type", "Point"}, {"coordinates", Value::array()}}}}}));
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result)["buildings"].size(), 1U);
}

TEST(GeoJson, ReadsTheFeaturesOfLargeFilesOneByOne) {
  const auto file = [](const std::string& between, const std::string& second) {
    return R"({"type": "FeatureCollection", "name": "a \"features\": [", "features": [)" + between +
           R"({"type": "Feature", "properties": {"building": "yes", "height": 4}, "geometry": {"type": "Polygon",)"
           R"("coordinates": [[[0, 0], [0.001, 0], [0.001, 0.001], [0, 0]]]}},)" +
           "\n  " + second + R"(], "bbox": [0, 0, 1, 1]})";
  };
  const std::string second =
      R"({"type": "Feature", "properties": {"note": "]}\"{"}, "geometry": {"type": "Point", "coordinates": [0.002, 0.001]}})";
  const std::string blanks(1'200'000, ' ');
  const auto small = imported("geojson", file("", second));
  const auto large = imported("geojson", file(blanks, second));
  ASSERT_TRUE(small) << reports(small)[0];
  ASSERT_TRUE(large) << reports(large)[0];
  EXPECT_EQ(parameters_of(large), parameters_of(small));
  EXPECT_EQ(reports(large), reports(small));
  for (const std::string wrong : {R"({"type": "Feature", "a": 1, "a": 2})", R"({"type": 1})",
                                  R"({"type": "Feature", "geometry": {"x": 1e999}})", "7", "{", "{}]"}) {
    const auto one = imported("geojson", file("", wrong)), other = imported("geojson", file(blanks, wrong));
    ASSERT_FALSE(one) << wrong;
    ASSERT_FALSE(other) << wrong;
    EXPECT_EQ(reports(other), reports(one)) << wrong;
    EXPECT_EQ(other.error().issues[0].pointer, one.error().issues[0].pointer) << wrong;
  }
}

TEST(GeoJson, ReadsMoreValuesThanARequestMayHave) {
  std::string text = R"({"type": "FeatureCollection", "features": [)";
  for (int line = 0; line < 5; ++line) {
    text += line == 0 ? "" : ",";
    text +=
        R"({"type": "Feature", "properties": {}, "geometry": {"type": "LineString", "coordinates": [[0,0])";
    for (int i = 0; i < 150'000; ++i) text += ",[0,0]";
    text += "]}}";
  }
  const auto result = imported("geojson", text + R"(,{"type": "Feature", "properties": {"building": "yes"},
      "geometry": {"type": "Polygon", "coordinates": [[[0, 0], [0.001, 0], [0.001, 0.001], [0, 0]]]}}]})");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result)["buildings"].size(), 1U);
}

TEST(GeoJson, ReadsWebMercatorAndMetres) {
  Value map =
      collection_of({feature_of({{"building", "yes"}}, {{{0, 0}, {20, 0}, {20, 10}, {0, 10}, {0, 0}}})});
  map["crs"] = {{"type", "name"}, {"properties", {{"name", "urn:ogc:def:crs:EPSG::3857"}}}};
  // On the equator, Web Mercator is 1 : 1 east, and 1 : 1.0067 north (the ellipsoid is flatter there).
  Value ring = parameters_of(imported_map(map))["buildings"][0]["footprint"][0];
  EXPECT_NEAR(ring[1][0].get<double>() - ring[0][0].get<double>(), 20, 0.01);
  EXPECT_NEAR(ring[1][1].get<double>() - ring[2][1].get<double>(), 10 / 1.0067395, 0.01);
  map["crs"]["properties"]["name"] = "urn:ogc:def:crs:EPSG::25832";
  for (Value& p : map["features"][0]["geometry"]["coordinates"][0])
    p = {691000 + p[0].get<double>(), 5334000 + p[1].get<double>()};
  const auto metres = imported_map(map);
  ring = parameters_of(metres)["buildings"][0]["footprint"][0];
  EXPECT_EQ(ring[1][0].get<double>() - ring[0][0].get<double>(), 20);
  EXPECT_THAT(reports(metres), Contains(HasSubstr("positions are metres from (691010, 5334005)")));
  map.erase("crs");
  EXPECT_THAT(reports(imported_map(map)), Contains(HasSubstr("read as metres")));
}

TEST(GeoJson, RefusesWhatItIsNotByPointer) {
  const auto pointers = [](const Value& map) {
    std::vector<std::string> texts;
    const auto result = imported_map(map);
    if (!result) {
      for (const Issue& issue : result.error().issues) texts.push_back(issue.pointer + ": " + issue.message);
    }
    return texts;
  };
  EXPECT_THAT(pointers({{"type", "FeatureCollection"}}), ElementsAre(": expected a member \"features\""));
  EXPECT_THAT(pointers({{"type", "Topology"}}), ElementsAre(HasSubstr("found the type \"Topology\"")));
  Value map = collection_of({feature_of({}, {box_of(0, 0, 9, 9)})});
  map["features"][0]["geometry"]["coordinates"][0][2] = "north";
  EXPECT_THAT(pointers(map),
              ElementsAre(HasSubstr("/features/0/geometry/coordinates/0/2: expected a position")));
  EXPECT_THAT(pointers(collection_of({})), ElementsAre(": the map has no positions"));
  EXPECT_THAT(pointers(collection_of({feature_of({{"place", "island"}}, {box_of(0, 0, 9, 9)})})),
              ElementsAre(HasSubstr("found no building, street, water, green area or tree")));
}

TEST(GeoJson, IsRecognised) {
  const Value map = collection_of({feature_of({{"building", "yes"}}, {box_of(0, 0, 9, 9)})});
  const auto result = imported("", map.dump(2));
  ASSERT_TRUE(result);
  EXPECT_THAT(result->answer, HasSubstr("\"format\":\"geojson\""));
}

/// A plan of the generator `city`, whose positions look like degrees.
Value plan_of(const std::string& features) {
  return Value::parse(
      R"({"type":"FeatureCollection","georeference":{"projection":"local","unit":"metre"},"features":[)" +
      features + "]}");
}

TEST(GeoJson, ReadsPlansOfCitiesInMetres) {
  const auto result = imported_map(plan_of(R"(
    {"type":"Feature","properties":{"kind":"area"},
     "geometry":{"type":"Polygon","coordinates":[[[-50,-50],[50,-50],[50,50],[-50,50],[-50,-50]]]}},
    {"type":"Feature","properties":{"kind":"street","id":"s","width":6},
     "geometry":{"type":"LineString","coordinates":[[-50,0],[50,0]]}},
    {"type":"Feature","properties":{"kind":"carriageway","street":"s"},
     "geometry":{"type":"Polygon","coordinates":[[[-50,-3],[50,-3],[50,3],[-50,3],[-50,-3]]]}},
    {"type":"Feature","properties":{"kind":"park"},
     "geometry":{"type":"Polygon","coordinates":[[[-50,-50],[50,-50],[50,-30],[-50,-30],[-50,-50]]]}},
    {"type":"Feature","properties":{"kind":"lot","id":"bare","building":null},
     "geometry":{"type":"Polygon","coordinates":[[[-40,5],[-20,5],[-20,30],[-40,30],[-40,5]]]}},
    {"type":"Feature","properties":{"kind":"lot","id":"built","position":[10,20,0],"turn":90,
      "building":{"generator":"building","parameters":{"size":[12,0,8],"attributes":{"floors":4}}}},
     "geometry":{"type":"Polygon","coordinates":[[[0,5],[20,5],[20,30],[0,30],[0,5]]]}})"));
  ASSERT_TRUE(result) << reports(result)[0];
  const Value parameters = parameters_of(result);
  ASSERT_EQ(parameters["buildings"].size(), 1U);
  EXPECT_EQ(parameters["paths"].size(), 1U);
  EXPECT_EQ(parameters["areas"].size(), 1U);
  // 12 m along the street before the quarter turn: 8 m from west to east, 12 m from south to north.
  double west = 1e9, east = -1e9, south = -1e9, north = 1e9;
  for (const Value& p : parameters["buildings"][0]["footprint"][0]) {
    west = std::min(west, p[0].get<double>());
    east = std::max(east, p[0].get<double>());
    north = std::min(north, p[1].get<double>());
    south = std::max(south, p[1].get<double>());
  }
  EXPECT_NEAR(east - west, 8, 1e-6);
  EXPECT_NEAR(south - north, 12, 1e-6);
  EXPECT_EQ(parameters["buildings"][0]["height"], 4 * 3);
}

}  // namespace
}  // namespace seedmesh
