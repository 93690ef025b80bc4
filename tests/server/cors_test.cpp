#include "server/cors.h"

#include <gmock/gmock.h>

namespace seedmesh {
namespace {

using testing::HasSubstr;

http::Response answered(const std::vector<std::string>& origins, const http::Headers& headers,
                        const std::string& method = "GET") {
  http::Request request;
  request.method = method;
  request.headers = headers;
  http::Response response;
  response.set("Vary", "Accept-Encoding");
  allow_origin(origins, request, response);
  return response;
}

std::string field(const http::Response& response, std::string_view name) {
  return http::field_value(response.headers, name);
}

TEST(Cors, AddsNothingWhereNoOriginIsNamed) {
  EXPECT_EQ(answered({}, {{"Origin", "https://a.example"}}).headers.size(), 1U);
}

TEST(Cors, LetsTheNamedOriginsReadAndVaries) {
  const std::vector<std::string> origins = {"https://a.example", "https://b.example"};
  const http::Response allowed = answered(origins, {{"Origin", "https://b.example"}});
  EXPECT_EQ(field(allowed, "Access-Control-Allow-Origin"), "https://b.example");
  EXPECT_THAT(field(allowed, "Access-Control-Expose-Headers"), HasSubstr("Content-Location"));
  EXPECT_EQ(field(allowed, "Vary"), "Accept-Encoding, Origin");
  for (const http::Headers& headers : {http::Headers{{"Origin", "https://c.example"}}, http::Headers{}}) {
    const http::Response other = answered(origins, headers);
    EXPECT_EQ(http::field_count(other.headers, "Access-Control-Allow-Origin"), 0U);
    EXPECT_EQ(field(other, "Vary"), "Accept-Encoding, Origin")
        << "a cache must not give it to the named ones";
  }
}

TEST(Cors, AllowsEveryOriginByAnAsterisk) {
  const http::Response response = answered({"*"}, {{"Origin", "null"}});
  EXPECT_EQ(field(response, "Access-Control-Allow-Origin"), "*");
  EXPECT_EQ(field(response, "Vary"), "Accept-Encoding");
}

TEST(Cors, AnswersThePreflight) {
  const http::Response response = answered(
      {"*"}, {{"Origin", "https://a.example"}, {"Access-Control-Request-Method", "POST"}}, "OPTIONS");
  EXPECT_THAT(field(response, "Access-Control-Allow-Methods"), HasSubstr("POST"));
  EXPECT_THAT(field(response, "Access-Control-Allow-Headers"), HasSubstr("Authorization"));
  EXPECT_EQ(field(response, "Access-Control-Max-Age"), "86400");
}

}  // namespace
}  // namespace seedmesh
