#pragma once
/// Random numbers by key. The n-th draw of a stream depends only on the seed, the path of names and
/// indices that leads to the stream, and n. A draw in one part of a model therefore never changes the draws
/// elsewhere. The distributions of <random> are not used, because they differ between standard libraries.
///
/// The mixing function is the finaliser of SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom
/// number generators", 2014, variant 13 of Stafford's mixers).
#include <cstdint>
#include <string_view>

namespace seedmesh {

/// A bijection of 64-bit words whose output bits all depend on all input bits.
constexpr std::uint64_t mix(std::uint64_t x) {
  x ^= x >> 30U;
  x *= 0xBF58476D1CE4E5B9U;
  x ^= x >> 27U;
  x *= 0x94D049BB133111EBU;
  x ^= x >> 31U;
  return x;
}

/// Returns the key of child `index` of `key`. The order of the arguments matters.
constexpr std::uint64_t key_at(std::uint64_t key, std::uint64_t index) {
  return mix(key + 0x9E3779B97F4A7C15U * (index + 1));
}

/// A stream of random numbers. Cheap to copy; `at` does not advance it.
class Rng {
 public:
  explicit constexpr Rng(std::uint64_t key) : key_(key) {}

  /// Returns the stream for the seed of a request.
  static constexpr Rng of_seed(std::uint64_t seed) { return Rng(mix(seed ^ 0x5EED5EED5EED5EEDU)); }

  /// Returns a child stream, e.g. rng.at("limb").at(limb_index).
  constexpr Rng at(std::uint64_t index) const { return Rng(key_at(key_, index)); }
  constexpr Rng at(std::string_view name) const {
    std::uint64_t hash = 0xCBF29CE484222325U;  // FNV-1a
    for (char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001B3U;
    return Rng(key_at(key_, hash));
  }

  constexpr std::uint64_t next() { return mix(key_ + 0x9E3779B97F4A7C15U * ++count_); }

  /// Uniform in [0, 1), 53 random bits.
  constexpr double unit() { return static_cast<double>(next() >> 11U) * 0x1p-53; }

  /// Uniform in [low, high).
  constexpr double uniform(double low, double high) { return low + (high - low) * unit(); }

  /// Uniform in 0 .. count-1; count > 0. The bias is below 2^-32 for counts up to 2^32.
  constexpr std::uint32_t below(std::uint32_t count) {
    return static_cast<std::uint32_t>(((next() >> 32U) * count) >> 32U);
  }

  constexpr std::uint64_t key() const { return key_; }

 private:
  std::uint64_t key_;
  std::uint64_t count_ = 0;
};

/// Returns a normally distributed number, by Marsaglia's polar method with the deterministic functions of math.h.
double normal(Rng& rng, double mean, double deviation);

}  // namespace seedmesh
