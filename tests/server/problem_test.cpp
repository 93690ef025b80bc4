#include "server/problem.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace seedmesh {
namespace {

nlohmann::json json_of(const Error& error) {
  return nlohmann::json::parse(problem_json(problem_of(error), "r1"));
}

TEST(Problem, ListsEveryErrorWithItsPointerAndKind) {
  const auto json = json_of({Code::invalid,
                             {{IssueKind::wrong_type, "/seed", "Bad."},
                              {IssueKind::syntax, "/parameters/productions/0", "No arrow.", 1, 3}}});
  EXPECT_EQ(json["status"], 422);
  EXPECT_EQ(json["type"], "/docs#invalid-request");
  EXPECT_EQ(json["instance"], "r1");
  EXPECT_EQ(json["errors"].size(), 2U);
  EXPECT_EQ(json["errors"][0]["code"], "wrong_type");
  EXPECT_EQ(json["errors"][1]["code"], "syntax");
  EXPECT_FALSE(json["errors"][0].contains("line"));
  EXPECT_FALSE(json["errors"][0].contains("resource"));
  EXPECT_EQ(json["errors"][1]["line"], 1);
  EXPECT_EQ(json["errors"][1]["column"], 3);
}

TEST(Problem, CountsTheErrorsThatItDoesNotList) {
  std::vector<Issue> issues(100, {IssueKind::wrong_type, "/seed", "Bad."});
  EXPECT_EQ(json_of({Code::invalid, issues})["detail"], "100 errors were found; `errors` lists them all.");
  issues.push_back(truncated_list(9899));
  const auto json = json_of({Code::invalid, issues});
  EXPECT_EQ(json["detail"], "9999 errors were found; `errors` lists the first 100.");
  EXPECT_EQ(json["errors"][100]["code"], "truncated_list");
  EXPECT_EQ(json["errors"][100]["unlisted"], 9899);
}

TEST(Problem, HasTheStatusOfTheContract) {
  const auto status = [](Code code) { return problem_of({code, {{IssueKind::internal, "", "m"}}}).status; };
  EXPECT_EQ(status(Code::malformed), 400);
  EXPECT_EQ(status(Code::invalid), 422);
  EXPECT_EQ(status(Code::limit), 422);
  EXPECT_EQ(problem_of({Code::limit, {{IssueKind::internal, "", "m"}}}).word, "limit-exceeded");
  EXPECT_EQ(status(Code::deadline), 504);
  EXPECT_EQ(status(Code::internal), 500);
}

TEST(Problem, KeepsTheInsideInside) {
  const Problem problem = problem_of({Code::internal, {{IssueKind::internal, "", "vector::at at line 7"}}});
  EXPECT_THAT(problem_json(problem, "r1"), testing::Not(testing::HasSubstr("vector")));
  EXPECT_THAT(problem.log_text, testing::HasSubstr("vector"));
}

TEST(Problem, SurvivesBytesThatAreNoText) {
  const auto json = json_of({Code::malformed, {{IssueKind::syntax, "", "Found \xff\xfe."}}});
  EXPECT_EQ(json["status"], 400);
}

TEST(Problem, StatesWhenToTryAgain) {
  const http::Response response = to_response(problem(429, "Full."), "r1");
  EXPECT_EQ(http::field_value(response.headers, "retry-after"), "1");
  EXPECT_EQ(response.type, "application/problem+json");
}

TEST(Problem, NamesTheResourceOfALimit) {
  const Error error{Code::limit, {limit_issue({Resource::output_bytes, 5, 7}, "Too long.", "/parameters")}};
  const auto entry = json_of(error)["errors"][0];
  EXPECT_EQ(entry["code"], "limit");
  EXPECT_EQ(entry["resource"], "output_bytes");
  EXPECT_EQ(entry["limit"], 5);
  EXPECT_EQ(entry["needed"], 7);
  EXPECT_EQ(limit_of(problem_of(error)), "output_bytes");
}

TEST(Problem, NamesNoResourceWhereNoErrorIsALimit) {
  EXPECT_EQ(limit_of(problem_of({Code::limit, {{IssueKind::not_available, "", "No memory."}}})), "other");
}

}  // namespace
}  // namespace seedmesh
