/// Decomposition, tables, rings, new contexts, declared modules, frames.
#include <gmock/gmock.h>

#include "tests/core/lsystem/support.h"
#include "tests/support/context.h"

namespace seedmesh::lsystem {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Decomposition, DecomposesModulesInTheStepThatWroteThem) {
  LsystemParams params = grammar_of("A(2.5)", {"A(t) -> A(t+1)"});
  params.decomposition = {"A(t) : t >= 1 -> F A(t-1)"};
  EXPECT_EQ(derived(params), "FFA(1.5)") << "once for the axiom, once for the step";
  params.decomposition_depth = 10;
  EXPECT_EQ(derived(params), "FFFA(0.5)");
}

TEST(Decomposition, KeepsModulesThatNoStepWrote) {
  LsystemParams params = grammar_of("AB", {"A -> AC"}, 2);
  params.decomposition = {"C -> D", "B -> BB"};
  EXPECT_EQ(derived(params), "ADDBB") << "B is taken apart in the axiom alone";
}

TEST(Decomposition, EntersTheWordAndInterpretationDoesNot) {
  LsystemParams params = grammar_of("A", {}, 0);
  params.decomposition = {"A -> B"};
  params.interpretation = {"B -> F"};
  Job job = job_of(0);
  const Result<Json> answer = derive(params, context_of(job));
  EXPECT_EQ(answer->at("string"), "B");
  EXPECT_EQ(answer->at("turtle").at("segments"), 1);
}

TEST(Decomposition, DrawsFromAStreamOfItsOwn) {
  LsystemParams params = grammar_of("A", {"A -> X(ran(1))A : 1", "A -> YA : 1"}, 12);
  const std::string before = derived(params, 3);
  params.decomposition = {"Z -> F : 1", "Z -> G : 1"};
  EXPECT_EQ(derived(params, 3), before);
  params.axiom = "ZZZZZZZZ";
  EXPECT_NE(derived(params, 3), derived(params, 4));
}

TEST(Decomposition, StopsAtTheLimit) {
  Limits limits;
  limits.modules = 1000;
  LsystemParams params = grammar_of("A", {}, 0);
  params.decomposition = {"A -> AA"};
  params.decomposition_depth = 32;
  Job job = job_of(0, limits);
  EXPECT_THROW((void)derive(params, context_of(job)), Stop);
  params.decomposition = {"A -> BB", "B -> AA"};
  params.decomposition[1] = "B -> [A][A]";
  Job other = job_of(0, limits);
  EXPECT_THROW((void)derive(params, context_of(other)), Stop);
}

TEST(Decomposition, TakesNoContext) {
  LsystemParams params = grammar_of("A", {});
  params.decomposition = {"B < A -> C"};
  EXPECT_THAT(errors_of(params),
              ElementsAre(HasSubstr("/decomposition/0 0:0 a decomposition rule cannot have a context")));
}

TEST(Tables, TakeTurns) {
  LsystemParams params = grammar_of("A", {"B -> b"}, 0);
  params.tables.resize(2);
  params.tables[0] = {2, {"A -> AB"}};
  params.tables[1] = {1, {"A -> A[C]", "B -> x"}};
  const char* words[] = {"A", "AB", "ABb", "A[C]xb", "AB[C]xb", "ABb[C]xb", "A[C]xb[C]xb"};
  for (int i = 0; i < 7; ++i) {
    params.iterations = i;
    EXPECT_EQ(derived(params), words[i]) << i;
  }
}

TEST(Tables, PointAtTheirProductions) {
  LsystemParams params = grammar_of("A", {});
  params.tables.resize(2);
  params.tables[1].productions = {"A -> B", "A B"};
  EXPECT_THAT(errors_of(params), ElementsAre(HasSubstr("/tables/1/productions/1 1:1 found no arrow")));
}

TEST(Ring, MakesNeighboursOfTheEnds) {
  LsystemParams params = grammar_of("ABC", {"C < A -> X", "C > A -> Y"});
  EXPECT_EQ(derived(params), "ABC");
  params.ring = true;
  EXPECT_EQ(derived(params), "XBY");
  params.productions = {"B C < A -> X", "C > A B -> Y", "A < A -> N"};
  EXPECT_EQ(derived(params), "XBY");
  params.axiom = "A";
  EXPECT_EQ(derived(params), "A") << "a module is not its own neighbour";
}

TEST(Ring, GoesRoundBranchesAndNotOutOfThem) {
  LsystemParams params = grammar_of("A[B]C", {"C < A -> X", "B > A -> Z", "C > A -> Y", "C < B -> N"});
  params.ring = true;
  EXPECT_EQ(derived(params), "X[B]Y");
}

TEST(Consider, PassesOverEverythingElse) {
  LsystemParams params = grammar_of("A+F-B", {"A < B -> C"});
  EXPECT_EQ(derived(params), "A+F-B");
  params.consider = "AB";
  EXPECT_EQ(derived(params), "A+F-C");
  params.ignore = "+";
  EXPECT_THAT(errors_of(params), ElementsAre(HasSubstr("/consider")));
}

TEST(NewContext, ReadsWhatTheStepHasWrittenOnTheLeft) {
  EXPECT_EQ(derived(grammar_of("ABBB", {"A -> C", "C << B -> C"})), "CCCC") << "a signal in one step";
  EXPECT_EQ(derived(grammar_of("ABBB", {"A -> C", "C < B -> C"})), "CBBB");
  EXPECT_EQ(derived(grammar_of("A[DB]B", {"A -> C", "C << B -> C", "D -> D"})), "C[DB]C");
  EXPECT_EQ(derived(grammar_of("A(1)B(0)B(0)", {"A(x) -> A(x+1)", "A(x) << B(y) -> A(x*2)"})),
            "A(2)A(4)A(8)");
}

TEST(NewContext, ReadsWhatTheStepHasWrittenOnTheRight) {
  EXPECT_EQ(derived(grammar_of("BBBA", {"A -> C", "B >> C -> C"})), "CCCC");
  EXPECT_EQ(derived(grammar_of("B[XA]BA", {"A -> C", "B >> [X]C -> C"})), "B[XC]BC");
  EXPECT_EQ(derived(grammar_of("B[XA]DA", {"A -> C", "B >> [X]D -> E"})), "E[XC]DC");
  EXPECT_EQ(derived(grammar_of("B(0)B(0)A(1)", {"A(x) -> A(x+1)XY", "B(y) >> A(x)XY -> A(x*2)XY"})),
            "A(8)XYA(4)XYA(2)XY");
  EXPECT_EQ(derived(grammar_of("[AB%C]D", {"Q >> Q -> Q"})), "[AB]D") << "the cut happens before";
}

TEST(NewContext, StandsBesideAnOldOne) {
  EXPECT_EQ(derived(grammar_of("AXB", {"A -> C", "X -> Y", "CY << X < B -> D"})), "CYD");
  EXPECT_THAT(errors_of(grammar_of("A", {"A << B -> C", "A >> B -> C"})),
              ElementsAre(HasSubstr("a word is written in one direction")));
}

TEST(Modules, HaveNamesOfMoreThanOneCharacter) {
  LsystemParams params = grammar_of("Apex(1)", {"Apex(n) -> Leaf Apex(n+1)", "Leaf -> Le af"});
  params.modules = {"Apex", "Leaf", "Le"};
  EXPECT_EQ(derived(params), "LeafApex(2)");
  params.iterations = 2;
  EXPECT_EQ(derived(params), "LeafLeafApex(3)") << "Le and af are no Leaf, but read together";
  Job job = job_of(0);
  EXPECT_EQ(derive(params, context_of(job))->at("counts").at("Leaf"), 1);
}

TEST(Modules, KeepTheirNumberOfParameters) {
  LsystemParams params = grammar_of("Apex(1)", {"Apex(a, b) -> Apex"});
  params.modules = {"Apex(n, m)", "for", "Node(", "9"};
  EXPECT_THAT(errors_of(params),
              testing::AllOf(Contains(HasSubstr("/modules/1 1:1 `for` begins a statement")),
                             Contains(HasSubstr("/modules/2 1:6 expected a parameter")),
                             Contains(HasSubstr("/modules/3 1:1 expected the name")),
                             Contains(HasSubstr("/axiom 1:1 found 1 parameters of `Apex`; expected 2"))));
}

/// Returns the last point drawn by frames.
nlohmann::json turtle_of(const LsystemParams& params) {
  Job job = job_of(0);
  const Result<Json> answer = derive(params, context_of(job));
  return answer ? answer->at("turtle") : Json(answer.error().issues[0].message);
}

TEST(Frames, MoveInTheirOwnAxes) {
  LsystemParams params = grammar_of(
      "A(frame(), 3)", {"A(f, n) : n > 0 -> @F(f)A(rotate_z(translate(f, 0, 1, 0), 90), n - 1)"}, 3);
  params.modules = {"A(frame f, n)"};
  const nlohmann::json turtle = turtle_of(params);
  EXPECT_EQ(turtle["segments"], 3);
  EXPECT_EQ(turtle["total_length"], 3);
  EXPECT_EQ(turtle["bounds"]["min"], nlohmann::json({-1, 0, 0}));
  EXPECT_EQ(turtle["bounds"]["max"], nlohmann::json({0, 1, 0}));
}

TEST(Frames, BranchByCopies) {
  LsystemParams params = grammar_of("A(scale(frame(), 0.1, 1, 0.1))",
                                    {"A(f) -> @F(f)A(rotate_x(scale(copy(translate(f, 0, 1, 0)), 0.5), "
                                     "30))A(rotate_x(scale(translate(f, 0, 1, 0), 0.5), -30))"},
                                    5);
  params.modules = {"A(frame)"};
  EXPECT_EQ(turtle_of(params)["segments"], 31);
  EXPECT_EQ(turtle_of(params)["total_length"], 5);
}

TEST(Frames, ReportTheirPosition) {
  LsystemParams params = grammar_of("A(translate(frame(), 1, 2, 3))", {"A(f) : f.y > 1 -> B(f.x, f.y, f.z)"});
  params.modules = {"A(frame f)"};
  EXPECT_EQ(derived(params), "B(1,2,3)");
}

TEST(Frames, TakeTheTurtleAlong) {
  LsystemParams params = grammar_of("@A(scale(rotate_z(translate(frame(), 5, 0, 0), -90), 1, 2, 1))F", {}, 0);
  const nlohmann::json turtle = turtle_of(params);
  EXPECT_EQ(turtle["position"], nlohmann::json({7, 0, 0}));
  EXPECT_EQ(turtle["heading"], nlohmann::json({1, 0, 0}));
}

TEST(Frames, ReportWhatIsNotAFrame) {
  const auto errors = [](const char* axiom) {
    LsystemParams params = grammar_of(axiom, {}, 0);
    params.modules = {"A(frame)"};
    return errors_of(params);
  };
  EXPECT_THAT(errors("A(2)"), ElementsAre(HasSubstr("1:3 found `2`; expected a frame")));
  EXPECT_THAT(errors("A(turn(frame(), 2))"),
              ElementsAre(HasSubstr("1:3 found `turn`; expected frame, copy")));
  EXPECT_THAT(errors("A(scale(frame(), 1, 2))"), ElementsAre(HasSubstr("found 2 numbers")));
  EXPECT_THAT(errors("A(translate(frame(), 1/0, 2, 3))"), IsEmpty());
  LsystemParams params = grammar_of("A(translate(frame(), 1/0, 2, 3))", {}, 0);
  params.modules = {"A(frame)"};
  Job job = job_of(0);
  EXPECT_THROW((void)derive(params, context_of(job)), Stop);
}

TEST(RandomChoice, AnEditedBranchLeavesTheOthersAsTheyWere) {
  const auto grown = [](const char* edited, std::uint64_t seed) {
    return derived(grammar_of("L(0)R(0)",
                              {"L(n) : n < 6 -> F(ran(1))[+L(n+1)]L(n+1) : 9", "L(n) : n < 6 -> X : 1",
                               edited, "R(n) : n < 6 -> Y : 1"},
                              7),
                   seed);
  };
  const std::string plain = grown("R(n) : n < 6 -> G(ran(1))[-R(n+1)]R(n+1) : 9", 11);
  const std::string edited = grown("R(n) : n < 6 -> G(ran(1))G(nran(0,1))[-R(n+1)][&R(n+1)]R(n+1) : 9", 11);
  const auto left = [](const std::string& word) { return word.substr(0, word.find_first_of("GY")); };
  EXPECT_GT(left(plain).size(), 40U);
  EXPECT_EQ(left(plain), left(edited));
  EXPECT_NE(plain, edited);
  EXPECT_NE(left(grown("R(n) : n < 6 -> Y : 9", 6)), left(plain));
}

TEST(RandomChoice, AnEditedBranchKeepsWhatItHadInCommon) {
  // The first random values of the branch stay, though each of its productions now uses more.
  const auto lengths = [](const char* rule) {
    const std::string word = derived(grammar_of("R(0)", {rule}, 4), 9);
    std::vector<std::string> found;
    for (std::size_t at = word.find("G("); at != std::string::npos; at = word.find("G(", at + 1)) {
      found.push_back(word.substr(at, word.find(')', at) - at));
    }
    return found;
  };
  EXPECT_EQ(lengths("R(n) -> G(ran(1))[-R(n+1)]R(n+1)"),
            lengths("R(n) -> G(ran(1))H(ran(9))[-(ran(2))R(n+1)]R(n+1)"));
}

}  // namespace
}  // namespace seedmesh::lsystem
