#include "server/compress.h"

#include <zlib.h>

#include <algorithm>
#include <cassert>
#include <limits>
#include <new>

namespace seedmesh {
namespace {

constexpr int raw_window = -15;
constexpr int gzip_window = 15 + 16;

std::string deflate_all(const std::vector<std::span<const std::byte>>& pieces, int level, int window) {
  z_stream stream{};
  if (deflateInit2(&stream, level, Z_DEFLATED, window, 8, Z_DEFAULT_STRATEGY) != Z_OK) throw std::bad_alloc();
  std::string out;
  std::size_t total = 0;
  for (const auto piece : pieces) total += piece.size();
  out.resize(std::min<std::size_t>(total / 2 + 64, 1U << 20U));
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

}  // namespace

std::string gzip(const std::vector<std::span<const std::byte>>& pieces, int level) {
  return deflate_all(pieces, level, gzip_window);
}

std::string gzip(std::string_view text, int level) {
  return deflate_all({std::as_bytes(std::span(text))}, level, gzip_window);
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
