#include <array>
#include <string_view>

#include "core/base/array.h"
#include "core/gltf/bin.h"

namespace seedmesh::gltf {
namespace {

constexpr std::size_t block_bytes = std::size_t{3} << 20U;  ///< encoded at once; text of 4 MiB

/// Two characters for each 12 bits: half as many look-ups as one character for 6, and 8 KiB stay in the first
/// cache.
constexpr auto pairs = [] {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<std::array<char, 2>, 4096> table{};
  for (std::size_t i = 0; i < table.size(); ++i) table[i] = {digits[i >> 6U], digits[i & 63U]};
  return table;
}();

char* put_triple(char* out, const std::byte* in) {
  const unsigned bits = std::to_integer<unsigned>(in[0]) << 16U | std::to_integer<unsigned>(in[1]) << 8U |
                        std::to_integer<unsigned>(in[2]);
  std::memcpy(out, pairs[bits >> 12U].data(), 2);
  std::memcpy(out + 2, pairs[bits & 4095U].data(), 2);
  return out + 4;
}

/// Encodes a stream that comes in parts of any length: up to two bytes wait for the next part.
class Encoder {
 public:
  Encoder(Payload& payload, Job& job) : payload_(payload), job_(job) {}

  void add(std::span<const std::byte> bytes) {
    for (; !bytes.empty(); bytes = bytes.subspan(std::min(bytes.size(), block_bytes))) {
      add_block(bytes.first(std::min(bytes.size(), block_bytes)));
      job_.check();
    }
  }

  void finish() {
    if (waiting_ == 0) return;
    for (std::size_t i = waiting_; i < 3; ++i) rest_[i] = std::byte{0};
    std::string last(4, '=');
    put_triple(last.data(), rest_.data());
    std::fill(last.begin() + static_cast<std::ptrdiff_t>(waiting_) + 1, last.end(), '=');
    payload_.add(std::move(last));
  }

 private:
  void add_block(std::span<const std::byte> bytes) {
    auto text = std::make_shared<Array<char>>(job_, (waiting_ + bytes.size()) / 3 * 4);
    char* out = text->data();
    while (waiting_ > 0 && !bytes.empty()) {
      rest_[waiting_++] = bytes.front();
      bytes = bytes.subspan(1);
      if (waiting_ < 3) continue;
      out = put_triple(out, rest_.data());
      waiting_ = 0;
    }
    const std::size_t whole = bytes.size() / 3 * 3;
    for (std::size_t i = 0; i < whole; i += 3) out = put_triple(out, bytes.data() + i);
    for (const std::byte each : bytes.subspan(whole)) rest_[waiting_++] = each;
    const auto written = std::as_bytes(std::as_const(*text).span());
    payload_.add(std::move(text), written);
  }

  Payload& payload_;
  Job& job_;
  std::array<std::byte, 3> rest_{};
  std::size_t waiting_ = 0;
};

}  // namespace

Payload base64(Bin bin, Job& job) {
  Payload payload;
  Encoder encoder(payload, job);
  bin.drain(job, [&](const Slice& slice) { encoder.add(slice.bytes); });
  encoder.finish();
  return payload;
}

}  // namespace seedmesh::gltf
