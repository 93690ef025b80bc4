/// The head of a request of any bytes: it is taken or refused with a status, and what is taken reads the same
/// when it is written out again, so that nothing behind this reader can see another request in it.
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "server/http/request_head.h"

namespace {

using namespace seedmesh::http;

std::string written(const Request& request) {
  std::string text =
      request.method + " " + request.target + " HTTP/1." + std::to_string(request.minor) + "\r\n";
  for (const auto& [name, value] : request.headers) text += name + ": " + value + "\r\n";
  return text + "\r\n";
}

void expect(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const HeadLimits limits;
  const std::optional<Refusal> early = check_partial_head(text, limits);
  expect(!early || early->status == 414 || early->status == 431);
  const auto read = parse_head(text, limits);
  if (const auto* refusal = std::get_if<Refusal>(&read)) {
    expect(refusal->status >= 400 && refusal->status < 600 && !refusal->detail.empty());
    return 0;
  }
  const RequestHead& head = std::get<RequestHead>(read);
  const Request& request = head.request;
  expect(request.target.size() <= limits.target && request.headers.size() <= limits.fields);
  expect(head.length <= limits.body && !request.has_header("Transfer-Encoding"));
  expect(request.target == "*" || request.target.front() == '/');
  expect(request.path.find("/../") == std::string::npos);
  const auto again = parse_head(written(request), limits);
  const RequestHead* same = std::get_if<RequestHead>(&again);
  expect(same && same->request.method == request.method && same->request.target == request.target &&
         same->request.path == request.path && same->request.query == request.query &&
         same->request.headers == request.headers && same->length == head.length &&
         same->keep_alive == head.keep_alive && same->expects_continue == head.expects_continue);
  return 0;
}
