#include "core/generators/city/productions.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

/// Builds every road that is asked for, and proposes successors until a number of roads is built.
class Counting final : public RoadRules {
 public:
  explicit Counting(int most) : most_(most) {}

  GlobalGoals global_goals(double rule, double road, Rng key) override {
    EXPECT_EQ(rule, 7);
    keys.push_back(key.key());
    GlobalGoals goals;
    goals.rule = {7, 7, 7};
    goals.road = {road + 1, road + 100, road + 200};
    if (static_cast<int>(built.size()) < most_) goals.delay = {0, 2, -1};
    return goals;
  }
  RoadState local_constraints(double road) override {
    built.push_back(road);
    return road >= 1000 ? RoadState::failed : RoadState::succeed;
  }
  std::array<double, 2> measure(double) const override { return {90, 50}; }

  std::vector<double> built;
  std::vector<std::uint64_t> keys;

 private:
  int most_;
};

StreetGrammar published() {
  std::vector<Issue> issues;
  StreetGrammar grammar(CityStreets{}.productions, "/streets/productions", issues);
  EXPECT_TRUE(issues.empty());
  return grammar;
}

std::vector<Issue> errors_of(const std::string& production) {
  std::vector<Issue> issues;
  const StreetGrammar grammar({production}, "/p", issues);
  return issues;
}

TEST(StreetProductions, BuildTheRoadStraightOnBeforeADelayedBranch) {
  Counting rules(2);
  const Job job(0, Job::Options{});
  ASSERT_EQ(published().grow({{0, 7, 1, 42}}, rules, 1000, job), std::nullopt);
  // Road 1 proposes 2 at once and 101 after two steps; road 2 does not propose any more.
  EXPECT_EQ(rules.built, (std::vector<double>{1, 2, 101}));
}

TEST(StreetProductions, EraseASiteWithANegativeDelay) {
  Counting rules(10);
  const Job job(0, Job::Options{});
  ASSERT_EQ(published().grow({{-1, 7, 1, 42}}, rules, 1000, job), std::nullopt);
  EXPECT_TRUE(rules.keys.empty());
}

TEST(StreetProductions, GiveNoSuccessorsToARoadThatFailed) {
  Counting rules(10);
  const Job job(0, Job::Options{});
  ASSERT_EQ(published().grow({{0, 7, 1000, 42}}, rules, 1000, job), std::nullopt);
  EXPECT_EQ(rules.built.size(), 1U);
  EXPECT_TRUE(rules.keys.empty());
}

TEST(StreetProductions, GiveEverySiteAKeyOfItsOwn) {
  Counting rules(40);
  const Job job(0, Job::Options{});
  ASSERT_EQ(published().grow({{0, 7, 1, 42}, {0, 7, 2, 43}}, rules, 100'000, job), std::nullopt);
  std::vector<std::uint64_t> keys = rules.keys;
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::unique(keys.begin(), keys.end()), keys.end());
  EXPECT_GT(keys.size(), 20U);
}

TEST(StreetProductions, SayWhenGrowthDoesNotEnd) {
  Counting rules(1'000'000);
  const Job job(0, Job::Options{});
  EXPECT_EQ(published().grow({{0, 7, 1, 42}}, rules, 500, job), std::uint64_t{500});
}

TEST(StreetProductions, NameTheLineAndTheColumnOfAnError) {
  const std::vector<Issue> arrow = errors_of("R(del,rule) e");
  ASSERT_FALSE(arrow.empty());
  EXPECT_EQ(arrow[0].pointer, "/p/0");
  EXPECT_EQ(arrow[0].line, 1);
  const std::vector<Issue> symbol = errors_of("R(del, rule) -> Q(1)");
  ASSERT_EQ(symbol.size(), 1U);
  EXPECT_EQ(symbol[0].column, 17);
  EXPECT_FALSE(errors_of("R(del, rule) : del < speed -> *").empty());
  EXPECT_FALSE(errors_of("R(del) -> *").empty());
  EXPECT_FALSE(errors_of("B(del, rule, road) -> [ R(del, rule)").empty());
  EXPECT_FALSE(errors_of("R(del, rule) : { moveRoad(rule) } 1 -> *").empty());
  EXPECT_FALSE(errors_of("R(del, rule) : ran(0, 1) < 0.5 -> *").empty());
  EXPECT_TRUE(errors_of("p1: R(del, rule) : del < 0 -> *").empty());
}

}  // namespace
}  // namespace seedmesh::city
