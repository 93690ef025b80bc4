#include "server/config.h"

#include <gmock/gmock.h>

#include <cstdio>
#include <fstream>

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
  EXPECT_TRUE(loaded.errors.empty());
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

TEST(Config, ListsEveryError) {
  const auto loaded =
      load_config({"SEEDMESH_QUEUE=-1", "SEEDMESH_CACHE_BYTES=99999GiB"},
                  {{"port", "70000"}, {"log-level", "loud"}, {"time-limit", "nan"}, {"colour", "red"}});
  EXPECT_THAT(loaded.errors,
              ElementsAre(HasSubstr("SEEDMESH_QUEUE"), HasSubstr("SEEDMESH_CACHE_BYTES"),
                          AllOf(HasSubstr("--port"), HasSubstr("65535")), HasSubstr("--log-level"),
                          HasSubstr("--time-limit"), HasSubstr("--colour")));
}

TEST(Config, RefusesLimitsThatContradictEachOther) {
  const auto loaded = load_config({}, {{"body-limit", "1GiB"}, {"body-memory", "1MiB"}});
  EXPECT_THAT(loaded.errors, ElementsAre(HasSubstr("body-memory")));
}

TEST(Config, WarnsOfVariablesThatAreNoSetting) {
  const auto loaded = load_config({"SEEDMESH_PROT=1"}, {});
  EXPECT_TRUE(loaded.errors.empty());
  EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("SEEDMESH_PROT")));
}

TEST(Config, IgnoresTheVariablesThatKubernetesSets) {
  const auto loaded =
      load_config({"SEEDMESH_PORT=tcp://10.0.0.1:8080", "SEEDMESH_PORT_8080_TCP=tcp://10.0.0.1:8080"}, {});
  EXPECT_TRUE(loaded.errors.empty());
  EXPECT_TRUE(loaded.warnings.empty());
  EXPECT_EQ(loaded.config.port, 8080);
}

/// A file of settings that is gone after the test.
struct SettingsFile {
  explicit SettingsFile(const std::string& text) : name(testing::TempDir() + "seedmesh-settings.json") {
    std::ofstream(name) << text;
  }
  ~SettingsFile() { std::remove(name.c_str()); }
  std::string name;
};

TEST(Config, LetsTheEnvironmentWinOverTheFile) {
  const SettingsFile file(
      R"({"queue": 7, "port": 9000, "cache-bytes": "1MiB", // a comment
          "only-presets": true, "generators": ["rehearsal"], "cors-origins": "*"})");
  const auto loaded = load_config({"SEEDMESH_CONFIG=" + file.name, "SEEDMESH_PORT=9001"}, {{"queue", "8"}});
  EXPECT_THAT(loaded.errors, testing::IsEmpty());
  EXPECT_THAT(loaded.warnings, testing::IsEmpty());
  EXPECT_EQ(loaded.config.queue, 8);
  EXPECT_EQ(loaded.config.port, 9001);
  EXPECT_EQ(loaded.config.cache_bytes, 1U << 20U);
  EXPECT_TRUE(loaded.config.only_presets);
  EXPECT_THAT(loaded.config.generators, ElementsAre("rehearsal"));
}

TEST(Config, ListsEveryErrorOfTheFileToo) {
  const SettingsFile file(R"({"queue": "many", "prot": 1, "port": null, "generators": ["oak"]})");
  const auto loaded = load_config({}, {{"config", file.name}, {"threads", "0"}});
  EXPECT_THAT(loaded.errors, ElementsAre(HasSubstr("queue is"), HasSubstr("prot is not a setting"),
                                         HasSubstr("port"), HasSubstr("oak"), HasSubstr("--threads")));
}

TEST(Config, RefusesAFileThatIsNone) {
  EXPECT_THAT(load_config({}, {{"config", "/no/such/file"}}).errors,
              ElementsAre(HasSubstr("cannot be read")));
  EXPECT_THAT(load_config({}, {{"config", SettingsFile("{").name}}).errors.size(), 1);
  const SettingsFile list("[]");
  EXPECT_THAT(load_config({}, {{"config", list.name}}).errors,
              ElementsAre(HasSubstr("does not contain an object")));
}

TEST(Config, NeverRevealsSecrets) {
  const std::string digest(64, 'c'), secret(32, 'd');
  const auto loaded = load_config({}, {{"api-keys", "a:" + digest},
                                       {"signing-keys", "k:" + secret},
                                       {"redis-url", "redis://u:hunter2@cache"}});
  EXPECT_THAT(loaded.errors, testing::IsEmpty());
  const std::string text = config_json(loaded.config);
  EXPECT_THAT(text,
              AllOf(HasSubstr("a:(hidden)"), HasSubstr("k:(hidden)"), HasSubstr("redis://cache:6379/0")));
  EXPECT_THAT(text, testing::Not(testing::AnyOf(HasSubstr(digest), HasSubstr(secret), HasSubstr("hunter2"))));
  const auto wrong =
      load_config({}, {{"api-keys", "a:hunter2"}, {"signing-keys", "hunter2"}, {"redis-url", "hunter2"}});
  EXPECT_EQ(wrong.errors.size(), 3U);
  for (const std::string& error : wrong.errors) EXPECT_THAT(error, testing::Not(HasSubstr("hunter2")));
}

TEST(Config, RefusesALifetimeOfLinksThatAreNotSigned) {
  EXPECT_THAT(load_config({}, {{"link-lifetime", "60"}}).errors, ElementsAre(HasSubstr("signing-keys")));
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
