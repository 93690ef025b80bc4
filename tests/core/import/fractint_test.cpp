#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "tests/core/import/support.h"

namespace seedmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

constexpr std::string_view koch = R"(Koch1 { ; a curve
  ; of von Koch
  angle 6
  axiom f--f--f
  f=f+f--f+f
}
)";

TEST(Fractint, ReadsAnEntryInEitherCase) {
  const auto result = imported("fractint", koch);
  EXPECT_EQ(parameters_of(result), nlohmann::json::parse(R"({
    "axiom": "-(90)F--F--F", "productions": ["F -> F+F--F+F"], "angle": 60, "iterations": 4, "style": "lines"
  })"));
  EXPECT_THAT(reports(result), ElementsAre(StartsWith("1:1 an entry has no number of steps")));
}

TEST(Fractint, JoinsTheRulesOfOneSymbol) {
  const auto result = imported("fractint", "E{Angle 4 \n Axiom X\n X=FX\n X=+F\n}");
  EXPECT_EQ(parameters_of(result)["productions"], nlohmann::json({"X -> FX+F"}));
}

TEST(Fractint, TurnsItsCommandsIntoOurs) {
  const auto result = imported("fractint", R"(E {
  axiom \30D/1.5M!D@2D@I4D@Q9D@IQ4D@QI25D
  angle 4
})");
  EXPECT_EQ(parameters_of(result)["axiom"],
            "-(90)+(30)D-(1.5)M@-D@Di(2)D@Di(0.25)D@Di(3)D@Di(0.5)D@Di(0.2)D");
  EXPECT_EQ(parameters_of(result)["interpretation"], nlohmann::json({"D -> F", "M -> f"}));
}

TEST(Fractint, TurnsAsFarAsTheAngleAllows) {
  EXPECT_EQ(parameters_of(imported("fractint", "E{\nAngle 5\nAxiom F|F\n}"))["axiom"], "-(90)F-(144)F");
}

TEST(Fractint, CountsColours) {
  const auto result = imported("fractint", "E{\nAngle 4\nAxiom C3F>1F<2F\n}");
  EXPECT_EQ(parameters_of(result)["axiom"], "-(90);(3)F,F;;F");
  EXPECT_THAT(reports(result), testing::Contains(HasSubstr("palette")));
}

TEST(Fractint, DrawsWhatFractintDraws) {
  // The third order of the Koch curve is as wide as its axiom is long after scaling: 3^4 steps.
  const auto result = imported("fractint", koch);
  const auto answer = nlohmann::json::parse(*derive(result->request, {}));
  EXPECT_EQ(answer["turtle"]["segments"], 3 * 256);
  EXPECT_NEAR(answer["turtle"]["bounds"]["max"][0].get<double>(), 81, 1e-9);
}

TEST(Fractint, ReadsEqualsSignsAndCommentsWhereFractintDoes) {
  const auto result =
      imported("fractint", "Shrub {\n angle=12;\n axiom=+++FX ; a trunk\n X=@.6[-FX]+FX\n}\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result)["angle"], 30);
  EXPECT_EQ(parameters_of(result)["axiom"], "-(90)+++FX");
}

TEST(Fractint, RemovesSymbolsOfEmptyRules) {
  const auto result =
      imported("fractint", "E {\n angle 4\n axiom F\n F=F<1C2F>1+@2\n <=\n >=\n C=\n @=\n +=-\n}\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result)["productions"],
            nlohmann::json({"F -> F;;(2)F,+@Di(2)", "; -> ", ", -> ", ";(n) -> ", "@Di(n) -> ", "+ -> -"}));
  EXPECT_THAT(derived(result), StartsWith("-(90)F;;(2)F,+@Di(2)F;;(2)F,+@Di(2)-"));
  EXPECT_THAT(
      reports(imported("fractint", "E {\n angle 4\n axiom F\n @=F\n [=F\n}\n")),
      ElementsAre(StartsWith("4:2 found a rule that gives `@`"), StartsWith("5:2 found a rule for `[`")));
}

TEST(Fractint, PassesOverWhatFractintPassesOver) {
  const auto result = imported("fractint", "E {\n angle 4\n axiom F\n F=F(4)\",F\n}\n");
  EXPECT_EQ(parameters_of(result)["productions"], nlohmann::json({"F -> F4F"}));
  EXPECT_THAT(reports(result),
              ElementsAre(HasSubstr("no number of steps"), StartsWith("4:5 `(` is not a command"),
                          StartsWith("4:7 `)`"), StartsWith("4:8"), StartsWith("4:9 `,`")));
}

TEST(Fractint, PassesOverEntriesThatAreComments) {
  const auto result = imported(
      "fractint", "{ tilings of\nthe plane (1994) }\nComment { by me }\nE {\n angle 4\n axiom F\n}\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(parameters_of(result)["axiom"], "-(90)F");
}

TEST(Fractint, KeepsItsTwoHeadingsApart) {
  const auto degrees = imported("fractint", "E {\n angle 4\n axiom D+D\\30D|D\n}\n");
  EXPECT_EQ(parameters_of(degrees)["axiom"], "-(90)DD+(30)DD") << "+ and | turn F and G alone";
  EXPECT_THAT(reports(degrees), testing::Contains(StartsWith("3:9 `+` turns only F and G")));
  const auto steps = imported("fractint", "E {\n angle 4\n axiom F/30F\n}\n");
  EXPECT_EQ(parameters_of(steps)["axiom"], "-(90)FF");
}

/// The turtle of Fractint's manual, with both headings in degrees: its segments, and the box around them.
struct TwoHeadings {
  int divisions;
  int segments = 0;
  double low[2] = {0, 0}, high[2] = {0, 0};

  struct State {
    double x = 0, y = 0, steps = 0, degrees = 0;
    bool is_mirrored = false;
  };

  void draw(const std::string& word) {
    State state;
    std::vector<State> saved;
    for (std::size_t i = 0; i < word.size(); ++i) {
      const char c = word[i];
      const double turn = 360.0 / divisions * (state.is_mirrored ? -1 : 1);
      if (c == '+') state.steps += turn;
      if (c == '-') state.steps -= turn;
      if (c == '|') state.steps += 180;
      if (c == '!') state.is_mirrored = !state.is_mirrored;
      if (c == '[') saved.push_back(state);
      if (c == ']') {
        state = saved.back();
        saved.pop_back();
      }
      if (c == '\\' || c == '/') {
        std::size_t length = 0;
        const double degrees = std::stod(word.substr(i + 1), &length);
        i += length;
        state.degrees += degrees * (c == '\\' ? 1 : -1) * (state.is_mirrored ? -1 : 1);
      }
      if (std::string_view("FGDM").find(c) == std::string_view::npos) continue;
      const double angle = (c == 'F' || c == 'G' ? state.steps : state.degrees) * M_PI / 180;
      for (const bool is_end : {false, true}) {
        if (is_end) state.x += std::cos(angle), state.y += std::sin(angle);
        if (c == 'G' || c == 'M') continue;
        low[0] = std::min(low[0], state.x), high[0] = std::max(high[0], state.x);
        low[1] = std::min(low[1], state.y), high[1] = std::max(high[1], state.y);
      }
      segments += c == 'F' || c == 'D' ? 1 : 0;
    }
  }
};

TEST(Fractint, DrawsWithBothHeadings) {
  const std::map<char, std::string> successors = {{'F', "F+[F\\20D!-D/35M]D"}, {'X', "[\\15DX|F]!+FGX"}};
  const auto result = imported("fractint",
                               "E {\n angle 8\n axiom X+\\10DF\n F=F+[F\\20D!-D/35M]D\n "
                               "X=[\\15DX|F]!+FGX\n}\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_THAT(reports(result), ElementsAre(HasSubstr("no number of steps")));
  std::string word = "X+\\10DF";
  for (int i = 0; i < 4; ++i) {
    std::string next;
    for (const char c : word) next += successors.contains(c) ? successors.at(c) : std::string(1, c);
    word = next;
  }
  TwoHeadings expected{8};
  expected.draw(word);
  const auto turtle = nlohmann::json::parse(*derive(result->request, {}))["turtle"];
  EXPECT_EQ(turtle["segments"], expected.segments);
  for (const int axis : {0, 1}) {
    EXPECT_NEAR(turtle["bounds"]["min"][axis].get<double>(), expected.low[axis], 1e-6);
    EXPECT_NEAR(turtle["bounds"]["max"][axis].get<double>(), expected.high[axis], 1e-6);
  }
}

TEST(Fractint, ReportsEveryErrorAtItsColumn) {
  EXPECT_THAT(
      reports(imported("fractint", "E {\n angle 4\n axiom F@F\n F=F[+F\n X=F]F\n}\n")),
      ElementsAre(StartsWith("3:9 found `@`"), StartsWith("4:5 found `[`"), StartsWith("5:5 found `]`")));
}

TEST(Fractint, TakesTheEntryThatIsNamed) {
  constexpr std::string_view two = "A {\nAngle 4\nAxiom F\n}\nB {\nAngle 8\nAxiom FF\n}\n";
  EXPECT_EQ(parameters_of(imported("fractint", two, "b"))["axiom"], "-(90)FF");
  const auto unnamed = imported("fractint", two);
  ASSERT_FALSE(unnamed);
  EXPECT_EQ(unnamed.error().issues[0].pointer, "/entry");
  EXPECT_THAT(unnamed.error().issues[0].message, HasSubstr("A, B"));
  EXPECT_FALSE(imported("fractint", two, "C"));
}

TEST(Fractint, RefusesUnknownTextAtItsLineAndColumn) {
  EXPECT_THAT(reports(imported("fractint", "E {\n  Angle 4\n  Axiom F@F\n  Blah\n}")),
              ElementsAre(StartsWith("3:10 found `@`"), StartsWith("4:3 found no command")));
  EXPECT_THAT(reports(imported("fractint", "E {\n Angle 4.5\n Axiom F@\n")),
              ElementsAre(StartsWith("1:1 found an entry without"), StartsWith("2:8 found no angle"),
                          StartsWith("3:9 found `@` without its number")));
  EXPECT_THAT(reports(imported("fractint", "nothing here")),
              testing::Contains(HasSubstr("outside an entry")));
  EXPECT_FALSE(imported("fractint", ""));
}

TEST(Import, NamesTheFormatsThatThereAre) {
  const auto result = imported("fractal_int", koch);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().issues[0].pointer, "/format");
  EXPECT_THAT(result.error().issues[0].message, HasSubstr("fractint"));
}

TEST(Import, RefusesBytesThatAreNoText) {
  const auto result = imported("fractint", "Koch\xFF {}");
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, Code::malformed);
}

}  // namespace
}  // namespace seedmesh
