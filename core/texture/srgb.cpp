#include "core/texture/srgb.h"

#include <algorithm>
#include <array>

#include "core/model/model.h"

namespace seedmesh::texture {

const std::array<std::uint8_t, 4096>& srgb_table() {
  static const std::array<std::uint8_t, 4096> table = [] {
    std::array<std::uint8_t, 4096> made{};
    std::uint8_t byte = 0;
    for (std::size_t i = 0; i < made.size(); ++i) {
      const double share = static_cast<double>(i) / 4095;
      while (byte < 255 &&
             share * 2 > static_cast<double>(linear_of_srgb(byte)) +
                             static_cast<double>(linear_of_srgb(static_cast<std::uint8_t>(byte + 1))))
        ++byte;
      made[i] = byte;
    }
    return made;
  }();
  return table;
}

std::uint8_t srgb_of(std::uint32_t linear) { return srgb_table()[std::min(linear, 65'535U) >> 4U]; }

}  // namespace seedmesh::texture
