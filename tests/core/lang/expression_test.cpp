#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/core/lang/expressions.h"

namespace seedmesh::lang {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

/// Values by the rules of the book and of C, computed by hand.
constexpr std::pair<const char*, double> known_values[] = {
    {"1+2*3", 7},
    {"(1+2)*3", 9},
    {"7-2-1", 4},
    {"24/4/2", 3},
    {"2*3%4", 2},
    {"2^3^2", 512},
    {"-2^2", -4},
    {"2^-1", 0.5},
    {"2^-3^2", 1.0 / 512},
    {"2**3", 8},
    {"2*-3", -6},
    {"2--3", 5},
    {"-x", -3},
    {"--x", 3},
    {"-+-x", 3},
    {"1-x", -2},
    {"12/x", 4},
    {"x^2", 9},
    {"2^x", 8},
    {"-x^2", -9},
    {"1<2", 1},
    {"2<1", 0},
    {"2<=2", 1},
    {"3>=4", 0},
    {"3!=4", 1},
    {"x=3", 1},
    {"x==4", 0},
    {"1+1==2", 1},
    {"1<2 && 2<1", 0},
    {"1<2 || 2<1", 1},
    {"1 || 0 && 0", 1},
    {"(1 || 0) && 0", 0},
    {"x>1 & y>1", 1},
    {"x>9 | y>9", 0},
    {"!0", 1},
    {"!x", 0},
    {"!z", 1},
    {"!!x", 1},
    {"!x < y", 1},
    {"!(x < y)", 0},
    {"!z + 1", 2},
    {"-!z", -1},
    {"x+y*z", 3},
    {"(x+y)*2", 14},
    {"x*y-x/y", 11.25},
    {"10 % y", 2},
    {"y % 3 * 2", 2},
    {"3<x", 0},
    {"5>x", 1},
    {"3<=x", 1},
    {"5>=x", 1},
    {"3==x", 1},
    {"5!=x", 1},
    {"x<y && y<5", 1},
    {"x && y", 1},
    {"z || y", 1},
    {"z || z", 0},
    {"x && 2", 1},
    {"x && 0", 0},
    {"z || 0", 0},
    {"(x && y) + (z || x)", 2},
    {"x+y+z>6", 1},
    {"(x+y)/2", 3.5},
    {"two*half", 1},
    {"x*half", 1.5},
    {"max(x, y) - min(x, y)", 1},
    {"max(x*2, min(y, 9))", 6},
    {"clamp(x*y, 0, x+y)", 7},
    {"lerp(x, y, half)", 3.5},
    {"sqrt(x*x + y*y)", 5},
    {"abs(x-y)", 1},
    {"((((x))))", 3},
    {"+x", 3},
    {"2 - (3 - (4 - x))", 0},
    {"x - (y - (x - (y - x)))", 1},
    {"x*x < y*y && !(x*x > y*y)", 1},
    {"1 && 5", 1},
    {"0 || 7", 1},
    {"max(1, x) ^ max(1, 2)", 9},
    {"sin(x*10)", 0.5},
    {"sin(90) + cos(0)", 2},
};

TEST(Precedence, FollowsTheBookAndC) {
  for (const auto& [text, result] : known_values) EXPECT_DOUBLE_EQ(value(text), result) << text;
}

TEST(Folding, LeavesNoCodeForConstants) {
  for (const char* text : {"1+2*3", "two^half", "sin(30)*two", "two < half || two > half", "clamp(two, 0, 1)",
                           "-two", "0 && x", "1 || x", "!two", "max(two, half)"}) {
    EXPECT_TRUE(parse(text).expression.is_constant) << text;
  }
  EXPECT_FALSE(parse("x").expression.is_constant);
  EXPECT_FALSE(parse("1 && x").expression.is_constant);
}

TEST(Folding, PutsASingleOperationIntoTheHandle) {
  using Form = Expression::Form;
  EXPECT_EQ(parse("x").expression.form, Form::slot);
  EXPECT_EQ(parse("(x)").expression.form, Form::slot);
  for (const char* text :
       {"x*two", "x*(two+1)", "two*x", "1-x", "1/x", "-x", "!x", "x<3", "3<x", "x%two", "x^two"}) {
    EXPECT_EQ(parse(text).expression.form, Form::slot_and_value) << text;
  }
  for (const char* text : {"x*y", "x-y", "x<=y", "x==y"}) {
    EXPECT_EQ(parse(text).expression.form, Form::slot_and_slot) << text;
  }
  for (const char* text : {"x*y+z", "sin(x)", "2^x", "7%x", "x && y"}) {
    EXPECT_EQ(parse(text).expression.form, Form::code) << text;
  }
}

TEST(Folding, GivesTheSameBitsAsEvaluation) {
  const double values[] = {0.1, -7.25, 3, 1e-3, 123456.789, 0};
  const char* const templates[] = {"A+B",
                                   "A-B",
                                   "A*B",
                                   "A/B",
                                   "A%B",
                                   "A^B",
                                   "A<B",
                                   "A==B",
                                   "atan2(A,B)",
                                   "pow(A,B)",
                                   "sin(A)*cos(B)",
                                   "A*A+B*B",
                                   "exp(A/100)+log(B)",
                                   "tan(A)",
                                   "mod(A,B)",
                                   "lerp(A,B,A)"};
  for (const std::string shape : templates) {
    for (const double a : values) {
      for (const double b : values) {
        Names constants, slots;
        constants.bind_constant("A", a);
        constants.bind_constant("B", b);
        slots.bind_slot("A", 0);
        slots.bind_slot("B", 1);
        const Parsed folded = parse(shape, constants), running = parse(shape, slots);
        ASSERT_TRUE(folded.expression.is_constant) << shape;
        const double once = folded.at(0), again = running.at(a, b);
        EXPECT_TRUE(once == again || (std::isnan(once) && std::isnan(again)))
            << shape << " " << a << " " << b;
      }
    }
  }
}

TEST(Expression, EndsAtTheFirstTokenThatCannotContinue) {
  const std::pair<const char*, std::size_t> table[] = {
      {"x)", 1},      {"x, y", 1},      {"x -> A", 2},  {"x: 0.5", 1}, {"x y", 2},
      {"1r", 1},      {"30% : A", 2},   {"30 %", 3},    {"x ]", 2},    {"x { A }", 2},
      {"x ~> A", 2},  {"x>9 --> A", 4}, {"x << y", 2},  {"x.5", 1},    {"x 5", 2},
      {"x \"a\"", 2}, {"(x)(y)", 3},    {"x*y . A", 4}, {"x ? 1", 2},
  };
  for (const auto& [text, end] : table) {
    const Parsed parsed = parse(text);
    EXPECT_EQ(parsed.end, end) << text;
    EXPECT_THAT(parsed.faults, SizeIs(0)) << text;
  }
}

TEST(Expression, ReadsFromTheMiddleOfATokenList) {
  const std::string text = "A(x*2, y+1)";
  std::vector<TextError> faults;
  const std::vector<Token> tokens = tokenize(text, 2, text.size(), faults);
  Program program;
  std::size_t at = 0;
  const Names names = few_names();
  const Expression first = program.parse(tokens, at, names, faults);
  ASSERT_TRUE(is_symbol(tokens[at], ","));
  const Expression second = program.parse(tokens, ++at, names, faults);
  EXPECT_TRUE(is_symbol(tokens[at], ")"));
  const double slots[] = {3, 4};
  Rng rng(0);
  EXPECT_EQ(program.evaluate(first, slots, rng), 6);
  EXPECT_EQ(program.evaluate(second, slots, rng), 5);
}

TEST(Expression, KeepsManyInOneProgram) {
  Program program;
  std::vector<Expression> expressions;
  std::vector<TextError> faults;
  for (int i = 0; i < 100; ++i) {
    const std::string text = "x*" + std::to_string(i) + " + y*x" + (i % 7 == 3 ? " + q" : "");
    std::size_t at = 0;
    expressions.push_back(program.parse(tokenize(text, 0, text.size(), faults), at, few_names(), faults));
  }
  const double slots[] = {3, 4, 0};
  Rng rng(0);
  for (int i = 0; i < 100; ++i) {
    EXPECT_EQ(program.evaluate(expressions[static_cast<std::size_t>(i)], slots, rng),
              i % 7 == 3 ? 0 : 3 * i + 12);
  }
}

TEST(Names, HideEarlierOnesAndComeBack) {
  Names names;
  names.bind_constant("a", 1);
  names.bind_slot("b", 0);
  const std::size_t outer = names.size();
  names.bind_constant("a", 2);
  names.bind_constant("a", 3);
  EXPECT_EQ(names.find("a")->value, 3);
  names.forget_after(outer + 1);
  EXPECT_EQ(names.find("a")->value, 2);
  names.forget_after(outer);
  EXPECT_EQ(names.find("a")->value, 1);
  names.forget_after(0);
  EXPECT_EQ(names.find("a"), nullptr);
  EXPECT_EQ(names.find("b"), nullptr);
}

TEST(Names, WithPointsAreOneName) {
  Names names;
  names.bind_slot("Scope.sx", 0);
  names.bind_slot("x", 1);
  EXPECT_EQ(parse("Scope.sx*2 + x", names).at(5, 1), 11);
  EXPECT_EQ(parse("x. B", names).end, 1U);
  EXPECT_EQ(parse("x .B", names).end, 2U);
  EXPECT_EQ(parse("Scope.sy", names).faults.at(0).message,
            "unknown name `Scope.sy`; did you mean `Scope.sx`?");
}

TEST(Names, AreFoundFastAmongVeryMany) {
  Names names;
  for (int i = 0; i < 100'000; ++i) names.bind_constant("n" + std::to_string(i), i);
  double sum = 0;
  for (int i = 0; i < 100'000; ++i) sum += names.find("n" + std::to_string(i))->value;
  EXPECT_EQ(sum, 4999950000.0);
}

TEST(NameDistance, CountsLettersAndForgivesCase) {
  EXPECT_EQ(name_distance("length", "length"), 0U);
  EXPECT_EQ(name_distance("Length", "length"), 1U);
  EXPECT_EQ(name_distance("lenght", "length"), 2U);
  EXPECT_EQ(name_distance("lengh", "length"), 2U);
  EXPECT_EQ(name_distance("x", "y"), 2U);
  EXPECT_EQ(name_distance("", "abc"), 6U);
  EXPECT_GT(name_distance(std::string(100, 'a'), "a"), hint_distance(std::string(100, 'a')));
}

TEST(IssueList, PointAtTheTokenAndSayWhatWasExpected) {
  const std::pair<const char*, const char*> table[] = {
      {"", "0: expected an expression, found the end"},
      {"x + ", "4: expected a value after `+`, found the end"},
      {"x * )", "4: expected a value after `*`, found `)`"},
      {"* 2", "0: expected an expression, found `*`"},
      {"(x", "2: expected an operator or `)`, found the end"},
      {"(x y)", "3: expected an operator or `)`, found `y`"},
      {"()", "1: expected a value after `(`, found `)`"},
      {"max(x y)", "6: expected an operator, `,` or `)`, found `y`"},
      {"max(x,", "6: expected a value after `,`, found the end"},
      {"max(x,)", "6: expected a value after `,`, found `)`"},
      {"x < y < 2", "6: expected `&&` or the end of the comparison (comparisons do not chain), found `<`"},
      {"x + \"a\"", "4: expected a value after `+`, found the string `a`"},
      {"w", "0: unknown name `w`; did you mean `x`?"},
      {"twoo", "0: unknown name `twoo`; did you mean `two`?"},
      {"something_else", "0: unknown name `something_else`"},
      {"HALF", "0: unknown name `HALF`; did you mean `half`?"},
      {"sin", "0: `sin` is a function: write `sin(angle)`"},
      {"sine(3)", "0: unknown function `sine`; did you mean `sin`?"},
      {"x(3)", "0: `x` is a value, not a function: write `*` between it and the bracket"},
      {"x + sin(1, 2)", "4: `sin` takes 1 argument (angle), found 2"},
      {"sin()", "0: `sin` takes 1 argument (angle), found 0"},
      {"pow(2)", "0: `pow` takes 2 arguments (base, exponent), found 1"},
      {"ran(1, 2, 3)", "0: `ran` takes 1 or 2 arguments (low, high), found 3"},
      {"1e999", "0: the number `1e999` is too large: the largest is about 1.8e308"},
  };
  for (const auto& [text, message] : table) EXPECT_EQ(faults(text), message) << text;
}

TEST(IssueList, ComeAllAtOnceInTheOrderOfTheText) {
  EXPECT_EQ(faults("a1 + max(b1, c1) * d1"),
            "0: unknown name `a1`\n9: unknown name `b1`\n"
            "13: unknown name `c1`\n19: unknown name `d1`");
  EXPECT_EQ(faults("max(x +, y *) + sin(1, q)"),
            "7: expected a value after `+`, found `,`\n12: expected a value after `*`, found `)`\n"
            "16: `sin` takes 1 argument (angle), found 2\n23: unknown name `q`; did you mean `x`?");
  EXPECT_EQ(faults("(x + ) * (y 3) + (2"),
            "5: expected a value after `+`, found `)`\n12: expected an operator or `)`, found `3`\n"
            "19: expected an operator or `)`, found the end");
}

TEST(IssueList, LeaveTheParserWhereAnotherCanGoOn) {
  const std::pair<const char*, std::size_t> table[] = {
      {"x + , y", 4},        {"x + ) A", 4},      {"* 2 -> A", 4},     {"(x -> A", 3},
      {"x < y < 2 : 1", 10}, {"* (a, b) , c", 9}, {"(* 2) + y, 3", 9}, {"* [1, 2] ]", 9},
      {"q + 1 , y", 6},      {"* ; x", 2},        {"max(2 } 3", 6},    {"* { A", 2},
  };
  for (const auto& [text, end] : table) {
    const Parsed parsed = parse(text);
    EXPECT_EQ(parsed.end, end) << text;
    EXPECT_THAT(parsed.faults, SizeIs(1)) << text;
    EXPECT_TRUE(parsed.expression.is_constant) << text;
    EXPECT_EQ(parsed.at(3), 0) << text;
  }
}

TEST(IssueList, ComeFromANestingThatIsTooDeep) {
  const auto nested = [](std::size_t depth, const std::string& open, const std::string& close) {
    std::string text;
    for (std::size_t i = 0; i < depth; ++i) text += open;
    text += "x";
    for (std::size_t i = 0; i < depth; ++i) text += close;
    return text;
  };
  struct Way {
    const char *open, *close;
    std::size_t levels;
  };
  const Way ways[] = {
      {"(", ")", 1},       {"-", "", 1},        {"sin(", ")", 1}, {"2^", "", 1},
      {"max(1, ", ")", 1}, {"(x*x + ", ")", 1}, {"!2^", "", 2},   {"x + max(x+1, y*2^(", "))", 3}};
  for (const auto& [open, close, levels] : ways) {
    EXPECT_EQ(faults(nested(200 / levels, open, close)), "") << open;
    EXPECT_THAT(faults(nested(200 / levels + 1, open, close)), HasSubstr(": nested deeper than 200")) << open;
    EXPECT_THAT(parse(nested(30'000, open, close)).faults, SizeIs(1)) << open;
  }
  EXPECT_EQ(faults("((x))", 2), "");
  EXPECT_EQ(faults("(((x)))", 2), "2: nested deeper than 2");
  EXPECT_THAT(faults(nested(300, "(", ")"), 1'000'000), HasSubstr("nested deeper than 256"));
}

TEST(Expression, HasAllRegistersOfTheDeepestNesting) {
  // Every level keeps the left sides of a comparison, a sum, a product and a power and two arguments waiting.
  std::string text = "x";
  for (int i = 0; i < 90; ++i) text = "sin(x) < cos(x) + tan(x)*abs(x)^clamp(x+1, y+1, " + text + ")";
  const Parsed deep = parse(text, few_names(), 256);
  EXPECT_THAT(deep.faults, SizeIs(0));
  EXPECT_EQ(deep.at(3, 4), 1);
}

TEST(IssueList, ComeFromTooManyOperations) {
  std::string sum = "x";
  for (std::uint32_t i = 0; i < Program::max_operations; ++i) sum += "+x";
  EXPECT_EQ(faults(sum), "");
  EXPECT_EQ(parse(sum).at(1), 1001);
  EXPECT_THAT(faults(sum + "+x"), HasSubstr(": more than 1000 operations in one expression"));
  EXPECT_THAT(faults("max(" + sum + ", 1)"), HasSubstr("more than 1000 operations"));
  EXPECT_THAT(faults("x && (" + sum + ")"), HasSubstr("more than 1000 operations"));
  std::string constant = "1";
  for (int i = 0; i < 100'000; ++i) constant += "+1";
  EXPECT_EQ(parse(constant).at(0), 100'001) << "constants are folded and cost nothing";
}

TEST(IssueList, StopAtAHundred) {
  std::string text = "q";
  for (int i = 0; i < 10'000; ++i) text += "+q";
  EXPECT_THAT(parse(text).faults, SizeIs(max_errors));
}

TEST(Conditions, HoldWhereNotZero) {
  EXPECT_EQ(value("x && -1"), 1);
  EXPECT_EQ(value("0.001 || 0"), 1);
  EXPECT_EQ(value("!0.5"), 0);
  EXPECT_EQ(value("(0/0 == 0/0) + (0/0 != 0/0)"), 1);
}

}  // namespace
}  // namespace seedmesh::lang
