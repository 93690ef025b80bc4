#include "core/schema/writer.h"

#include "generated/params/lsystem.h"
#include "generated/params/request.h"
#include "generated/params/tiny.h"
#include "tests/core/schema/support.h"

namespace seedmesh {
namespace {

std::string canonical_lsystem(std::string_view text) {
  return canonical_text(write_lsystem(reading<read_lsystem>(text).params));
}

std::string canonical_tiny(std::string_view text) {
  return canonical_text(write_tiny(reading<read_tiny>(text).params));
}

TEST(Writer, LeavesDefaultsOut) {
  EXPECT_EQ(canonical_lsystem(
                R"({"sides":8,"style":"tubes","axiom":"F","productions":[],"constants":{},"iterations":1,
                                  "angle":45,"step":{"value":1,"spread":0},"width":0.10,"materials":[]})"),
            R"({"axiom":"F"})");
}

TEST(Writer, WritesWhatIsRequiredWhateverItIs) { EXPECT_EQ(canonical_lsystem("{}"), R"({"axiom":""})"); }

TEST(Writer, GivesEqualMeaningOneForm) {
  EXPECT_EQ(canonical_lsystem(R"({"axiom":"F","angle":{"yaw":20,"roll":20.0,"pitch":2e1}})"),
            R"({"angle":20,"axiom":"F"})");
  EXPECT_EQ(canonical_lsystem(R"({"axiom":"F","angle":{"yaw":45}})"), R"({"axiom":"F"})");
  EXPECT_EQ(canonical_lsystem(R"({"axiom":"F","angle":{"yaw":20}})"), R"({"angle":{"yaw":20},"axiom":"F"})");
  EXPECT_EQ(canonical_lsystem(R"({"axiom":"F","step":{"spread":0.5}})"),
            R"({"axiom":"F","step":{"spread":0.5}})");
  EXPECT_EQ(canonical_lsystem(R"({"axiom":"F","materials":[{"roughness":0.9,"color":"#ABCDEF"}]})"),
            R"({"axiom":"F","materials":[{"color":"#abcdef"}]})");
}

TEST(Writer, KeepsAnObjectWhoseAbsenceMatters) {
  EXPECT_EQ(canonical_lsystem(R"({"axiom":"F","alphabet":{"variables":""}})"),
            R"({"alphabet":{"variables":""},"axiom":"F"})");
  EXPECT_EQ(canonical_tiny(R"({"mood":"calm","note":""})"), R"({"mood":"calm","note":""})");
}

TEST(Writer, ReadsBackAsEqualParameters) {
  const char* texts[] = {
      R"({"mood":"wild","visible":false,"size":[3,2,1],"class":"b","count":5,"shape":[],"tint":"#ffaa00","reach":{"far":9,"blur":1},
          "places":{"a":-5,"b":5},"note":"n","frame":{"depth":0}})",
      R"({"mood":"calm","shape":"ball","reach":7})", R"({"mood":"calm"})"};
  for (const char* text : texts) {
    const auto once = reading<read_tiny>(text);
    ASSERT_THAT(once.issues, testing::IsEmpty());
    const std::string canonical = canonical_text(write_tiny(once.params));
    const auto twice = reading<read_tiny>(canonical);
    EXPECT_EQ(once.params, twice.params) << canonical;
    EXPECT_EQ(canonical_text(write_tiny(twice.params)), canonical);
  }
}

TEST(Seed, IsTakenAsNumberAndAsDigits) {
  const auto seed = [](const std::string& text) {
    const auto read = reading<read_request>("{\"seed\":" + text + "}");
    EXPECT_THAT(read.issues, testing::IsEmpty()) << text;
    return read.params.seed;
  };
  EXPECT_EQ(seed("7"), 7U);
  EXPECT_EQ(seed("7.0"), 7U);
  EXPECT_EQ(seed("\"7\""), 7U);
  EXPECT_EQ(seed("\"007\""), 7U);
  EXPECT_EQ(seed("1e3"), 1'000U);
  EXPECT_EQ(seed("18446744073709551615"), 18446744073709551615U);
  EXPECT_EQ(seed("\"18446744073709551615\""), 18446744073709551615U);
}

TEST(Seed, IsRefusedBeyondSixtyFourBits) {
  for (const char* text :
       {"-1", "1.5", "18446744073709551616", "1e30", "\"18446744073709551616\"", "\"\"", "\"-1\"", "\"1.0\"",
        "\" 1\"", "\"0x1\"", "\"99999999999999999999\"", "null", "[1]", "true"}) {
    const auto read = reading<read_request>("{\"seed\":" + std::string(text) + "}");
    EXPECT_THAT(read.pointers(), testing::ElementsAre("/seed")) << text;
  }
}

TEST(Seed, IsWrittenAsDigitsWhereJavascriptWouldRoundIt) {
  EXPECT_EQ(canonical_text(schema::write_seed(9007199254740991)), "9007199254740991");
  EXPECT_EQ(canonical_text(schema::write_seed(9007199254740992)), "\"9007199254740992\"");
}

}  // namespace
}  // namespace seedmesh
