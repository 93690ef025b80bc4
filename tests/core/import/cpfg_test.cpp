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

TEST(Cpfg, TellsWhereACommentBeginsThatDoesNotEnd) {
  EXPECT_THAT(
      told(imported("cpfg", "Lsystem: 1\nderivation length: 1\nAxiom: F\n  /* F --> FF\nendlsystem\n")),
      ElementsAre("4:3 found a comment without its end; expected `*/`"));
}

TEST(Cpfg, ReadsMacrosProductionsDecompositionAndHomomorphism) {
  const auto result = imported("cpfg", monopodial);
  ASSERT_TRUE(result) << told(result)[0];
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
  EXPECT_THAT(told(result), ElementsAre(HasSubstr("view file")));
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
  ASSERT_TRUE(result) << told(result)[0];
  EXPECT_EQ(parameters_of(result)["ring"], true);
  EXPECT_EQ(derived(result), "A(0.75)FB");
}

TEST(Cpfg, WarnsOfWhatHasNoCounterpart) {
  const auto result = imported("cpfg", "Lsystem: 1\nderivation length: 0\nAxiom: F@L(2)@L(3)\n");
  ASSERT_TRUE(result) << told(result)[0];
  EXPECT_THAT(told(result), ElementsAre(HasSubstr("view file"), StartsWith("3:9 `@L` prints a label")));
}

TEST(Cpfg, RefusesWhatItDoesNotUnderstandAtItsPlace) {
  const auto fault = [](std::string_view lines) {
    const auto result = imported("cpfg", "Lsystem: 1\nderivation length: 1\nAxiom: A\n" + std::string(lines));
    return result ? "" : told(result)[0];
  };
  EXPECT_EQ(fault("A --> B\n"), "");
  EXPECT_THAT(fault("A B C\n"), StartsWith("4:1 found no keyword and no production"));
  EXPECT_THAT(fault("A --> B(func(1,2))\n"), HasSubstr("4:9 unknown function `func`"));
  EXPECT_THAT(fault("#include \"x.h\"\n"), StartsWith("4:1 found `#include`"));
  EXPECT_THAT(fault("EndEach: {n=n+1;}\n"), StartsWith("4:1 found statements that run between steps"));
  EXPECT_THAT(fault("A --> ?(1,2)B$\n"), StartsWith("4:7 found a sub-L-system"));
  EXPECT_THAT(fault("#define X [X]\nA --> X\n"), StartsWith("5:7 found macros that contain themselves"));
  EXPECT_THAT(fault("Lsystem: 2\n"), StartsWith("4:1 found a second L-system"));
  EXPECT_THAT(fault("A --> [B\n"), StartsWith("4:7 found `[`"));
  EXPECT_THAT(told(imported("cpfg", "A --> B\n")), Contains(HasSubstr("found no axiom")));
}

TEST(Cpfg, TellsTheLineOfAFaultInALongProduction) {
  const auto result = imported("cpfg", "Lsystem: 1\nderivation length: 1\nAxiom: A\nA -->\n\tF(1)\n\tF(y)\n");
  EXPECT_THAT(told(result), ElementsAre(StartsWith("6:4 unknown name `y`")));
}

TEST(Cpfg, ExpandsNoBombs) {
  std::string text = "Lsystem: 1\nderivation length: 1\nAxiom: A\n#define X0 [F]\n";
  for (int i = 1; i < 40; ++i) {
    const std::string before = "X" + std::to_string(i - 1);
    text += "#define X" + std::to_string(i) + " " + before + " " + before + "\n";
  }
  EXPECT_THAT(told(imported("cpfg", text + "A --> X39\n")), Contains(HasSubstr("longer than")));
}

}  // namespace
}  // namespace seedmesh
