#include <gmock/gmock.h>

#include "tests/core/import/support.h"

namespace seedmesh {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

Result<ImportedRequest> file(std::string_view lines) {
  return imported("cpfg", "Lsystem: 1\nderivation length: 1\n" + std::string(lines));
}

/// The reports without the one about the view file.
std::vector<std::string> reports_of(std::string_view lines) {
  std::vector<std::string> all = reports(file(lines));
  std::erase_if(all, [](const std::string& each) {
    return each.find("view file; ") != std::string::npos ||
           each.find("cpfg's view file; they") != std::string::npos;
  });
  return all;
}

double length_of(const Result<ImportedRequest>& result) {
  return json::parse(*derive(result->request, {}))["turtle"]["total_length"];
}

TEST(CpfgWords, MakesOrgansOfSurfacesAndNoTurtleCommands) {
  const auto result = file("Axiom: F(1)~F(2)~f(1)~1\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result)["axiom"], "F(1)~F(2)~f(1)~_1");
  EXPECT_EQ(length_of(result), 1) << "a surface neither draws a line nor moves";
  EXPECT_THAT(reports_of("Axiom: F(1)~F(2)\n"),
              ElementsAre(StartsWith("3:12 `~F` is a surface of another file")));
}

TEST(CpfgWords, RewritesSurfacesAsCpfgDoes) {
  const auto two = file("Axiom: ~b(1)\n~b(s) : s < 1.4 --> ~b(s*1.5)\n");
  EXPECT_EQ(derived(two), "~b(1.5)");
  const auto one = file("Axiom: b(2)~b(1)\nb(s) --> b(s*3)F\n");
  EXPECT_EQ(derived(one), "b(6)F~b(3)F") << "the letter behind ~ is a module of its own there";
}

TEST(CpfgWords, RewritesSurfacesThatRulesOfSurfacesWrite) {
  const auto result =
      imported("cpfg", "Lsystem: 1\nderivation length: 3\nAxiom: ~b\nc --> d\nb --> c\nd --> e(2)\n");
  EXPECT_EQ(derived(result), "~e(2)");
}

TEST(CpfgWords, ReportsThatARuleDoesNotReachAPartOfACommand) {
  EXPECT_THAT(reports_of("Axiom: F@vF\nv --> F\n"), ElementsAre(StartsWith("4:1 `@v` is one symbol here")));
}

TEST(CpfgWords, SkipsAndReportsWordsWithoutCounterpart) {
  const auto result = file("Axiom: F@TfF@TpF@Tx(2)F@PS(1)F@Gr(1)F@#(2)F@!(5)F'F\np --> FFF\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result)["axiom"], "FFFFFFFFF");
  EXPECT_THAT(reports(result), Contains(StartsWith("3:9 `@Tf` keeps or removes the twist")));
  EXPECT_THAT(reports(result), Contains(StartsWith("3:13 `@Tp`")));
  EXPECT_THAT(reports(result), Contains(StartsWith("3:17 `@Tx` chooses a texture")));
  EXPECT_THAT(reports(result), Contains(HasSubstr("`@#` chooses a cross-section")));
  EXPECT_THAT(reports_of("Axiom: A\n@Tx --> F\n"),
              ElementsAre(StartsWith("4:1 found `@Tx` in a predecessor")));
}

TEST(CpfgWords, PassesOverTheMarkOfACommandThatIsNone) {
  const auto result = file("Axiom: @F(2)@ F\n");
  EXPECT_EQ(parameters_of(result)["axiom"], "F(2)F") << "as cpfg goes on behind the @";
  EXPECT_THAT(reports(result), Contains(StartsWith("3:8 `@F` is not a command of cpfg")));
}

TEST(CpfgWords, ReportsLossesOfArguments) {
  EXPECT_THAT(reports_of("Axiom: @R(1,0,0,0,0,1)F\n"), ElementsAre(StartsWith("3:8 `@R` with an up vector")));
  EXPECT_EQ(parameters_of(file("Axiom: @R(1,0,f(2),0,0,1)F@M(1,2)\n")), nullptr) << "f is no function";
  EXPECT_EQ(parameters_of(file("Axiom: @R(1,0,0,0,0,1)F@M(1,2)\n"))["axiom"], "@R(1,0,0)F@M(1,2,0)");
  EXPECT_EQ(parameters_of(file("Axiom: @Gsf(1)@Ge(3)\n"))["axiom"], "@Gsf(1)@Ge");
  EXPECT_THAT(reports_of("Axiom: @Gsf(1)@Ge(3)\n"),
              ElementsAre(StartsWith("3:15 `@Ge` has no number of strips")));
}

TEST(CpfgWords, DrawsTheOlderFormOfGeneralizedCylinders) {
  const auto result = file("Axiom: {(1)f.(3)f.f}{(0)f+f+f}\n");
  EXPECT_EQ(parameters_of(result)["axiom"], "@Gsf@Gc(3)f@Gcf@Ge{f+f+f}");
  EXPECT_THAT(reports(result), Contains(StartsWith("3:8 `{(1)` is a generalized cylinder")));
}

TEST(CpfgWords, AnswersQuestionsOfTwoParameters) {
  const auto result = file("Axiom: F(2)A?P(0,0)\nA > ?P(x,y) --> F(y)\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result)["axiom"], "F(2)A?P(0,0,0)");
  EXPECT_THAT(derived(result), StartsWith("F(2)F(2)?P(0,"));
}

TEST(CpfgWords, GroupsSignsAndPowersAsCpfgDoes) {
  const auto result = file("#define n 3\nAxiom: F(2^3^2)F((-n)^2+-n^2)F(a)\nF(x) : x <> 1 --> F(-x^2)\n");
  EXPECT_THAT(reports(result), ElementsAre(HasSubstr("unknown name `a`")));
  EXPECT_EQ(parameters_of(file("#define n 3\nAxiom: F(2^3^2)F(1-n^2)F(2--n^2)\n"))["axiom"],
            "F((2^3)^2)F(1-n^2)F(2-(-n)^2)");
  EXPECT_EQ(derived(file("Axiom: F(2)\nF(x) : x <> 1 --> F(-x^2)\n")), "F(4)");
}

TEST(CpfgWords, TakesLinesOfRollsForRolls) {
  const auto result = file("Axiom: F///F // a stem\n// a comment\n");
  EXPECT_EQ(parameters_of(result)["axiom"], "F///F");
  EXPECT_THAT(reports(result), Contains(StartsWith("3:14 `//` between blanks begins a comment")));
}

TEST(CpfgWords, IgnoresLongerSymbolsWithTheirFirstCharacter) {
  EXPECT_EQ(parameters_of(file("ignore: +@~\nAxiom: F+F@v~lC\n"))["ignore"], "+@v~l");
  EXPECT_EQ(parameters_of(file("consider: JF?P\nAxiom: JF?P(0,0,0)\n"))["consider"], "JFP?P");
}

TEST(CpfgRules, PastesMacrosAsThePreprocessorDoes) {
  EXPECT_EQ(derived(file("#define X 3\n#define Y X+1\nAxiom: F(Y*2)\n")), "F(5)");
  EXPECT_EQ(derived(file("#define X 3\n#define Y (X+1)\nAxiom: F(Y*2)\n")), "F(8)");
  EXPECT_EQ(derived(file("#define twice(x) (x*2)\nAxiom: F(twice(1+2))F(twice(3))\n")), "F(5)F(6)");
  EXPECT_EQ(derived(file("#define stem(x,y) F(x)[+F(y)]\nAxiom: stem(1,2+3)\n")), "F(1)[+F(5)]");
  EXPECT_THAT(reports_of("#define stem(x,y) F(x)[+F(y)]\nAxiom: stem(1)\n"),
              ElementsAre(StartsWith("4:8 found 1 arguments of the macro `stem`")));
}

TEST(CpfgRules, KeepsTheSeedOfTheDerivation) {
  const auto result = file("seed: 1234\nAxiom: A\nA --> F\nhomomorphism\nseed: 3\nF --> F\n");
  EXPECT_EQ(result->request.seed(), 1234U);
  EXPECT_THAT(reports(result), Contains(StartsWith("7:7 this seed of a homomorphism is left out")));
  EXPECT_THAT(reports_of("seed: 1\nseed: 2\nAxiom: A\n"), ElementsAre("4:7 found a second seed"));
}

TEST(CpfgRules, GoesOnInLinesThatBeginWithABlank) {
  const auto result = file("Axiom: F(1)\n\t[+F]\n\t-F\nA -->\n\tB\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(derived(result), "F(1)[+F]-F");
}

TEST(CpfgRules, ReadsStarsAsNoContextAndAsTrue) {
  EXPECT_EQ(derived(file("Axiom: A(1)\n* < A(x) > * : * --> F(x)\n")), "F(1)");
  EXPECT_EQ(derived(file("Axiom: A(1)\nA(x) : * {y = x*2;} --> F(y)\n")), "F(2)");
}

TEST(CpfgRules, PassesOverContextsOfAHomomorphism) {
  const auto result = file("Axiom: AB\nhomomorphism: no warnings\nA < B --> F\n");
  EXPECT_EQ(parameters_of(result)["interpretation"], json({"B --> F"}));
  EXPECT_THAT(reports(result), Contains(StartsWith("5:1 `<` and `>` of a homomorphism")));
}

TEST(CpfgRules, ReadsPredecessorsOfSeveralModules) {
  EXPECT_EQ(derived(file("Axiom: F(1)AB\nF(n)A > B : n>0 --> F\n")), "FB");
  EXPECT_EQ(derived(file("Axiom: A,,[-F];B\n,,[-F]; --> Z\n")), "AZB");
}

TEST(CpfgRules, ReportsEveryErrorAtOnce) {
  EXPECT_THAT(reports_of("Axiom: A(1\nA --> B(\nB -> A[\nC --> F(q)D[\n"),
              ElementsAre(StartsWith("3:9 found `(`"), StartsWith("4:8 found `(`"),
                          "5:1 found no keyword and no production; the arrow of cpfg is `-->`",
                          StartsWith("6:9 unknown name `q`"), StartsWith("6:12 found `[`")));
}

TEST(CpfgRules, ReadsBlocksOfSeveralLines) {
  const auto result = file("Start: {\n a = 2;\n\tb = a*3;\n}\nAxiom: F(b)\n");
  EXPECT_EQ(derived(result), "F(6)");
  EXPECT_EQ(derived(file("Define: {\n\tarray n[2] = {3,5};\n}\nStart: {x = 0;}\nStartEach: {\n x = 1;\n}\n"
                         "Axiom: F\nF --> F(n[x])\n")),
            "F(5)");
  EXPECT_EQ(derived(file("Start: {c = 1;}\nAxiom: A\nA : 1 {c = c+1;} --> F(c)\n")), "F(2)");
}

TEST(CpfgRules, CanBeSentOn) {
  const auto result = file("Axiom: A@#(2)~l(1)?Q(0)_(1)@O(2)\nA --> F@TfA\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_TRUE(produce(result->request, {}));
}

}  // namespace
}  // namespace seedmesh
