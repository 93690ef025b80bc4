#include "server/http/response_writer.h"

#include <algorithm>
#include <cstdio>
#include <ctime>

namespace seedmesh::http {
namespace {

/// Status codes with their phrases (RFC 9110 section 15).
constexpr std::string_view phrases =
    "200 OK|204 No Content|206 Partial Content|304 Not Modified|307 Temporary Redirect|400 Bad Request|"
    "401 Unauthorized|403 Forbidden|404 Not Found|405 Method Not Allowed|406 Not Acceptable|"
    "411 Length Required|413 Content Too Large|414 URI Too Long|415 Unsupported Media Type|"
    "416 Range Not Satisfiable|417 Expectation Failed|422 Unprocessable Content|429 Too Many Requests|"
    "431 Request Header Fields Too Large|499 Client Closed Request|500 Internal Server Error|"
    "503 Service Unavailable|504 Gateway Timeout|505 HTTP Version Not Supported|";

/// "404 Not Found"; the code and a space where there is no phrase for it.
std::string status_text(int status) {
  std::string code = std::to_string(status) + " ";
  const auto found = phrases.find(code);
  if (found == std::string_view::npos) return code;
  return std::string(phrases.substr(found, phrases.find('|', found) - found));
}

/// "Sun, 06 Nov 1994 08:49:37 GMT". Formatted once a second in each thread.
std::string_view http_date() {
  thread_local std::time_t at = -1;
  thread_local char text[40];
  thread_local std::size_t size = 0;
  const std::time_t now = std::time(nullptr);
  if (now != at) {
    std::tm utc{};
    ::gmtime_r(&now, &utc);
    size = std::strftime(text, sizeof(text), "%a, %d %b %Y %H:%M:%S GMT", &utc);
    at = now;
  }
  return {text, size};
}

bool has_body(int status) { return status != 204 && status != 304; }

/// A loop over characters: find_first_of() would call memchr() for each, a third of all work on a 304.
bool has_break(std::string_view text) {
  return std::any_of(text.begin(), text.end(), [](char c) { return c == '\r' || c == '\n' || c == '\0'; });
}

void add_field(std::string& head, std::string_view name, std::string_view value) {
  if (has_break(name) || has_break(value)) return;
  head += name;
  head += ": ";
  head += value;
  head += "\r\n";
}

bool write_slice(Connection& connection, const Slice& slice) {
  std::uint64_t skip = slice.offset, left = slice.length;
  for (const auto piece : slice.payload->pieces()) {
    if (left == 0) break;
    if (skip >= piece.size()) {
      skip -= piece.size();
      continue;
    }
    const std::uint64_t count = std::min<std::uint64_t>(piece.size() - skip, left);
    if (!connection.write({reinterpret_cast<const char*>(piece.data()) + skip, count})) return false;
    left -= count;
    skip = 0;
  }
  return true;
}

/// Small pieces are sent at once. The end of a large one is sent with what follows.
bool write_chunks(Connection& connection, const Stream& stream) {
  constexpr std::size_t large = 32 * 1'024;
  stream([&](std::string_view piece) {
    if (piece.empty()) return !connection.broken();  // an empty chunk would end the body
    char size[24];
    connection.write(
        {size, static_cast<std::size_t>(std::snprintf(size, sizeof(size), "%zx\r\n", piece.size()))});
    connection.write(piece);
    connection.write("\r\n");
    return piece.size() >= large ? !connection.broken() : connection.flush();
  });
  return connection.write("0\r\n\r\n");
}

}  // namespace

std::string response_head(const Request& request, const Response& response) {
  std::string head;
  head.reserve(1'024);
  head += "HTTP/1.1 " + status_text(response.status) + "\r\n";
  for (const auto& [name, value] : response.headers) add_field(head, name, value);
  if (has_body(response.status)) {
    if (!response.type.empty()) add_field(head, "Content-Type", response.type);
    if (const auto* text = std::get_if<std::string>(&response.body)) {
      add_field(head, "Content-Length", std::to_string(text->size()));
    } else if (const auto* slice = std::get_if<Slice>(&response.body)) {
      add_field(head, "Content-Length", std::to_string(slice->length));
    } else {
      add_field(head, "Transfer-Encoding", "chunked");
    }
  }
  add_field(head, "Date", http_date());
  add_field(head, "X-Content-Type-Options", "nosniff");
  add_field(head, "X-Request-Id", request.id);
  if (response.close) add_field(head, "Connection", "close");
  if (!response.close && request.minor == 0) add_field(head, "Connection", "keep-alive");
  return head += "\r\n";
}

bool write_response(Connection& connection, const Request& request, const Response& response) {
  connection.begin_response();
  bool complete = connection.write(response_head(request, response));
  if (complete && has_body(response.status) && request.method != "HEAD") {
    if (const auto* text = std::get_if<std::string>(&response.body)) {
      complete = connection.write(*text);
    } else if (const auto* slice = std::get_if<Slice>(&response.body)) {
      complete = write_slice(connection, *slice);
    } else {
      complete = write_chunks(connection, std::get<Stream>(response.body));
    }
  }
  return connection.flush() && complete;
}

}  // namespace seedmesh::http
