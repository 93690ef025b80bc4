#include "server/compress.h"

#include <brotli/encode.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <memory>
#include <new>
#include <stdexcept>

namespace seedmesh {
namespace {

constexpr int raw_window = -15;
constexpr int gzip_window = 15 + 16;

std::size_t size_of(const std::vector<std::span<const std::byte>>& pieces) {
  std::size_t total = 0;
  for (const auto piece : pieces) total += piece.size();
  return total;
}

std::string deflate_all(const std::vector<std::span<const std::byte>>& pieces, int level, int window) {
  z_stream stream{};
  if (deflateInit2(&stream, level, Z_DEFLATED, window, 8, Z_DEFAULT_STRATEGY) != Z_OK) throw std::bad_alloc();
  std::string out;
  out.resize(std::min<std::size_t>(size_of(pieces) / 2 + 64, 1U << 20U));
  std::size_t written = 0;
  const auto run = [&](int flush) {
    int status = Z_OK;
    do {
      if (written == out.size()) out.resize(out.size() + out.size() / 2);
      const auto room = static_cast<uInt>(std::min<std::size_t>(out.size() - written, 1U << 30U));
      stream.next_out = reinterpret_cast<Bytef*>(out.data() + written);
      stream.avail_out = room;
      status = deflate(&stream, flush);
      written += room - stream.avail_out;
    } while (flush == Z_FINISH ? status != Z_STREAM_END : stream.avail_in > 0);
  };
  for (auto piece : pieces) {
    while (!piece.empty()) {
      const auto part = piece.first(std::min<std::size_t>(piece.size(), 1U << 30U));
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(part.data()));
      stream.avail_in = static_cast<uInt>(part.size());
      run(Z_NO_FLUSH);
      piece = piece.subspan(part.size());
    }
  }
  run(Z_FINISH);
  deflateEnd(&stream);
  out.resize(written);
  out.shrink_to_fit();
  return out;
}

std::string brotli_all(const std::vector<std::span<const std::byte>>& pieces, int quality) {
  const std::unique_ptr<BrotliEncoderState, void (*)(BrotliEncoderState*)> state(
      BrotliEncoderCreateInstance(nullptr, nullptr, nullptr), BrotliEncoderDestroyInstance);
  if (!state) throw std::bad_alloc();
  BrotliEncoderSetParameter(state.get(), BROTLI_PARAM_QUALITY, static_cast<std::uint32_t>(quality));
  BrotliEncoderSetParameter(state.get(), BROTLI_PARAM_SIZE_HINT,
                            static_cast<std::uint32_t>(std::min<std::size_t>(size_of(pieces), 1U << 30U)));
  std::string out;
  const auto run = [&](BrotliEncoderOperation operation, std::span<const std::byte> piece) {
    std::size_t left = piece.size(), room = 0;
    const auto* next = reinterpret_cast<const std::uint8_t*>(piece.data());
    do {
      if (!BrotliEncoderCompressStream(state.get(), operation, &left, &next, &room, nullptr, nullptr))
        throw std::bad_alloc();
      std::size_t taken = 0;
      const std::uint8_t* made = BrotliEncoderTakeOutput(state.get(), &taken);
      out.append(reinterpret_cast<const char*>(made), taken);
    } while (left > 0 || BrotliEncoderHasMoreOutput(state.get()));
  };
  for (const auto piece : pieces) run(BROTLI_OPERATION_PROCESS, piece);
  run(BROTLI_OPERATION_FINISH, {});
  return out;
}

std::string zstd_all(const std::vector<std::span<const std::byte>>& pieces, int level) {
  const std::unique_ptr<ZSTD_CCtx, std::size_t (*)(ZSTD_CCtx*)> context(ZSTD_createCCtx(), ZSTD_freeCCtx);
  if (!context) throw std::bad_alloc();
  const auto sound = [](std::size_t status) {
    if (ZSTD_isError(status)) throw std::bad_alloc();  // nothing else can go wrong while compressing
    return status;
  };
  sound(ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, level));
  sound(ZSTD_CCtx_setPledgedSrcSize(context.get(), size_of(pieces)));
  std::string out(std::min<std::size_t>(size_of(pieces) / 2 + 64, 1U << 20U), '\0');
  std::size_t written = 0;
  const auto run = [&](ZSTD_EndDirective directive, std::span<const std::byte> piece) {
    ZSTD_inBuffer input{piece.data(), piece.size(), 0};
    std::size_t left = 0;
    do {
      if (written == out.size()) out.resize(out.size() + out.size() / 2);
      ZSTD_outBuffer output{out.data(), out.size(), written};
      left = sound(ZSTD_compressStream2(context.get(), &output, &input, directive));
      written = output.pos;
    } while (directive == ZSTD_e_end ? left > 0 : input.pos < input.size);
  };
  for (const auto piece : pieces) run(ZSTD_e_continue, piece);
  run(ZSTD_e_end, {});
  out.resize(written);
  out.shrink_to_fit();
  return out;
}

}  // namespace

std::string encode(Coding coding, const std::vector<std::span<const std::byte>>& pieces, Effort effort) {
  const auto step = static_cast<std::size_t>(effort);
  static constexpr int gzip_levels[] = {1, 6, 9}, brotli_qualities[] = {3, 5, 11}, zstd_levels[] = {1, 3, 19};
  switch (coding) {
    case Coding::gzip:
      return deflate_all(pieces, gzip_levels[step], gzip_window);
    case Coding::br:
      return brotli_all(pieces, brotli_qualities[step]);
    case Coding::zstd:
      return zstd_all(pieces, zstd_levels[step]);
    case Coding::identity:
      break;
  }
  throw std::invalid_argument("identity is no coding to encode with");
}

std::string encode(Coding coding, std::string_view text, Effort effort) {
  return encode(coding, {std::as_bytes(std::span(text))}, effort);
}

std::string deflate_raw(std::string_view text) {
  return deflate_all({std::as_bytes(std::span(text))}, 9, raw_window);
}

std::optional<std::string> inflate_raw(std::string_view data, std::size_t most) {
  z_stream stream{};
  if (inflateInit2(&stream, raw_window) != Z_OK) throw std::bad_alloc();
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));
  stream.avail_in = static_cast<uInt>(data.size());
  std::string out;
  int status = Z_OK;
  while (status == Z_OK && out.size() <= most) {
    char room[16 * 1'024];
    stream.next_out = reinterpret_cast<Bytef*>(room);
    stream.avail_out = sizeof(room);
    status = inflate(&stream, Z_NO_FLUSH);
    out.append(room, sizeof(room) - stream.avail_out);
    if (status == Z_OK && stream.avail_in == 0 && stream.avail_out > 0) break;  // it ends too early
  }
  const bool whole = status == Z_STREAM_END && stream.avail_in == 0 && out.size() <= most;
  inflateEnd(&stream);
  if (!whole) return std::nullopt;
  return out;
}

}  // namespace seedmesh
