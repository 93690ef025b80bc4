#include "core/texture/run_deflate.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <vector>

#include "core/base/rng.h"

namespace seedmesh::texture {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes deflated(const Bytes& data, std::size_t period) {
  Bytes out(run_deflate_bound(data.size()));
  out.resize(run_deflate(data, period, out.data(), Job(0, Job::Options{})));
  return out;
}

/// The data of a stream as zlib reads it, which refuses codes that do not use all bits and compares the checksum.
Bytes inflated(const Bytes& stream, std::size_t size) {
  Bytes data(size + 1);
  uLongf length = data.size();
  EXPECT_EQ(uncompress(data.data(), &length, stream.data(), stream.size()), Z_OK);
  data.resize(length);
  return data;
}

/// Bytes whose value i occurs with about `ratio` times the probability of value i - 1.
Bytes noise(std::size_t size, double ratio, std::uint64_t seed) {
  Rng rng = Rng::of_seed(seed);
  Bytes data(size);
  for (std::uint8_t& byte : data) {
    byte = 0;
    while (byte < 255 && rng.unit() < ratio) ++byte;
  }
  return data;
}

TEST(RunDeflate, IsReadByZlibWhateverTheData) {
  for (const std::size_t period : {1U, 2U, 3U, 4U}) {
    for (const double ratio : {0.0, 0.1, 0.9, 0.99}) {
      for (const std::size_t size : {0U, 1U, 2U, 3U, 7U, 8U, 9U, 100U, 4'097U}) {
        const Bytes data = noise(size, ratio, size);
        EXPECT_EQ(inflated(deflated(data, period), size), data) << period << ' ' << ratio << ' ' << size;
      }
    }
  }
}

TEST(RunDeflate, WritesRunsOfEveryLength) {
  for (const std::size_t period : {1U, 3U, 4U}) {
    for (std::size_t run = 0; run < 800; ++run) {
      Bytes data = noise(24, 0.95, run);
      for (std::size_t i = 0; i < run; ++i) data.push_back(data[data.size() - period]);
      data.push_back(77);
      ASSERT_EQ(inflated(deflated(data, period), data.size()), data) << period << ' ' << run;
    }
  }
}

// Frequencies of powers of two would need codes of up to 20 bits.
TEST(RunDeflate, LimitsCodesOfVeryRareBytes) {
  Bytes data;
  for (int value = 0; value < 20; ++value) {
    for (int i = 0; i < 1 << value; ++i)
      data.push_back(static_cast<std::uint8_t>((value * 37 + i % 2 * 100) & 255));
  }
  EXPECT_EQ(inflated(deflated(data, 1), data.size()), data);
}

// Shannon's bound. Huffman codes of such bytes are at most 1 % longer. The codes of the 29 lengths, of 14 bits, take
// 29 / 2^14 of the codes, which makes others 0.06 % longer.
TEST(RunDeflate, NeedsAboutTheEntropyOfTheBytes) {
  const Bytes data = noise(500'000, 0.9, 4);
  double count[256] = {}, bits = 0;
  for (const std::uint8_t byte : data) ++count[byte];
  for (const double n : count) {
    if (n > 0) bits -= n * std::log2(n / static_cast<double>(data.size()));
  }
  const auto size = static_cast<double>(deflated(data, 3).size());
  EXPECT_GT(size, bits / 8);
  EXPECT_LT(size, 1.0106 * bits / 8 + 200);
}

// Codes come from a part of large data; all other bytes need codes too.
TEST(RunDeflate, HasCodesForBytesThatOccurOnce) {
  for (const std::size_t at : {1'000U, 1'999U, 60'001U, 299'999U}) {
    for (const int rare : {1, 127, 128, 255}) {
      Bytes data = noise(300'000, 0.5, 1);
      data[at] = static_cast<std::uint8_t>(rare);
      EXPECT_EQ(inflated(deflated(data, 1), data.size()), data) << at << ' ' << rare;
    }
  }
}

TEST(RunDeflate, NeedsNextToNothingForEqualPixels) {
  const Bytes data(300'000, 9);
  EXPECT_LT(deflated(data, 3).size(), 500U);
}

}  // namespace
}  // namespace seedmesh::texture
