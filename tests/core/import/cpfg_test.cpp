#include <gmock/gmock.h>

#include "tests/core/import/support.h"

namespace seedmesh {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

constexpr std::string_view monopodial = R"(/* A monopodial plant, */
#define STEPS 4      // of the derivation
#define r 0.5
#define half(x) (x*r)
#define BUD [+(40)A(0)]

Lsystem: 1
seed: 17
derivation length: STEPS
ignore: + -
Axiom: #(0.1)A(1)

A(t) : {x = t*2;} t > 0
	--> F(half(x))BUD[-(40)A(t-1)]A(t*r)
A(t) --> *

decomposition
maximum depth: 2
F(l) : l > 3 --> F(l/2)F(l/2)

homomorphism
A(t) --> ;F(t)

endlsystem
everything behind it is not read
)";

TEST(Cpfg, ReportsTheBeginningOfACommentWithoutAnEnd) {
  EXPECT_THAT(
      reports(imported("cpfg", "Lsystem: 1\nderivation length: 1\nAxiom: F\n  /* F --> FF\nendlsystem\n")),
      ElementsAre("4:3 found a comment without its end; expected `*/`"));
}

TEST(Cpfg, RefusesProgramsOfLpfgAndLPy) {
  EXPECT_THAT(reports(imported("cpfg",
                               "#include <lpfgall.h>\nderivation length: 3;\nmodule A(int);\nAxiom: A(0);\n"
                               "production:\nA(n): { produce F(1) A(n+1); }\n")),
              ElementsAre(AllOf(StartsWith("1:1 "), HasSubstr("L+C, the language of lpfg"))));
  EXPECT_THAT(reports(imported("cpfg",
                               "Axiom: A(1)\nderivation length: 3\nproduction:\nA(x) :\n  produce F(x)A(x)\n"
                               "homomorphism:\nendlsystem\n")),
              ElementsAre(AllOf(StartsWith("3:1 "), HasSubstr("L-Py"))));
}

/// L-Py takes whole files of Python. Each of these has one line that cpfg cannot have.
TEST(Cpfg, NamesLPyInShortFiles) {
  for (const auto& [text, place] : std::initializer_list<std::pair<const char*, const char*>>{
           {"Axiom: F\nproduction:\nF --> FF\n", "2:1 "},
           {"Axiom: F\nF : produce FF\n", "2:1 "},
           {"from math import *\nAxiom: F(1)\nF(x) --> F(x+1)\n", "1:1 "},
           {"Axiom: F\nderivation length: 1\nF --> FF\ninterpretation:\nF --> G\n", "4:1 "},
           {"def StartEach():\n  pass\nAxiom: F\nF --> FF\n", "1:1 "}}) {
    EXPECT_THAT(reports(imported("", text)), ElementsAre(AllOf(StartsWith(place), HasSubstr("L-Py"))))
        << text;
  }
  EXPECT_TRUE(
      imported("", "Lsystem: 1\nderivation length: 1\nAxiom: A(1)\nA(n) : n > 0 --> F\nendlsystem\n"));
}

TEST(Cpfg, ReadsMacrosProductionsDecompositionAndHomomorphism) {
  const auto result = imported("cpfg", monopodial);
  ASSERT_TRUE(result) << reports(result)[0];
  const json parameters = parameters_of(result);
  EXPECT_EQ(parameters["axiom"], "#(0.1)A(1)");
  EXPECT_EQ(parameters["iterations"], 4);
  EXPECT_EQ(parameters["ignore"], "+-");
  EXPECT_EQ(parameters["constants"], json({{"STEPS", "4"}, {"r", "0.5"}}));
  EXPECT_EQ(parameters["functions"], json({"half(x) = (x*r)"}));
  EXPECT_EQ(parameters["productions"].size(), 2U);
  EXPECT_THAT(parameters["productions"][0].get<std::string>(), HasSubstr("[+(40)A(0)][-(40)"));
  EXPECT_EQ(parameters["decomposition"], json({"F(l) : l > 3 --> F(l/2)F(l/2)"}));
  EXPECT_EQ(parameters["decomposition_depth"], 2);
  EXPECT_EQ(parameters["interpretation"], json({"A(t) --> ;F(t)"}));
  EXPECT_EQ(result->request.seed(), 17U);
  EXPECT_THAT(reports(result), ElementsAre(HasSubstr("view file")));
  EXPECT_THAT(derived(result), StartsWith("#(0.1)F(1)"));
}

TEST(Cpfg, DerivesWhatCpfgDerives) {
  const auto result = imported("cpfg", R"(#define dt 0.5
#define D 2
Lsystem: 1
derivation length: 8
Axiom: A(0)
A(t) --> A(t+dt)
decomposition
maximum depth: 2
A(t) : t >= D --> M(t-D) A(t-1)
M(t) : 1 {x=0.5*2^t;}
	--> I(x)[+A(t)]I(x)
)");
  EXPECT_EQ(derived(result),
            "I(0.5)[+I(0.5)[+A(0)]I(0.5)A(1)]I(0.5)I(0.5)[+A(1)]I(0.5)I(0.5)[+A(0)]I(0.5)A(1)")
      << "what is two units old is taken apart in the step that made it so";
}

TEST(Cpfg, TakesTheMarkOfTheRestOfABranchOut) {
  const auto result = imported("cpfg", "Lsystem: 1\nderivation length: 1\nAxiom: G[HX]M\nG > [H=]M --> Y\n");
  EXPECT_EQ(derived(result), "Y[HX]M");
}

TEST(Cpfg, MakesARingAndConstantsOfTheStart) {
  const auto result = imported("cpfg", R"(ring Lsystem: 1
Start: {b = 1-c; c = 0.25;}
derivation length: 1
consider: AB
Axiom: A(1)FB
B < A(x) --> A(x*b)
)");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result)["ring"], true);
  EXPECT_EQ(derived(result), "A(0.75)FB");
}

TEST(Cpfg, WarnsOfSymbolsWithoutACounterpart) {
  const auto result = imported("cpfg", "Lsystem: 1\nderivation length: 0\nAxiom: F@L(2)@L(3)\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_THAT(reports(result), ElementsAre(HasSubstr("view file"), StartsWith("3:9 `@L` prints a label")));
}

TEST(Cpfg, RefusesUnknownTextAtItsLineAndColumn) {
  const auto fault = [](std::string_view lines) {
    const auto result = imported("cpfg", "Lsystem: 1\nderivation length: 1\nAxiom: A\n" + std::string(lines));
    return result ? "" : reports(result)[0];
  };
  EXPECT_EQ(fault("A --> B\n"), "");
  EXPECT_THAT(fault("A B C\n"), StartsWith("4:1 found no keyword and no production"));
  EXPECT_THAT(fault("A --> B(fund(1,2))\n"), HasSubstr("4:9 unknown function `fund`"));
  EXPECT_THAT(fault("#include \"x.h\"\n"), StartsWith("4:1 the file of this `#include`"));
  EXPECT_THAT(fault("#if 1\nA --> B\n"), StartsWith("4:1 found a choice without its `#endif`"));
  EXPECT_THAT(fault("A --> ?(1,2)B$\n"), StartsWith("4:7 found a sub-L-system"));
  EXPECT_THAT(fault("#define X [X]\nA --> X\n"), StartsWith("5:7 found macros that contain themselves"));
  EXPECT_THAT(fault("Lsystem: 2\n"), StartsWith("4:1 found a second L-system"));
  EXPECT_THAT(fault("A --> [B\n"), StartsWith("4:7 found `[`"));
  EXPECT_THAT(reports(imported("cpfg", "A --> B\n")), Contains(HasSubstr("found no axiom")));
}

TEST(Cpfg, ReportsTheLineOfAnErrorInALongProduction) {
  const auto result = imported("cpfg", "Lsystem: 1\nderivation length: 1\nAxiom: A\nA -->\n\tF(1)\n\tF(y)\n");
  EXPECT_THAT(reports(result), ElementsAre(StartsWith("6:4 unknown name `y`")));
}

TEST(Cpfg, ExpandsNoBombs) {
  std::string text = "Lsystem: 1\nderivation length: 1\nAxiom: A\n#define X0 [F]\n";
  for (int i = 1; i < 40; ++i) {
    const std::string before = "X" + std::to_string(i - 1);
    text.append("#define X").append(std::to_string(i));
    text.append(" ").append(before).append(" ").append(before).append("\n");
  }
  EXPECT_THAT(reports(imported("cpfg", text + "A --> X39\n")), Contains(HasSubstr("longer than")));
}

/// A system of these lines, derived.
std::string word_of(const std::string& lines, int steps = 1) {
  const auto result =
      imported("cpfg", "Lsystem: 1\nderivation length: " + std::to_string(steps) + "\n" + lines);
  return result ? derived(result) : reports(result)[0];
}

TEST(Cpfg, RunsStatementsBetweenSteps) {
  EXPECT_EQ(
      word_of("Start: {n=1; m=0.5;}\nStartEach: {p=n*m; printf(\"Step %3f\\n\",n);}\nEndEach: {n=n+2;}\n"
              "Axiom: A(n)\nA(x) --> B(p)A(n)\n",
              3),
      "B(0.5)B(1.5)B(2.5)A(5)");
  EXPECT_EQ(word_of("Start: {c=0;}\nAxiom: AAB\nA : 1 {c=c+1;} --> C(c)\nB --> D(c)\n"), "C(1)C(2)D(2)")
      << "what a rule sets, the rules to its right read";
}

TEST(Cpfg, RunsTheStatementsOfTheStart) {
  EXPECT_EQ(
      word_of("#define N 4\nDefine: {array a[N] = {1,2}, b[N];}\n"
              "Start: {i=0; while(i<N) { b[i]=a[i]*10+i; i=i+1; }\n if (i > 3) {k = b[1];} else k = 7;}\n"
              "Axiom: A(0)\nA(j) : j < N --> B(b[j])A(j+1)\nA(j) --> C(k)\n",
              5),
      "B(10)B(21)B(2)B(3)C(21)");
  EXPECT_EQ(word_of("Start: {srand(3); n=2;}\nAxiom: A(n)\n", 0), "A(2)");
  EXPECT_EQ(
      imported("cpfg", "Lsystem: 1\nderivation length: 0\nStart: {srand(17);}\nAxiom: F\n")->request.seed(),
      17U);
  EXPECT_THAT(word_of("Start: {n=0; while (1) n=n+1;}\nAxiom: A\n"),
              HasSubstr("the statements of `Start` do not end"));
}

TEST(Cpfg, ReplacesStrictPredecessorsAsAWhole) {
  EXPECT_EQ(word_of("Axiom: fE(1)fE(0)G\nfE(x) : x==1 --> ;FA\nfE(x) : x==0 --> fE(0.5)\n"), ";FAfE(0.5)G");
  EXPECT_EQ(
      word_of("Axiom: L(0);(1,2)!(3,4)L(1);(1,2)!(3,4)\nL(g);(c,b)!(r,a) : g == 0 --> ;(4,4)!(2,r+b)D(5)\n"),
      ";(4,4)!(2,5)D(5)L(1);(1,2)!(3,4)");
  EXPECT_EQ(word_of("Axiom: [f(1)P(2)][f(3)P(4)]\n[f(y)P(r)] : r > 2 --> *\n"), "[f(1)P(2)]");
}

TEST(Cpfg, TriesRulesInTheOrderOfTheFile) {
  EXPECT_EQ(word_of("Axiom: BA\nA --> C\nB < A --> D\n"), "BC");
  EXPECT_EQ(word_of("Axiom: BA\nB < A --> D\nA --> C\n"), "BD");
}

TEST(Cpfg, ChoosesByQuestionMarks) {
  EXPECT_EQ(
      word_of("#define MAX(a,b) (((a)>(b))?(a):(b))\nAxiom: A(2,3)\nA(x,y) --> B(MAX(x,y+1),x<y ? 1 : 2)\n"),
      "B(4,1)");
  EXPECT_EQ(word_of("Axiom: A(7)\nA(x) : 1 {c = (x > 5) ? 5 : ((x < 1) ? 1 : x);} --> B(c)\n"), "B(5)");
}

TEST(Cpfg, ReadsChoicesOfThePreprocessor) {
  const std::string lines =
      "#define LEAVES 1\n#undef ODD\n#define ODD 0\n#if LEAVES==1 && !defined(NONE)\nA --> B\n#else\nA --> "
      "C\n#endif\n"
      "#ifdef NONE\n#if 1\nA --> D\n#endif\n#elif ODD\nA --> E\n#else\nB --> F(1)\n#endif\nAxiom: A\n";
  EXPECT_EQ(word_of(lines, 2), "F(1)");
}

TEST(Cpfg, GoesOnBehindBackslashes) {
  EXPECT_EQ(word_of("#define half(x) \\\\\n  (x*0.5)\n#define BOX [+F] \\\n [-F]\nAxiom: A(4)BOX\nA(x) --> "
                    "\\\\(half(x))F\\ (90)\n"),
            "\\\\(2)F\\(90)[+F][-F]");
}

TEST(Cpfg, DrawsCirclesAndSpheres) {
  const auto result =
      imported("cpfg", "Lsystem: 1\nderivation length: 1\nAxiom: A\nA --> F(1)@O(2)@c(3)[@o(1)]\n");
  ASSERT_TRUE(result) << reports(result)[0];
  const json parameters = parameters_of(result);
  EXPECT_EQ(parameters["surfaces"]["_O"]["shape"], "sphere");
  EXPECT_EQ(parameters["surfaces"]["_c"]["shape"], "disc");
  EXPECT_EQ(derived(result), "F(1)~_O(2)~_c(3)[~_o(1)]");
  EXPECT_EQ(word_of("Axiom: ,@o(2);F\n,@o(s); --> *\n"), "F") << "also in a predecessor";
}

TEST(Cpfg, HonoursDeepDecompositions) {
  EXPECT_EQ(
      word_of("Axiom: A(3000)\ndecomposition\nmaximum depth: 5000\nA(n) : n>0 --> A(n-1)\nA(n) --> B\n"),
      "B");
  const auto result =
      imported("cpfg",
               "Lsystem: 1\nderivation length: 0\nAxiom: A(250)\nhomomorphism\nmaximum depth: 300\n"
               "A(n) : n>0 --> F(1)A(n-1)\n");
  EXPECT_EQ(parameters_of(result)["interpretation_depth"], 300);
}

TEST(Cpfg, ReadsAViewFileAndFunctionsBesideIt) {
  // Two samples of a straight line are as far up as to the side, whatever its B-spline.
  const json files = {
      {"plant.l", "Lsystem: 1\nderivation length: 1\nAxiom: A\nA --> B(func(1,0.25),func(2,1),func(1,2))\n"},
      {"plant.v",
       "angle factor: 8\ninitial line width: 0.3\nline width increment: 0.01\ncontour sides: 12\n"
       "tropism: T: 0 -1 0 E: 0.2 S: 0.01\nfunction set: f.fset\nviewpoint: 0,0,1\nodd thing: 3\n"},
      {"f.fset",
       "funcgalleryver 1 1\nitems: 2\nfver 1 1\nname: a\nsamples: 100\nflip: off\npoints: 4\n"
       "0 2\n0.3333333 4\n0.6666667 6\n1 8\nfver 1 1\nname: b\nsamples: 100\nflip: off\npoints: 4\n"
       "0 5\n0.3 5\n0.6 5\n1 7\n"}};
  const auto result = imported("", json({{"files", files}}).dump());
  ASSERT_TRUE(result) << reports(result)[0];
  const json parameters = parameters_of(result);
  EXPECT_EQ(parameters.value("angle", json(45)), 45) << "360 / 8 is the default";
  EXPECT_EQ(parameters["width"], 0.3);
  EXPECT_EQ(parameters["sides"], 12);
  EXPECT_EQ(parameters["tropism"][0]["elasticity"], 0.2);
  EXPECT_EQ(derived(result), "B(3.5,7,8)");
  EXPECT_THAT(reports(result),
              ElementsAre(HasSubstr("`odd thing` has no counterpart"), HasSubstr("nothing will be drawn")));
}

TEST(Cpfg, CallsFunctionsOfFilesInTheStart) {
  // A line from 2 to 8: 3.5 at a quarter. Arrays of the file stay apart from the samples.
  const std::string system =
      "Lsystem: 1\nDefine: {array v[2] = {7, 8};}\nStart: {a =\n\tfunc(1, 0.25) + 1; v[0] = 9;}\n"
      "derivation length: 1\nAxiom: A\nA --> B(a,v[0],v[1])\n";
  const json files = {{"plant.l", system},
                      {"f.func",
                       "fver 1 1\nname: a\nsamples: 100\nflip: off\npoints: 4\n0 2\n0.3333333 4\n"
                       "0.6666667 6\n1 8\n"}};
  const auto result = imported("", json({{"files", files}}).dump());
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(derived(result), "B(4.5,9,8)");
  const auto without = imported("cpfg",
                                "Lsystem: 1\nStart: {a = 2 * func(3, 0);}\nderivation length: 1\n"
                                "Axiom: A\nA --> B(a)\n");
  ASSERT_TRUE(without) << reports(without)[0];
  EXPECT_EQ(derived(without), "B(2)");
}

constexpr std::string_view head = "Lsystem: 1\nderivation length: 1\nAxiom: A(7)\n";

TEST(Cpfg, WarnsOfFilesThatAreNotGivenAndGoesOn) {
  const auto without_functions = imported("cpfg", std::string(head) + "A(x) --> B(2 * func(3, x / 10))\n");
  ASSERT_TRUE(without_functions) << reports(without_functions)[0];
  EXPECT_EQ(derived(without_functions), "B(2)");
  EXPECT_THAT(reports(without_functions), Contains(HasSubstr("`func(n, x)` is 1 everywhere")));

  const auto without_numbers =
      imported("cpfg",
               "Lsystem: 1\nStart: {fp = fopen(\"n.txt\", \"r\"); fscanf(fp, \"%lf\", &count); fclose(fp);}\n"
               "EndEach: {stop(1);}\nderivation length: 1\nAxiom: A(7)\nA(x) --> B(x + count)\n");
  ASSERT_TRUE(without_numbers) << reports(without_numbers)[0];
  EXPECT_EQ(derived(without_numbers), "B(7)");
  EXPECT_THAT(reports(without_numbers), Contains(HasSubstr("`fscanf` reads a file of its own")));
}

TEST(Cpfg, GivesNamesOfInnerBracesToTheWholeRule) {
  const std::string_view rule = "A(x) : x > 0 {if (x > 5) {y = x * 2;} else {y = 1;}} --> B(y)\n";
  EXPECT_EQ(derived(imported("cpfg", std::string(head) + std::string(rule))), "B(14)");
  EXPECT_EQ(derived(imported("cpfg", "Lsystem: 1\nderivation length: 1\nAxiom: A(3)\n" + std::string(rule))),
            "B(1)");
  // A parameter and a name that Start sets keep their values where the braces are not entered.
  EXPECT_EQ(derived(imported("cpfg",
                             "Lsystem: 1\nStart: {n = 4;}\nderivation length: 1\nAxiom: A(3)\n"
                             "A(x) : x > 0 {if (x > 5) {x = 0; n = 0;}} --> B(x,n)\n")),
            "B(3,4)");
}

TEST(Cpfg, LeavesOutDrawingRulesForSeveralModules) {
  const auto result = imported("cpfg", std::string(head) + "A(x) --> ST\nhomomorphism\nST --> F\nS --> f\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result)["interpretation"], json({"S --> f"}));
  EXPECT_THAT(reports(result), Contains(StartsWith("6:1 a rule of a decomposition or homomorphism")));
}

TEST(Cpfg, TakesAtMostAThousandSteps) {
  const auto result = imported("cpfg", "Lsystem: 1\nderivation length: 1100\nAxiom: A\nA --> A\n");
  EXPECT_EQ(parameters_of(result)["iterations"], 1000);
  EXPECT_THAT(reports(result), Contains(StartsWith("2:20 the derivation length 1100 becomes 1000")));
}

TEST(Cpfg, ClosesABranchOfAContext) {
  EXPECT_EQ(derived(imported("cpfg", "Lsystem: 1\nderivation length: 1\nAxiom: A[B]C\nA > [B --> D\n")),
            "D[B]C");
}

}  // namespace
}  // namespace seedmesh
