#include "server/problem.h"

#include <algorithm>
#include <charconv>
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

/// A list that would be too long ends with a line without a place that counts the rest, "and 899 more
/// faults": the number in it; 0 where the list is whole.
std::uint64_t unlisted(const std::vector<Issue>& issues) {
  constexpr std::string_view before = "and ", after = " more faults";
  const std::string_view text = issues.back().message;
  const bool counts = issues.back().pointer.empty() && text.starts_with(before) && text.ends_with(after) &&
                      text.size() > before.size() + after.size();
  std::uint64_t count = 0;
  if (counts) std::from_chars(text.data() + before.size(), text.data() + text.size(), count);
  return count;
}

std::string summary(const Error& error) {
  const std::size_t listed = error.issues.size();
  if (listed == 1) return error.issues.front().message;
  if (const std::uint64_t rest = unlisted(error.issues); rest > 0) {
    return std::to_string(listed - 1 + rest) + " faults were found; errors lists the first " +
           std::to_string(listed - 1) + ".";
  }
  return std::to_string(listed) + " faults were found; errors lists them all.";
}

}  // namespace

const std::vector<ProblemKind>& problem_kinds() {
  static const std::vector<ProblemKind> kinds = {
      {400, "malformed-request", "The request is malformed"},
      {401, "unauthorized", "A key is required"},
      {403, "forbidden", "This is not allowed"},
      {404, "not-found", "There is nothing here"},
      {405, "method-not-allowed", "The method is not allowed here"},
      {406, "not-acceptable", "No acceptable form of the answer"},
      {411, "length-required", "Content-Length is required"},
      {413, "content-too-large", "The body is too large"},
      {414, "uri-too-long", "The URL is too long"},
      {415, "unsupported-media-type", "The body is not of a type that is taken here"},
      {416, "range-not-satisfiable", "The range lies outside the answer"},
      {417, "expectation-failed", "The expectation cannot be met"},
      {422, "invalid-request", "The request is not valid"},
      {422, "limit-exceeded", "The request passes a limit"},
      {429, "queue-full", "Too many requests are waiting"},
      {429, "rate-limited", "Too many requests with this key"},
      {431, "headers-too-large", "The header fields are too large"},
      {499, "client-gone", "The client has gone"},
      {500, "internal-error", "Internal error"},
      {503, "unavailable", "The service cannot take the request now"},
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
  Problem made{status, std::string(found->word), std::move(detail), {}, 0, {}};
  if (status == 429 || status == 503) made.retry_after = 1;
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
      made = problem(499, "The client has gone; the work has been stopped.");
      break;
    case Code::internal:
      made = problem(500, "Something went wrong here. The instance names the request in the log.");
      made.log_text = joined_messages(error);
      return made;
  }
  made.errors = error.issues;
  return made;
}

std::string_view limit_of(const Problem& problem) {
  const std::string_view text = problem.errors.empty() ? problem.detail : problem.errors.front().message;
  // As Job and the generators name what they count.
  static constexpr std::pair<std::string_view, std::string_view> words[] = {
      {"memory", "memory"}, {"output bytes", "output"}, {"modules", "modules"},
      {"shapes", "shapes"}, {"triangles", "triangles"}, {"iterations", "iterations"},
      {"points", "points"}, {"segments", "segments"},   {"leaves", "leaves"},
      {"deep", "depth"},    {"depth", "depth"},         {"values", "values"},
  };
  for (const auto& [word, limit] : words) {
    if (text.find(word) != std::string_view::npos) return limit;
  }
  return "other";
}

std::string problem_json(const Problem& problem, std::string_view instance, int indent) {
  nlohmann::ordered_json object = {
      {"type", "/docs#" + problem.word}, {"title", title_of(problem)}, {"status", problem.status},
      {"detail", problem.detail},        {"instance", instance},
  };
  if (!problem.errors.empty()) {
    auto& errors = object["errors"] = nlohmann::ordered_json::array();
    for (const Issue& issue : problem.errors) {
      nlohmann::ordered_json entry = {{"pointer", issue.pointer}, {"message", issue.message}};
      if (issue.line > 0) entry["line"] = issue.line;
      if (issue.column > 0) entry["column"] = issue.column;
      errors.push_back(std::move(entry));
    }
  }
  // A message may quote what the client sent, and a quote may cut a character in two.
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
