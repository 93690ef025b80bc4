#pragma once
/// The alpha channel of a WebP file (RFC 9649, section 2.7.1.2), without loss.
#include <cstdint>
#include <span>
#include <vector>

namespace seedmesh::texture {

/// Returns the content of the chunk ALPH for rows of `width` bytes: Huffman codes of bytes, and of runs that repeat
/// the byte before or the row above. Equal bytes give equal chunks, because all arithmetic is on integers. libwebp
/// compares sums of floats here, whose order differs between processors. Cost: about 3 ns a byte.
std::vector<std::uint8_t> webp_alpha(std::span<const std::uint8_t> alpha, std::uint32_t width);

}  // namespace seedmesh::texture
