#include "server/permalink.h"

#include <gmock/gmock.h>

#include "core/base/deflate.h"

namespace seedmesh {
namespace {

constexpr std::string_view plant = R"({"generator":"lsystem","parameters":{"axiom":"F"},"seed":3})";

std::string base64url_of_deflated(std::string_view text) {
  // write_token adds an engine; a token by somebody else's hand is made here from its parts.
  const std::string packed = deflate_raw(text);
  static constexpr char alphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
  std::string out;
  for (std::size_t bit = 0; bit < packed.size() * 8; bit += 6) {
    unsigned value = 0;
    for (std::size_t i = bit; i < bit + 6; ++i) {
      const unsigned set =
          i < packed.size() * 8 ? (static_cast<unsigned char>(packed[i / 8]) >> (7 - i % 8)) & 1U : 0U;
      value = value * 2 + set;
    }
    out.push_back(alphabet[value]);
  }
  return out;
}

TEST(Token, BringsTheRequestAndTheEngineBack) {
  const auto token = read_token(write_token(plant, "1+abc"), 1'000);
  ASSERT_TRUE(token);
  EXPECT_EQ(token->engine, "1+abc");
  EXPECT_EQ(token->request, plant);
}

TEST(Token, FitsIntoAUrlWithoutEscapes) {
  EXPECT_THAT(write_token(plant, "1"), testing::MatchesRegex("[A-Za-z0-9_-]+"));
}

TEST(Token, ContainsAnEmptyRequest) {
  const auto token = read_token(write_token("{}", "1"), 100);
  ASSERT_TRUE(token);
  EXPECT_EQ(token->request, "{}");
  EXPECT_EQ(token->engine, "1");
}

TEST(Token, MayCarryNoEngine) {
  const auto token = read_token(base64url_of_deflated(plant), 1'000);
  ASSERT_TRUE(token);
  EXPECT_FALSE(token->engine);
  EXPECT_EQ(token->request, plant);
}

TEST(Token, MayCarryTheEngineAnywhere) {
  const auto token =
      read_token(base64url_of_deflated(R"({"seed": 3, "engine": "7", "generator": "tree"})"), 1'000);
  ASSERT_TRUE(token);
  EXPECT_EQ(token->engine, "7");
  EXPECT_THAT(token->request, testing::Not(testing::HasSubstr("engine")));
  EXPECT_THAT(token->request, testing::HasSubstr("tree"));
}

TEST(Token, RefusesWhatIsNoToken) {
  const std::string whole = write_token(plant, "1");
  for (const std::string& text :
       {std::string(), std::string("AAAA"), std::string("===="), std::string("a b"), whole + "A",
        whole.substr(0, whole.size() / 2), base64url_of_deflated("[1,2]"), base64url_of_deflated("not JSON"),
        base64url_of_deflated(R"({"engine":1})"), base64url_of_deflated(std::string(100'000, '['))}) {
    const auto token = read_token(text, 1'000'000);
    ASSERT_FALSE(token) << text;
    EXPECT_EQ(token.error().code, Code::malformed);
  }
}

TEST(Token, DoesNotOpenToMoreThanIsAllowed) {
  const std::string bomb = write_token("{\"a\":\"" + std::string(1'000'000, 'a') + "\"}", "1");
  EXPECT_LT(bomb.size(), 3'000U);
  EXPECT_FALSE(read_token(bomb, 100'000));
  EXPECT_TRUE(read_token(bomb, 2'000'000));
}

TEST(Inflate, RefusesWhatFollowsTheEnd) {
  const std::string packed = deflate_raw("abc");
  EXPECT_EQ(inflate_raw(packed, 3), "abc");
  EXPECT_FALSE(inflate_raw(packed, 2));
  EXPECT_FALSE(inflate_raw(packed + "x", 10));
  EXPECT_FALSE(inflate_raw(packed.substr(0, packed.size() - 1), 10));
}

}  // namespace
}  // namespace seedmesh
