/// Parameters that have no effect, as the code made from tiny.schema.json reports them.
#include <gmock/gmock.h>

#include "generated/params/tiny.h"
#include "generated/params/tiny_unused.h"

namespace seedmesh {
namespace {

using testing::IsEmpty;

/// A note has an effect if the mood is wild and either the count is above 2 or an invisible class is neither
/// plain nor flat.
TinyParams with_note() {
  TinyParams params;
  params.note = "text";
  params.mood = TinyMood::wild;
  params.count = 3;
  return params;
}

std::string only_message(const TinyParams& params) {
  const std::vector<UnusedParameter> unused = unused_parameters(params);
  return unused.size() == 1 ? unused.front().pointer + ": " + unused.front().message
                            : std::to_string(unused.size()) + " messages";
}

TEST(UnusedParameters, AreNoneOfTheDefaults) { EXPECT_THAT(unused_parameters(TinyParams{}), IsEmpty()); }

TEST(UnusedParameters, AreNoneWhoseConditionsHold) {
  TinyParams params = with_note();
  EXPECT_THAT(unused_parameters(params), IsEmpty());
  params.count = 0;
  params.visible = false;
  params.class_name = "round";
  EXPECT_THAT(unused_parameters(params), IsEmpty());
}

TEST(UnusedParameters, AreReportedOnceWithTheFirstConditionThatFails) {
  TinyParams params = with_note();
  params.mood = TinyMood::calm;
  params.count = 0;
  EXPECT_EQ(only_message(params), "/note: `note` has no effect unless `mood` is wild.");
}

TEST(UnusedParameters, SayEveryAlternative) {
  TinyParams params = with_note();
  params.count = 2;
  params.visible = false;
  params.class_name = "flat";
  EXPECT_EQ(
      only_message(params),
      "/note: `note` has no effect unless `count` is greater than 2, or `visible` is false and `class` is "
      "not plain or flat.");
}

TEST(UnusedParameters, MayDependOnWhatIsLeftOut) {
  TinyParams params;
  params.places["a"] = 1;
  EXPECT_EQ(only_message(params), "/places: `places` has no effect unless `note` is given.");
}

}  // namespace
}  // namespace seedmesh
