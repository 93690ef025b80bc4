/// A request inside a request, as the reader made from tiny.schema.json takes it.
#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "core/schema/json.h"
#include "generated/params/tiny.h"

namespace seedmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TinyParams read(const std::string& members, IssueList& faults) {
  const Result<Json> json = parse_json(R"({"mood": "calm", )" + members + "}");
  EXPECT_TRUE(json);
  return read_tiny(*json, "/parameters", faults);
}

TEST(Child, KeepsItsParametersForItsOwnGenerator) {
  IssueList faults;
  TinyParams params =
      read(R"("part": {"generator": "any", "seed": "7", "parameters": {"b": 1.0, "a": []}})", faults);
  EXPECT_TRUE(faults.empty());
  ASSERT_TRUE(params.part);
  EXPECT_EQ(params.part->generator, "any");
  EXPECT_EQ(params.part->seed, 7U);
  EXPECT_EQ(params.part->parameters, R"({"a":[],"b":1})");
}

TEST(Child, IsMergedOverItsPreset) {
  IssueList faults;
  const TinyParams params =
      read(R"("part": {"preset": "koch_snowflake", "parameters": {"iterations": 1}})", faults);
  EXPECT_TRUE(faults.empty());
  EXPECT_EQ(params.part->generator, "lsystem");
  EXPECT_THAT(params.part->parameters, HasSubstr(R"("iterations":1)"));
  EXPECT_THAT(params.part->parameters, HasSubstr("axiom"));
}

TEST(Child, RefusesMembersAndPresetsThatDoNotExist) {
  IssueList faults;
  read(R"("part": {"preset": "koch_snowflak", "output": {}}, "parts": {"x": [{}, {"generator": 3}]})",
       faults);
  std::vector<std::string> found;
  for (const Issue& issue : faults.issues())
    found.push_back(issue.pointer + " " + std::string(word_of(issue.kind)));
  EXPECT_THAT(found,
              ElementsAre("/parameters/part/output unknown_key", "/parameters/part/preset unknown_name",
                          "/parameters/parts/x/0 missing", "/parameters/parts/x/1/generator wrong_type"));
}

TEST(Child, RefusesAGeneratorWithoutAName) {
  IssueList faults;
  read(R"("part": {"generator": ""}, "parts": {"x": [{"generator": "", "parameters": {}}]})", faults);
  std::vector<std::string> found;
  for (const Issue& issue : faults.issues())
    found.push_back(issue.pointer + " " + std::string(word_of(issue.kind)));
  EXPECT_THAT(found, ElementsAre("/parameters/part/generator unknown_name",
                                 "/parameters/parts/x/0/generator unknown_name"));
}

TEST(Child, IsFoundWithItsPointer) {
  IssueList faults;
  TinyParams params = read(
      R"("part": {"generator": "a"}, "parts": {"x/y": [{"generator": "b"}, {"generator": "c"}]})", faults);
  std::vector<std::string> places;
  for (const ChildLocation& place : children_of(params))
    places.push_back(place.pointer + " " + place.child->generator);
  EXPECT_THAT(places, ElementsAre("/part a", "/parts/x~1y/0 b", "/parts/x~1y/1 c"));
}

TEST(Child, IsWrittenWithoutDefaults) {
  IssueList faults;
  const TinyParams params = read(R"("part": {"generator": "any", "parameters": {}})", faults);
  EXPECT_THAT(canonical_text(write_tiny(params)), HasSubstr(R"("part":{"generator":"any"})"));
}

}  // namespace
}  // namespace seedmesh
