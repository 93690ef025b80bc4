#include "core/texture/run_deflate.h"

#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>

#include "core/texture/huffman.h"

namespace seedmesh::texture {
namespace {

// Four codes and the rest of a byte fit the 64 bits of the writer.
constexpr int longest_code = 14;
constexpr int longest_length_code = 7;  ///< of the codes of code lengths (RFC 1951, 3.2.7)
constexpr std::size_t symbols = 286, end_of_block = 256, first_length = 257;
constexpr std::size_t longest_run = 258, least_run = 3;
constexpr std::size_t word = 8;  ///< bytes that are processed together
constexpr std::ptrdiff_t bytes_a_look = 1 << 20;
// Symbols are counted in the first part of each stretch of large data: counts of a quarter give nearly the same codes.
// The length is prime, so that the parts lie at all columns of an image.
constexpr std::uint32_t parts = 4;
constexpr std::size_t stretch = 2039, counted_whole = 1 << 16;

struct Pixels {
  std::span<const std::uint8_t> data;
  std::size_t period;
  const Job& job;
};

std::uint64_t load(const std::uint8_t* at) {
  std::uint64_t value = 0;
  std::memcpy(&value, at, word);
  return value;
}

/// Splits the data into words of literals and repeats: calls literals(at, count) with at most 8 bytes, and
/// repeat(length) for 3 to 258 bytes that equal those `period` bytes before them.
template <class Literals, class Repeat>
void walk(const Pixels& pixels, Literals&& literals, Repeat&& repeat) {
  const std::size_t period = pixels.period;
  const std::uint8_t *at = pixels.data.data(), *const end = at + pixels.data.size();
  const std::size_t first = std::min(period, pixels.data.size());
  if (first > 0) literals(at, first);
  at += first;
  const std::uint8_t* look = at;
  while (static_cast<std::size_t>(end - at) >= word) {
    if (at >= look) {
      pixels.job.check();
      look = at + std::min(bytes_a_look, end - at);
    }
    if (load(at) != load(at - period)) {
      literals(at, word);
      at += word;
      continue;
    }
    const std::uint8_t* last = at + word;
    while (static_cast<std::size_t>(end - last) >= word && load(last) == load(last - period)) last += word;
    auto length = static_cast<std::size_t>(last - at);
    at = last;
    while (length > 0) {
      // What is left of the run may not be shorter than the shortest match.
      const std::size_t part = length <= longest_run ? length : std::min(longest_run, length - least_run);
      repeat(part);
      length -= part;
    }
  }
  if (at < end) literals(at, static_cast<std::size_t>(end - at));
}

/// The symbol of a run and its extra bits (RFC 1951, 3.2.5).
struct LengthCode {
  std::uint16_t symbol;
  std::uint8_t extra_bits;
  std::uint16_t extra;
};

LengthCode length_code(std::size_t length) {
  if (length == longest_run) return {285, 0, 0};
  const auto rest = static_cast<std::uint32_t>(length - least_run);
  if (rest < 8) return {static_cast<std::uint16_t>(first_length + rest), 0, 0};
  const auto bits = static_cast<std::uint32_t>(std::bit_width(rest)) - 3;
  const std::uint32_t group = (rest >> bits) & 3U;
  return {static_cast<std::uint16_t>(first_length + 4 * bits + 4 + group), static_cast<std::uint8_t>(bits),
          static_cast<std::uint16_t>(rest & ((1U << bits) - 1))};
}

using Counts = std::array<std::uint32_t, symbols>;

/// Counts of bytes in four tables, because adding to one number twice in a row makes the processor wait.
struct ByteCounts {
  std::array<std::array<std::uint32_t, 256>, 4> of{};
};

void add_counts(const Pixels& pixels, ByteCounts& bytes, Counts& counts) {
  walk(
      pixels,
      [&](const std::uint8_t* at, std::size_t size) {
        for (std::size_t i = 0; i < size; ++i) ++bytes.of[i % 4][at[i]];
      },
      [&](std::size_t length) { ++counts[length_code(length).symbol]; });
}

/// A set that contains all bytes of the data: signed values from the least to the greatest, with the bits that occur.
struct ByteRange {
  std::uint8_t low = 255, high = 0;  ///< with the sign reversed, so that they are compared as unsigned
  std::uint8_t bits = 0;
  bool contains(std::uint8_t byte) const {
    const std::uint8_t reversed = byte ^ sign;
    return reversed >= low && reversed <= high && (byte & ~bits) == 0;
  }
  static constexpr std::uint8_t sign = 128;
};

ByteRange range_of(std::span<const std::uint8_t> data) {
  ByteRange range;
  for (const std::uint8_t byte : data) {
    const std::uint8_t reversed = byte ^ ByteRange::sign;
    range.low = reversed < range.low ? reversed : range.low;
    range.high = reversed > range.high ? reversed : range.high;
    range.bits |= byte;
  }
  return range;
}

/// How often each symbol occurs, or an estimate that is positive for every symbol that may occur.
Counts count(const Pixels& pixels) {
  ByteCounts bytes;
  Counts counts{};
  const bool is_estimate = pixels.data.size() > counted_whole;
  const std::size_t step = is_estimate ? stretch : counted_whole;
  for (std::size_t begin = 0; begin < pixels.data.size(); begin += step) {
    const std::size_t size = std::min(is_estimate ? stretch / parts : step, pixels.data.size() - begin);
    add_counts({pixels.data.subspan(begin, size), pixels.period, pixels.job}, bytes, counts);
  }
  for (std::size_t i = 0; i < 256; ++i)
    counts[i] = bytes.of[0][i] + bytes.of[1][i] + bytes.of[2][i] + bytes.of[3][i];
  if (is_estimate) {
    const ByteRange range = range_of(pixels.data);
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const bool may_occur = i > end_of_block || range.contains(static_cast<std::uint8_t>(i));
      counts[i] = parts * counts[i] + (may_occur ? 1 : 0);
    }
  }
  counts[end_of_block] = 1;
  return counts;
}

/// The head of a block with its own codes: the lengths of 286 symbols, and of distances up to `distance`, of which
/// only the last has a code. Runs of equal lengths are not shortened.
void put_head(BitWriter& bits, std::span<const std::uint8_t> lengths, std::uint32_t distance) {
  constexpr std::array<std::uint8_t, 19> order = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                  11, 4,  12, 3, 13, 2, 14, 1, 15};
  std::array<std::uint32_t, 19> counts{};
  for (const std::uint8_t length : lengths) ++counts[length];
  counts[0] += distance - 1;
  ++counts[1];
  const auto length_lengths = code_lengths(counts, longest_length_code);
  const auto codes = codes_of(length_lengths);
  constexpr std::uint32_t last_block = 1, own_codes = 2;
  bits.put(last_block | own_codes << 1U, 3);
  bits.put(symbols - 257, 5);
  bits.put(distance - 1, 5);
  bits.put(order.size() - 4, 4);
  bits.flush();
  for (const std::uint8_t symbol : order) {
    bits.put(length_lengths[symbol], 3);
    bits.flush();
  }
  for (const std::uint8_t length : lengths) {
    bits.put(codes[length]);
    bits.flush();
  }
  for (std::uint32_t i = 1; i < distance; ++i) bits.put(codes[0]);
  bits.put(codes[1]);
  bits.flush();
}

void put_data(BitWriter& bits, const Pixels& pixels, std::span<const Code> codes) {
  walk(
      pixels,
      [&](const std::uint8_t* at, std::size_t size) {
        if (size == word) {
          for (std::size_t i = 0; i < 4; ++i) bits.put(codes[at[i]]);
          bits.flush();
          for (std::size_t i = 4; i < word; ++i) bits.put(codes[at[i]]);
          bits.flush();
          return;
        }
        for (std::size_t i = 0; i < size; ++i) {
          bits.put(codes[at[i]]);
          bits.flush();
        }
      },
      [&](std::size_t length) {
        const LengthCode found = length_code(length);
        bits.put(codes[found.symbol]);
        bits.put(found.extra, found.extra_bits);
        bits.put(0, 1);  // the only distance
        bits.flush();
      });
  bits.put(codes[end_of_block]);
}

}  // namespace

std::size_t run_deflate_bound(std::size_t size) {
  constexpr std::size_t head = 512;  // of stream and block, the checksum, and the last word of the writer
  return size + size * (longest_code - 8) / 8 + head;
}

std::size_t run_deflate(std::span<const std::uint8_t> data, std::size_t period, std::uint8_t* out,
                        const Job& job) {
  assert(period >= 1 && period <= 4);  // distances that have codes of their own (RFC 1951, 3.2.5)
  const Pixels pixels{data, period, job};
  constexpr std::uint8_t method = 0x78, level = 0x01;  // deflate with 32 KiB; the fastest
  const auto lengths = code_lengths(count(pixels), longest_code);
  out[0] = method;
  out[1] = level;
  BitWriter bits(out + 2);
  put_head(bits, lengths, static_cast<std::uint32_t>(period));
  put_data(bits, pixels, codes_of(lengths));
  std::uint8_t* end = bits.finish();
  const std::uint32_t checksum = libdeflate_adler32(1, data.data(), data.size());
  for (int i = 0; i < 4; ++i) *end++ = static_cast<std::uint8_t>(checksum >> (24 - 8 * i));
  return static_cast<std::size_t>(end - out);
}

}  // namespace seedmesh::texture
