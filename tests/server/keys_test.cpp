#include "server/keys.h"

#include <gmock/gmock.h>

#include <cstdio>
#include <fstream>

#include "server/redis_address.h"

namespace seedmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::string digest(64, 'a');

TEST(ListElements, AreSeparatedByAnythingUsual) {
  EXPECT_THAT(list_elements("a,b  c\n\nd # e, f\ng"), ElementsAre("a", "b", "c", "d", "g"));
  EXPECT_THAT(list_elements(""), IsEmpty());
  EXPECT_THAT(list_elements("# nothing"), IsEmpty());
}

TEST(ApiKeys, HaveNameDigestAndLimits) {
  std::vector<ApiKey> keys;
  EXPECT_EQ(read_api_keys("a:" + digest + " b:" + digest + ":2.5:3", keys), "");
  ASSERT_EQ(keys.size(), 2U);
  EXPECT_EQ(keys[0].digest, std::string(32, '\xaa'));
  EXPECT_EQ(keys[0].rate, -1);
  EXPECT_EQ(keys[1].rate, 2.5);
  EXPECT_EQ(keys[1].concurrency, 3);
}

TEST(ApiKeys, ReportErrorsWithoutRevealingTheKey) {
  std::vector<ApiKey> keys;
  for (const std::string& text :
       {"a:" + digest + "a", std::string("a:secret"), std::string("a"), std::string("secret"), ":" + digest,
        "a b:" + digest, "a:" + digest + ":x", "a:" + digest + ":-1", "a:" + digest + ":1:x",
        "a:" + digest + ":1:2:3", "a:" + digest + ",a:" + digest}) {
    const std::string fault = read_api_keys(text, keys);
    EXPECT_FALSE(fault.empty()) << text;
    EXPECT_THAT(fault, testing::Not(testing::AnyOf(HasSubstr("secret"), HasSubstr("aaaa")))) << text;
  }
}

TEST(SigningKeys, AreHexOfAtLeastSixteenBytes) {
  std::vector<SigningKey> keys;
  EXPECT_EQ(read_signing_keys("k:" + std::string(32, '0') + ",l:" + std::string(64, 'f'), keys), "");
  ASSERT_EQ(keys.size(), 2U);
  EXPECT_EQ(keys[1].id, "l");
  EXPECT_EQ(keys[1].secret, std::string(32, '\xff'));
  EXPECT_THAT(read_signing_keys("k:" + std::string(30, '0'), keys), HasSubstr("32 hexadecimal"));
  EXPECT_FALSE(read_signing_keys("k:zz", keys).empty());
  EXPECT_FALSE(read_signing_keys(std::string(32, '0'), keys).empty());
  EXPECT_THAT(read_signing_keys("k:" + digest + " k:" + digest, keys), HasSubstr("two keys"));
}

TEST(Origins, AreSchemeAndHost) {
  std::vector<std::string> origins;
  EXPECT_EQ(read_origins("https://a.example, http://localhost:5173", origins), "");
  EXPECT_THAT(origins, ElementsAre("https://a.example", "http://localhost:5173"));
  EXPECT_EQ(read_origins("*", origins), "");
  for (const char* text : {"a.example", "https://", "https://a.example/", "https://*.example", "ftp://a"})
    EXPECT_FALSE(read_origins(text, origins).empty()) << text;
}

TEST(Generators, AreThoseThatThereAre) {
  std::vector<std::string> names;
  EXPECT_EQ(read_generators("rehearsal", names), "");
  EXPECT_THAT(read_generators("tree", names), HasSubstr("rehearsal"));
}

TEST(IndirectText, IsReadFromItsFile) {
  const std::string name = testing::TempDir() + "seedmesh-indirect";
  std::ofstream(name) << "from a file";
  std::string text;
  EXPECT_TRUE(read_indirect("@" + name, text));
  EXPECT_EQ(text, "from a file");
  EXPECT_TRUE(read_indirect("as it is", text));
  EXPECT_EQ(text, "as it is");
  std::remove(name.c_str());
  EXPECT_FALSE(read_indirect("@" + name, text));
}

TEST(RedisAddress, IsReadWhole) {
  std::optional<RedisAddress> address;
  EXPECT_EQ(read_redis_address("redis://me:p%40ss@cache.example:7000/3\n", address), "");
  ASSERT_TRUE(address);
  EXPECT_EQ(address->host, "cache.example");
  EXPECT_EQ(address->port, 7000);
  EXPECT_EQ(address->user, "me");
  EXPECT_EQ(address->password, "p@ss");
  EXPECT_EQ(address->database, 3);
  EXPECT_EQ(shown_address(*address), "redis://cache.example:7000/3");
  EXPECT_EQ(read_redis_address("redis://:secret@[::1]", address), "");
  EXPECT_EQ(address->host, "::1");
  EXPECT_EQ(address->password, "secret");
  EXPECT_EQ(address->port, 6379);
  EXPECT_EQ(read_redis_address("unix:///run/redis.sock?db=2", address), "");
  EXPECT_EQ(address->path, "/run/redis.sock");
  EXPECT_EQ(address->database, 2);
  EXPECT_EQ(read_redis_address("", address), "");
  EXPECT_FALSE(address);
}

TEST(RedisAddress, RefusesWhatItCannotReach) {
  std::optional<RedisAddress> address;
  for (const char* text :
       {"localhost:6379", "rediss://a", "redis://", "redis://a:0", "redis://a:x", "redis://a/x",
        "redis://secret@a", "unix://run", "unix:///a?db=x", "redis://[::1"}) {
    const std::string fault = read_redis_address(text, address);
    EXPECT_FALSE(fault.empty()) << text;
    EXPECT_THAT(fault, testing::Not(HasSubstr("secret")));
    EXPECT_FALSE(address);
  }
}

}  // namespace
}  // namespace seedmesh
