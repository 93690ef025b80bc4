#pragma once
/// Converts foreign files to requests. Every format is one ImportFormat. The pipeline, the HTTP route, the command line
/// and the documentation use this table. A reader reports everything that it cannot parse as an error, and everything
/// that a request cannot express as a warning.
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/job.h"
#include "core/base/result.h"
#include "core/model/model.h"
#include "core/schema/json.h"

namespace seedmesh {

/// The text of the request from byte `at` on comes from byte `from` of the foreign text. If verbatim, the bytes are
/// the same (with a blank for each line end); otherwise every byte of the run maps to the byte at `from`.
struct TextRun {
  std::size_t at = 0, from = 0;
  bool verbatim = false;
};

/// The source of a value of the request. With it, an error of the generator is reported at the line and
/// column of the foreign text.
struct Origin {
  std::string pointer;        ///< pointer into the request, such as "/parameters/productions/2"
  std::vector<TextRun> runs;  ///< the first begins at byte 0; a number has one run
};

struct Imported {
  Json request = Json::object();

  /// For a text: line and column, and a pointer into the request or "". For JSON: a pointer into the file.
  std::vector<Warning> warnings;
  std::vector<Origin> origins;

  /// If there are any errors, `request` contains only the parts that were understood. It is then checked for
  /// further errors and not returned to the client.
  std::vector<Issue> errors;
};

struct ImportOptions {
  std::string entry;  ///< name of the system to import, if the file has several; empty: the only one
  std::map<std::string, std::string>
      files;                 ///< further files beside the text, by name, such as a view file of cpfg
  const Job* job = nullptr;  ///< job of the request, for its limits, stop and deadline; null: there are none

  void check() const {
    if (job) job->check();
  }
};

struct ImportFormat {
  std::string_view name;        ///< the value of the query parameter `format`
  std::string_view title;       ///< the program and kind of file
  std::string_view text;        ///< one sentence on the result
  std::string_view media_type;  ///< "text/plain", "application/json" or "application/xml"

  /// Returns the text with each byte of its comments replaced by a blank, because comments can have any encoding.
  /// Null if the format has no comments.
  std::string (*without_comments)(std::string_view text);

  /// Returns how well the keywords of a text match this format; 0: not at all. `text` is valid UTF-8.
  int (*score)(std::string_view text);

  /// Reads valid UTF-8. All errors are reported, each with pointer "" and line and column (for JSON, with a pointer into
  /// the file). Cost: linear.
  Result<Imported> (*read)(std::string_view text, const ImportOptions& options);
};

std::span<const ImportFormat> import_formats();

/// Returns the format of this name; null if there is none.
const ImportFormat* find_import_format(std::string_view name);

/// Returns the format with the greatest score; null if all are 0.
const ImportFormat* likeliest_format(std::string_view text);

}  // namespace seedmesh
