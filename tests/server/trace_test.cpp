#include "server/trace.h"

#include <gmock/gmock.h>

namespace seedmesh {
namespace {

const std::string sound = "00-4bf92f3577b34da6a3ce929d0e0e4736-00f067aa0ba902b7-01";

TEST(Traceparent, GivesTraceParentAndFlags) {
  const auto trace = read_traceparent(sound);
  ASSERT_TRUE(trace);
  EXPECT_EQ(trace->trace_id, "4bf92f3577b34da6a3ce929d0e0e4736");
  EXPECT_EQ(trace->parent_id, "00f067aa0ba902b7");
  EXPECT_EQ(trace->flags, "01");
  EXPECT_THAT(trace->span_id, testing::MatchesRegex("[0-9a-f]{16}"));
  EXPECT_EQ(traceparent(*trace), "00-" + trace->trace_id + "-" + trace->span_id + "-01");
  EXPECT_TRUE(read_traceparent(traceparent(*trace)));
}

TEST(Traceparent, DrawsANewSpanEachTime) {
  EXPECT_NE(read_traceparent(sound)->span_id, read_traceparent(sound)->span_id);
}

TEST(Traceparent, OfALaterVersionIsReadByItsBeginning) {
  EXPECT_TRUE(read_traceparent("01" + sound.substr(2)));
  EXPECT_TRUE(read_traceparent("01" + sound.substr(2) + "-more"));
}

TEST(Traceparent, ThatIsMalformedIsIgnored) {
  for (const std::string& text :
       {std::string(), sound + "0", sound.substr(1), sound + "-more", "ff" + sound.substr(2),
        std::string("00-4BF92F3577B34DA6A3CE929D0E0E4736-00f067aa0ba902b7-01"),
        "00-" + std::string(32, '0') + "-00f067aa0ba902b7-01",
        "00-4bf92f3577b34da6a3ce929d0e0e4736-" + std::string(16, '0') + "-01",
        std::string("00_4bf92f3577b34da6a3ce929d0e0e4736-00f067aa0ba902b7-01"),
        std::string("00-4bf92f3577b34da6a3ce929d0e0e4736-00f067aa0ba902b7-0g")}) {
    EXPECT_FALSE(read_traceparent(text)) << text;
  }
}

}  // namespace
}  // namespace seedmesh
