#pragma once
/// The numeric parameters of Houdini's L-System node.
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace seedmesh {

/// A parameter: its name in the file without blanks, and its default value in Houdini.
struct HoudiniSetting {
  std::string_view name;
  double value;
  std::size_t at = 0;  ///< offset in the file
};
std::span<const HoudiniSetting> houdini_settings();

/// Returns the name of a parameter in lower case, without blanks and hyphens, and for some other names that of the node.
std::string houdini_name(std::string_view text);

}  // namespace seedmesh
