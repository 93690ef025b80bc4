/// Code lengths by the two-queue method (van Leeuwen, "On the construction of Huffman trees", 1976), limited as zlib
/// limits them: codes that are too long are shortened, and others become longer until the codes fit again.
#include "core/texture/huffman.h"

#include <algorithm>

namespace seedmesh::texture {
namespace {

/// The depths of the leaves of a Huffman tree over weights in ascending order.
std::vector<int> depths_of(const std::vector<std::uint64_t>& weights) {
  const std::size_t leaves = weights.size();
  std::vector<std::uint64_t> weight(weights);
  std::vector<std::size_t> parent(2 * leaves - 1, 0);
  std::size_t leaf = 0, node = leaves;
  const auto take_least = [&] {
    const bool is_leaf = leaf < leaves && (node >= weight.size() || weight[leaf] <= weight[node]);
    return is_leaf ? leaf++ : node++;
  };
  while (weight.size() < 2 * leaves - 1) {
    const std::size_t a = take_least(), b = take_least();
    parent[a] = parent[b] = weight.size();
    weight.push_back(weight[a] + weight[b]);
  }
  std::vector<int> depth(2 * leaves - 1, 0);
  for (std::size_t i = depth.size() - 1; i-- > 0;) depth[i] = depth[parent[i]] + 1;
  depth.resize(leaves);
  return depth;
}

/// Makes the codes fit `most` bits: Kraft's sum of 2^-length must be exactly 1, as decoders demand. Lengths fall with
/// the weight.
void limit(std::vector<int>& lengths, int most) {
  const auto share = [most](int length) { return std::int64_t{1} << (most - length); };
  std::int64_t rest = share(0);
  for (int& length : lengths) {
    length = std::min(length, most);
    rest -= share(length);
  }
  // The rarest symbols that can still become longer come first.
  for (std::size_t i = 0; rest < 0; i = i + 1 < lengths.size() ? i + 1 : 0) {
    if (lengths[i] == most) continue;
    rest += share(lengths[i] + 1);
    ++lengths[i];
  }
  // What is left over goes to the most frequent symbols that it suffices for.
  for (std::size_t i = lengths.size(); rest > 0; i = i > 1 ? i : lengths.size()) {
    --i;
    if (lengths[i] == 1 || share(lengths[i]) > rest) continue;
    rest -= share(lengths[i]);
    --lengths[i];
  }
}

}  // namespace

std::vector<std::uint8_t> code_lengths(std::span<const std::uint32_t> counts, int most) {
  const std::size_t size = counts.size();
  std::vector<std::size_t> used;
  for (std::size_t i = 0; i < size; ++i) {
    if (counts[i] > 0) used.push_back(i);
  }
  // A tree needs two leaves.
  for (std::size_t i = 0; used.size() < 2; ++i) {
    if (counts[i] == 0) used.push_back(i);
  }
  std::stable_sort(used.begin(), used.end(),
                   [&](std::size_t a, std::size_t b) { return counts[a] < counts[b]; });
  std::vector<std::uint64_t> weights;
  for (const std::size_t symbol : used) weights.push_back(std::max(counts[symbol], 1U));
  std::vector<int> lengths = depths_of(weights);
  limit(lengths, most);
  std::vector<std::uint8_t> made(size, 0);
  for (std::size_t i = 0; i < used.size(); ++i) made[used[i]] = static_cast<std::uint8_t>(lengths[i]);
  return made;
}

std::vector<Code> codes_of(std::span<const std::uint8_t> lengths) {
  constexpr std::uint32_t longest_code = 15;
  const std::size_t size = lengths.size();
  std::vector<Code> codes(size);
  std::uint32_t next = 0;
  for (std::uint32_t length = 1; length <= longest_code; ++length) {
    for (std::size_t i = 0; i < size; ++i) {
      if (lengths[i] != length) continue;
      std::uint32_t reversed = 0;
      for (std::uint32_t bit = 0; bit < length; ++bit) reversed |= ((next >> bit) & 1U) << (length - 1 - bit);
      codes[i] = {reversed, length};
      ++next;
    }
    next <<= 1U;
  }
  return codes;
}

}  // namespace seedmesh::texture
