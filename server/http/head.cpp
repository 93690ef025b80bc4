#include "server/http/head.h"

#include <algorithm>

namespace seedmesh::http {
namespace {

Refusal bad(std::string detail) { return {400, std::move(detail)}; }

bool is_token_char(char c) {
  const bool alphanumeric = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
  return alphanumeric || std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos;
}

bool is_token(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), is_token_char);
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// The next line without its CRLF; false at a CR or LF that stands alone.
bool take_line(std::string_view& rest, std::string_view& line) {
  const auto end = rest.find_first_of("\r\n");
  if (end == std::string_view::npos || rest.substr(end, 2) != "\r\n") return false;
  line = rest.substr(0, end);
  rest.remove_prefix(end + 2);
  return true;
}

/// "" where the path is sound, else what is wrong with it.
std::string fault_of_path(std::string_view path) {
  std::string decoded;
  if (!percent_decode(path, Plus::literal, decoded)) return "The path has a malformed percent escape.";
  if (decoded.find('\0') != std::string::npos) return "The path has a NUL character.";
  for (std::string_view rest = decoded; !rest.empty();) {
    const auto slash = std::min(rest.find_first_of("/\\"), rest.size());
    const std::string_view segment = rest.substr(0, slash);
    if (segment == "." || segment == "..") return "The path has a dot segment.";
    rest.remove_prefix(std::min(slash + 1, rest.size()));
  }
  return {};
}

Refusal read_request_line(std::string_view line, const HeadLimits& limits, Request& request) {
  const auto first = line.find(' ');
  const auto last = line.rfind(' ');
  if (first == std::string_view::npos || first == last) return bad("The request line has not three parts.");
  const std::string_view method = line.substr(0, first);
  const std::string_view version = line.substr(last + 1);
  std::string_view target = line.substr(first + 1, last - first - 1);
  if (!is_token(method) || method.size() > 32) return bad("The method is not a token.");
  if (version.substr(0, 5) != "HTTP/" || version.size() != 8)
    return bad("The request line ends without a version.");
  if (version != "HTTP/1.1" && version != "HTTP/1.0")
    return {505, "Only HTTP/1.1 and HTTP/1.0 are spoken here."};
  if (target.size() > limits.target) {
    return {414, "The request target is longer than " + std::to_string(limits.target) + " characters."};
  }
  const auto printable = [](char c) { return c > 0x20 && c < 0x7F; };
  if (!std::all_of(target.begin(), target.end(), printable))
    return bad("The request target has a forbidden character.");
  // The absolute form is meant for proxies, but every server has to take it (RFC 9112 section 3.2.2).
  for (std::string_view scheme : {"http://", "https://"}) {
    if (target.substr(0, scheme.size()) != scheme) continue;
    target.remove_prefix(std::min(target.find('/', scheme.size()), target.size()));
    if (target.empty()) target = "/";
  }
  if (target.front() != '/' && !(target == "*" && method == "OPTIONS")) {
    return bad("The request target does not begin with a slash.");
  }
  request.method = method;
  request.minor = version.back() - '0';
  request.target = target.substr(0, target.find('#'));
  const auto question = std::min(request.target.find('?'), request.target.size());
  request.path = request.target.substr(0, question);
  request.query = request.target.substr(std::min(question + 1, request.target.size()));
  const std::string fault = fault_of_path(request.path);
  return fault.empty() ? Refusal{0, {}} : bad(fault);
}

Refusal read_field(std::string_view line, Request& request) {
  const auto colon = line.find(':');
  if (colon == std::string_view::npos || !is_token(line.substr(0, colon)))
    return bad("A header field has no valid name.");
  const std::string_view value = trimmed(line.substr(colon + 1));
  const auto control = [](char c) {
    return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7F;
  };
  if (std::any_of(value.begin(), value.end(), control)) return bad("A header field has a control character.");
  request.headers.emplace_back(line.substr(0, colon), value);
  return {0, {}};
}

std::size_t count_of(const Headers& headers, std::string_view name) {
  const auto named = [&](const auto& field) { return same_name(field.first, name); };
  return static_cast<std::size_t>(std::count_if(headers.begin(), headers.end(), named));
}

bool lists(std::string_view list, std::string_view word) {
  while (!list.empty()) {
    const auto comma = std::min(list.find(','), list.size());
    if (same_name(trimmed(list.substr(0, comma)), word)) return true;
    list.remove_prefix(std::min(comma + 1, list.size()));
  }
  return false;
}

Refusal read_length(const Request& request, const HeadLimits& limits, std::uint64_t& length) {
  const std::size_t lengths = count_of(request.headers, "Content-Length");
  if (request.has_header("Transfer-Encoding")) {
    if (lengths > 0) return bad("Content-Length and Transfer-Encoding exclude each other.");
    return {411, "Send the body with Content-Length; Transfer-Encoding is not taken."};
  }
  const bool has_body = request.method == "POST" || request.method == "PUT" || request.method == "PATCH";
  if (lengths == 0) return has_body ? Refusal{411, "Content-Length is missing."} : Refusal{0, {}};
  const std::string text = request.header("Content-Length");
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  if (lengths > 1 || text.empty() || !std::all_of(text.begin(), text.end(), digit)) {
    return bad("Content-Length is not one number.");
  }
  if (text.size() > 15 || (length = std::stoull(text)) > limits.body) {
    return {413, "The body is larger than " + std::to_string(limits.body) + " bytes."};
  }
  return {0, {}};
}

}  // namespace

bool percent_decode(std::string_view text, Plus plus, std::string& out) {
  out.clear();
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '%') {
      if (i + 2 >= text.size() || hex_digit(text[i + 1]) < 0 || hex_digit(text[i + 2]) < 0) return false;
      out.push_back(static_cast<char>(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2])));
      i += 2;
    } else {
      out.push_back(text[i] == '+' && plus == Plus::space ? ' ' : text[i]);
    }
  }
  return true;
}

Refusal too_long(std::string_view unfinished, const HeadLimits& limits) {
  const std::size_t around_target = 32 + sizeof("  HTTP/1.1\r\n");  // method and version
  if (std::min(unfinished.find('\n'), unfinished.size()) > limits.target + around_target) {
    return {414, "The request target is longer than " + std::to_string(limits.target) + " characters."};
  }
  if (unfinished.size() > limits.head) {
    return {431, "The header fields are larger than " + std::to_string(limits.head) + " bytes."};
  }
  return {0, {}};
}

std::variant<Head, Refusal> read_head(std::string_view text, const HeadLimits& limits) {
  Head head;
  Request& request = head.request;
  std::string_view line;
  if (!take_line(text, line)) return bad("A line does not end with CR LF.");
  if (Refusal refusal = read_request_line(line, limits, request); refusal.status) return refusal;
  while (true) {
    if (!take_line(text, line)) return bad("A line does not end with CR LF.");
    if (line.empty()) break;
    if (request.headers.size() == limits.fields) {
      return Refusal{431, "There are more than " + std::to_string(limits.fields) + " header fields."};
    }
    if (Refusal refusal = read_field(line, request); refusal.status) return refusal;
  }

  const std::size_t hosts = count_of(request.headers, "Host");
  if (hosts > 1 || (hosts == 0 && request.minor == 1)) return bad("A request names exactly one Host.");
  if (Refusal refusal = read_length(request, limits, head.length); refusal.status) return refusal;
  if (head.length > 0 && request.has_header("Content-Encoding") &&
      !same_name(request.header("Content-Encoding"), "identity")) {
    return Refusal{415, "Send the body without Content-Encoding."};
  }
  const std::string connection = request.header("Connection");
  head.keep_alive = request.minor == 1 ? !lists(connection, "close") : lists(connection, "keep-alive");
  head.expects_continue = request.minor == 1 && same_name(request.header("Expect"), "100-continue");
  if (request.has_header("Expect") && !head.expects_continue && request.minor == 1) {
    return Refusal{417, "Only Expect: 100-continue is known here."};
  }
  return head;
}

}  // namespace seedmesh::http
