#include "core/generators/lsystem/drawing_cache.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/generators/lsystem/growth.h"
#include "tests/core/lsystem/support.h"

namespace seedmesh::lsystem {
namespace {

Grammar compiled(const LsystemParams& params) {
  std::vector<Issue> issues;
  Grammar grammar = compile(params, 0, Limits{}, issues);
  EXPECT_TRUE(issues.empty());
  return grammar;
}

struct Drawn {
  Skeleton skeleton;
  TurtleReport report;
  glm::dvec3 end;
};

template <class Sink>
Drawn drawn(const LsystemParams& params) {
  Job job = job_of(1);
  const Grammar grammar = compiled(params);
  const auto steps = static_cast<std::uint32_t>(params.iterations);
  Drawn result{Skeleton(job), {}, {}};
  Drawing drawing(grammar, params, &result.skeleton, {job});
  if constexpr (std::is_same_v<Sink, Drawing>) {
    ContextFreeDerivation<Drawing>(grammar, steps, false, job, drawing).run();
  } else {
    DrawingCache cache(grammar, params, steps, drawing, {job});
    ContextFreeDerivation<DrawingCache>(grammar, steps, false, job, cache).run();
  }
  result.report = drawing.turtle().report();
  result.end = drawing.turtle().position();
  return result;
}

/// Expects the same joints in the same order, at the same positions except for rounding.
void expect_same(const LsystemParams& params) {
  const Drawn plain = drawn<Drawing>(params), copied = drawn<DrawingCache>(params);
  const Limbs &a = plain.skeleton.limbs, &b = copied.skeleton.limbs;
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(plain.report.segments, copied.report.segments);
  EXPECT_NEAR(plain.report.total_length, copied.report.total_length, 1e-9 * plain.report.total_length);
  EXPECT_TRUE(std::ranges::equal(a.parent, b.parent));
  EXPECT_TRUE(std::ranges::equal(a.color, b.color));
  EXPECT_TRUE(std::ranges::equal(a.radius, b.radius));
  EXPECT_TRUE(std::ranges::equal(a.base_radius, b.base_radius));
  EXPECT_TRUE(std::ranges::equal(a.starts_limb, b.starts_limb));
  EXPECT_TRUE(std::ranges::equal(a.order, b.order));
  double size = 0, most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      size = std::max(size, std::abs(static_cast<double>(a.position[i][axis])));
      most = std::max(most, std::abs(static_cast<double>(a.position[i][axis] - b.position[i][axis])));
    }
  }
  EXPECT_LE(most, 2e-7 * size);
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(plain.end[axis], copied.end[axis], 1e-9 * size);
}

TEST(DrawingCache, DrawsATreeAsTheTurtleDoes) {
  LsystemParams params = grammar_of("FFA", {"A -> F[&&A][^^A]///A"}, 8);
  params.interpretation = {"A -> F"};
  expect_same(params);
  params.style = LsystemParams::Style::lines;
  expect_same(params);
}

TEST(DrawingCache, KeepsColoursWidthsAndMoves) {
  LsystemParams params = grammar_of("!F'X", {"X -> F(2)[!+'X]f[|-;X]gX"}, 7);
  params.width_decrement = 0.01;
  expect_same(params);
  params.style = LsystemParams::Style::lines;
  expect_same(params);
  params.productions = {"X -> F[+X]f[-X]gX"};
  params.axiom = "X";
  expect_same(params);
}

TEST(DrawingCache, FollowsCurvesWithoutBranches) {
  LsystemParams params = grammar_of("FX", {"X -> X+YF+", "Y -> -FX-Y"}, 14);
  params.angle.yaw = 90;
  params.style = LsystemParams::Style::lines;
  expect_same(params);
  params = grammar_of("F", {"F -> F+F--F+F"}, 7);
  params.angle.yaw = 60;
  expect_same(params);
}

TEST(DrawingCache, TakesTheDecrementOfEachStep) {
  LsystemParams params = grammar_of("A", {"A -> F[+A][-A]FA"}, 9);
  params.width_rule = LsystemParams::WidthRule::decrement;
  params.width_decrement = 0.002;
  expect_same(params);
}

TEST(DrawingCache, IsUsedForBigPlainSystemsOnly) {
  const auto fits = [](const LsystemParams& params) {
    return DrawingCache::fits(compiled(params), params, static_cast<std::uint32_t>(params.iterations));
  };
  EXPECT_TRUE(fits(grammar_of("A", {"A -> F[+A][-A]FA"}, 12)));
  EXPECT_FALSE(fits(grammar_of("A", {"A -> F[+A][-A]FA"}, 6)));
  EXPECT_FALSE(fits(grammar_of("A", {"A -> F[+A][-A]$FA"}, 12))) << "depends on the up direction";
  EXPECT_FALSE(fits(grammar_of("A(1)", {"A(n) -> F(n)[+A(n/2)][-A(n)]FA(n)"}, 12))) << "has parameters";
  EXPECT_FALSE(fits(grammar_of("A", {"A : 0.5 -> F[+A][-A]FA", "A : 0.5 -> F[+A][-A][-A]"}, 12)))
      << "has random choices";
  LsystemParams spread = grammar_of("A", {"A -> F[+A][-A]FA"}, 12);
  spread.angle.spread = 5;
  EXPECT_FALSE(fits(spread)) << "has random angles";
}

TEST(DrawingCache, RefusesTheSameAsTheTurtle) {
  const LsystemParams params = grammar_of("A", {"A -> F[+A][-A]FA"}, 9);
  Job job = job_of(1);
  const Grammar grammar = compiled(params);
  Skeleton skeleton(job);
  Drawing drawing(grammar, params, &skeleton, {job});
  drawing.set_most_segments(5000);
  DrawingCache cache(grammar, params, 9, drawing, {job});
  EXPECT_THROW((ContextFreeDerivation<DrawingCache>(grammar, 9, false, job, cache).run()), Stop);
  EXPECT_LE(drawing.turtle().report().segments, 5000U);
}

TEST(DrawingCache, SpendsTheModulesOfTheWord) {
  const LsystemParams params = grammar_of("A", {"A -> F[+A][-A]FA"}, 9);
  const Grammar grammar = compiled(params);
  const std::uint64_t modules = least_modules(grammar, 9);
  for (const auto& [limit, allowed] : {std::pair{modules / 2, false}, std::pair{2 * modules, true}}) {
    Limits limits;
    limits.modules = limit;
    Job job = job_of(1, limits);
    Skeleton skeleton(job);
    Drawing drawing(grammar, params, &skeleton, {job});
    DrawingCache cache(grammar, params, 9, drawing, {job});
    ContextFreeDerivation<DrawingCache> derivation(grammar, 9, false, job, cache);
    if (allowed) {
      EXPECT_NO_THROW(derivation.run());
    } else {
      EXPECT_THROW(derivation.run(), Stop);
    }
  }
}

}  // namespace
}  // namespace seedmesh::lsystem
