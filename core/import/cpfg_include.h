#pragma once
/// Replaces each line `#include "name"` of a cpfg file by the text of the named file.
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/import/foreign_text.h"

namespace seedmesh {

struct JoinedText {
  std::string text;
  std::vector<TextPart> parts;        ///< sources of the bytes of `text`
  std::vector<std::string> included;  ///< names of the files that were used
};

/// Returns `text` with the files that it includes, and those that they include, at most 16 deep and 16 MiB in
/// all. A directory before the name is ignored. Lines that name no given file stay as they are.
JoinedText with_cpfg_includes(std::string_view text, const std::map<std::string, std::string>& files);

}  // namespace seedmesh
