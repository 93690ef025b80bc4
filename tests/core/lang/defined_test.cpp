#include <gmock/gmock.h>

#include "core/lang/expression.h"

namespace seedmesh::lang {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

/// Definitions and one expression over the slot x.
struct Text {
  explicit Text(std::vector<std::string> given) : definitions(std::move(given)) {
    for (const std::string& each : definitions) {
      Names::Defined function;
      const std::string name = read_definition(each, function, faults);
      names.define(name, std::move(function));
    }
    names.bind_constant("k", 10);
    names.bind_slot("x", 0);
  }

  double value(const std::string& text, double x) {
    const std::vector<Token> tokens = tokenize(text, 0, text.size(), faults);
    std::size_t at = 0;
    const Expression expression = program.parse(tokens, at, names, faults);
    Rng rng(0);
    return program.evaluate(expression, &x, rng);
  }

  std::vector<std::string> definitions;
  Names names;
  Program program;
  std::vector<TextError> faults;
};

TEST(Defined, ExpandsAFunctionWithItsArguments) {
  Text text({"twice(a) = a + a", "far(a, b) = max(a, twice(b)) * k"});
  EXPECT_EQ(text.value("twice(x)", 3), 6);
  EXPECT_EQ(text.value("1 + twice(x * x) / 2", 3), 10);
  EXPECT_EQ(text.value("far(x + 1, x - 1)", 4), 60);
  EXPECT_EQ(text.value("far(1, twice(twice(x)))", 1), 80);
  EXPECT_EQ(text.value("far(2, 3)", 0), 60);
  EXPECT_THAT(text.faults, IsEmpty());
}

TEST(Defined, UsesItsParametersAndConstantsAndNothingOfTheCaller) {
  Text text({"f(x) = x + k", "g() = x"});
  EXPECT_EQ(text.value("f(5) + x", 100), 115);
  text.value("g()", 1);
  ASSERT_EQ(text.faults.size(), 1U);
  EXPECT_THAT(text.faults[0].message, HasSubstr("unknown name `x`"));
}

TEST(Defined, EvaluatesAnArgumentOnce) {
  Text text({"same(a) = a == a", "second(a, b, c, d, e, f, g, h) = b * 100 + h"});
  for (int i = 0; i < 20; ++i) EXPECT_EQ(text.value("same(ran(1))", 0), 1);
  EXPECT_EQ(text.value("second(x, x + 1, 3, 4, 5, 6, x * 7, x * x)", 5), 625);
  EXPECT_THAT(text.faults, IsEmpty());
}

TEST(Defined, RefusesAFunctionThatCallsItself) {
  Text text({"f(a) = g(a)", "g(a) = f(a)"});
  text.value("f(1)", 0);
  ASSERT_FALSE(text.faults.empty());
  EXPECT_THAT(text.faults[0].message, HasSubstr("calls itself"));
}

TEST(Defined, BoundsTheExpansionOfNestedCalls) {
  std::vector<std::string> doubling = {"f0(a) = a * a + a"};
  for (int i = 1; i < 40; ++i) {
    const std::string before = "f" + std::to_string(i - 1);
    doubling.push_back("f" + std::to_string(i) + "(a) = " + before + "(a + 1) + " + before + "(a)");
  }
  Text text(doubling);
  text.value("f39(x)", 1);
  ASSERT_FALSE(text.faults.empty());
  EXPECT_THAT(text.faults[0].message, HasSubstr("more than 1000 operations"));
  text.faults.clear();
  text.value("f39(1)", 1);  // folds, so that no code counts it
  ASSERT_FALSE(text.faults.empty());
  EXPECT_THAT(text.faults[0].message, HasSubstr("more than 1000 calls"));
}

TEST(Defined, CountsArguments) {
  Text text({"f(a, b) = a"});
  text.value("f(1)", 0);
  ASSERT_EQ(text.faults.size(), 1U);
  EXPECT_EQ(text.faults[0].message, "`f` takes 2 arguments (a, b), found 1");
}

TEST(Defined, ReportsErrorsInADefinition) {
  const auto fault_of = [](const std::string& text) {
    Names::Defined function;
    std::vector<TextError> faults;
    read_definition(text, function, faults);
    return faults.empty() ? "" : std::to_string(faults[0].offset) + " " + faults[0].message;
  };
  EXPECT_EQ(fault_of("f(a, b) = a + b"), "");
  EXPECT_THAT(fault_of("f(a, a) = a"), HasSubstr("5 the parameter `a` is named twice"));
  EXPECT_THAT(fault_of("f a = 2"), HasSubstr("2 expected `(`"));
  EXPECT_THAT(fault_of("sin(a) = 2"), HasSubstr("0 `sin` is the name of a built-in function"));
  EXPECT_THAT(fault_of("f(a) 2"), HasSubstr("5 expected `=`"));
  EXPECT_THAT(fault_of("f(a,b,c,d,e,f,g,h,i) = 1"), HasSubstr("more than 8"));
  EXPECT_THAT(fault_of(""), HasSubstr("expected the name"));
}

TEST(Defined, HasModAsAWordBetweenValues) {
  Text text({});
  EXPECT_EQ(text.value("x mod 3 == 1", 7), 1);
  EXPECT_EQ(text.value("x mod (3) + mod(x, 4)", 7), 4);
  EXPECT_THAT(text.faults, IsEmpty());
}

}  // namespace
}  // namespace seedmesh::lang
