#include "server/http/response_writer.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <thread>

namespace seedmesh::http {
namespace {

/// What a client receives of a response, until the connection ends.
std::string received(const Request& request, const Response& response) {
  int sockets[2];
  EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK, 0, sockets), 0);
  std::string all;
  std::thread client([&] {
    ::fcntl(sockets[1], F_SETFL, 0);
    char part[4'096];
    while (const auto size = ::read(sockets[1], part, sizeof(part)))
      all.append(part, static_cast<std::size_t>(size));
  });
  {
    Connection connection(sockets[0], nullptr, {.timeout = std::chrono::seconds(5)});
    EXPECT_TRUE(write_response(connection, request, response));
    EXPECT_GE(connection.sent(), 1U);
  }
  client.join();
  EXPECT_EQ(::close(sockets[1]), 0);
  return all;
}

std::string body_of(const std::string& text) { return text.substr(text.find("\r\n\r\n") + 4); }

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

Request get() {
  Request request;
  request.method = "GET";
  request.id = "abc";
  return request;
}

Response with_payload(std::uint64_t offset, std::uint64_t length) {
  auto payload = std::make_shared<Payload>();
  payload->add(std::string(100'000, 'a'));
  payload->add("bcd");
  payload->add(std::string(50'000, 'e'));
  Response response;
  response.type = "model/gltf-binary";
  response.body = Slice{payload, offset, length};
  return response;
}

TEST(ResponseWriter, WritesStatusFieldsAndLength) {
  Response response;
  response.status = 404;
  response.type = "text/plain";
  response.set("Vary", "Accept");
  response.body = "gone";
  const std::string text = received(get(), response);
  EXPECT_EQ(text.rfind("HTTP/1.1 404 Not Found\r\n", 0), 0U);
  for (const char* line :
       {"\r\nVary: Accept\r\n", "\r\nContent-Type: text/plain\r\n", "\r\nContent-Length: 4\r\n",
        "\r\nX-Request-Id: abc\r\n", "\r\nX-Content-Type-Options: nosniff\r\n", " GMT\r\n"})
    EXPECT_TRUE(contains(text, line)) << line;
  EXPECT_FALSE(contains(text, "Connection:"));
  EXPECT_EQ(body_of(text), "gone");
}

TEST(ResponseWriter, HasNoLengthWhereThereCanBeNoBody) {
  for (const int status : {204, 304}) {
    Response response;
    response.status = status;
    const std::string text = received(get(), response);
    EXPECT_FALSE(contains(text, "Content-Length")) << status;
    EXPECT_EQ(body_of(text), "");
  }
}

TEST(ResponseWriter, AnswersHeadWithTheLengthAlone) {
  Request request = get();
  request.method = "HEAD";
  const std::string text = received(request, with_payload(0, 150'003));
  EXPECT_TRUE(contains(text, "\r\nContent-Length: 150003\r\n"));
  EXPECT_EQ(body_of(text), "");
}

TEST(ResponseWriter, SendsASliceAcrossThePiecesOfAPayload) {
  EXPECT_EQ(body_of(received(get(), with_payload(99'998, 7))), "aabcdee");
  EXPECT_EQ(body_of(received(get(), with_payload(100'001, 1))), "c");
  EXPECT_EQ(body_of(received(get(), with_payload(0, 150'003))).size(), 150'003U);
}

TEST(ResponseWriter, SendsAStreamInChunks) {
  Response response;
  response.type = "text/event-stream";
  response.body = Stream([](const Write& write) {
    EXPECT_TRUE(write("0123456789abcdef"));
    EXPECT_TRUE(write(""));
    EXPECT_TRUE(write("x"));
  });
  const std::string text = received(get(), response);
  EXPECT_TRUE(contains(text, "\r\nTransfer-Encoding: chunked\r\n"));
  EXPECT_FALSE(contains(text, "Content-Length"));
  EXPECT_EQ(body_of(text), "10\r\n0123456789abcdef\r\n1\r\nx\r\n0\r\n\r\n");
}

TEST(ResponseWriter, LeavesOutAFieldThatWouldSplitTheResponse) {
  Response response;
  response.set("Location", "/a\r\nSet-Cookie: b");
  response.set("A\nB", "c");
  const std::string text = response_head(get(), response);
  EXPECT_FALSE(contains(text, "Set-Cookie") || contains(text, "A\nB"));
}

TEST(ResponseWriter, AnnouncesThatTheConnectionCloses) {
  Response response;
  response.close = true;
  EXPECT_TRUE(contains(response_head(get(), response), "\r\nConnection: close\r\n"));
}

}  // namespace
}  // namespace seedmesh::http
