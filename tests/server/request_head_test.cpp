#include "server/http/request_head.h"

#include <gtest/gtest.h>

namespace seedmesh::http {
namespace {

std::variant<RequestHead, Refusal> read(const std::string& text, HeadLimits limits = {}) {
  return parse_head(text, limits);
}

int status_of(const std::string& text, HeadLimits limits = {}) {
  const auto head = read(text, limits);
  const auto* refusal = std::get_if<Refusal>(&head);
  return refusal ? refusal->status : 0;
}

std::string get(const std::string& target, const std::string& fields = "") {
  return "GET " + target + " HTTP/1.1\r\nHost: here\r\n" + fields + "\r\n";
}

std::string post(const std::string& fields) { return "POST /a HTTP/1.1\r\nHost: here\r\n" + fields + "\r\n"; }

TEST(Head, TakesARequestApart) {
  const auto read_one = read(
      "POST /a/b%20c?x=1&y HTTP/1.1\r\nHost: here\r\nContent-Length: 12\r\nAccept:  a \r\naccept: b\r\n\r\n");
  const RequestHead& head = std::get<RequestHead>(read_one);
  EXPECT_EQ(head.request.method, "POST");
  EXPECT_EQ(head.request.target, "/a/b%20c?x=1&y");
  EXPECT_EQ(head.request.path, "/a/b%20c");
  EXPECT_EQ(head.request.query, "x=1&y");
  EXPECT_EQ(head.request.header("ACCEPT"), "a, b");
  EXPECT_EQ(head.length, 12U);
  EXPECT_TRUE(head.keep_alive);
}

TEST(Head, DeterminesWhenTheConnectionEnds) {
  EXPECT_FALSE(std::get<RequestHead>(read(get("/", "Connection: x, Close\r\n"))).keep_alive);
  EXPECT_FALSE(std::get<RequestHead>(read("GET / HTTP/1.0\r\n\r\n")).keep_alive);
  EXPECT_TRUE(std::get<RequestHead>(read("GET / HTTP/1.0\r\nConnection: keep-alive\r\n\r\n")).keep_alive);
}

TEST(Head, TakesTheAbsoluteForm) {
  EXPECT_EQ(std::get<RequestHead>(read(get("http://here:80/a?b"))).request.target, "/a?b");
  EXPECT_EQ(std::get<RequestHead>(read(get("http://here"))).request.target, "/");
}

TEST(Head, RefusesWhatTwoPartiesCouldReadInTwoWays) {
  EXPECT_EQ(status_of(post("Content-Length: 1\r\nContent-Length: 1\r\n")), 400);
  EXPECT_EQ(status_of(post("Content-Length: 1\r\nTransfer-Encoding: chunked\r\n")), 400);
  EXPECT_EQ(status_of(post("Content-Length: -1\r\n")), 400);
  EXPECT_EQ(status_of(post("Content-Length: 1, 1\r\n")), 400);
  EXPECT_EQ(status_of(post("Content-Length: 0x10\r\n")), 400);
  EXPECT_EQ(status_of(post("Content-Length:\r\n")), 400);
  EXPECT_EQ(status_of("GET / HTTP/1.1\nHost: here\n\n"), 400);
  EXPECT_EQ(status_of(get("/", "A: b\rC: d\r\n")), 400);
  EXPECT_EQ(status_of(get("/", "A: b\nC: d\r\n")), 400);
  EXPECT_EQ(status_of(get("/", "A : b\r\n")), 400);
  EXPECT_EQ(status_of(get("/", " folded: b\r\n")), 400);
  EXPECT_EQ(status_of(get("/", "Host: there\r\n")), 400);
  EXPECT_EQ(status_of("GET / HTTP/1.1\r\n\r\n"), 400);
  EXPECT_EQ(status_of(get("/", std::string("A: b\0c\r\n", 8))), 400);
}

/// RFC 9112 section 3.2 with RFC 3986 section 3.2.2; the second list has what the RFC calls invalid.
TEST(Head, TakesHostsAndRefusesWhatIsNone) {
  const auto status = [](const std::string& host) {
    return status_of("GET / HTTP/1.1\r\nHost:" + host + "\r\n\r\n");
  };
  for (const char* host : {"a", "example.org:8080", "127.0.0.1:", "[::1]", "[2001:db8::1]:443", " a-b_c.d ",
                           "a%20b", "xn--bcher-kva.example", "a,b", "a:65535"})
    EXPECT_EQ(status(host), 0) << host;
  for (const char* host : {"", ":80", "a b", "a/b", "http://a", "a:b", "a:80:90", "[::1", "::1", "[]", "[a]",
                           "a@b", "a?b", "a#b", "a%2", "a\\b", "<a>", "a:1234567"})
    EXPECT_EQ(status(host), 400) << host;
  EXPECT_EQ(status_of("GET http://a@b/ HTTP/1.1\r\nHost: here\r\n\r\n"), 400);
  EXPECT_EQ(status_of("GET http:///x HTTP/1.1\r\nHost: here\r\n\r\n"), 400);
  EXPECT_EQ(status_of("GET / HTTP/1.0\r\nHost: a b\r\n\r\n"), 400);
}

TEST(Head, RefusesPathsThatClimbOrHide) {
  for (const char* target :
       {"/../etc/passwd", "/a/%2e%2E/b", "/a/./b", "/a%2f..%2fb", "/a\\..\\b", "/%00", "/a%", "/a%g1", "a"}) {
    EXPECT_EQ(status_of(get(target)), 400) << target;
  }
  EXPECT_EQ(status_of(get("/a..b/...")), 0);
}

TEST(Head, RefusesRequestLinesThatAreNone) {
  for (const char* line : {"GET / \r\n", "GET  HTTP/1.1\r\n", "GET / HTTP/1.1 \r\n", "G(T / HTTP/1.1\r\n",
                           "\r\n", "GET /a b HTTP/1.1\r\n"}) {
    EXPECT_EQ(status_of(std::string(line) + "Host: here\r\n\r\n"), 400) << line;
  }
  EXPECT_EQ(status_of("GET / HTTP/2.0\r\nHost: here\r\n\r\n"), 505);
}

TEST(Head, LimitsBodiesToTheirLengthAndTheLimit) {
  HeadLimits limits;
  limits.body = 10;
  EXPECT_EQ(status_of(post("Content-Length: 10\r\n"), limits), 0);
  EXPECT_EQ(status_of(post("Content-Length: 11\r\n"), limits), 413);
  EXPECT_EQ(status_of(post("Content-Length: 99999999999999999999999\r\n"), limits), 413);
  EXPECT_EQ(status_of(post("")), 411);
  EXPECT_EQ(status_of(post("Transfer-Encoding: chunked\r\n")), 411);
  EXPECT_EQ(status_of(post("Content-Length: 5\r\nContent-Encoding: gzip\r\n")), 415);
  EXPECT_EQ(status_of(post("Content-Length: 5\r\nContent-Encoding: identity\r\n")), 0);
  EXPECT_EQ(status_of(post("Content-Length: 5\r\nExpect: a-miracle\r\n")), 417);
}

TEST(Head, LimitsLinesAndFields) {
  HeadLimits limits;
  limits.target = 100;
  limits.fields = 5;
  limits.head = 1'000;
  EXPECT_EQ(status_of(get("/" + std::string(99, 'a')), limits), 0);
  EXPECT_EQ(status_of(get("/" + std::string(100, 'a')), limits), 414);
  EXPECT_EQ(status_of(get("/", "a: 1\r\nb: 1\r\nc: 1\r\nd: 1\r\n"), limits), 0);
  EXPECT_EQ(status_of(get("/", "a: 1\r\nb: 1\r\nc: 1\r\nd: 1\r\ne: 1\r\n"), limits), 431);
  EXPECT_FALSE(check_partial_head("GET /" + std::string(50, 'a'), limits));
  EXPECT_EQ(check_partial_head("GET /" + std::string(500, 'a'), limits).value().status, 414);
  EXPECT_EQ(check_partial_head("GET / HTTP/1.1\r\nA: " + std::string(1'000, 'a'), limits).value().status,
            431);
}

TEST(Head, IsLegibleAsFarAsItsFieldsAreValid) {
  const Request whole = legible_part("HEAD / HTTP/9\r\nno field\r\nOrigin: a\r\nB : c\r\n\r\nD: e\r\n", {});
  EXPECT_EQ(whole.method, "HEAD");
  EXPECT_EQ(whole.headers, (Headers{{"Origin", "a"}}));
  EXPECT_EQ(whole.path, "") << "the first line is not valid";
  EXPECT_EQ(legible_part("PUT /v1/presets?a=b HTTP/1.1\r\nOrigin: a\r\n\r\n", {}).path, "/v1/presets");
  const Request cut = legible_part("G(T / HTTP/1.1\nA: 1\nOrigin: https://exam", {});
  EXPECT_EQ(cut.method, "");
  EXPECT_EQ(cut.headers, (Headers{{"A", "1"}})) << "the last line is not complete";
}

}  // namespace
}  // namespace seedmesh::http
