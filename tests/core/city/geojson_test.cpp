// The lists of cases follow RFC 7946 and the files that common programs write.
#include "core/generators/city/geojson.h"

#include <gtest/gtest.h>

#include <tuple>

#include "core/generators/city/city.h"
#include "core/generators/city/given.h"
#include "core/generators/city/plan_warnings.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

/// The value as a request with it reads it, and what is found in it.
struct Read {
  std::vector<GeoFeature> features;
  std::vector<Issue> issues;
  std::vector<Warning> warnings;
};
Read read(const std::string& text, GeoKind kind = GeoKind::lines) {
  IssueList errors;
  const char* name = kind == GeoKind::lines ? "streets" : "water";
  const CityParams params = read_city({{"given", {{name, Json::parse(text)}}}}, "", errors);
  EXPECT_TRUE(errors.empty()) << text;
  Read result;
  const auto& value = kind == GeoKind::lines ? params.given.given_streets : params.given.given_water;
  result.features =
      features_of(*value, kind, std::string("/given/") + name, {result.issues, &result.warnings});
  return result;
}

std::string collection(const std::string& features, const std::string& more = "") {
  return R"({"type":"FeatureCollection",)" + more + R"("features":[)" + features + "]}";
}
std::string feature(const std::string& geometry, const std::string& more = R"("properties":{})") {
  return R"({"type":"Feature",)" + more + R"(,"geometry":)" + geometry + "}";
}
const std::string line = R"({"type":"LineString","coordinates":[[-200,10],[180.5,42.25]]})";

TEST(GeoJsonOfCities, AcceptsForeignMembers) {
  const std::string plain = collection(feature(line));
  const std::vector<std::string> texts = {
      // ogr2ogr and QGIS
      collection(feature(line, R"("properties":{"fid":1,"name":null,"width":null})"),
                 R"("name":"roads","xy_coordinate_resolution":0.001,"crs":{"type":"name","properties":)"
                 R"({"name":"urn:ogc:def:crs:EPSG::25832"}},)"),
      // overpass turbo and osmtogeojson
      collection(feature(line, R"("id":"way/1","properties":{"@id":"way/1","highway":"residential",)"
                               R"("@relations":[{"role":"","rel":7}],"tainted":true})"),
                 R"("generator":"overpass-ide","copyright":"x","timestamp":"2026-01-01T00:00:00Z",)"),
      // geojson.io
      collection(feature(line, R"("id":0,"bbox":[-200,10,180.5,42.25],"properties":null)")),
      collection(R"({"type":"Feature","geometry":)" + line + "}"),
      feature(line),
      line,
      R"({"type":"GeometryCollection","geometries":[)" + line + "]}",
      R"({"type":"LineString","coordinates":[[-200,10,3],[180.5,42.25,4.5]]})",
      R"({"type":"MultiLineString","bbox":[0,0,1,1],"coordinates":[[[-200,10,3,77],[180.5,42.25,0,78]]]})",
      collection(feature("null") + "," + feature(R"({"type":"LineString","coordinates":[]})") + "," +
                 feature(line)),
  };
  for (const std::string& text : texts) {
    const Read found = read(text);
    ASSERT_TRUE(found.issues.empty()) << text << found.issues[0].message;
    EXPECT_TRUE(found.warnings.empty()) << text;
    ASSERT_EQ(found.features.size(), 1U) << text;
    EXPECT_EQ(found.features[0].lines, read(plain).features[0].lines) << text;
    EXPECT_TRUE(found.features[0].properties.is_object());
  }
}

TEST(GeoJsonOfCities, LeavesForeignMembersOutOfTheCanonicalRequest) {
  const auto canonical = [](const std::string& text) {
    IssueList errors;
    return canonical_text(write_city(read_city({{"given", {{"streets", Json::parse(text)}}}}, "", errors)));
  };
  EXPECT_EQ(
      canonical(collection(feature(line, R"("properties":{},"id":9,"bbox":[1,2,3,4])"), R"("name":"a",)")),
      canonical(collection(feature(line))));
}

TEST(GeoJsonOfCities, RefusesWhatTheFormatForbids) {
  const std::string at = "/given/streets";
  const std::vector<std::tuple<IssueKind, std::string, std::string>> cases = {
      {IssueKind::invalid_value, R"({"features":[]})", at},
      {IssueKind::invalid_value, R"({"type":"Topology","objects":{}})", at},
      {IssueKind::missing, R"({"type":"FeatureCollection"})", at},
      {IssueKind::wrong_type, R"({"type":"FeatureCollection","features":{}})", at + "/features"},
      {IssueKind::invalid_value, collection("7"), at + "/features/0"},
      {IssueKind::invalid_value, collection(line), at + "/features/0"},
      {IssueKind::missing, collection(R"({"type":"Feature","properties":{}})"), at + "/features/0"},
      {IssueKind::wrong_type, collection(feature(line, R"("properties":[1])")),
       at + "/features/0/properties"},
      {IssueKind::missing, collection(feature(R"({"type":"LineString"})")), at + "/features/0/geometry"},
      {IssueKind::invalid_value, collection(feature(R"({"type":"Curve","coordinates":[]})")),
       at + "/features/0/geometry"},
      {IssueKind::wrong_type, R"({"type":"LineString","coordinates":[[0,0],[5]]})", at + "/coordinates/1"},
      {IssueKind::wrong_type, R"({"type":"LineString","coordinates":[[0,0],[5,"7"]]})",
       at + "/coordinates/1"},
      {IssueKind::wrong_type, R"({"type":"LineString","coordinates":[[0,0],[5,null]]})",
       at + "/coordinates/1"},
      {IssueKind::wrong_type, R"({"type":"LineString","coordinates":[[[0,0],[50,0]]]})",
       at + "/coordinates/0"},
      {IssueKind::wrong_type, R"({"type":"MultiLineString","coordinates":[[0,0],[50,0]]})",
       at + "/coordinates/0/0"},
      {IssueKind::out_of_range, R"({"type":"LineString","coordinates":[[500000,5700000],[500100,5700000]]})",
       at + "/coordinates/0"},
      {IssueKind::invalid_value, R"({"type":"LineString","coordinates":[[10,10],[10,10]]})", at},
  };
  for (const auto& [kind, text, pointer] : cases) {
    const Read found = read(text);
    ASSERT_FALSE(found.issues.empty()) << text;
    EXPECT_EQ(found.issues[0].pointer, pointer) << text;
    EXPECT_EQ(found.issues[0].kind, kind) << text;
  }
}

TEST(GeoJsonOfCities, NamesGeometriesWithoutAMeaning) {
  const std::string point = R"({"type":"Point","coordinates":[3,4]})";
  const Read some = read(collection(feature(line) + "," + feature(point) + "," + feature(point)));
  EXPECT_TRUE(some.issues.empty());
  ASSERT_EQ(some.warnings.size(), 1U);
  EXPECT_EQ(some.warnings[0].pointer, "/given/streets/features/1/geometry");
  EXPECT_EQ(some.warnings[0].message,
            "2 geometries are left out, the first a Point; expected LineString or MultiLineString");
  const Read none = read(collection(feature(point)));
  ASSERT_EQ(none.issues.size(), 1U);
  EXPECT_EQ(none.issues[0].pointer, "/given/streets/features/0/geometry");
  EXPECT_EQ(none.issues[0].message, "found Point, expected LineString or MultiLineString");
  const Read water = read(line, GeoKind::polygons);
  ASSERT_EQ(water.issues.size(), 1U);
  EXPECT_EQ(water.issues[0].message, "found LineString, expected Polygon or MultiPolygon");
}

TEST(GeoJsonOfCities, RefusesDegrees) {
  for (const char* crs :
       {"", R"("crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:OGC:1.3:CRS84"}},)"}) {
    const Read found = read(collection(
        feature(R"({"type":"LineString","coordinates":[[14.50512,46.05108],[14.50731,46.05219]]})"), crs));
    ASSERT_EQ(found.issues.size(), 1U);
    EXPECT_EQ(found.issues[0].pointer, "/given/streets");
    EXPECT_EQ(found.issues[0].kind, IssueKind::invalid_value);
  }
}

TEST(GeoJsonOfCities, ReadsTheTextsOfOpenStreetMap) {
  IssueList errors;
  const Json streets = Json::parse(
      collection(feature(line, R"("properties":{"lanes":"2","width":"7.5","bridge":"yes","class":null})")));
  const CityParams params = read_city({{"given", {{"streets", streets}}}}, "", errors);
  std::vector<CrossSection> sections = classes_of(params);
  std::vector<Issue> issues;
  const std::vector<GivenLine> lines = given_lines(params, sections, issues);
  ASSERT_TRUE(issues.empty()) << issues[0].message;
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].level, 1);
  EXPECT_EQ(sections[lines[0].section].lanes, 2);
  EXPECT_EQ(sections[lines[0].section].width, 7.5);
}

/// The key `highway` and lengths as the wiki of OpenStreetMap describes them ("Key:highway", "Key:width"), lists as OSMnx
/// writes them where it merges ways.
TEST(GeoJsonOfCities, ReadsTagsOfOpenStreetMap) {
  struct Case {
    const char* tags;
    const char* section;
    double width;  ///< 0: that of the class
    int level;
  };
  const std::array<Case, 10> cases{{
      {R"("highway":"motorway")", "highway", 0, 0},
      {R"("highway":"trunk_link","width":"3;4")", "highway", 3, 0},
      {R"("highway":["secondary","residential"],"width":["9","7"])", "major", 9, 0},
      {R"("highway":"residential","width":"6.5 m","sidewalk":"both")", "minor", 6.5, 0},
      {R"("highway":"footway","width":"2m","sidewalk":"no")", "lane", 2, 0},
      {R"("highway":"service","width":"20 ft")", "lane", 6.096, 0},
      {R"("highway":"primary","class":"lane","width":"16'")", "lane", 4.8768, 0},
      {R"("highway":"tertiary","bridge":"viaduct","layer":"2")", "minor", 0, 2},
      {R"("highway":"tertiary","tunnel":"building_passage","layer":1)", "minor", 0, -1},
      {R"("highway":"tertiary","bridge":"no","layer":"1")", "minor", 0, 0},
  }};
  for (const Case& each : cases) {
    IssueList errors;
    const Json streets =
        Json::parse(collection(feature(line, std::string("\"properties\":{") + each.tags + "}")));
    const CityParams params = read_city({{"given", {{"streets", streets}}}}, "", errors);
    std::vector<CrossSection> sections = classes_of(params);
    std::vector<Issue> issues;
    const std::vector<GivenLine> lines = given_lines(params, sections, issues);
    ASSERT_TRUE(issues.empty()) << each.tags << ": " << issues[0].message;
    ASSERT_EQ(lines.size(), 1U);
    const CrossSection& section = sections[lines[0].section];
    EXPECT_EQ(std::string(section.name), each.section) << each.tags;
    if (each.width > 0) {
      EXPECT_NEAR(section.width, each.width, 1e-9) << each.tags;
    }
    EXPECT_EQ(lines[0].level, each.level) << each.tags;
  }
}

TEST(GeoJsonOfCities, RefusesLengthsInOtherUnits) {
  IssueList errors;
  const Json streets = Json::parse(collection(feature(line, R"("properties":{"width":"7 yards"})")));
  const CityParams params = read_city({{"given", {{"streets", streets}}}}, "", errors);
  std::vector<CrossSection> sections = classes_of(params);
  std::vector<Issue> issues;
  given_lines(params, sections, issues);
  ASSERT_EQ(issues.size(), 1U);
  EXPECT_EQ(issues[0].pointer, "/given/streets/features/0/properties/width");
}

TEST(GeoJsonOfCities, WarnsOfStreetsOutsideOfTheArea) {
  IssueList errors;
  const Json far = Json::parse(R"({"type":"LineString","coordinates":[[5000,10],[5200,10]]})");
  const CityParams params =
      read_city({{"area", {{"size", {200, 200}}}}, {"given", {{"streets", far}}}}, "", errors);
  Job job(1, Job::Options{});
  const Result<CityPlan> plan = plan_of(params, job);
  ASSERT_TRUE(plan);
  const std::vector<Warning> warnings = plan_warnings(params, *plan, job);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].pointer, "/given/streets");
}

std::vector<Warning> warnings_for(const Json& streets, const char* method) {
  IssueList errors;
  const CityParams params = read_city({{"area", {{"size", {200, 200}}}},
                                       {"streets", {{"method", method}}},
                                       {"given", {{"streets", streets}}}},
                                      "", errors);
  Job job(1, Job::Options{});
  const Result<CityPlan> plan = plan_of(params, job);
  EXPECT_TRUE(plan);
  return plan_warnings(params, *plan, job);
}

// The line x + y = 198 is 2.8 m long within the corner of the area at 100, 100.
TEST(GeoJsonOfCities, WarnsOfEachStreetThatIsLeftOut) {
  const Json streets = Json::parse(R"({"type":"FeatureCollection","features":[
    {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[-90,0],[90,0]]}},
    {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[90,108],[108,90]]}},
    {"type":"Feature","properties":{"level":1},"geometry":{"type":"LineString","coordinates":[[-50,50],[50,50]]}}]})");
  const std::vector<Warning> warnings = warnings_for(streets, "given");
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_EQ(warnings[0].pointer, "/given/streets/features/1");
  EXPECT_EQ(warnings[0].message,
            "a piece at 99, 99 is left out; expected pieces of more than 3.1 m in the area");
  EXPECT_EQ(warnings[1].pointer, "/given/streets/features/2");
  EXPECT_EQ(warnings[1].message,
            "the bridge or tunnel at 0, 50 is left out; expected ends or corners of streets of level 0 at "
            "both ends");
}

// A rest of 2 m at the border, parts outside of the area, and a bridge between streets give no warning.
TEST(GeoJsonOfCities, DoesNotWarnOfStreetsThatAreBuilt) {
  const Json streets = Json::parse(R"({"type":"FeatureCollection","features":[
    {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[-50,0],[98,0],[150,0]]}},
    {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[-50,0],[-50,60],[-50,150]]}},
    {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[50,0],[50,60]]}},
    {"type":"Feature","properties":{"level":1},"geometry":{"type":"LineString","coordinates":[[-50,60],[50,60]]}}]})");
  EXPECT_TRUE(warnings_for(streets, "given").empty());
  EXPECT_TRUE(warnings_for(streets, "growth").empty());
}

TEST(GeoJsonOfCities, BuildsABridgeOnceThatIsGivenTwice) {
  const Json streets = Json::parse(R"({"type":"FeatureCollection","features":[
    {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[-90,0],[90,0]]}},
    {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[-50,0],[-50,60],[-50,90]]}},
    {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[50,0],[50,60]]}},
    {"type":"Feature","properties":{"level":1},"geometry":{"type":"LineString","coordinates":[[-50,60],[50,60]]}},
    {"type":"Feature","properties":{"level":1},"geometry":{"type":"LineString","coordinates":[[50,60],[-50,60]]}},
    {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[90,0],[-90,0]]}}]})");
  const Json water =
      Json::parse(R"({"type":"Polygon","coordinates":[[[-9,-20],[9,-20],[9,20],[-9,20],[-9,-20]]]})");
  IssueList errors;
  const CityParams params = read_city({{"area", {{"size", {200, 200}}}},
                                       {"streets", {{"method", "given"}}},
                                       {"given", {{"streets", streets}, {"water", water}}}},
                                      "", errors);
  ASSERT_TRUE(errors.empty());
  Job job(1, Job::Options{});
  const Result<CityPlan> plan = plan_of(params, job);
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->graph.separated.size(), 2U) << "one over the street at 0, 60, one over the water";
  EXPECT_TRUE(plan_warnings(params, *plan, job).empty());
}

// Minor streets are 7 m wide. The first two are 5 m apart from x = 0 on, and the third is 7 m away from the first. The
// fourth and the fifth leave one junction at 20 degrees, so that they are near to each other there.
TEST(GeoJsonOfCities, WarnsOfStreetsThatRunTooNearToEachOther) {
  const Json streets = Json::parse(R"({"type":"FeatureCollection","features":[
    {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[-90,0],[90,0]]}},
    {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[0,5],[80,5]]}},
    {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[-80,-7],[80,-7]]}},
    {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[-80,40],[80,40]]}},
    {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[-80,40],[60,91]]}}]})");
  const std::vector<Warning> warnings = warnings_for(streets, "given");
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_EQ(warnings[0].pointer, "/given/streets/features/1");
  EXPECT_EQ(
      warnings[0].message,
      "runs 5 m beside the street `given/streets/features/0` at 0, 0, so that their carriageways overlap; "
      "expected at least 7 m, or a common corner");
}

// The streets share the corner 0, 0, which is in the water.
TEST(GeoJsonOfCities, RefusesStreetsThatMeetOverWater) {
  const Json streets = Json::parse(R"({"type":"FeatureCollection","features":[
    {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[-90,0],[0,0],[90,0]]}},
    {"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[0,-90],[0,0],[0,90]]}}]})");
  const Json water =
      Json::parse(R"({"type":"Polygon","coordinates":[[[-9,-9],[9,-9],[9,9],[-9,9],[-9,-9]]]})");
  IssueList errors;
  const CityParams params = read_city({{"area", {{"size", {200, 200}}}},
                                       {"streets", {{"method", "given"}}},
                                       {"given", {{"streets", streets}, {"water", water}}}},
                                      "", errors);
  Job job(1, Job::Options{});
  const Result<CityPlan> plan = plan_of(params, job);
  ASSERT_FALSE(plan);
  ASSERT_EQ(plan.error().issues.size(), 1U);
  EXPECT_EQ(plan.error().issues[0].pointer, "/given/streets/features/1/geometry");
  EXPECT_EQ(
      plan.error().issues[0].message,
      "meets another street over water near 0, 0; expected land there, since bridges have no junctions");
}

}  // namespace
}  // namespace seedmesh::city
