#pragma once
/// zlib streams (RFC 1950, RFC 1951) of filtered pixels: Huffman codes of single bytes, and of runs of equal pixels.
/// Other matches are not searched: residuals of noise have few, and the search takes most of the time.
#include <cstdint>
#include <span>

#include "core/base/array.h"

namespace seedmesh::texture {

/// Returns the greatest number of bytes that a stream of `size` bytes of data can have.
std::size_t run_deflate_bound(std::size_t size);

/// Writes the stream of `data`, whose pixels have `period` bytes (1 to 4), to `out`, which has
/// run_deflate_bound() bytes, and returns its length. Checks the deadline at intervals. Equal data give equal
/// streams. The codes of large data are computed from a quarter of
/// them, which gives nearly the same codes. Cost: about 1.1 ns a byte, where libdeflate needs 6 ns
/// at its lowest level.
std::size_t run_deflate(std::span<const std::uint8_t> data, std::size_t period, std::uint8_t* out,
                        const Job& job);

}  // namespace seedmesh::texture
