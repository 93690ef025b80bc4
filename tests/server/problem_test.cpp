#include "server/problem.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace seedmesh {
namespace {

nlohmann::json json_of(const Error& error) {
  return nlohmann::json::parse(problem_json(problem_of(error), "r1"));
}

TEST(Problem, ListsEveryFaultWithItsPlace) {
  const auto json =
      json_of({Code::invalid, {{"/seed", "Bad."}, {"/parameters/productions/0", "No arrow.", 1, 3}}});
  EXPECT_EQ(json["status"], 422);
  EXPECT_EQ(json["type"], "/docs#invalid-request");
  EXPECT_EQ(json["instance"], "r1");
  EXPECT_EQ(json["errors"].size(), 2U);
  EXPECT_FALSE(json["errors"][0].contains("line"));
  EXPECT_EQ(json["errors"][1]["line"], 1);
  EXPECT_EQ(json["errors"][1]["column"], 3);
}

TEST(Problem, CountsTheFaultsThatItDoesNotList) {
  std::vector<Issue> issues(100, {"/seed", "Bad."});
  EXPECT_EQ(json_of({Code::invalid, issues})["detail"], "100 faults were found; errors lists them all.");
  issues.push_back({"", "and 9899 more faults"});
  EXPECT_EQ(json_of({Code::invalid, issues})["detail"],
            "9999 faults were found; errors lists the first 100.");
  issues.back().pointer = "/seed";
  EXPECT_EQ(json_of({Code::invalid, issues})["detail"], "101 faults were found; errors lists them all.");
}

TEST(Problem, HasTheStatusOfTheContract) {
  const auto status = [](Code code) { return problem_of({code, {{"", "m"}}}).status; };
  EXPECT_EQ(status(Code::malformed), 400);
  EXPECT_EQ(status(Code::invalid), 422);
  EXPECT_EQ(status(Code::limit), 422);
  EXPECT_EQ(problem_of({Code::limit, {{"", "m"}}}).word, "limit-exceeded");
  EXPECT_EQ(status(Code::deadline), 504);
  EXPECT_EQ(status(Code::internal), 500);
}

TEST(Problem, KeepsTheInsideInside) {
  const Problem problem = problem_of({Code::internal, {{"", "vector::at at line 7"}}});
  EXPECT_THAT(problem_json(problem, "r1"), testing::Not(testing::HasSubstr("vector")));
  EXPECT_THAT(problem.log_text, testing::HasSubstr("vector"));
}

TEST(Problem, SurvivesBytesThatAreNoText) {
  const auto json = json_of({Code::malformed, {{"", "Found \xff\xfe."}}});
  EXPECT_EQ(json["status"], 400);
}

TEST(Problem, SaysWhenToComeBack) {
  const http::Response response = to_response(problem(429, "Full."), "r1");
  EXPECT_EQ(http::joined(response.headers, "retry-after"), "1");
  EXPECT_EQ(response.type, "application/problem+json");
}

TEST(LimitOf, IsOneWordOfABoundedSet) {
  const auto limit = [](const char* message) { return limit_of(problem_of({Code::limit, {{"", message}}})); };
  EXPECT_EQ(limit("needs at least 7 modules; the limit is 5"), "modules");
  EXPECT_EQ(limit("needs at least 7 triangles; the limit is 5"), "triangles");
  EXPECT_EQ(limit("needs at least 7 output bytes; the limit is 5"), "output");
  EXPECT_EQ(limit("needs at least 7 bytes of memory; the limit is 5"), "memory");
  EXPECT_EQ(limit("something else"), "other");
}

}  // namespace
}  // namespace seedmesh
