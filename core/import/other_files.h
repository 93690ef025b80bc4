#pragma once
/// Recognises texts of formats that have no reader, so that the error names them.
#include <cstddef>
#include <optional>
#include <string_view>

namespace seedmesh {

struct OtherFile {
  std::string_view name;    ///< "a KML file"
  std::string_view advice;  ///< "convert it to GeoJSON"
  std::size_t at = 0;       ///< offset of the words that are typical of the format
};

/// Returns the format of a text by words in its first 8 KiB; nullopt without such words.
std::optional<OtherFile> other_file(std::string_view text);

}  // namespace seedmesh
