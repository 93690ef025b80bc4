/// Files of cpfg that include others, arrays with several indices, and macros that are defined again.
#include <gmock/gmock.h>

#include "tests/core/import/support.h"

namespace seedmesh {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::StartsWith;

Result<ImportedRequest> with_files(std::string_view text, std::map<std::string, std::string> files) {
  return import_request(ImportInput{"cpfg", "", text, std::move(files)}, Limits{});
}

constexpr const char* plant =
    "#include \"common/sizes.h\"\n"
    "Lsystem: 1\n"
    "derivation length: STEPS\n"
    "Axiom: A(1)\n"
    "#include \"rules.txt\"\n"
    "endlsystem\n";

TEST(CpfgInclude, PutsTheTextOfTheFileInThePlaceOfTheLine) {
  const auto result = with_files(plant, {{"sizes.h", "/* sizes */\n#define STEPS 2\n#define R 0.5\n"},
                                         {"rules.txt", "#include <leaf.txt>\nA(x) --> F(x)A(x*R)L\n"},
                                         {"leaf.txt", "L --> [+F]\n"}});
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(derived(result), "F(1)F(0.5)A(0.25)L[+F]");
}

TEST(CpfgInclude, ReportsFaultsOfTheFileAtTheLineThatIncludesIt) {
  const auto result = with_files(plant, {{"sizes.h", "#define STEPS 2\n"}, {"rules.txt", "A(x) --> F(x\n"}});
  EXPECT_THAT(reports(result), Contains(StartsWith("5:1 `rules.txt`: ")));
  const auto later = with_files("#include \"a.h\"\nLsystem: 1\nderivation length: 1\nAxiom: A(\n",
                                {{"a.h", "#define X 1\n#define Y 2\n"}});
  EXPECT_THAT(reports(later), Contains(StartsWith("4:9 "))) << "lines of the file itself keep their numbers";
}

TEST(CpfgInclude, ReportsAFileThatIsNotGiven) {
  EXPECT_THAT(reports(with_files(plant, {})),
              Contains(StartsWith("1:1 the file of this `#include` is not given")));
  EXPECT_TRUE(
      with_files("#ifdef NEVER\n#include \"x.h\"\n#endif\nLsystem: 1\nderivation length: 1\nAxiom: F\n", {}));
  const auto circle = with_files("#include \"a.h\"\nLsystem: 1\nAxiom: F\n", {{"a.h", "#include \"a.h\"\n"}});
  EXPECT_THAT(reports(circle), Contains(StartsWith("1:1 `a.h`: the file of this `#include`")));
}

TEST(CpfgArrays, HaveSeveralIndices) {
  // C stores rows one after another: table[1][2] is the sixth number.
  const auto result =
      imported("cpfg",
               "Lsystem: 1\n"
               "Define: { array table[2][3] = {1, 2, 3, 4, 5, 6}, one[2] = {7, 8}; }\n"
               "derivation length: 2\n"
               "Axiom: A(1, 2)\n"
               "A(i, k) : i > 0 {table[i][k] = table[i][k] + 10; m = table[i - 1][k / 2];} --> "
               "F(table[i][k])F(m)F(one[i])A(i - 1, table[0][0])\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(derived(result), "F(16)F(2)F(8)A(0,1)");
}

TEST(CpfgMacros, CountAsDefinedLast) {
  const auto result =
      imported("cpfg", "#define N 1\n#define N 3\nLsystem: 1\nderivation length: 1\nAxiom: F(N)\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(derived(result), "F(3)");
  EXPECT_THAT(reports(result), Contains(StartsWith("2:9 found a second macro `N`")));
}

TEST(CpfgStatements, RepeatUntilAConditionFails) {
  const auto result = imported("cpfg",
                               "Lsystem: 1\nderivation length: 2\nAxiom: A(3)\n"
                               "A(n) : * {s = 0; do {s = s + n; n = n - 1;} while (n > 0);} --> F(s)B(4)\n"
                               "B(n) : * {do n = n + 1; while (n < 3);} --> F(n)\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(derived(result), "F(6)F(5)") << "the statement is done once before the condition is asked";
  const auto open = imported("cpfg",
                             "Lsystem: 1\nderivation length: 1\nAxiom: A\n"
                             "A : * {do {x = 1;} x = 2;} --> B\n");
  EXPECT_THAT(reports(open), Contains(StartsWith("4:8 found `do` without its `while (...);`")));
}

TEST(CpfgStatements, ReportAnIndexWithoutItsEnd) {
  EXPECT_THAT(reports(imported("cpfg", "Lsystem: 1\nStart: {a[1 = 2;}\nderivation length: 1\nAxiom: A\n")),
              Contains(StartsWith("2:10 found `[` without its `]`")));
}

TEST(CpfgFiles, HaveEmptyLinesInStatements) {
  const auto result = imported("cpfg",
                               "Lsystem: 1\nderivation length: 3\nAxiom: A(0)\n"
                               "A(x) : x < 9\n"
                               "  {/* first */\n"
                               "   y = x;\n"
                               "\t\n"
                               "\n"
                               "   /* second */\n"
                               "   if (y > 0) {\n"
                               "\n"
                               "     y = y + 1;\n"
                               "   }\n"
                               "  }\n"
                               "  --> F(y)A(y + 1)\n"
                               "\nendlsystem\n");
  ASSERT_TRUE(result) << reports(result)[0];
  EXPECT_EQ(derived(result), "F(0)F(2)F(4)A(5)");
}

/// Signals that travel up and down an axis, with ignored modules, branches and cuts, as in models of flowering.
constexpr const char* signals =
    "Lsystem: 1\n"
    "derivation length: 21\n"
    "ignore: EF+-;\n"
    "Axiom: ET(0)FA(0)\n"
    "T(a) : a == 7 --> b\n"
    "T(a) --> T(a+1)\n"
    "b < a --> b\n"
    "b < A(a) --> U(0)[;B(0)]\n"
    "A(a) : a == 1 --> a[+Fx]F-A(0)\n"
    "A(a) --> A(a+1)\n"
    "U(a) : a == 1 --> cd\n"
    "U(a) --> U(a+1)\n"
    "b > c --> t(0)\n"
    "c < x --> A(0)\n"
    "c > d --> u\n"
    "t(a) --> c\n"
    "B(a) : a == 2 --> C[+F%F]F\n"
    "B(a) --> B(a+1)\n"
    "E --> ;E\n"
    "endlsystem\n";

TEST(CpfgFiles, DeriveTheWordOfASecondInterpreter) {
  // The word is that of a program of its own, which has the rules of cpfg for contexts, `ignore` and `%`.
  EXPECT_EQ(derived(imported("cpfg", signals)),
            ";;;;;;;;;;;;;;;;;;;;;EbFb[+Fx]F-b[+Fx]F-b[+Fx]F-b[+Fx]F-b[+Fx]F-t(0)[+Fx]F-c[+FA(0)]F-"
            "ud[;C[+F]F]");
}

}  // namespace
}  // namespace seedmesh
