#pragma once
/// The numbers of Houdini's L-System node.
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace seedmesh {

/// A number of the node: its name in the file, without blanks, and what the node has where it is not given.
struct HoudiniSetting {
  std::string_view name;
  double value;
  std::size_t at = 0;  ///< in the file
};
std::span<const HoudiniSetting> houdini_settings();

/// A name as the settings have it: small letters without blanks.
std::string houdini_name(std::string_view text);

}  // namespace seedmesh
