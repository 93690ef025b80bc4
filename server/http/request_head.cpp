#include "server/http/request_head.h"

#include <algorithm>
#include <array>

#include "server/http/text.h"

namespace seedmesh::http {
namespace {

using Check = std::optional<Refusal>;

constexpr std::size_t longest_method = 32;

Refusal bad(std::string detail) { return {400, std::move(detail)}; }

Refusal too_long_target(const HeadLimits& limits) {
  return {414, "The request target is longer than " + std::to_string(limits.target) + " characters."};
}

/// A set of characters: digits, letters and `others`.
constexpr std::array<bool, 256> alphanumeric_and(std::string_view others) {
  std::array<bool, 256> set{};
  for (char c = '0'; c <= '9'; ++c) set[static_cast<unsigned char>(c)] = true;
  for (char c = 'a'; c <= 'z'; ++c) set[static_cast<unsigned char>(c)] = true;
  for (char c = 'A'; c <= 'Z'; ++c) set[static_cast<unsigned char>(c)] = true;
  for (const char c : others) set[static_cast<unsigned char>(c)] = true;
  return set;
}
constexpr std::array<bool, 256> token_chars = alphanumeric_and("!#$%&'*+-.^_`|~"),
                                host_chars = alphanumeric_and("-._~!$&'()*+,;=%");

bool consists_of(const std::array<bool, 256>& set, std::string_view text) {
  return std::all_of(text.begin(), text.end(), [&](char c) { return set[static_cast<unsigned char>(c)]; });
}

bool is_token(std::string_view text) { return !text.empty() && consists_of(token_chars, text); }

/// Takes the next line without its CRLF. False at a CR or LF that stands alone.
bool take_line(std::string_view& rest, std::string_view& line) {
  const auto end = rest.find('\r');
  if (end == std::string_view::npos || rest.substr(end, 2) != "\r\n") return false;
  line = rest.substr(0, end);
  if (line.find('\n') != std::string_view::npos) return false;
  rest.remove_prefix(end + 2);
  return true;
}

Check check_path(std::string_view path) {
  const std::optional<std::string> decoded = percent_decode(path);
  if (!decoded) return bad("The path contains an invalid percent escape.");
  if (decoded->find('\0') != std::string::npos) return bad("The path contains a NUL character.");
  for (std::string_view rest = *decoded; !rest.empty();) {
    const auto slash = std::min(rest.find_first_of("/\\"), rest.size());
    const std::string_view segment = rest.substr(0, slash);
    if (segment == "." || segment == "..") return bad("The path contains a dot segment.");
    rest.remove_prefix(std::min(slash + 1, rest.size()));
  }
  return {};
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Whether a text is `uri-host [ ":" port ]` (RFC 9112 section 3.2, RFC 3986 section 3.2): a name, an IPv4
/// address, or an IPv6 address in brackets.
bool is_host(std::string_view text) {
  const auto end = text.substr(0, 1) == "[" ? text.find(']') : std::min(text.find(':'), text.size()) - 1;
  if (text.empty() || text.front() == ':' || end == std::string_view::npos) return false;
  const std::string_view host = text.substr(0, end + 1), port = text.substr(end + 1);
  if (!port.empty() &&
      (port.front() != ':' || port.size() > 6 || !std::all_of(port.begin() + 1, port.end(), is_digit)))
    return false;
  if (host.front() == '[') {
    const std::string_view address = host.substr(1, host.size() - 2);
    return address.find_first_not_of("0123456789abcdefABCDEF:.") == std::string_view::npos &&
           address.find(':') != std::string_view::npos;
  }
  return consists_of(host_chars, host) && percent_decode(host).has_value();
}

/// Removes scheme and authority from a target. The absolute form is meant for proxies, but every server has to
/// accept it (RFC 9112 section 3.2.2). False where the authority is not a host.
bool to_origin_form(std::string_view& target) {
  for (std::string_view scheme : {"http://", "https://"}) {
    if (target.substr(0, scheme.size()) != scheme) continue;
    const auto end = std::min(target.find_first_of("/?#", scheme.size()), target.size());
    const std::string_view authority = target.substr(scheme.size(), end - scheme.size());
    target.remove_prefix(end);
    if (target.empty()) target = "/";
    return is_host(authority);
  }
  return true;
}

Check parse_request_line(std::string_view line, const HeadLimits& limits, Request& request) {
  const auto first = line.find(' ');
  const auto last = line.rfind(' ');
  if (first == std::string_view::npos || first == last)
    return bad("The request line does not have three parts.");
  const std::string_view method = line.substr(0, first), version = line.substr(last + 1);
  std::string_view target = line.substr(first + 1, last - first - 1);
  if (!is_token(method) || method.size() > longest_method) return bad("The method is not a token.");
  if (version.substr(0, 5) != "HTTP/" || version.size() != 8)
    return bad("The request line does not end with an HTTP version.");
  if (version != "HTTP/1.1" && version != "HTTP/1.0")
    return Refusal{505, "Only HTTP/1.1 and HTTP/1.0 are supported."};
  if (target.size() > limits.target) return too_long_target(limits);
  const auto printable = [](char c) { return c > 0x20 && c < 0x7F; };
  if (!std::all_of(target.begin(), target.end(), printable))
    return bad("The request target contains a forbidden character.");
  if (!to_origin_form(target)) return bad("The request target does not name a valid host.");
  if (target.substr(0, 1) != "/" && !(target == "*" && method == "OPTIONS"))
    return bad("The request target does not begin with a slash.");
  request.method = method;
  request.minor = version.back() - '0';
  request.target = target.substr(0, target.find('#'));
  const auto question = std::min(request.target.find('?'), request.target.size());
  request.path = request.target.substr(0, question);
  request.query = request.target.substr(std::min(question + 1, request.target.size()));
  return check_path(request.path);
}

Check parse_field(std::string_view line, Request& request) {
  const auto colon = line.find(':');
  if (colon == std::string_view::npos || !is_token(line.substr(0, colon)))
    return bad("A header field does not have a valid name.");
  const std::string_view value = trimmed(line.substr(colon + 1));
  const auto control = [](char c) {
    return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F;
  };
  if (std::any_of(value.begin(), value.end(), control))
    return bad("A header field contains a control character.");
  request.headers.emplace_back(line.substr(0, colon), value);
  return {};
}

bool contains_element(std::string_view list, std::string_view word) {
  while (!list.empty()) {
    if (equals_ignoring_case(take_part(list, ','), word)) return true;
  }
  return false;
}

Check parse_length(const Request& request, const HeadLimits& limits, std::uint64_t& length) {
  const std::size_t lengths = field_count(request.headers, "Content-Length");
  if (request.has_header("Transfer-Encoding")) {
    if (lengths > 0) return bad("Content-Length and Transfer-Encoding exclude each other.");
    return Refusal{411,
                   "found Transfer-Encoding, expected Content-Length with the number of bytes of the body"};
  }
  const bool has_body = request.method == "POST" || request.method == "PUT" || request.method == "PATCH";
  if (lengths == 0)
    return has_body ? Check(Refusal{
                          411, "found no Content-Length, expected one with the number of bytes of the body"})
                    : std::nullopt;
  const std::string text = request.header("Content-Length");
  if (lengths > 1 || text.empty() || !std::all_of(text.begin(), text.end(), is_digit))
    return bad("Content-Length is not one number.");
  const auto value = parse_number<std::uint64_t>(text);
  if (!value || *value > limits.body)
    return Refusal{413, "The body is larger than " + std::to_string(limits.body) + " bytes."};
  length = *value;
  return {};
}

}  // namespace

std::optional<Refusal> check_partial_head(std::string_view text, const HeadLimits& limits) {
  const std::size_t beside_target = longest_method + sizeof("  HTTP/1.1\r\n");
  if (std::min(text.find('\n'), text.size()) > limits.target + beside_target) return too_long_target(limits);
  if (text.size() > limits.head)
    return Refusal{431, "The header fields are larger than " + std::to_string(limits.head) + " bytes."};
  return {};
}

Request legible_part(std::string_view text, const HeadLimits& limits) {
  Request request;
  const auto next_line = [&text] {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  };
  const std::string_view first = next_line(), method = first.substr(0, first.find(' '));
  if (parse_request_line(first, limits, request)) {
    request = {};
    if (is_token(method) && method.size() <= longest_method) request.method = method;
  }
  while (text.find('\n') != std::string_view::npos && request.headers.size() < limits.fields) {
    const std::string_view line = next_line();
    if (line.empty()) break;
    parse_field(line, request);
  }
  return request;
}

std::variant<RequestHead, Refusal> parse_head(std::string_view text, const HeadLimits& limits) {
  RequestHead head;
  Request& request = head.request;
  const Refusal bad_line_end = bad("A line does not end with CR LF.");
  std::string_view line;
  if (!take_line(text, line)) return bad_line_end;
  if (Check refusal = parse_request_line(line, limits, request)) return *refusal;
  while (true) {
    if (!take_line(text, line)) return bad_line_end;
    if (line.empty()) break;
    if (request.headers.size() == limits.fields)
      return Refusal{431, "There are more than " + std::to_string(limits.fields) + " header fields."};
    if (Check refusal = parse_field(line, request)) return *refusal;
  }

  const std::size_t hosts = field_count(request.headers, "Host");
  if (hosts > 1 || (hosts == 0 && request.minor == 1)) return bad("A request needs exactly one Host field.");
  if (hosts == 1 && !is_host(request.header("Host")))
    return bad("The Host field is not a host with or without a port.");
  if (Check refusal = parse_length(request, limits, head.length)) return *refusal;
  if (head.length > 0 && request.has_header("Content-Encoding") &&
      !equals_ignoring_case(request.header("Content-Encoding"), "identity"))
    return Refusal{415, "Send the body without Content-Encoding."};
  const std::string connection = request.header("Connection");
  head.keep_alive = request.minor == 1 ? !contains_element(connection, "close")
                                       : contains_element(connection, "keep-alive");
  head.expects_continue =
      request.minor == 1 && equals_ignoring_case(request.header("Expect"), "100-continue");
  if (request.has_header("Expect") && !head.expects_continue && request.minor == 1)
    return Refusal{417, "Only the expectation 100-continue is supported."};
  return head;
}

}  // namespace seedmesh::http
