#pragma once
/// Huffman codes with a limited length, and a writer of bits, for formats that put the first bit lowest: deflate
/// (RFC 1951) and the lossless part of WebP.
#include <cstdint>
#include <span>
#include <vector>

namespace seedmesh::texture {

/// Returns the length of each symbol's code, at most `most` bits, and 0 for symbols that do not occur. At least two
/// symbols get a code, because a tree needs two leaves. Equal counts give equal lengths. Kraft's sum is exactly 1, as
/// decoders require.
std::vector<std::uint8_t> code_lengths(std::span<const std::uint32_t> counts, int most);

struct Code {
  std::uint32_t bits = 0;  ///< the first bit of the code is the lowest
  std::uint32_t length = 0;
};

/// Returns the code of each symbol. Codes of one length are consecutive (RFC 1951, 3.2.2).
std::vector<Code> codes_of(std::span<const std::uint8_t> lengths);

class BitWriter {
 public:
  /// `out` has 8 bytes more than are written.
  explicit BitWriter(std::uint8_t* out) : out_(out) {}
  /// Adds bits; at most 56 between two calls of flush().
  void put(std::uint64_t bits, std::uint32_t length) {
    held_ |= bits << count_;
    count_ += length;
  }
  void put(const Code& code) { put(code.bits, code.length); }
  void flush() {
    for (std::size_t i = 0; i < sizeof(held_); ++i) out_[i] = static_cast<std::uint8_t>(held_ >> (8 * i));
    out_ += count_ / 8;
    held_ >>= count_ & ~7U;
    count_ &= 7U;
  }
  std::uint8_t* finish() {
    flush();
    return count_ > 0 ? out_ + 1 : out_;
  }

 private:
  std::uint8_t* out_;
  std::uint64_t held_ = 0;
  std::uint32_t count_ = 0;
};

}  // namespace seedmesh::texture
