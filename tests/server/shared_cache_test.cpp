#include "server/shared_cache.h"

#include <gtest/gtest.h>

namespace seedmesh {
namespace {

CachedModel model() {
  CachedModel made;
  made.product.media_type = "model/gltf-binary";
  made.product.extension = "glb";
  made.product.statistics = {12, 24, 1};
  auto payload = std::make_shared<Payload>();
  payload->add(std::string("first and "));
  payload->add(std::string("second\n\0part", 12));
  made.payload = std::move(payload);
  return made;
}

Cache::Entry opened(const std::string& bytes) {
  const auto owner = std::make_shared<std::string>(bytes);
  return unpack(owner, *owner, "token");
}

TEST(PackedModel, ComesBack) {
  const CachedModel made = model();
  const Cache::Entry back = opened(pack(made));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->payload->text(), made.payload->text());
  EXPECT_EQ(back->product.media_type, "model/gltf-binary");
  EXPECT_EQ(back->product.extension, "glb");
  EXPECT_EQ(back->product.statistics.triangles, 12U);
  EXPECT_EQ(back->product.statistics.vertices, 24U);
  EXPECT_EQ(back->product.statistics.warnings, 1U);
  EXPECT_EQ(back->token, "token");
  EXPECT_TRUE(back->shared);
}

TEST(PackedModel, IsTakenWholeAndUnchangedOnly) {
  const std::string bytes = pack(model());
  for (std::size_t size = 0; size < bytes.size(); ++size) EXPECT_FALSE(opened(bytes.substr(0, size))) << size;
  EXPECT_FALSE(opened(bytes + "x"));
  for (std::size_t i = bytes.size() - 22; i < bytes.size(); ++i) {
    std::string changed = bytes;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    EXPECT_FALSE(opened(changed)) << i;
  }
}

TEST(PackedModel, IsNotWhatSomebodyElsePutThere) {
  for (const char* text : {"seedmesh model 1\n", "seedmesh model 1\n{}\n", "seedmesh model 1\n[]\n",
                           "seedmesh model 1\n{\"bytes\":\"x\",\"hash\":0}\n", "seedmesh model 2\n{}\n"}) {
    EXPECT_FALSE(opened(text)) << text;
  }
}

TEST(SharedCache, WithoutAnAddressIsEmpty) {
  const Log log("off");
  SharedCache cache(Config{}, log);
  EXPECT_FALSE(cache.get("{}", ""));
  cache.put("{}", std::make_shared<CachedModel>(model()));
  const auto counters = cache.counters();
  EXPECT_EQ(counters.hits + counters.misses + counters.writes + counters.errors + counters.skips, 0U);
}

TEST(SharedCache, ThatDoesNotAnswerIsSkipped) {
  const Log log("off");
  Config config;
  config.threads = 1;
  config.redis = RedisAddress{"", 0, "/no/such/socket", "", "", 0};
  SharedCache cache(config, log);
  EXPECT_FALSE(cache.get("{}", ""));
  EXPECT_EQ(cache.counters().skips, 1U);
  EXPECT_EQ(cache.counters().connections, 0U);
}

}  // namespace
}  // namespace seedmesh
