#pragma once
/// Linear colours as bytes of sRGB (IEC 61966-2-1).
#include <array>
#include <cstdint>

namespace seedmesh::texture {

/// Returns the nearest sRGB byte of a linear value, where 65535 is 1. Larger values give 255. Cost: about 1 ns.
std::uint8_t srgb_of(std::uint32_t linear);

/// The same for loops: srgb_of(linear) is the element of `linear` / 16.
const std::array<std::uint8_t, 4096>& srgb_table();

}  // namespace seedmesh::texture
