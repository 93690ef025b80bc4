/// The lossless format of WebP (RFC 9649, section 3) without transforms, cache and groups of codes.
#include "core/texture/webp_alpha.h"

#include <algorithm>
#include <array>
#include <bit>

#include "core/texture/huffman.h"

namespace seedmesh::texture {
namespace {

constexpr std::size_t literals = 256, length_codes = 24;
constexpr std::size_t longest_run = 4096, least_run = 3;
constexpr int longest_code = 15, longest_length_code = 7;
constexpr std::uint8_t lossless_without_filter = 1;

/// Two of the codes of distances (section 3.6.2.2): 1 is the pixel above, 2 the pixel before.
enum class Distance : std::uint8_t { above, before };

struct Token {
  std::uint16_t symbol = 0;  ///< of the green channel: a byte, or the code of a length
  std::uint16_t extra = 0;
  std::uint8_t extra_bits = 0;
  Distance distance = Distance::above;  ///< of a run
};

Token run_of(std::size_t length, Distance distance) {
  const auto rest = static_cast<std::uint32_t>(length - 1);
  if (rest < 4) return {static_cast<std::uint16_t>(literals + rest), 0, 0, distance};
  const auto high = static_cast<std::uint32_t>(std::bit_width(rest)) - 1;
  const std::uint32_t second = (rest >> (high - 1)) & 1U, extra_bits = high - 1;
  return {static_cast<std::uint16_t>(literals + 2 * high + second),
          static_cast<std::uint16_t>(rest & ((1U << extra_bits) - 1)), static_cast<std::uint8_t>(extra_bits),
          distance};
}

/// How many bytes from `at` equal those `back` bytes before them.
std::size_t run_length(std::span<const std::uint8_t> bytes, std::size_t at, std::size_t back) {
  if (at < back) return 0;
  const std::size_t most = std::min(longest_run, bytes.size() - at);
  std::size_t length = 0;
  while (length < most && bytes[at + length] == bytes[at + length - back]) ++length;
  return length;
}

std::vector<Token> tokens_of(std::span<const std::uint8_t> alpha, std::uint32_t width) {
  std::vector<Token> tokens;
  for (std::size_t at = 0; at < alpha.size();) {
    const std::size_t above = run_length(alpha, at, width), before = run_length(alpha, at, 1);
    const std::size_t length = std::max(above, before);
    if (length < least_run) {
      tokens.push_back({alpha[at], 0, 0, Distance::above});
      ++at;
      continue;
    }
    tokens.push_back(run_of(length, above >= before ? Distance::above : Distance::before));
    at += length;
  }
  return tokens;
}

/// One symbol without bits: 0.
void put_constant(BitWriter& bits) {
  constexpr std::uint32_t simple = 1, length = 4;  // one symbol, of one bit, which is 0
  bits.put(simple, length);
  bits.flush();
}

/// The lengths of a code, themselves in a code. Runs of lengths are not shortened, except for zeros.
void put_lengths(BitWriter& bits, std::span<const std::uint8_t> lengths) {
  constexpr std::array<std::uint8_t, 19> order = {17, 18, 0, 1,  2,  3,  4,  5,  16, 6,
                                                  7,  8,  9, 10, 11, 12, 13, 14, 15};
  constexpr std::size_t least_zeros = 11, most_zeros = 138;  // of the symbol 18
  constexpr std::uint8_t zeros = 18;
  struct Part {
    std::uint8_t symbol, extra;
  };
  std::vector<Part> parts;
  for (std::size_t i = 0; i < lengths.size();) {
    std::size_t run = 0;
    while (i + run < lengths.size() && run < most_zeros && lengths[i + run] == 0) ++run;
    if (run >= least_zeros) {
      parts.push_back({zeros, static_cast<std::uint8_t>(run - least_zeros)});
      i += run;
    } else {
      parts.push_back({lengths[i], 0});
      ++i;
    }
  }
  std::array<std::uint32_t, 19> counts{};
  for (const Part& part : parts) ++counts[part.symbol];
  const std::vector<std::uint8_t> own = code_lengths(counts, longest_length_code);
  const std::vector<Code> codes = codes_of(own);
  bits.put(0, 1);  // not simple
  bits.put(order.size() - 4, 4);
  for (const std::uint8_t symbol : order) {
    bits.flush();
    bits.put(own[symbol], 3);
  }
  bits.put(0, 1);  // all symbols have a length
  for (const Part& part : parts) {
    bits.flush();
    bits.put(codes[part.symbol]);
    if (part.symbol == zeros) bits.put(part.extra, 7);
  }
  bits.flush();
}

}  // namespace

std::vector<std::uint8_t> webp_alpha(std::span<const std::uint8_t> alpha, std::uint32_t width) {
  const std::vector<Token> tokens = tokens_of(alpha, width);
  std::array<std::uint32_t, literals + length_codes> counts{};
  for (const Token& token : tokens) ++counts[token.symbol];
  const std::vector<std::uint8_t> lengths = code_lengths(counts, longest_code);
  const std::vector<Code> codes = codes_of(lengths);

  constexpr std::size_t head = 1024, most_bits = 15 + 11 + 1;
  std::vector<std::uint8_t> chunk(head + tokens.size() * most_bits / 8 + sizeof(std::uint64_t));
  chunk[0] = lossless_without_filter;
  BitWriter bits(chunk.data() + 1);
  bits.put(0, 3);  // no transform, no cache of colours, one group of codes
  put_lengths(bits, lengths);
  for (int channel = 0; channel < 3; ++channel) put_constant(bits);  // red, blue, alpha
  // Distances: two symbols of one bit each.
  constexpr std::uint32_t simple = 1, two = 1;
  bits.put(simple, 1);
  bits.put(two, 1);
  bits.put(0, 1);  // the first symbol has one bit: 0
  bits.put(0, 1);
  bits.put(1, 8);
  for (const Token& token : tokens) {
    bits.flush();
    bits.put(codes[token.symbol]);
    if (token.symbol < literals) continue;
    bits.put(token.extra, token.extra_bits);
    bits.put(static_cast<std::uint64_t>(token.distance), 1);
  }
  chunk.resize(static_cast<std::size_t>(bits.finish() - chunk.data()));
  return chunk;
}

}  // namespace seedmesh::texture
