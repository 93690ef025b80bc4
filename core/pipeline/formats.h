#pragma once
/// The only table of output formats. core/pipeline, the server and the command line read it. Tests compare it
/// with output.schema.json, with openapi.json and with the formats that generators list.
#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace seedmesh {

struct FormatInfo {
  std::string_view name;  ///< the value of output.format
  std::string_view media_type;
  std::string_view extension;  ///< extension in file names and URLs
  bool is_model = false;       ///< glTF, which every generator makes; the others belong to some generators
};

/// Where several formats share an extension, the extension alone selects the first of them.
inline constexpr FormatInfo output_formats[] = {
    {"glb", "model/gltf-binary", "glb", true},
    {"gltf", "model/gltf+json", "gltf", true},
    {"zip", "application/zip", "zip", true},
    {"png16", "image/png", "png"},
    {"png8", "image/png", "png"},
    {"rgb24", "image/png", "png"},
    {"rgba32", "image/png", "png"},
    {"r16", "application/octet-stream", "r16"},
    {"ply", "application/octet-stream", "ply"},
    {"placements", "application/zip", "zip"},
    {"geojson", "application/geo+json", "geojson"},
};

/// The row of a name that the schema has accepted.
constexpr const FormatInfo& format_named(std::string_view name) {
  return *std::ranges::find(output_formats, name, &FormatInfo::name);
}

/// Returns the first format with this extension, or null if there is none.
constexpr const FormatInfo* format_with_extension(std::string_view extension) {
  const auto* const found = std::ranges::find(output_formats, extension, &FormatInfo::extension);
  return found == std::end(output_formats) ? nullptr : found;
}

/// Each extension once, in the order of the table.
inline std::vector<std::string_view> output_extensions() {
  std::vector<std::string_view> extensions;
  for (const FormatInfo& format : output_formats) {
    if (std::ranges::find(extensions, format.extension) == extensions.end())
      extensions.push_back(format.extension);
  }
  return extensions;
}

/// ".glb, .gltf, .zip, .png, .r16 or .ply", with `more` extensions at the end.
inline std::string output_extension_list(const std::vector<std::string_view>& more = {}) {
  std::vector<std::string_view> extensions = output_extensions();
  extensions.insert(extensions.end(), more.begin(), more.end());
  std::string list;
  for (std::size_t i = 0; i < extensions.size(); ++i) {
    if (i > 0) list += i + 1 == extensions.size() ? " or " : ", ";
    list.append(".").append(extensions[i]);
  }
  return list;
}

}  // namespace seedmesh
