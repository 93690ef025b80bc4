/// Models of a server, over HTTP.
#include <httplib.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/base64url.h"
#include "core/base/deflate.h"
#include "core/base/token.h"
#include "core/pipeline.h"
#include "server/http/text.h"
#include "server/model_source.h"

namespace seedmesh {
namespace {

using Json = nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr std::chrono::seconds patience{60};  ///< with a server that is busy
constexpr std::size_t longest_path = 8'000;

/// Waits, and ends early where a stop is requested.
void pause(std::chrono::milliseconds time, const std::stop_token& stop) {
  std::mutex mutex;
  std::condition_variable_any changed;
  std::unique_lock lock(mutex);
  changed.wait_for(lock, stop, time, [] { return false; });
}

/// How long to wait before the same call is repeated.
std::optional<std::chrono::milliseconds> wait_after(const httplib::Response& response) {
  if (response.status != 429 && response.status != 503) return std::nullopt;
  const auto seconds = http::parse_number<int>(response.get_header_value("Retry-After"));
  if (!seconds || *seconds < 0) return std::nullopt;
  return std::max(std::chrono::milliseconds(100), std::chrono::milliseconds(std::chrono::seconds(*seconds)));
}

/// A member that is a text; `fallback` where there is none, or where it is no text.
std::string text_in(const Json& object, const char* key, const std::string& fallback) {
  if (!object.is_object()) return fallback;
  const auto member = object.find(key);
  return member != object.end() && member->is_string() ? member->get<std::string>() : fallback;
}

int number_in(const Json& object, const char* key) {
  const auto member = object.find(key);
  return member != object.end() && member->is_number_unsigned() ? member->get<int>() : 0;
}

/// The errors of a problem document; its detail where it lists none.
std::vector<Issue> issues_of(const httplib::Response& response) {
  const Json problem = Json::parse(response.body, nullptr, false);
  const std::string status = "HTTP status " + std::to_string(response.status);
  const std::string detail = text_in(problem, "detail", text_in(problem, "title", status));
  std::vector<Issue> issues;
  if (problem.is_object() && problem.contains("errors")) {
    for (const Json& each : problem["errors"]) {
      if (!each.is_object()) continue;
      issues.emplace_back(IssueKind::invalid_value, text_in(each, "pointer", ""),
                          text_in(each, "message", detail), number_in(each, "line"),
                          number_in(each, "column"));
    }
  }
  if (issues.empty()) issues.emplace_back(IssueKind::invalid_value, "", detail);
  return issues;
}

/// The path of the permalink of a request; "" where it would be too long.
std::string permalink_of(const std::string& request) {
  const Json value = Json::parse(request, nullptr, false);
  const std::string token =
      base64url(deflate_raw(value.dump(-1, ' ', false, Json::error_handler_t::replace)));
  const auto output = value.find("output");
  const std::string format = output != value.end() ? text_in(*output, "format", "glb") : "glb";
  const auto* const row = std::ranges::find(output_formats, format, &FormatInfo::name);
  if (row == std::end(output_formats)) return "";
  const std::string path = permalink(token, row->extension);
  return path.size() > longest_path ? "" : path;
}

class RemoteSource final : public ModelSource {
 public:
  RemoteSource(std::string origin, std::string prefix, const std::string& key)
      : origin_(std::move(origin)), prefix_(std::move(prefix)), headers_{{"Accept-Encoding", "identity"}} {
    if (!key.empty()) headers_.emplace("Authorization", "Bearer " + key);
  }

  SourceEngine engine() override {
    const httplib::Result answer = ask("/version", nullptr, "", {});
    if (!answer) return {"", reason_of(answer)};
    const std::string version = text_in(Json::parse(answer->body, nullptr, false), "engine", "");
    if (answer->status == 200 && !version.empty()) return {version, ""};
    return {"", origin_ + prefix_ + "/version returned " + issues_of(*answer).front().message};
  }

  SourceResponse make(const std::string& request, const std::string& known, int,
                      const std::stop_token& stop) override {
    const std::string link = permalink_of(request);
    httplib::Result result =
        link.empty() ? ask("/v1/generate", &request, "", stop) : ask(link, nullptr, known, stop);
    SourceResponse answer;
    if (stop.stop_requested()) {
      answer.kind = SourceResponse::Kind::stopped;
    } else if (!result) {
      answer.kind = SourceResponse::Kind::unreachable;
      answer.reason = reason_of(result);
    } else if (result->status == 304) {
      answer.kind = SourceResponse::Kind::same;
    } else if (result->status == 200) {
      answer.etag = result->get_header_value("ETag");
      answer.payload.add(std::move(result->body));
    } else {
      answer.kind = SourceResponse::Kind::refused;
      answer.issues = issues_of(*result);
    }
    return answer;
  }

 private:
  std::string reason_of(const httplib::Result& result) const {
    return "no response from " + origin_ + prefix_ + " (" + httplib::to_string(result.error()) + ")";
  }

  /// GET, or POST with a body. Each call has a connection of its own, because calls run side by side.
  httplib::Result ask(const std::string& path, const std::string* body, const std::string& known,
                      const std::stop_token& stop) {
    httplib::Client client(origin_);
    client.set_connection_timeout(10);
    client.set_read_timeout(120);
    client.set_write_timeout(120);
    httplib::Headers headers = headers_;
    if (!known.empty()) headers.emplace("If-None-Match", known);
    const auto end = Clock::now() + patience;
    while (true) {
      httplib::Result answer = body ? client.Post(prefix_ + path, headers, *body, "application/json")
                                    : client.Get(prefix_ + path, headers);
      if (!answer) return answer;
      const auto wait = wait_after(*answer);
      if (!wait || Clock::now() + *wait > end || stop.stop_requested()) return answer;
      pause(*wait, stop);
    }
  }

  const std::string origin_;  ///< "http://host:port"
  const std::string prefix_;  ///< "" or a path without a slash at its end
  httplib::Headers headers_;
};

}  // namespace

std::unique_ptr<ModelSource> remote_source(const std::string& url, const std::string& key) {
  const auto scheme = url.find("://");
  if (scheme == std::string::npos || (url.substr(0, scheme) != "http" && url.substr(0, scheme) != "https"))
    return nullptr;
  const auto path = std::min(url.find('/', scheme + 3), url.size());
  if (path == scheme + 3) return nullptr;
  std::string prefix = url.substr(path);
  while (prefix.ends_with('/')) prefix.pop_back();
  return std::make_unique<RemoteSource>(url.substr(0, path), std::move(prefix), key);
}

}  // namespace seedmesh
