#include "server/access.h"
#include "server/http/text.h"

#include <gmock/gmock.h>

#include <ctime>

#include "server/negotiate.h"

namespace seedmesh {
namespace {

using namespace std::chrono_literals;

Config with(std::vector<std::pair<std::string, std::string>> flags) {
  const ConfigResult loaded = load_config({}, flags);
  EXPECT_THAT(loaded.errors, testing::IsEmpty());
  return loaded.config;
}

const std::string alice_key = "alices-own-key";
std::string alice(const std::string& limits = "") { return "alice:" + http::hex(sha256(alice_key)) + limits; }
constexpr const char* signing = "k1:00112233445566778899aabbccddeeff";

http::Request asking(std::string method, std::string target, http::Headers headers = {}) {
  http::Request request;
  request.method = std::move(method);
  request.target = std::move(target);
  request.headers = std::move(headers);
  return request;
}

int status_of(const std::variant<Grant, Denial>& admitted) {
  const auto* denial = std::get_if<Denial>(&admitted);
  return denial ? denial->problem.status : 200;
}

TEST(Access, IsOpenWithoutKeys) {
  Access access(with({}));
  EXPECT_FALSE(access.closed());
  EXPECT_EQ(status_of(access.admit(asking("POST", "/v1/generate"))), 200);
}

TEST(Access, RequiresAKey) {
  Access access(with({{"api-keys", alice()}}));
  EXPECT_TRUE(access.closed());
  const auto request = [](http::Headers headers) {
    return asking("POST", "/v1/generate", std::move(headers));
  };
  EXPECT_EQ(status_of(access.admit(request({}))), 401);
  EXPECT_EQ(status_of(access.admit(request({{"Authorization", "Basic abc"}}))), 401);
  EXPECT_EQ(status_of(access.admit(request({{"Authorization", "Bearer wrong"}}))), 403);
  EXPECT_EQ(status_of(access.admit(request({{"X-Api-Key", ""}}))), 403);
  EXPECT_EQ(status_of(access.admit(request({{"authorization", "bearer  " + alice_key + " "}}))), 200);
  const auto admitted = access.admit(request({{"X-Api-Key", alice_key}}));
  ASSERT_EQ(status_of(admitted), 200);
  EXPECT_EQ(std::get<Grant>(admitted).key, "alice");
}

TEST(Access, LetsASignatureReadAndNothingElse) {
  const Config config = with({{"signing-keys", signing}});
  Access access(config);
  const std::string link = sign_target("/v1/models/AAAA.glb", config.signing_keys[0], std::nullopt);
  const auto admitted = access.admit(asking("GET", link));
  ASSERT_EQ(status_of(admitted), 200);
  EXPECT_EQ(std::get<Grant>(admitted).target_size, std::string_view("/v1/models/AAAA.glb").size());
  EXPECT_EQ(status_of(access.admit(asking("HEAD", link))), 200);
  EXPECT_EQ(status_of(access.admit(asking("POST", link))), 401);
  EXPECT_EQ(status_of(access.admit(asking("GET", "/v1/models/AAAA.glb"))), 401);
  EXPECT_EQ(status_of(access.admit(asking("GET", link + "x"))), 403);
  const std::string old = sign_target("/v1/models/AAAA.glb", config.signing_keys[0], std::time(nullptr) - 1);
  const auto late = access.admit(asking("GET", old));
  ASSERT_EQ(status_of(late), 403);
  EXPECT_EQ(std::get<Denial>(late).reason, "signature_expired");
}

TEST(Access, SignsPermalinksForThoseWithAKeyAlone) {
  const Config config = with({{"signing-keys", signing}, {"api-keys", alice()}, {"link-lifetime", "100"}});
  Access access(config);
  Grant with_key;
  with_key.by = Grant::By::key;
  const SignatureCheck check = check_signature(access.signed_for(with_key, "/v1/models/A.glb"),
                                               config.signing_keys, std::time(nullptr));
  EXPECT_EQ(check.state, SignatureState::good);
  EXPECT_NEAR(static_cast<double>(check.expires.value_or(0)), static_cast<double>(std::time(nullptr)) + 100,
              2);
  Grant with_signature;
  with_signature.by = Grant::By::signature;
  with_signature.expires = 7;
  EXPECT_EQ(access.signed_for(with_signature, "/v1/models/A.glb"), "");
  EXPECT_THAT(access.signed_until(with_signature, "/v1/models/B.glb"),
              testing::HasSubstr("?expires=7&key=k1&"));
}

TEST(Access, CountsRequestsAtOnceOfAKey) {
  Access access(with({{"api-keys", alice(":0:2")}}));
  const auto request = asking("POST", "/v1/generate", {{"X-Api-Key", alice_key}});
  auto first = access.admit(request);
  {
    const auto second = access.admit(request);
    EXPECT_EQ(status_of(second), 200);
    const auto third = access.admit(request);
    ASSERT_EQ(status_of(third), 429);
    EXPECT_EQ(std::get<Denial>(third).reason, "key_concurrency");
    EXPECT_GE(std::get<Denial>(third).problem.retry_after, 1);
  }
  EXPECT_EQ(status_of(access.admit(request)), 200);
}

TEST(Access, CountsRequestsASecondOfEachKeyByItself) {
  const std::string bob = ",bob:" + http::hex(sha256("bobs"));
  Access access(with({{"api-keys", alice() + bob}, {"key-rate", "0.01"}}));
  EXPECT_EQ(status_of(access.admit(asking("POST", "/", {{"X-Api-Key", alice_key}}))), 200);
  const auto second = access.admit(asking("POST", "/", {{"X-Api-Key", alice_key}}));
  ASSERT_EQ(status_of(second), 429);
  EXPECT_GE(std::get<Denial>(second).problem.retry_after, 99);
  EXPECT_EQ(std::get<Denial>(second).problem.word, "rate-limited");
  EXPECT_EQ(status_of(access.admit(asking("POST", "/", {{"X-Api-Key", "bobs"}}))), 200);
}

TEST(TokenBucket, FillsWithTime) {
  TokenBucket bucket(2);
  const auto start = TokenBucket::Clock::now();
  EXPECT_EQ(bucket.take(start), 0);
  EXPECT_EQ(bucket.take(start), 0);
  EXPECT_NEAR(bucket.take(start), 0.5, 1e-6);
  EXPECT_EQ(bucket.take(start + 500ms), 0);
  EXPECT_GT(bucket.take(start + 500ms), 0);
  EXPECT_EQ(bucket.take(start + 10h), 0);
  EXPECT_EQ(bucket.take(start + 10h), 0);
  EXPECT_GT(bucket.take(start + 10h), 0) << "it holds no more than a second's worth";
}

TEST(TokenBucket, WithoutARateIsNeverEmpty) {
  TokenBucket bucket(0);
  for (int i = 0; i < 1'000; ++i) EXPECT_EQ(bucket.take(TokenBucket::Clock::now()), 0);
}

Request reading(const std::string& text) { return *read_request(text, Limits{}); }

TEST(Access, MakesOnlyPresetsWithAnySeedAndOutput) {
  Access access(with({{"only-presets", "true"}}));
  const std::string small = R"({"generator":"rehearsal","parameters":{"bytes":2000})";
  EXPECT_FALSE(access.forbid(reading(small + "}")));
  EXPECT_FALSE(access.forbid(reading(small + R"(,"seed":77,"output":{"format":"zip"}})")));
  const auto denial = access.forbid(reading(R"({"generator":"rehearsal","parameters":{"bytes":2001}})"));
  ASSERT_TRUE(denial);
  EXPECT_EQ(denial->problem.status, 403);
  EXPECT_EQ(denial->reason, "only_presets");
}

TEST(Access, AllowsTheNamedGeneratorsAloneAlsoInside) {
  Access access(with({{"generators", "rehearsal"}}));
  EXPECT_TRUE(access.allows_generator("rehearsal"));
  EXPECT_FALSE(access.allows_generator("other"));
  EXPECT_FALSE(access.forbid(reading(R"({"generator":"rehearsal"})")));
  const auto denial = access.forbid(
      reading(R"({"generator":"rehearsal","parameters":{"parts":[{"model":{"generator":"other"}}]}})"));
  ASSERT_TRUE(denial);
  EXPECT_EQ(denial->problem.status, 403);
  EXPECT_THAT(denial->problem.detail, testing::HasSubstr("other"));
}

}  // namespace
}  // namespace seedmesh
