#pragma once
/// Foreign files as requests of ours. Every format has one row; the pipeline, the route, the program and the
/// documentation walk the rows. A format's reader understands the whole text or refuses it at its line: what
/// it knows but cannot say in a request becomes a warning, what it does not know an error.
#include <cstddef>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/model/model.h"
#include "core/schema/json.h"

namespace seedmesh {

/// From byte `at` of a text of the request on stands what came from byte `from` of the foreign text: the same
/// bytes (a blank for a line's end) where it is verbatim, something else for what stands at `from` where not.
struct TextRun {
  std::size_t at = 0, from = 0;
  bool verbatim = false;
};

/// Where a value of the request came from, so that a fault that only the generator finds can be told at the
/// place in the foreign text.
struct Origin {
  std::string pointer;        ///< into the request, such as "/parameters/productions/2"
  std::vector<TextRun> runs;  ///< the first at byte 0; of a number one run alone
};

struct Imported {
  Json request = Json::object();

  /// Of a text with line and column and a pointer into the request or ""; of JSON with a pointer into the
  /// file.
  std::vector<Warning> warnings;
  std::vector<Origin> origins;

  /// What was not understood. Where there is any, the request is what is left: it is looked at for further
  /// faults and not answered.
  std::vector<Issue> faults;
};

struct ImportOptions {
  std::string entry;  ///< which system of a file that holds several; empty: the only one
};

struct ImportFormat {
  std::string_view name;        ///< of the query's `format`
  std::string_view title;       ///< whose files these are
  std::string_view text;        ///< one sentence: what becomes of them
  std::string_view media_type;  ///< "text/plain" or "application/json"

  /// The text with blanks for its comments, byte for byte: they may be in any encoding. Null: no comments.
  std::string (*without_comments)(std::string_view text);

  /// How many marks of this format the text has, such as its keywords; 0: none. `text` is valid UTF-8.
  int (*marks)(std::string_view text);

  /// `text` is valid UTF-8. Faults: every one, with pointer "" and line and column of `text` (of JSON: with
  /// a pointer into it). Cost: linear.
  Result<Imported> (*read)(std::string_view text, const ImportOptions& options);
};

std::span<const ImportFormat> import_formats();

/// Null: there is none of this name.
const ImportFormat* find_import_format(std::string_view name);

/// The format that the text has most marks of; null: it has none of any.
const ImportFormat* likeliest_format(std::string_view text);

}  // namespace seedmesh
