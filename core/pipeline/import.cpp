/// Import of foreign files. The reader of a format makes a request, which is then checked like any other, so
/// that the result can be sent back unchanged.
#include "core/import/import.h"

#include <algorithm>

#include "core/import/lparser.h"
#include "core/import/other_files.h"
#include "core/pipeline/body.h"
#include "core/pipeline/guarded.h"
#include "core/schema/json_syntax.h"
#include "core/schema/nearest.h"
#include "core/schema/warning_list.h"

namespace seedmesh {
namespace {

Error unknown_format(std::string_view name) {
  std::vector<std::string_view> names;
  std::string list;
  for (const ImportFormat& row : import_formats()) {
    names.push_back(row.name);
    list += (list.empty() ? "" : ", ") + std::string(row.name);
  }
  std::string message = name.empty() ? "found no keywords of a known format; expected one of " + list
                                     : schema::unknown_word_of_few("format", name, names);
  return {Code::invalid, {{IssueKind::unknown_name, "/format", std::move(message)}}};
}

/// The byte offset of line and column in `text`.
std::size_t byte_of(std::string_view text, int line, int column) {
  std::size_t at = 0;
  for (; line > 1 && at < text.size(); ++at) {
    if (text[at] == '\n') --line;
  }
  for (; column > 1 && at < text.size(); --column) {
    ++at;
    while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U) ++at;
  }
  return at;
}

/// Moves an error or warning of the converted request to its origin in the foreign text. False: the value has
/// no origin there.
template <class Located>
bool put_at_origin(Located& located, const Imported& imported, std::string_view text) {
  const auto origin = std::find_if(imported.origins.begin(), imported.origins.end(),
                                   [&](const Origin& each) { return each.pointer == located.pointer; });
  if (origin == imported.origins.end() || origin->runs.empty()) return false;
  std::size_t at = 0;
  const Json::json_pointer place_in_request(located.pointer);
  if (located.line > 0 && imported.request.contains(place_in_request)) {
    const Json& value = imported.request.at(place_in_request);
    if (value.is_string()) at = byte_of(value.get_ref<const std::string&>(), located.line, located.column);
  }
  const auto behind = [](std::size_t value, const TextRun& run) { return value < run.at; };
  auto run = std::upper_bound(origin->runs.begin() + 1, origin->runs.end(), at, behind) - 1;
  const TextPosition place = text_position(text, run->from + (run->verbatim ? at - run->at : 0));
  located.line = place.line;
  located.column = place.column;
  located.pointer.clear();
  return true;
}

/// The errors of the reader and of the generator, in the order of the text.
Error all_errors(std::vector<Issue> errors, std::vector<Issue> found, const Imported& imported,
                 std::string_view text) {
  const bool alone = errors.empty();
  for (Issue& issue : found) {
    const bool has_position = put_at_origin(issue, imported, text);
    const bool is_known = std::any_of(errors.begin(), errors.end(), [&](const Issue& each) {
      return each.line == issue.line && each.column == issue.column;
    });
    if (alone || (has_position && !is_known)) errors.push_back(std::move(issue));
  }
  std::stable_sort(errors.begin(), errors.end(), [](const Issue& a, const Issue& b) {
    return a.line != b.line ? a.line < b.line : a.column < b.column;
  });
  return {Code::invalid, std::move(errors)};
}

/// The errors of a file whose format was guessed; the first one names the format.
Error in_format(Error error, const ImportInput& input, const ImportFormat& format) {
  if (input.format.empty() && !error.issues.empty()) {
    error.issues[0].message = "read as " + std::string(format.name) + ": " + error.issues[0].message;
  }
  return error;
}

/// Whether the time has passed or the caller has gone.
bool is_stopped(const Error& error) { return error.code == Code::deadline || error.code == Code::cancelled; }

/// Adds the errors and warnings of validate() to the warnings of the import. A request that exceeds a limit is
/// returned too, because the user can make it smaller. Returns an error only if the time limit has passed or the
/// request was cancelled.
std::optional<Error> append_appraisal(const Request& request, Imported& imported, const Job::Options& options,
                                      std::string_view text) {
  const auto append = [&](Warning warning) {
    put_at_origin(warning, imported, text);
    imported.warnings.push_back(std::move(warning));
  };
  const Result<std::string> appraisal = validate(request, options);
  if (!appraisal) {
    if (is_stopped(appraisal.error())) return appraisal.error();
    for (const Issue& issue : appraisal.error().issues) {
      append({issue.pointer, "the imported request would be refused: " + issue.message, issue.line,
              issue.column});
    }
    return std::nullopt;
  }
  const Json answer = Json::parse(*appraisal);
  for (const Json& each : answer.at("warnings")) {
    append({each.value("pointer", ""), each.value("message", ""), each.value("line", 0),
            each.value("column", 0)});
  }
  return std::nullopt;
}

/// A body `{"files": {name: text, ...}}` contains several files. The one that matches a format best is the text, the
/// others are beside it. `main` owns its text.
void unpack(ImportInput& input, std::string& main, const Job& job) {
  const std::size_t first = input.text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || input.text[first] != '{' ||
      input.text.find("\"files\"") == std::string_view::npos)
    return;
  const Result<Json> body = parse_json(input.text, {.job = &job});
  if (!body || !body->is_object() || body->size() != 1 || !body->contains("files")) return;
  const Json& files = body->at("files");
  if (!files.is_object() || files.empty()) return;
  std::string chosen;
  int most = -1;
  for (const auto& [name, text] : files.items()) {
    if (!text.is_string()) return;
    const std::string& content = text.get_ref<const std::string&>();
    const ImportFormat* const format =
        input.format.empty() ? likeliest_format(content) : find_import_format(input.format);
    const int score = format ? format->score(content) : 0;
    if (score <= most) continue;
    most = score;
    chosen = name;
  }
  for (const auto& [name, text] : files.items()) {
    if (name == chosen) {
      main = text.get<std::string>();
    } else {
      input.files[name] = text.get<std::string>();
    }
  }
  input.text = main;
}

/// Whether a text is a request that needs no import.
bool is_request(std::string_view text, const Job& job) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || text[first] != '{') return false;
  const Result<Json> body = parse_json(text, {.job = &job});
  return body && body->is_object() && (body->contains("generator") || body->contains("preset"));
}

/// The error of a file that is no text in UTF-8, or whose format has no reader.
std::optional<Error> not_readable(const ImportInput& input) {
  if (const std::string_view name = foreign_encoding(input.text); !name.empty()) {
    const std::string found(name);
    std::string message = name.starts_with("UTF")
                              ? "found text in " + found + ", expected UTF-8; save the file as UTF-8"
                              : "found data in the format " + found + ", expected text in UTF-8";
    return Error{Code::malformed, {{IssueKind::syntax, "", std::move(message), 1, 1}}};
  }
  if (!input.format.empty()) return std::nullopt;
  const auto refuse = [&](std::size_t at, std::string message) {
    return Error{Code::invalid, {issue_at(IssueKind::not_available, "", input.text, at, std::move(message))}};
  };
  if (const std::optional<OtherFile> other = other_file(input.text)) {
    return refuse(other->at, "found " + std::string(other->name) + ", which has no reader; " +
                                 std::string(other->advice));
  }
  if (const auto start = start_of_lparser(input.text))
    return refuse(*start, "this file is written in the language of Lparser, which is not supported");
  return std::nullopt;
}

}  // namespace

static Result<ImportedRequest> import_within(const ImportInput& asked, const Job::Options& options,
                                             const Job& job) {
  ImportInput input = asked;
  std::string main;
  unpack(input, main, job);
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (input.text.starts_with(byte_order_mark)) input.text.remove_prefix(byte_order_mark.size());
  if (std::optional<Error> error = not_readable(input)) return *std::move(error);
  std::string lines;
  if (input.text.find('\n') == std::string_view::npos && input.text.find('\r') != std::string_view::npos) {
    lines = input.text;  // of the old Mac OS
    std::replace(lines.begin(), lines.end(), '\r', '\n');
    input.text = lines;
  }
  const ImportFormat* format =
      input.format.empty() ? likeliest_format(input.text) : find_import_format(input.format);
  std::string clean;
  std::size_t bad = find_bad_utf8(input.text);
  if (bad != std::string_view::npos && format && format->without_comments) {
    clean = format->without_comments(input.text);
    input.text = clean;
    bad = find_bad_utf8(input.text);
  }
  if (bad != std::string_view::npos) {
    return Error{Code::malformed,
                 {issue_at(IssueKind::syntax, "", input.text, bad, "found a byte that is not UTF-8")}};
  }
  if (!format && input.format.empty() && is_request(input.text, job)) {
    return Error{Code::invalid,
                 {issue_at(IssueKind::not_available, "", input.text, 0,
                           "found a request of Seedmesh, which needs no import; send it to "
                           "/v1/generate, or use the command generate")}};
  }
  if (!format) return unknown_format(input.format);
  Result<Imported> imported = format->read(input.text, {std::string(input.entry), input.files, &job});
  if (!imported) return in_format(std::move(imported).error(), input, *format);
  Result<Request> request = read_request_body(imported->request, options);
  if (!request && is_stopped(request.error())) return std::move(request).error();
  if (!request || !imported->errors.empty()) {
    std::vector<Issue> found;
    if (!request) found = std::move(request).error().issues;
    return in_format(all_errors(std::move(imported->errors), std::move(found), *imported, input.text), input,
                     *format);
  }
  if (auto stopped = append_appraisal(*request, *imported, options, input.text)) return std::move(*stopped);
  Json answer = {{"format", format->name},
                 {"request", Json::parse(request->canonical())},
                 {"warnings", warning_list(imported->warnings)}};
  return ImportedRequest{std::move(*request), canonical_text(answer), std::move(imported->warnings)};
}

Result<ImportedRequest> import_request(const ImportInput& input, const Job::Options& options) {
  return guarded<ImportedRequest>([&] { return import_within(input, options, Job(0, options)); });
}

Result<ImportedRequest> import_request(const ImportInput& input, const Limits& limits) {
  Job::Options options;
  options.limits = limits;
  return import_request(input, options);
}

std::string_view likely_import_format(std::string_view text) {
  const ImportFormat* format = likeliest_format(text);
  return format ? format->name : std::string_view();
}

std::vector<ImportFormatInfo> import_format_list() {
  std::vector<ImportFormatInfo> list;
  for (const ImportFormat& row : import_formats()) {
    list.push_back({std::string(row.name), std::string(row.title), std::string(row.text)});
  }
  return list;
}

}  // namespace seedmesh
