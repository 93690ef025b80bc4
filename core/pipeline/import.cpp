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
  std::string message =
      name.empty() ? "\"format\" is missing" : "there is no format \"" + shortened(name, 40) + "\"";
  message +=
      nearest.empty() ? "; expected one of " + list : "; did you mean \"" + std::string(nearest) + "\"?";
  return {Code::invalid, {{"/format", std::move(message)}}};
}

/// A fault of the request that was made, at the place of the foreign text that it came from.
Issue at_origin(Issue issue, const Imported& imported, std::string_view text) {
  const auto origin = std::find_if(imported.origins.begin(), imported.origins.end(),
                                   [&](const Origin& each) { return each.pointer == issue.pointer; });
  if (origin == imported.origins.end()) return issue;
  std::size_t offset = origin->offset;
  for (int column = 1; origin->verbatim && column < issue.column && offset < text.size(); ++column) {
    ++offset;
    while (offset < text.size() && (static_cast<unsigned char>(text[offset]) & 0xC0U) == 0x80U) ++offset;
  }
  const TextPlace place = place_of(text, offset);
  issue.line = place.line;
  issue.column = place.column;
  issue.pointer.clear();
  return issue;
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

}  // namespace

Result<ImportedRequest> import_request(const ImportQuestion& question, const Limits& limits) {
  const ImportFormat* format = find_import_format(question.format);
  if (!format) return unknown_format(question.format);
  const std::size_t bad = find_bad_utf8(question.text);
  if (bad != std::string_view::npos) {
    return Error{Code::malformed, {issue_at("", question.text, bad, "found a byte that is not UTF-8")}};
  }
  Result<Imported> imported = format->read(question.text, {std::string(question.entry)});
  if (!imported) return std::move(imported).error();
  Result<Request> request = read_request_body(imported->request, limits);
  if (!request) {
    Error error = std::move(request).error();
    for (Issue& issue : error.issues) issue = at_origin(std::move(issue), *imported, question.text);
    return error;
  }
  Json answer = {{"request", Json::parse(request->canonical())}, {"warnings", described(imported->warnings)}};
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
