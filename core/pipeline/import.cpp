/// The door for foreign files: a format's reader makes a request, which is then read like any other, so that
/// what comes out can be sent back as it is.
#include "core/import/import.h"

#include <algorithm>

#include "core/pipeline/body.h"
#include "core/schema/nearest.h"

namespace seedmesh {
namespace {

Error unknown_format(std::string_view name) {
  std::vector<std::string_view> names;
  std::string list;
  for (const ImportFormat& row : import_formats()) {
    names.push_back(row.name);
    list += (list.empty() ? "" : ", ") + std::string(row.name);
  }
  const std::string_view nearest = schema::nearest_word(name, names);
  std::string message = name.empty() ? "found no marks of a format that is known"
                                     : "there is no format \"" + shortened(name, 40) + "\"";
  message +=
      nearest.empty() ? "; expected one of " + list : "; did you mean \"" + std::string(nearest) + "\"?";
  return {Code::invalid, {{"/format", std::move(message)}}};
}

/// The byte of line and column in `text`.
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

/// Puts a fault or a warning of the request that was made at the place of the foreign text that it came from.
/// False: it came from nowhere there.
template <class Told>
bool put_at_origin(Told& told, const Imported& imported, std::string_view text) {
  const auto origin = std::find_if(imported.origins.begin(), imported.origins.end(),
                                   [&](const Origin& each) { return each.pointer == told.pointer; });
  if (origin == imported.origins.end() || origin->runs.empty()) return false;
  std::size_t at = 0;
  const Json::json_pointer place_in_request(told.pointer);
  if (told.line > 0 && imported.request.contains(place_in_request)) {
    const Json& value = imported.request.at(place_in_request);
    if (value.is_string()) at = byte_of(value.get_ref<const std::string&>(), told.line, told.column);
  }
  const auto behind = [](std::size_t value, const TextRun& run) { return value < run.at; };
  auto run = std::upper_bound(origin->runs.begin() + 1, origin->runs.end(), at, behind) - 1;
  const TextPlace place = place_of(text, run->from + (run->verbatim ? at - run->at : 0));
  told.line = place.line;
  told.column = place.column;
  told.pointer.clear();
  return true;
}

/// Faults that only the generator finds stand beside those that the reader found, in the order of the text.
Error all_faults(std::vector<Issue> faults, std::vector<Issue> found, const Imported& imported,
                 std::string_view text) {
  const bool alone = faults.empty();
  for (Issue& issue : found) {
    const bool placed = put_at_origin(issue, imported, text);
    const bool is_told = std::any_of(faults.begin(), faults.end(), [&](const Issue& each) {
      return each.line == issue.line && each.column == issue.column;
    });
    if (alone || (placed && !is_told)) faults.push_back(std::move(issue));
  }
  std::stable_sort(faults.begin(), faults.end(), [](const Issue& a, const Issue& b) {
    return a.line != b.line ? a.line < b.line : a.column < b.column;
  });
  return {Code::invalid, std::move(faults)};
}

Json described(const std::vector<Warning>& warnings) {
  Json list = Json::array();
  for (const Warning& warning : warnings) {
    Json row = {{"pointer", warning.pointer}, {"message", warning.message}};
    if (warning.line > 0) {
      row["line"] = warning.line;
      row["column"] = warning.column;
    }
    list.push_back(std::move(row));
  }
  return list;
}

/// The faults of a file whose format was found by its marks: the first says which it was.
Error in_format(Error error, const ImportQuestion& question, const ImportFormat& format) {
  if (question.format.empty() && !error.issues.empty()) {
    error.issues[0].message = "read as " + std::string(format.name) + ": " + error.issues[0].message;
  }
  return error;
}

/// What the generator says of the request before it makes anything. A request that is more than the limits
/// allow is a request still: it can be made smaller.
void append_appraisal(const Request& request, Imported& imported, const Limits& limits,
                      std::string_view text) {
  Job::Options options;
  options.limits = limits;
  Job job(request.seed(), options);
  const auto append = [&](Warning warning) {
    put_at_origin(warning, imported, text);
    imported.warnings.push_back(std::move(warning));
  };
  const Result<std::string> appraisal = validate(request, job);
  if (!appraisal) {
    for (const Issue& issue : appraisal.error().issues) {
      append(
          {issue.pointer, "the model is refused as it stands: " + issue.message, issue.line, issue.column});
    }
    return;
  }
  const Json told = Json::parse(*appraisal);
  for (const Json& each : told.at("warnings")) {
    append({each.value("pointer", ""), each.value("message", ""), each.value("line", 0),
            each.value("column", 0)});
  }
}

}  // namespace

Result<ImportedRequest> import_request(const ImportQuestion& asked, const Limits& limits) {
  ImportQuestion question = asked;
  const ImportFormat* format =
      question.format.empty() ? likeliest_format(question.text) : find_import_format(question.format);
  std::string clean;
  std::size_t bad = find_bad_utf8(question.text);
  if (bad != std::string_view::npos && format && format->without_comments) {
    clean = format->without_comments(question.text);
    question.text = clean;
    bad = find_bad_utf8(question.text);
  }
  if (bad != std::string_view::npos) {
    return Error{Code::malformed, {issue_at("", question.text, bad, "found a byte that is not UTF-8")}};
  }
  if (!format) return unknown_format(question.format);
  Result<Imported> imported = format->read(question.text, {std::string(question.entry)});
  if (!imported) return in_format(std::move(imported).error(), question, *format);
  Result<Request> request = read_request_body(imported->request, limits);
  if (!request || !imported->faults.empty()) {
    std::vector<Issue> found;
    if (!request) found = std::move(request).error().issues;
    return in_format(all_faults(std::move(imported->faults), std::move(found), *imported, question.text),
                     question, *format);
  }
  append_appraisal(*request, *imported, limits, question.text);
  Json answer = {{"format", format->name},
                 {"request", Json::parse(request->canonical())},
                 {"warnings", described(imported->warnings)}};
  return ImportedRequest{std::move(*request), canonical_text(answer), std::move(imported->warnings)};
}

std::vector<ImportFormatInfo> import_format_list() {
  std::vector<ImportFormatInfo> list;
  for (const ImportFormat& row : import_formats()) {
    list.push_back({std::string(row.name), std::string(row.title), std::string(row.text)});
  }
  return list;
}

}  // namespace seedmesh
