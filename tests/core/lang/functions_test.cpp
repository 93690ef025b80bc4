#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <set>

#include "core/base/math.h"
#include "tests/core/lang/expressions.h"

namespace seedmesh::lang {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The value of each example of the table; random ones by the interval they must stay in.
struct Interval {
  double low, high;
};
const std::map<std::string, Interval> expected = {
    {"sin(30)", {0.5, 0.5}},      {"cos(60)", {0.5, 0.5}},
    {"tan(45)", {1, 1}},          {"asin(1)", {90, 90}},
    {"acos(0.5)", {60, 60}},      {"atan(1)", {45, 45}},
    {"atan2(1, -1)", {135, 135}}, {"exp(0)", {1, 1}},
    {"log(1)", {0, 0}},           {"ln(1)", {0, 0}},
    {"log10(1000)", {3, 3}},      {"sqrt(2.25)", {1.5, 1.5}},
    {"pow(2, 10)", {1024, 1024}}, {"abs(-3)", {3, 3}},
    {"fabs(-0.5)", {0.5, 0.5}},   {"sign(-7)", {-1, -1}},
    {"floor(-1.5)", {-2, -2}},    {"ceil(1.2)", {2, 2}},
    {"round(2.5)", {3, 3}},       {"rint(2.5)", {2, 2}},
    {"trunc(-1.5)", {-1, -1}},    {"mod(-7, 3)", {2, 2}},
    {"min(2, 3)", {2, 2}},        {"max(2, 3)", {3, 3}},
    {"clamp(7, 0, 5)", {5, 5}},   {"lerp(10, 20, 0.25)", {12.5, 12.5}},
    {"isnan(0/0)", {1, 1}},       {"isinf(1/0)", {1, 1}},
    {"ran(5)", {0, 5}},           {"ran(2, 5)", {2, 5}},
    {"rand()", {0, 1}},           {"rand(5)", {0, 5}},
    {"rand(2, 5)", {2, 5}},       {"nran(10, 2)", {-10, 30}},
    {"p(0.25)", {0, 1}},          {"select(2 > 1, 10, 20)", {10, 10}},
};

TEST(Functions, GiveWhatTheirExamplesPromise) {
  EXPECT_EQ(functions().size(), expected.size());
  for (const Function& row : functions()) {
    const auto found = expected.find(std::string(row.example));
    ASSERT_NE(found, expected.end()) << row.example;
    const double result = value(found->first);
    EXPECT_GE(result, found->second.low) << row.example;
    EXPECT_LE(result, found->second.high) << row.example;
    EXPECT_EQ(found->second.low != found->second.high, row.random) << row.example;
  }
}

TEST(Functions, HaveOneRowForEachNumberOfArguments) {
  std::set<std::pair<std::string_view, int>> rows;
  std::set<std::string_view> closed;
  std::string_view last;
  for (const Function& row : functions()) {
    EXPECT_TRUE(rows.insert({row.name, row.arity}).second) << row.name;
    EXPECT_LE(row.arity, max_arity) << row.name;
    EXPECT_EQ(row.text.back(), '.') << row.name;
    const auto commas = std::count(row.arguments.begin(), row.arguments.end(), ',');
    EXPECT_EQ(row.arguments.empty() ? 0 : commas + 1, row.arity) << row.name;
    if (row.name != last) {
      EXPECT_TRUE(closed.insert(row.name).second) << row.name << " stands in two places";
    }
    last = row.name;
  }
}

TEST(Functions, StandInTheDocs) {
  std::ifstream file(SEEDMESH_SOURCE_DIR "/docs/expressions.md");
  const std::string docs((std::istreambuf_iterator<char>(file)), {});
  for (const Function& row : functions()) {
    const std::string line = "| `" + std::string(row.name) + "(" + std::string(row.arguments) + ")` | " +
                             std::string(row.text) + " | `" + std::string(row.example) + "` |\n";
    EXPECT_NE(docs.find(line), std::string::npos) << "docs/expressions.md lacks the line\n" << line;
  }
}

TEST(Functions, TakeDegrees) {
  for (int quarter = -4; quarter <= 4; ++quarter) {
    const double sines[] = {0, 1, 0, -1}, cosines[] = {1, 0, -1, 0};
    const std::string angle = std::to_string(90 * quarter);
    EXPECT_EQ(value("sin(" + angle + ")"), sines[(quarter + 4) % 4]) << angle;
    EXPECT_EQ(value("cos(" + angle + ")"), cosines[(quarter + 4) % 4]) << angle;
  }
  EXPECT_EQ(value("sin(150)"), 0.5);
  EXPECT_EQ(value("sin(-30)"), -0.5);
  EXPECT_EQ(value("sin(210)"), -0.5);
  EXPECT_EQ(value("cos(120)"), -0.5);
  EXPECT_EQ(value("cos(-60)"), 0.5);
  EXPECT_EQ(value("tan(-45)"), -1);
  EXPECT_EQ(value("tan(90)"), infinity);
  EXPECT_EQ(value("tan(180)"), 0);
  EXPECT_EQ(value("acos(-0.5)"), 120);
  EXPECT_NEAR(value("sin(10)"), 0.17364817766693033, 1e-16);
  EXPECT_NEAR(value("tan(60)"), 1.7320508075688772, 1e-15);
  EXPECT_EQ(value("atan2(0, -1)"), 180);
}

TEST(Functions, GiveNoNegativeZeroAtRightAngles) {
  for (const char* text : {"sin(180)", "sin(-180)", "cos(270)", "cos(90)", "tan(180)", "sin(0)"}) {
    EXPECT_FALSE(std::signbit(value(text))) << text;
  }
}

TEST(Functions, TakeTheRestWithTheSignOfTheDivisor) {
  EXPECT_EQ(value("mod(7, 3)"), 1);
  EXPECT_EQ(value("mod(7, -3)"), -2);
  EXPECT_EQ(value("mod(-7, -3)"), -1);
  EXPECT_EQ(value("mod(-6, 3)"), 0);
  EXPECT_EQ(value("mod(5.5, 2)"), 1.5);
  EXPECT_EQ(value("mod(-0.5, 2)"), 1.5);
  EXPECT_EQ(value("mod(1e300, 7)"), std::fmod(1e300, 7));
  EXPECT_TRUE(std::isnan(value("mod(1, 0)")));
  EXPECT_EQ(value("-7 % 3"), 2);
}

TEST(Functions, RoundHalvesAsTheySay) {
  EXPECT_EQ(value("round(-2.5)"), -3);
  EXPECT_EQ(value("rint(3.5)"), 4);
  EXPECT_EQ(value("rint(-2.5)"), -2);
  EXPECT_EQ(value("rint(2.6)"), 3);
  EXPECT_EQ(value("rint(-0.4)"), 0);
}

TEST(Functions, RaiseWholeNumbersExactly) {
  for (int base = 2; base <= 100; ++base) {
    double exact = 1;
    for (int exponent = 0; exact < 9007199254740992.0; ++exponent) {
      ASSERT_EQ(power(base, exponent), exact) << base << "^" << exponent;
      exact *= base;
    }
  }
  for (int exponent = 0; exponent <= 22; ++exponent) {
    EXPECT_EQ(value("log10(1e" + std::to_string(exponent) + ")"), exponent);
  }
}

TEST(Functions, LetInfinitiesAndNotANumberThrough) {
  EXPECT_EQ(value("1/0"), infinity);
  EXPECT_EQ(value("-1/0"), -infinity);
  EXPECT_TRUE(std::isnan(value("0/0")));
  EXPECT_TRUE(std::isnan(value("sqrt(-1)")));
  EXPECT_TRUE(std::isnan(value("asin(2)")));
  EXPECT_EQ(value("log(0)"), -infinity);
  EXPECT_TRUE(std::isnan(value("sign(0/0)")));
  EXPECT_TRUE(std::isnan(value("sin(1/0)")));
  EXPECT_EQ(value("isinf(x/z) && !isnan(x/z)"), 1);
}

double draw(const std::string& text, std::uint64_t seed, int times) {
  const Parsed parsed = parse(text);
  EXPECT_TRUE(parsed.faults.empty()) << text;
  Rng rng = Rng::of_seed(seed);
  double sum = 0;
  const double slots[] = {3, 4, 0};
  for (int i = 0; i < times; ++i) sum += parsed.program.evaluate(parsed.expression, slots, rng);
  return sum / times;
}

TEST(RandomFunctions, DrawTheSameFromTheSameStream) {
  for (const Function& row : functions()) {
    if (!row.random) continue;
    const std::string text(row.example);
    EXPECT_EQ(draw(text, 7, 100), draw(text, 7, 100)) << text;
    EXPECT_NE(draw(text, 7, 100), draw(text, 8, 100)) << text;
  }
}

TEST(RandomFunctions, DrawAsTheyAreNamed) {
  EXPECT_NEAR(draw("ran(2, 6)", 1, 100'000), 4, 0.02);
  EXPECT_NEAR(draw("ran(x)", 1, 100'000), 1.5, 0.02);
  EXPECT_NEAR(draw("rand()", 1, 100'000), 0.5, 0.005);
  EXPECT_NEAR(draw("nran(10, 2)", 1, 100'000), 10, 0.05);
  EXPECT_NEAR(draw("p(0.25)", 1, 100'000), 0.25, 0.01);
}

TEST(RandomFunctions, DrawFromLeftToRightAndOnlyWhereEvaluated) {
  Rng rng = Rng::of_seed(5);
  const double first = rng.unit(), second = rng.unit();
  const auto with_seed_5 = [](const std::string& text) { return draw(text, 5, 1); };
  EXPECT_EQ(with_seed_5("rand() - 2*rand()"), first - 2 * second);
  EXPECT_EQ(with_seed_5("min(rand(), 9) + 10*rand()"), first + 10 * second);
  EXPECT_EQ(with_seed_5("(z && rand()) + rand()"), first) << "z is 0, so && stops";
  EXPECT_EQ(with_seed_5("(x || rand()) - 1 + rand()"), first) << "x is not 0, so || stops";
  EXPECT_EQ(with_seed_5("(0 && rand()) + rand()"), first) << "also where it is known when parsed";
}

TEST(RandomFunctions, AreNeverFolded) {
  EXPECT_FALSE(parse("ran(1, 1)").expression.is_constant);
  const Parsed parsed = parse("x + ran(1, 2)*0");
  EXPECT_TRUE(parsed.program.draws(parsed.expression));
  const Parsed plain = parse("x + min(y, 2)");
  EXPECT_FALSE(plain.program.draws(plain.expression));
  const Parsed dropped = parse("x + (0 && rand())");
  EXPECT_FALSE(dropped.program.draws(dropped.expression));
}

}  // namespace
}  // namespace seedmesh::lang
