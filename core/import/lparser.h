#pragma once
/// Files of Lparser, which no reader supports.
#include <cstddef>
#include <optional>
#include <string_view>

namespace seedmesh {

/// Returns the offset of the first command if the text is an L-system of Lparser. Its rules resemble those of Houdini
/// (`A=FA`) and ShapeML (`rule A = FA`). Cost: constant; the beginning of the text decides.
std::optional<std::size_t> start_of_lparser(std::string_view text);

}  // namespace seedmesh
