#include "core/texture/png.h"

#include <libdeflate.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <exception>
#include <memory>
#include <string>
#include <vector>

#include "core/texture/run_deflate.h"

// libpng leaves a call by longjmp. Every function here that calls it is a frame of plain data: what has a
// destructor belongs to its caller, and no callback lets an exception pass through the library.
// NOLINTBEGIN(cert-err52-cpp, modernize-avoid-setjmp-longjmp)

namespace seedmesh::texture {
namespace {

constexpr bool little_endian = std::endian::native == std::endian::little;

// Rows between two checks of the deadline.
constexpr std::uint32_t rows_a_look = 64;
// Deflate cannot store more than this number of bytes in one (RFC 1951: 258 bytes in a code of 2 bits, and
// framing).
constexpr std::uint64_t densest_deflate = 1032;
// The most bytes of a chunk other than image data. Palettes have 768; profiles and texts are skipped.
constexpr png_alloc_size_t largest_chunk = 1 << 20U;

/// The last message of libpng.
struct LibraryMessage {
  std::array<char, 128> text{};
  void take(const char* message) {
    const std::size_t length = std::min(std::strlen(message), text.size() - 1);
    std::memcpy(text.data(), message, length);
    text[length] = 0;
  }
};

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
  static_cast<LibraryMessage*>(png_get_error_ptr(png))->take(message);
  png_longjmp(png, 1);
}
void on_warning(png_structp /*png*/, png_const_charp /*message*/) {}

// --- Writing row by row

struct Writer {
  png_structp png = nullptr;
  png_infop info = nullptr;
  LibraryMessage library_message;
  Array<std::uint8_t> out;
  std::exception_ptr failure;

  explicit Writer(const Job& job) : out(job) {}
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;
  ~Writer() { png_destroy_write_struct(&png, &info); }

  bool append(const png_byte* data, std::size_t length) noexcept {
    try {
      out.append({data, length});
      return true;
    } catch (...) {
      failure = std::current_exception();
      return false;
    }
  }
};

void on_write(png_structp png, png_bytep data, std::size_t length) {
  if (!static_cast<Writer*>(png_get_io_ptr(png))->append(data, length)) png_error(png, "stopped");
}
void on_flush(png_structp /*png*/) {}

int color_type(int channels) {
  constexpr std::array<int, 4> types = {PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                        PNG_COLOR_TYPE_RGB_ALPHA};
  return types[static_cast<std::size_t>(channels - 1)];
}

bool write_head(Writer& writer, const PictureView& picture) {
  if (setjmp(png_jmpbuf(writer.png))) return false;
  png_set_write_fn(writer.png, &writer, on_write, on_flush);
  png_set_user_limits(writer.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_IHDR(writer.png, writer.info, picture.width, picture.height, picture.bits,
               color_type(picture.channels), PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  png_set_compression_buffer_size(writer.png, std::size_t{1} << 16U);
  png_set_compression_level(writer.png, 1);
  png_set_compression_mem_level(writer.png, 8);
  png_set_compression_strategy(writer.png, 1);  // Z_FILTERED
  png_set_filter(writer.png, PNG_FILTER_TYPE_BASE, PNG_FILTER_UP);
  png_write_info(writer.png, writer.info);
  if (picture.bits == 16 && little_endian) png_set_swap(writer.png);
  return true;
}

bool write_rows(Writer& writer, const std::byte* first, std::size_t row_bytes, std::uint32_t count) {
  if (setjmp(png_jmpbuf(writer.png))) return false;
  for (std::uint32_t i = 0; i < count; ++i) {
    png_write_row(writer.png, reinterpret_cast<png_const_bytep>(first + i * row_bytes));
  }
  return true;
}

bool write_end(Writer& writer) {
  if (setjmp(png_jmpbuf(writer.png))) return false;
  png_write_end(writer.png, nullptr);
  return true;
}

// --- Writing without a stream

constexpr std::array<std::uint8_t, 8> signature = {137, 'P', 'N', 'G', '\r', '\n', 26, '\n'};
constexpr std::size_t chunk_head = 8, chunk_foot = 4;  // length and type; checksum

void put_big_endian(std::uint8_t* out, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) out[i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
}

/// Writes the length, the type and the checksum around `length` bytes of data that follow the head.
void seal_chunk(std::uint8_t* head, const char* type, std::size_t length) {
  put_big_endian(head, static_cast<std::uint32_t>(length));
  std::memcpy(head + 4, type, 4);
  put_big_endian(head + chunk_head + length, libdeflate_crc32(0, head + 4, length + 4));
}

std::vector<std::uint8_t> chunk(const char* type, std::span<const std::uint8_t> data) {
  std::vector<std::uint8_t> made(chunk_head + data.size() + chunk_foot);
  std::copy(data.begin(), data.end(), made.begin() + chunk_head);
  seal_chunk(made.data(), type, data.size());
  return made;
}

std::array<std::uint8_t, 13> header_bytes(const PictureView& picture) {
  std::array<std::uint8_t, 13> made{};
  put_big_endian(made.data(), picture.width);
  put_big_endian(made.data() + 4, picture.height);
  made[8] = static_cast<std::uint8_t>(picture.bits);
  const int type = picture.palette.empty() ? color_type(picture.channels) : PNG_COLOR_TYPE_PALETTE;
  made[9] = static_cast<std::uint8_t>(type);
  return made;  // deflate, adaptive filters, no interlacing: three zeros
}

/// Swaps the bytes of 16-bit values: PNG has the high byte first.
void swap_bytes(std::uint8_t* values, std::size_t bytes) {
  for (std::size_t i = 0; i + 1 < bytes; i += 2) std::swap(values[i], values[i + 1]);
}

/// Rows as in the file: the number of the filter Up, then each byte less the one above it.
Array<std::uint8_t> filtered_up(const PictureView& picture, std::size_t row_bytes, const Job& job) {
  constexpr std::uint8_t filter_up = 2;
  Array<std::uint8_t> rows(job, (row_bytes + 1) * picture.height);
  const auto* pixels = reinterpret_cast<const std::uint8_t*>(picture.bytes.data());
  for (std::uint32_t y = 0; y < picture.height; ++y) {
    if (y % rows_a_look == 0) job.check();
    const std::uint8_t* now = pixels + y * row_bytes;
    std::uint8_t* out = rows.data() + y * (row_bytes + 1);
    *out++ = filter_up;
    if (y == 0) {
      std::memcpy(out, now, row_bytes);
    } else {
      const std::uint8_t* above = now - row_bytes;
      for (std::size_t i = 0; i < row_bytes; ++i) out[i] = static_cast<std::uint8_t>(now[i] - above[i]);
    }
    if (picture.bits == 16 && little_endian) swap_bytes(out, row_bytes);
  }
  return rows;
}

std::size_t row_size(const PictureView& picture) {
  return std::size_t{picture.width} * static_cast<std::size_t>(picture.channels) *
         static_cast<std::size_t>(picture.bits / 8);
}

/// Appends the chunk of image data.
void append_small(Array<std::uint8_t>& out, const Array<std::uint8_t>& rows) {
  constexpr int level = 4;
  const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
      libdeflate_alloc_compressor(level), &libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  const std::size_t start = out.size();
  const std::size_t bound = libdeflate_zlib_compress_bound(compressor.get(), rows.size());
  out.resize(start + chunk_head + bound + chunk_foot);
  const std::size_t length = libdeflate_zlib_compress(compressor.get(), rows.data(), rows.size(),
                                                      out.data() + start + chunk_head, bound);
  assert(length > 0);
  seal_chunk(out.data() + start, "IDAT", length);
  out.resize(start + chunk_head + length + chunk_foot);
}

void append_quick(Array<std::uint8_t>& out, const Array<std::uint8_t>& rows, std::size_t pixel_bytes,
                  const Job& job) {
  const std::size_t period = pixel_bytes <= 4 ? pixel_bytes : 1;
  const std::size_t start = out.size();
  out.resize(start + chunk_head + run_deflate_bound(rows.size()) + chunk_foot);
  const std::size_t length = run_deflate(rows.span(), period, out.data() + start + chunk_head, job);
  seal_chunk(out.data() + start, "IDAT", length);
  out.resize(start + chunk_head + length + chunk_foot);
}

/// The whole file in memory.
Array<std::uint8_t> encode_at_once(const PictureView& picture, PngEffort effort, const Job& job) {
  const Array<std::uint8_t> rows = filtered_up(picture, row_size(picture), job);
  Array<std::uint8_t> out(job);
  out.append(signature);
  out.append(chunk("IHDR", header_bytes(picture)));
  if (!picture.palette.empty()) {
    std::vector<std::uint8_t> colors;
    for (const glm::u8vec3& color : picture.palette) colors.insert(colors.end(), {color.x, color.y, color.z});
    out.append(chunk("PLTE", colors));
  }
  if (effort == PngEffort::small) {
    append_small(out, rows);
  } else {
    append_quick(out, rows, row_size(picture) / picture.width, job);
  }
  out.append(chunk("IEND", {}));
  out.shrink_to_fit();
  job.check();
  return out;
}

/// Row by row with libpng, so that large pictures need no second copy.
Array<std::uint8_t> encode_in_rows(const PictureView& picture, const Job& job) {
  const std::size_t row_bytes = row_size(picture);
  Writer writer(job);
  writer.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &writer.library_message, on_error, on_warning);
  if (writer.png) writer.info = png_create_info_struct(writer.png);
  if (!writer.info) throw std::bad_alloc();
  bool good = write_head(writer, picture);
  for (std::uint32_t row = 0; good && row < picture.height; row += rows_a_look) {
    job.check();
    good = write_rows(writer, picture.bytes.data() + row * row_bytes, row_bytes,
                      std::min(rows_a_look, picture.height - row));
  }
  good = good && write_end(writer);
  if (writer.failure) std::rethrow_exception(writer.failure);
  if (!good) throw std::bad_alloc();  // all that can still fail is libpng's own memory
  writer.out.shrink_to_fit();
  return std::move(writer.out);
}

// --- Reading

struct Reader {
  png_structp png = nullptr;
  png_infop info = nullptr;
  LibraryMessage library_message;
  std::span<const std::byte> rest;
  bool ended = false;  ///< libpng tried to read beyond the end

  explicit Reader(std::span<const std::byte> file) : rest(file) {}
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() { png_destroy_read_struct(&png, &info, nullptr); }
};

void on_read(png_structp png, png_bytep data, std::size_t length) {
  auto* reader = static_cast<Reader*>(png_get_io_ptr(png));
  if (length > reader->rest.size()) {
    reader->ended = true;
    png_error(png, "truncated");
  }
  std::memcpy(data, reader->rest.data(), length);
  reader->rest = reader->rest.subspan(length);
}

struct Header {
  png_uint_32 width = 0, height = 0;
  std::size_t row_bytes = 0;  ///< as the file has them, before expansion
  int passes = 1;
};

bool read_head(Reader& reader, const PngLimits& limits, Header& header) {
  if (setjmp(png_jmpbuf(reader.png))) return false;
  png_set_read_fn(reader.png, &reader, on_read);
  // Its own limits would only say "invalid IHDR data"; ours come next, before anything is allocated.
  png_set_user_limits(reader.png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_chunk_malloc_max(reader.png, largest_chunk);
  png_set_chunk_cache_max(reader.png, 1);
  png_set_keep_unknown_chunks(reader.png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);  // all except those of pixels
  png_read_info(reader.png, reader.info);
  header.width = png_get_image_width(reader.png, reader.info);
  header.height = png_get_image_height(reader.png, reader.info);
  if (header.width > limits.longest_side || header.height > limits.longest_side) return true;
  header.row_bytes = png_get_rowbytes(reader.png, reader.info);
  png_set_expand(reader.png);  // palettes, few bits, one transparent colour
  if (little_endian) png_set_swap(reader.png);
  header.passes = png_set_interlace_handling(reader.png);
  png_read_update_info(reader.png, reader.info);
  return true;
}

bool read_rows(Reader& reader, std::uint8_t* first, std::size_t row_bytes, std::uint32_t count) {
  if (setjmp(png_jmpbuf(reader.png))) return false;
  for (std::uint32_t i = 0; i < count; ++i) png_read_row(reader.png, first + i * row_bytes, nullptr);
  return true;
}

bool read_end(Reader& reader) {
  if (setjmp(png_jmpbuf(reader.png))) return false;
  png_read_end(reader.png, nullptr);
  return true;
}

Error refused(std::string message) {
  return Error{Code::invalid, {{IssueKind::invalid_value, "", std::move(message)}}};
}

Error damaged(const Reader& reader, std::size_t size) {
  if (reader.ended) {
    return refused("the PNG is truncated: it ends after " + std::to_string(size) +
                   " bytes, before the end of its data");
  }
  return refused(std::string("the PNG is damaged: ") + reader.library_message.text.data());
}

std::string size_text(const Header& header) {
  return std::to_string(header.width) + " x " + std::to_string(header.height);
}

}  // namespace

std::uint32_t Picture::channel(std::size_t index) const {
  if (bits == 8) return bytes[index];
  std::uint16_t value = 0;
  std::memcpy(&value, bytes.data() + index * 2, sizeof(value));
  return value;
}

Array<std::uint8_t> encode_png(const PictureView& picture, PngEffort effort, const Job& job) {
  assert(picture.width > 0 && picture.height > 0 && (picture.bits == 8 || picture.bits == 16));
  assert(picture.channels >= 1 && picture.channels <= 4);
  assert(picture.bytes.size() == row_size(picture) * picture.height);
  assert(picture.palette.empty() || (picture.channels == 1 && picture.bits == 8 &&
                                     picture.palette.size() <= 256 && effort != PngEffort::streamed));
  return effort == PngEffort::streamed ? encode_in_rows(picture, job) : encode_at_once(picture, effort, job);
}

Result<Picture> decode_png(std::span<const std::byte> file, const PngLimits& limits, const Job& job) {
  constexpr std::size_t signature_size = 8;
  if (file.size() < signature_size ||
      png_sig_cmp(reinterpret_cast<png_const_bytep>(file.data()), 0, signature_size) != 0) {
    return refused("found " + std::to_string(file.size()) + " bytes without the signature of a PNG");
  }
  Reader reader(file);
  reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader.library_message, on_error, on_warning);
  if (reader.png) reader.info = png_create_info_struct(reader.png);
  if (!reader.info) throw std::bad_alloc();

  Header header;
  if (!read_head(reader, limits, header)) return damaged(reader, file.size());
  if (header.width > limits.longest_side || header.height > limits.longest_side) {
    return refused("the PNG has " + size_text(header) + " pixels; a side may have " +
                   std::to_string(limits.longest_side));
  }
  Picture picture;
  picture.width = header.width;
  picture.height = header.height;
  picture.channels = png_get_channels(reader.png, reader.info);
  picture.bits = png_get_bit_depth(reader.png, reader.info);
  const std::size_t row_bytes = png_get_rowbytes(reader.png, reader.info);
  if (std::uint64_t{header.row_bytes} * header.height > densest_deflate * file.size()) {
    return refused("the PNG is truncated: " + std::to_string(file.size()) + " bytes cannot hold " +
                   size_text(header) + " pixels");
  }
  picture.bytes = Array<std::uint8_t>(job, row_bytes * header.height);
  for (int pass = 0; pass < header.passes; ++pass) {
    for (std::uint32_t row = 0; row < header.height; row += rows_a_look) {
      job.check();
      if (!read_rows(reader, picture.bytes.data() + row * row_bytes, row_bytes,
                     std::min(rows_a_look, header.height - row))) {
        return damaged(reader, file.size());
      }
    }
  }
  if (!read_end(reader)) return damaged(reader, file.size());
  return picture;
}

}  // namespace seedmesh::texture

// NOLINTEND(cert-err52-cpp, modernize-avoid-setjmp-longjmp)
