// JPEG files; see decode.h. libjpeg leaves a call by longjmp: every function here that calls it is a frame of plain data.
#include <cstddef>
#include <cstdio>

#include <jpeglib.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <string>

#include "core/texture/decode.h"

// NOLINTBEGIN(cert-err52-cpp, modernize-avoid-setjmp-longjmp)

namespace seedmesh::texture {
namespace {

// Progressive files with more scans than this only cost time.
constexpr int most_scans = 200;
// Bytes that libjpeg may allocate by itself, for coefficients of progressive files.
constexpr long most_memory = 1L << 30;
constexpr std::uint32_t rows_a_look = 64;

struct Reader {
  jpeg_decompress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg_progress_mgr progress{};
  std::jmp_buf back{};
  std::array<char, JMSG_LENGTH_MAX> library_message{};
  bool is_made = false;

  Reader() = default;
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;
  ~Reader() {
    if (is_made) jpeg_destroy_decompress(&jpeg);
  }
};

[[noreturn]] void on_error(j_common_ptr jpeg) {
  auto* reader = static_cast<Reader*>(jpeg->client_data);
  jpeg->err->format_message(jpeg, reader->library_message.data());
  std::longjmp(reader->back, 1);
}

/// Warnings report damaged data, which would give wrong heights.
void on_message(j_common_ptr jpeg, int level) {
  if (level < 0) on_error(jpeg);
}

void on_progress(j_common_ptr jpeg) {
  const auto* decompress = reinterpret_cast<j_decompress_ptr>(jpeg);
  if (decompress->input_scan_number <= most_scans) return;
  auto* reader = static_cast<Reader*>(jpeg->client_data);
  std::snprintf(reader->library_message.data(), reader->library_message.size(), "it has more than %d scans",
                most_scans);
  std::longjmp(reader->back, 1);
}

bool read_head(Reader& reader, std::span<const std::byte> file) {
  reader.jpeg.err = jpeg_std_error(&reader.errors);
  reader.errors.error_exit = on_error;
  reader.errors.emit_message = on_message;
  reader.jpeg.client_data = &reader;
  if (setjmp(reader.back)) return false;
  jpeg_create_decompress(&reader.jpeg);
  reader.is_made = true;
  reader.jpeg.client_data = &reader;
  reader.jpeg.mem->max_memory_to_use = most_memory;
  reader.progress.progress_monitor = on_progress;
  reader.jpeg.progress = &reader.progress;
  jpeg_mem_src(&reader.jpeg, reinterpret_cast<const unsigned char*>(file.data()),
               static_cast<unsigned long>(file.size()));
  jpeg_read_header(&reader.jpeg, TRUE);
  return true;
}

bool start(Reader& reader) {
  if (setjmp(reader.back)) return false;
  const bool is_grey = reader.jpeg.num_components == 1;
  reader.jpeg.out_color_space = is_grey ? JCS_GRAYSCALE : JCS_RGB;
  reader.jpeg.dct_method = JDCT_ISLOW;
  reader.jpeg.do_fancy_upsampling = FALSE;
  jpeg_start_decompress(&reader.jpeg);
  return true;
}

bool read_rows(Reader& reader, std::uint8_t* first, std::size_t row_bytes, std::uint32_t count) {
  if (setjmp(reader.back)) return false;
  const std::uint32_t end = reader.jpeg.output_scanline + count;
  for (JSAMPROW row = first; reader.jpeg.output_scanline < end; row += row_bytes)
    jpeg_read_scanlines(&reader.jpeg, &row, 1);
  return true;
}

Error damaged(const Reader& reader) {
  return detail::refused_picture(std::string("the JPEG is damaged: ") + reader.library_message.data());
}

}  // namespace

Result<Picture> decode_jpeg(std::span<const std::byte> file, const PngLimits& limits, const Job& job) {
  Reader reader;
  if (!read_head(reader, file)) return damaged(reader);
  if (auto error = detail::size_error("JPEG", reader.jpeg.image_width, reader.jpeg.image_height, limits))
    return *std::move(error);
  const int components = reader.jpeg.num_components;
  if (components != 1 && components != 3) {
    return detail::refused_picture("the JPEG has " + std::to_string(components) +
                                   " channels; expected 1 or 3");
  }
  Picture picture;
  picture.width = reader.jpeg.image_width;
  picture.height = reader.jpeg.image_height;
  picture.channels = components;
  const std::size_t row_bytes = std::size_t{picture.width} * static_cast<std::size_t>(components);
  // What a progressive file needs besides: a coefficient of two bytes for each sample, and blocks at the borders.
  const Array<std::uint8_t> coefficients(job, jpeg_has_multiple_scans(&reader.jpeg)
                                                  ? 2 * (row_bytes + 64) * (std::size_t{picture.height} + 16)
                                                  : 0);
  picture.bytes = Array<std::uint8_t>(job, row_bytes * picture.height);
  if (!start(reader)) return damaged(reader);
  for (std::uint32_t row = 0; row < picture.height; row += rows_a_look) {
    job.check();
    if (!read_rows(reader, picture.bytes.data() + row * row_bytes, row_bytes,
                   std::min(rows_a_look, picture.height - row)))
      return damaged(reader);
  }
  return picture;
}

}  // namespace seedmesh::texture

// NOLINTEND(cert-err52-cpp, modernize-avoid-setjmp-longjmp)
