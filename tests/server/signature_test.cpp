#include "server/signature.h"
#include "server/http/text.h"

#include <gmock/gmock.h>

#include "core/base/base64url.h"

namespace seedmesh {
namespace {

constexpr std::int64_t now = 1'800'000'000;
const std::vector<SigningKey> keys = {{"new", "0123456789abcdef"}, {"old", "fedcba9876543210"}};
const std::string target = "/v1/models/q1YqSy1RslIyVqoFAA.glb";

SignatureState state_of(const std::string& text, const std::vector<SigningKey>& held = keys) {
  return check_signature(text, held, now).state;
}

TEST(Hmac, IsThatOfRfc4231) {
  EXPECT_EQ(http::hex(hmac_sha256("Jefe", "what do ya want for nothing?")),
            "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843");
  EXPECT_EQ(http::hex(sha256("abc")), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Signature, IsValidForTheSignedTarget) {
  for (const SigningKey& key : keys) {
    for (const std::string& text : {target, std::string("/v1/presets/a.glb?seed=3")}) {
      const std::string link = sign_target(text, key, now + 60);
      const SignatureCheck check = check_signature(link, keys, now);
      EXPECT_EQ(check.state, SignatureState::good) << link;
      EXPECT_EQ(link.substr(0, check.target_size), text);
      EXPECT_EQ(check.expires, now + 60);
      EXPECT_EQ(state_of(sign_target(text, key, std::nullopt)), SignatureState::good);
    }
  }
}

TEST(Signature, IsMadeOfTheTextBeforeIt) {
  const std::string link = sign_target(target, keys[0], 5);
  const std::string covered = target + "?expires=5&key=new";
  EXPECT_EQ(link, covered + "&signature=" + base64url(hmac_sha256(keys[0].secret, covered)));
}

TEST(Signature, IsAbsentWithoutAParameter) {
  for (const char* text : {"/", "/v1/presets/a.glb?seed=3", "/signature=x", "/v1/a.glb?xsignature=b"}) {
    const SignatureCheck check = check_signature(text, keys, now);
    EXPECT_EQ(check.state, SignatureState::absent) << text;
    EXPECT_EQ(check.target_size, std::string_view(text).size());
  }
}

TEST(Signature, DoesNotHoldForAnythingElse) {
  const std::string link = sign_target(target, keys[0], now + 60);
  for (std::size_t i = 1; i < link.size(); ++i) {
    std::string changed = link;
    changed[i] = changed[i] == 'A' ? 'B' : 'A';
    EXPECT_NE(state_of(changed), SignatureState::good) << changed;
  }
  const std::string longer = sign_target(target, keys[0], now + 60) + "A";
  EXPECT_EQ(state_of(longer), SignatureState::wrong);
  EXPECT_EQ(state_of(target + "?signature="), SignatureState::wrong);
  EXPECT_EQ(state_of(target + "?key=new&signature=" + std::string(43, 'A')), SignatureState::wrong);
  const std::string unlimited = sign_target(target, keys[0], std::nullopt);
  EXPECT_EQ(state_of(target + "?expires=9999999999" + unlimited.substr(target.size() + 1)),
            SignatureState::wrong);
}

TEST(Signature, CannotBeMovedToAnotherPositionInTheQuery) {
  const std::string link = sign_target("/v1/presets/a.glb?seed=3", keys[0], std::nullopt);
  EXPECT_EQ(state_of(link + "&seed=4"), SignatureState::absent) << "which a closed service refuses";
}

TEST(Signature, ExpiresAtItsSecond) {
  const std::string link = sign_target(target, keys[0], now);
  EXPECT_EQ(check_signature(link, keys, now - 1).state, SignatureState::good);
  EXPECT_EQ(check_signature(link, keys, now).state, SignatureState::expired);
}

TEST(Signature, OfARemovedKeyIsInvalid) {
  const std::string link = sign_target(target, keys[1], std::nullopt);
  EXPECT_EQ(state_of(link, {keys[0]}), SignatureState::wrong);
  EXPECT_EQ(state_of(link, {{"old", "another secret of that name"}}), SignatureState::wrong);
}

TEST(Comparison, DistinguishesEqualFromUnequal) {
  EXPECT_TRUE(same_in_constant_time("", ""));
  EXPECT_TRUE(same_in_constant_time("abc", "abc"));
  EXPECT_FALSE(same_in_constant_time("abc", "abd"));
  EXPECT_FALSE(same_in_constant_time("abc", "abcd"));
}

TEST(Hex, ComesBack) {
  const std::string bytes("\x00\x7f\xff", 3);
  EXPECT_EQ(http::hex(bytes), "007fff");
  EXPECT_EQ(from_hex("007FfF"), bytes);
  for (const char* text : {"0", "0g", "-1", " 1", "0x"}) EXPECT_FALSE(from_hex(text)) << text;
}

TEST(SecretBytes, AreNotTheSameTwice) { EXPECT_NE(secret_bytes(16), secret_bytes(16)); }

}  // namespace
}  // namespace seedmesh
