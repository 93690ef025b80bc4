#include "server/config.h"

#include <gmock/gmock.h>

namespace seedmesh {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(Config, HasTheLimitsOfTheContract) {
  const Config config = load_config({}, {}).config;
  EXPECT_EQ(config.body_limit, 16U << 20U);
  EXPECT_EQ(config.queue, 64);
  EXPECT_EQ(config.time_limit, 30);
  EXPECT_EQ(config.limits.modules, 64'000'000U);
  EXPECT_EQ(config.limits.memory_bytes, std::uint64_t{2} << 30U);
  EXPECT_EQ(config.threads, usable_cores());
}

TEST(Config, LetsFlagsWinOverTheEnvironment) {
  const auto loaded =
      load_config({"SEEDMESH_PORT=9000", "SEEDMESH_TIME_LIMIT=5", "HOME=/root"}, {{"port", "9001"}});
  EXPECT_TRUE(loaded.faults.empty());
  EXPECT_EQ(loaded.config.port, 9001);
  EXPECT_EQ(loaded.config.time_limit, 5);
}

TEST(Config, ReadsBytesWithUnits) {
  const auto loaded =
      load_config({}, {{"cache-bytes", "64MiB"}, {"body-limit", "2048"}, {"max-memory", "3GiB"}});
  EXPECT_EQ(loaded.config.cache_bytes, 64U << 20U);
  EXPECT_EQ(loaded.config.body_limit, 2'048U);
  EXPECT_EQ(loaded.config.limits.memory_bytes, std::uint64_t{3} << 30U);
}

TEST(Config, ListsEveryFault) {
  const auto loaded =
      load_config({"SEEDMESH_QUEUE=-1", "SEEDMESH_CACHE_BYTES=99999GiB"},
                  {{"port", "70000"}, {"log-level", "loud"}, {"time-limit", "nan"}, {"colour", "red"}});
  EXPECT_THAT(loaded.faults,
              ElementsAre(HasSubstr("SEEDMESH_QUEUE"), HasSubstr("SEEDMESH_CACHE_BYTES"),
                          AllOf(HasSubstr("--port"), HasSubstr("65535")), HasSubstr("--log-level"),
                          HasSubstr("--time-limit"), HasSubstr("--colour")));
}

TEST(Config, RefusesLimitsThatContradictEachOther) {
  const auto loaded = load_config({}, {{"body-limit", "1GiB"}, {"body-memory", "1MiB"}});
  EXPECT_THAT(loaded.faults, ElementsAre(HasSubstr("body-memory")));
}

TEST(Config, WarnsOfVariablesThatAreNoSetting) {
  const auto loaded = load_config({"SEEDMESH_PROT=1"}, {});
  EXPECT_TRUE(loaded.faults.empty());
  EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("SEEDMESH_PROT")));
}

TEST(Config, OverlooksTheVariablesThatKubernetesSets) {
  const auto loaded =
      load_config({"SEEDMESH_PORT=tcp://10.0.0.1:8080", "SEEDMESH_PORT_8080_TCP=tcp://10.0.0.1:8080"}, {});
  EXPECT_TRUE(loaded.faults.empty());
  EXPECT_TRUE(loaded.warnings.empty());
  EXPECT_EQ(loaded.config.port, 8080);
}

TEST(Config, PrintsWhatItWouldRead) {
  Config config = load_config({}, {{"port", "9"}, {"host", "::1"}}).config;
  const std::string text = config_json(config);
  EXPECT_THAT(text, HasSubstr("\"port\": 9"));
  EXPECT_THAT(text, HasSubstr("\"host\": \"::1\""));
  for (const SettingInfo& setting : settings()) EXPECT_THAT(text, HasSubstr("\"" + setting.name + "\":"));
}

}  // namespace
}  // namespace seedmesh
