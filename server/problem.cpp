#include "server/problem.h"

#include <algorithm>
#include <nlohmann/json.hpp>

namespace seedmesh {
namespace {

std::string_view title_of(const Problem& problem) {
  for (const ProblemKind& kind : problem_kinds()) {
    if (kind.word == problem.word) return kind.title;
  }
  return "Error";
}

std::string joined_messages(const Error& error) {
  std::string all;
  for (const Issue& issue : error.issues) all += (all.empty() ? "" : "; ") + issue.message;
  return all;
}

std::string summary(const Error& error) {
  if (error.issues.size() == 1) return error.issues.front().message;
  std::uint64_t listed = 0, unlisted = 0;
  for (const Issue& issue : error.issues) {
    listed += issue.kind == IssueKind::truncated_list ? 0 : 1;
    unlisted += issue.unlisted;
  }
  const std::string found = std::to_string(listed + unlisted) + " errors were found; `errors` lists ";
  return found + (unlisted > 0 ? "the first " + std::to_string(listed) + "." : "them all.");
}

nlohmann::ordered_json json_of(const Issue& issue) {
  nlohmann::ordered_json entry = {
      {"pointer", issue.pointer}, {"code", word_of(issue.kind)}, {"message", issue.message}};
  if (issue.line > 0) entry["line"] = issue.line;
  if (issue.column > 0) entry["column"] = issue.column;
  if (issue.limit) {
    entry["resource"] = word_of(issue.limit->resource);
    entry["limit"] = issue.limit->bound;
    entry["needed"] = issue.limit->needed;
  }
  if (issue.unlisted > 0) entry["unlisted"] = issue.unlisted;
  return entry;
}

}  // namespace

const std::vector<ProblemKind>& problem_kinds() {
  static const std::vector<ProblemKind> kinds = {
      {400, "malformed-request", "The request is malformed"},
      {401, "unauthorized", "A key is required"},
      {403, "forbidden", "This is not allowed"},
      {404, "not-found", "This URL does not exist"},
      {405, "method-not-allowed", "The method is not allowed here"},
      {406, "not-acceptable", "No acceptable representation"},
      {411, "length-required", "Content-Length is required"},
      {413, "content-too-large", "The body is too large"},
      {414, "uri-too-long", "The URL is too long"},
      {415, "unsupported-media-type", "The media type of the body is not supported"},
      {416, "range-not-satisfiable", "The range lies outside the response"},
      {417, "expectation-failed", "The expectation cannot be met"},
      {422, "invalid-request", "The request is not valid"},
      {422, "limit-exceeded", "The request exceeds a limit"},
      {429, "queue-full", "Too many requests are waiting"},
      {429, "rate-limited", "Too many requests with this key"},
      {431, "headers-too-large", "The header fields are too large"},
      {499, "client-gone", "The client has disconnected"},
      {500, "internal-error", "Internal error"},
      {503, "unavailable", "The service cannot accept the request now"},
      {504, "deadline-exceeded", "The request took too long"},
      {505, "version-not-supported", "The version of HTTP is not supported"},
  };
  return kinds;
}

Problem problem(int status, std::string detail) {
  const auto& kinds = problem_kinds();
  const auto found =
      std::find_if(kinds.begin(), kinds.end(), [&](const auto& kind) { return kind.status == status; });
  assert(found != kinds.end());
  Problem made{status, std::string(found->word), std::move(detail), {}, {}, 0, {}};
  if (status == 429 || status == 503) made.retry_after = 1;
  return made;
}

Problem internal_error(std::string log_text) {
  Problem made = problem(500, "An internal error occurred. The instance identifies the request in the log.");
  made.log_text = std::move(log_text);
  return made;
}

Problem problem_of(const Error& error) {
  Problem made;
  switch (error.code) {
    case Code::malformed:
      made = problem(400, summary(error));
      break;
    case Code::invalid:
      made = problem(422, summary(error));
      break;
    case Code::limit:
      made = problem(422, summary(error));
      made.word = "limit-exceeded";
      break;
    case Code::deadline:
      made = problem(504, "The time limit has passed; the work has been stopped.");
      break;
    case Code::cancelled:
      made = problem(499, "The client has disconnected; the work has been stopped.");
      break;
    case Code::internal:
      return internal_error(joined_messages(error));
  }
  made.errors = error.issues;
  return made;
}

std::string_view limit_of(const Problem& problem) {
  for (const Issue& issue : problem.errors) {
    if (issue.limit) return word_of(issue.limit->resource);
  }
  return "other";
}

std::string problem_json(const Problem& problem, std::string_view instance, int indent) {
  nlohmann::ordered_json object = {
      {"type", "/docs#" + problem.word}, {"title", title_of(problem)}, {"status", problem.status},
      {"detail", problem.detail},        {"instance", instance},
  };
  if (!problem.format.empty()) object["format"] = problem.format;
  if (!problem.errors.empty()) {
    auto& errors = object["errors"] = nlohmann::ordered_json::array();
    for (const Issue& issue : problem.errors) errors.push_back(json_of(issue));
  }
  // A message may quote bytes of the client that are not valid UTF-8.
  return object.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

http::Response to_response(const Problem& problem, std::string_view instance) {
  http::Response response;
  response.status = problem.status;
  response.type = "application/problem+json";
  response.body = problem_json(problem, instance);
  response.log_text = problem.log_text;
  response.set("Cache-Control", "no-store");
  if (problem.retry_after > 0) response.set("Retry-After", std::to_string(problem.retry_after));
  return response;
}

}  // namespace seedmesh
