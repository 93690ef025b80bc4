#include "server/request_file.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base/json_pointer.h"
#include "core/pipeline.h"
#include "server/json_positions.h"

namespace seedmesh {
namespace {

using Json = nlohmann::ordered_json;

constexpr int deepest = 64;  ///< as for requests
constexpr std::string_view own_members[] = {"$schema", "name", "outputs"};

std::string line_of(const std::string& path, TextPosition position, std::string_view pointer,
                    std::string_view message) {
  std::string line =
      path + ":" + std::to_string(position.line) + ":" + std::to_string(position.column) + ": ";
  if (!pointer.empty()) line.append(pointer).append(": ");
  return line.append(message);
}

/// The errors of a text that is not a JSON object. The reader of requests words them.
ErrorLines syntax_errors(const std::string& path, const std::string& text) {
  const Result<Request> request = read_request(text, Limits{});
  ErrorLines lines;
  if (!request) {
    for (const Issue& issue : request.error().issues) {
      const TextPosition position{std::max(issue.line, 1), std::max(issue.column, 1)};
      lines.push_back(line_of(path, position, issue.pointer, issue.message));
    }
  } else {
    lines.push_back(line_of(path, {}, "", "expected a JSON object"));
  }
  return lines;
}

bool is_file_name(std::string_view name) {
  const auto is_good = [](char c) {
    return static_cast<unsigned char>(c) >= 0x20 &&
           std::string_view("/\\:*?\"<>|").find(c) == std::string_view::npos;
  };
  return !name.empty() && name.front() != '.' && std::all_of(name.begin(), name.end(), is_good);
}

/// The row of the format that the members of output select; null for one that the reader of requests will refuse.
const FormatInfo* format_of(const Json& output) {
  const auto format = output.find("format");
  if (format == output.end()) return output_formats;
  const auto* const row =
      format->is_string() ? std::ranges::find(output_formats, format->get<std::string>(), &FormatInfo::name)
                          : std::end(output_formats);
  return row == std::end(output_formats) ? nullptr : row;
}

/// The reader of one file that is a JSON object.
class Splitter {
 public:
  Splitter(const std::string& path, const std::string& text, const Json& value)
      : path_(path), positions_(text), value_(value), request_(value) {
    for (const std::string_view member : own_members) request_.erase(std::string(member));
  }

  /// The outputs; none if there are errors.
  std::vector<RequestFileOutput> split() {
    if (const auto& twice = positions_.duplicate())
      errors_.push_back(line_of(path_, twice->position, "", "the key \"" + twice->key + "\" is given twice"));
    if (const auto output = request_.find("output"); output != request_.end() && !output->is_object())
      refuse("/output", "expected an object");
    const auto outputs = value_.find("outputs");
    if (outputs == value_.end() || outputs->is_null()) {
      add_default();
    } else if (!outputs->is_object() || outputs->empty()) {
      refuse("/outputs", "expected an object of file names, at least one");
    } else {
      for (const auto& [name, changes] : outputs->items()) add(name, changes);
    }
    return errors_.empty() ? std::move(outputs_) : std::vector<RequestFileOutput>();
  }

  ErrorLines errors() && { return std::move(errors_); }

 private:
  void refuse(std::string_view pointer, std::string_view message) {
    errors_.push_back(line_of(path_, positions_.of(pointer), pointer, message));
  }

  Json output() const {
    const auto found = request_.find("output");
    return found != request_.end() && found->is_object() ? *found : Json::object();
  }

  /// One output with the name of the file, in the format of the request.
  void add_default() {
    const auto slash = path_.find_last_of('/');
    std::string name = path_.substr(slash == std::string::npos ? 0 : slash + 1);
    name.resize(name.size() - request_file_suffix.size());
    if (const auto given = value_.find("name"); given != value_.end()) {
      name = given->is_string() ? given->get<std::string>() : "";
    }
    if (!is_file_name(name)) return refuse("/name", "expected the name of a file, without a directory");
    const FormatInfo* const format = format_of(output());
    outputs_.push_back({name + "." + std::string(format ? format->extension : "glb"), request_.dump()});
  }

  /// One of several outputs, which overrides members of the request's output.
  void add(const std::string& name, const Json& changes) {
    const std::string pointer = "/outputs" + pointer_token(name);
    if (!is_file_name(name) || name.ends_with(request_file_suffix))
      return refuse(pointer, "expected the name of a file, without a directory");
    if (!changes.is_object()) return refuse(pointer, "expected an object with members of output");
    Json merged = output();
    for (const auto& [key, value] : changes.items()) merged[key] = value;
    const Json every = merged;
    for (const auto& [key, value] : every.items()) {
      if (value.is_null()) merged.erase(key);
    }
    const FormatInfo* const format = format_of(merged);
    if (format && !name.ends_with("." + std::string(format->extension))) {
      return refuse(pointer, "expected the extension ." + std::string(format->extension) + " of the format " +
                                 std::string(format->name));
    }
    Json request = request_;
    request["output"] = std::move(merged);
    outputs_.push_back({name, request.dump()});
  }

  const std::string& path_;
  const JsonPositions positions_;
  const Json& value_;
  Json request_;  ///< without the members that only request files have
  std::vector<RequestFileOutput> outputs_;
  ErrorLines errors_;
};

/// The value of a JSON text; discarded if the text is not JSON or nests too deep.
Json parsed(const std::string& text) {
  bool is_deep = false;
  const auto watch_depth = [&](int depth, Json::parse_event_t, Json&) {
    is_deep = is_deep || depth > deepest;
    return !is_deep;
  };
  Json value = Json::parse(text, watch_depth, false);
  return is_deep ? Json(Json::value_t::discarded) : value;
}

}  // namespace

std::variant<RequestFile, ErrorLines> read_request_file(const std::string& path, std::string text) {
  const Json value = parsed(text);
  if (!value.is_object()) return syntax_errors(path, text);
  Splitter splitter(path, text, value);
  std::vector<RequestFileOutput> outputs = splitter.split();
  if (outputs.empty()) return std::move(splitter).errors();
  return RequestFile{path, std::move(text), std::move(outputs)};
}

ErrorLines error_lines(const RequestFile& file, std::string_view output, const std::vector<Issue>& issues) {
  const JsonPositions positions(file.text);
  const std::string changed = "/outputs" + pointer_token(output);
  constexpr std::string_view prefix = "/output";
  ErrorLines lines;
  for (const Issue& issue : issues) {
    std::string pointer = issue.pointer;
    if (pointer.starts_with("/output/")) {
      const std::string own = changed + pointer.substr(prefix.size());
      if (positions.contains(own)) pointer = own;
    }
    std::string message = issue.message;
    if (issue.line > 0) {
      message += " (line " + std::to_string(issue.line) + ", column " + std::to_string(issue.column) +
                 " of this text)";
    }
    lines.push_back(line_of(file.path, positions.of(pointer), pointer, message));
  }
  return lines;
}

}  // namespace seedmesh
