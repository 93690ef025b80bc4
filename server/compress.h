#pragma once
/// Compression: content codings for responses.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "server/negotiate.h"

namespace seedmesh {

/// How much work a coding may cost. `fast` is for responses that are made for one request. It takes 1 to 2 ms
/// per MB: Zstandard level 1, Brotli quality 0, gzip by ISA-L. For at most 64 KiB, gzip is made by
/// libdeflate, in 5 to 8 ms per MB. `once` is the highest level of each coding, for texts that are encoded
/// once; it takes up to a second per MB.
enum class Effort { fast, once };

/// Encodes bytes that arrive in parts as one stream. Not for use from several threads.
class Encoder {
 public:
  virtual ~Encoder() = default;

  /// Encodes a part, or keeps it for later; adds what is ready to `out`. `part` need not outlive the call.
  virtual void add(std::span<const std::byte> part, std::string& out) = 0;

  /// Ends the stream and adds the rest to `out`.
  virtual void end(std::string& out) = 0;
};

/// Returns an encoder for `size` bytes in all. It uses at most `encoder_memory` bytes with Effort::fast. `coding` is
/// not identity. Throws std::bad_alloc.
std::unique_ptr<Encoder> encoder_of(Coding coding, Effort effort, std::uint64_t size);
constexpr std::uint64_t encoder_memory = 3U << 20U;

/// Encodes all pieces as one stream.
std::string encode(Coding coding, const std::vector<std::span<const std::byte>>& pieces, Effort effort);
std::string encode(Coding coding, std::string_view text, Effort effort);

/// Estimates the share of bytes that compression saves, 0 to 1, from samples of the pieces. Images (PNG, WebP,
/// JPEG, KTX 2) count as not compressible. Costs about 1/20 of Effort::fast.
double likely_saving(const std::vector<std::span<const std::byte>>& pieces);

}  // namespace seedmesh
