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

/// Where a text of the request came from, so that a fault that only the generator finds can be told at the
/// place in the foreign text.
struct Origin {
  std::string pointer;     ///< into the request, such as "/parameters/productions/2"
  std::size_t offset = 0;  ///< byte of the foreign text
  bool verbatim = false;   ///< the text stands there, byte for byte (a blank for a line's end): columns hold
};

struct Imported {
  Json request = Json::object();
  std::vector<Warning> warnings;  ///< pointer into the request or "", line and column of the foreign text
  std::vector<Origin> origins;
};

struct ImportOptions {
  std::string entry;  ///< which system of a file that holds several; empty: the only one
};

struct ImportFormat {
  std::string_view name;        ///< of the query's `format`
  std::string_view title;       ///< whose files these are
  std::string_view text;        ///< one sentence: what becomes of them
  std::string_view media_type;  ///< "text/plain" or "application/json"

  /// `text` is valid UTF-8. Faults: every one, with pointer "" and line and column of `text` (of JSON: with
  /// a pointer into it). Cost: linear.
  Result<Imported> (*read)(std::string_view text, const ImportOptions& options);
};

std::span<const ImportFormat> import_formats();

/// Null: there is none of this name.
const ImportFormat* find_import_format(std::string_view name);

}  // namespace seedmesh
