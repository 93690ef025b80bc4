#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "server/http/text.h"
#include "server/manifest.h"

namespace seedmesh {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t longest_name = 200;
constexpr int deepest = 64;

/// Returns "" for a path below the folder, else an error message.
std::string check_name(std::string_view name) {
  if (name.empty() || name.size() > longest_name) return "expected a name with 1 to 200 characters";
  for (std::string_view rest = name; !rest.empty();) {
    const auto slash = std::min(rest.find('/'), rest.size());
    const std::string_view segment = rest.substr(0, slash);
    if (segment.empty() || segment.front() == '.') return "a part of the name is empty or begins with a dot";
    const auto valid = [](char c) {
      return static_cast<unsigned char>(c) > 0x20 && c != 0x7F && c != '\\' && c != ':';
    };
    if (!std::all_of(segment.begin(), segment.end(), valid))
      return "the name contains a space, control character, backslash or colon";
    rest.remove_prefix(std::min(slash + 1, rest.size()));
  }
  return name.back() == '/' ? "the name ends with a slash" : "";
}

/// Parses one line into `job`. Returns the error.
std::optional<Issue> read_line(std::string_view text, ManifestJob& job) {
  bool deep = false;
  const auto watch_depth = [&](int depth, Json::parse_event_t, Json&) {
    deep = deep || depth > deepest;
    return !deep;
  };
  const Json line = Json::parse(text, watch_depth, false);
  if (deep || !line.is_object()) return Issue{IssueKind::wrong_type, "", "expected one JSON object"};
  if (!line.contains("request")) {
    job.request = text;
    return std::nullopt;
  }
  for (const auto& [key, value] : line.items()) {
    if (key != "request" && key != "name")
      return Issue{IssueKind::unknown_key, "/" + key, "expected only the members request and name"};
  }
  if (line.contains("name")) {
    if (!line["name"].is_string()) return Issue{IssueKind::wrong_type, "/name", "expected a string"};
    job.name = line["name"].get<std::string>();
    if (std::string error = check_name(job.name); !error.empty())
      return Issue{IssueKind::invalid_value, "/name", error};
  }
  if (!line["request"].is_object()) return Issue{IssueKind::wrong_type, "/request", "expected an object"};
  job.request = line["request"].dump();
  return std::nullopt;
}

}  // namespace

std::optional<ManifestPart> read_part(std::string_view text) {
  const auto slash = text.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const auto index = http::parse_number<std::size_t>(text.substr(0, slash));
  const auto count = http::parse_number<std::size_t>(text.substr(slash + 1));
  if (!index || !count || *index >= *count || *count > 1'000'000) return std::nullopt;
  return ManifestPart{*index, *count};
}

Result<std::vector<ManifestJob>> read_manifest(std::string_view text) {
  std::vector<ManifestJob> jobs;
  std::vector<Issue> issues;
  std::unordered_map<std::string, std::size_t> lines_by_name;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const auto end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.find_first_not_of(" \t\r") == std::string_view::npos) continue;
    ManifestJob job;
    job.line = number;
    auto issue = read_line(line, job);
    if (!issue) {
      if (job.name.empty()) {
        char name[32];
        std::snprintf(name, sizeof(name), "%06zu", number);
        job.name = name;
      }
      const auto [first, is_new] = lines_by_name.emplace(job.name, number);
      if (!is_new) {
        issue = Issue{IssueKind::duplicate_key, "/name",
                      "\"" + job.name + "\" is also the name of line " + std::to_string(first->second)};
      }
    }
    if (issue) {
      issue->line = static_cast<int>(number);
      issues.push_back(std::move(*issue));
    } else {
      jobs.push_back(std::move(job));
    }
  }
  if (!issues.empty()) return Error{Code::invalid, std::move(issues)};
  return jobs;
}

}  // namespace seedmesh
