#pragma once
/// Files of pictures for tests. TIFF files without compression are written here byte by byte; the others by the libraries'
/// own writers.
#include <cstdio>
// jpeglib.h needs size_t and FILE.
#include <jpeglib.h>
#include <tiffio.h>
#include <webp/encode.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace seedmesh {

using FileBytes = std::vector<std::uint8_t>;

inline std::span<const std::byte> bytes_of(const FileBytes& file) { return std::as_bytes(std::span(file)); }

/// A JPEG of the best quality without subsampling.
inline FileBytes jpeg_file(const FileBytes& pixels, std::uint32_t width, int channels,
                           bool is_progressive = false) {
  jpeg_compress_struct jpeg{};
  jpeg_error_mgr errors{};
  jpeg.err = jpeg_std_error(&errors);
  jpeg_create_compress(&jpeg);
  unsigned char* data = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&jpeg, &data, &size);
  jpeg.image_width = width;
  jpeg.image_height = static_cast<JDIMENSION>(pixels.size() / width / static_cast<std::size_t>(channels));
  jpeg.input_components = channels;
  jpeg.in_color_space = channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
  jpeg_set_defaults(&jpeg);
  jpeg_set_quality(&jpeg, 100, TRUE);
  if (is_progressive) jpeg_simple_progression(&jpeg);
  jpeg_start_compress(&jpeg, TRUE);
  while (jpeg.next_scanline < jpeg.image_height) {
    JSAMPROW row = const_cast<JSAMPROW>(pixels.data() + std::size_t{jpeg.next_scanline} * width *
                                                            static_cast<std::size_t>(channels));
    jpeg_write_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_compress(&jpeg);
  jpeg_destroy_compress(&jpeg);
  FileBytes file(data, data + size);
  std::free(data);
  return file;
}

/// A WebP without loss, of RGB.
inline FileBytes webp_file(const FileBytes& pixels, int width) {
  std::uint8_t* data = nullptr;
  const int height = static_cast<int>(pixels.size()) / 3 / width;
  const std::size_t size = WebPEncodeLosslessRGB(pixels.data(), width, height, 3 * width, &data);
  FileBytes file(data, data + size);
  WebPFree(data);
  return file;
}

/// A WebP with losses, of RGB.
inline FileBytes lossy_webp_file(const FileBytes& pixels, int width) {
  std::uint8_t* data = nullptr;
  const int height = static_cast<int>(pixels.size()) / 3 / width;
  const std::size_t size = WebPEncodeRGB(pixels.data(), width, height, 3 * width, 75, &data);
  FileBytes file(data, data + size);
  WebPFree(data);
  return file;
}

/// A TIFF of one strip without compression, low byte first.
class TiffText {
 public:
  void entry(std::uint16_t tag, std::uint16_t type, std::uint32_t count, std::uint32_t value) {
    append(entries_, tag, 2);
    append(entries_, type, 2);
    append(entries_, count, 4);
    append(entries_, value, 4);
    ++count_;
  }
  /// A list of doubles, behind the head.
  void doubles(std::uint16_t tag, const std::vector<double>& values) {
    entry(tag, 12, static_cast<std::uint32_t>(values.size()), static_cast<std::uint32_t>(8 + extra_.size()));
    for (const double value : values) {
      std::uint64_t bits = 0;
      std::memcpy(&bits, &value, 8);
      append(extra_, bits, 8);
    }
  }
  void text(std::uint16_t tag, std::string value) {
    while (value.size() < 5) value += ' ';  // short texts stand in the entry itself
    value += '\0';
    entry(tag, 2, static_cast<std::uint32_t>(value.size()), static_cast<std::uint32_t>(8 + extra_.size()));
    extra_.insert(extra_.end(), value.begin(), value.end());
    if (extra_.size() % 2 != 0) extra_.push_back(0);
  }
  FileBytes file(const FileBytes& pixels) const {
    FileBytes made{'I', 'I', 42, 0};
    const std::size_t directory = 8 + extra_.size() + pixels.size() + pixels.size() % 2;
    append(made, directory, 4);
    made.insert(made.end(), extra_.begin(), extra_.end());
    made.insert(made.end(), pixels.begin(), pixels.end());
    if (pixels.size() % 2 != 0) made.push_back(0);
    append(made, count_, 2);
    made.insert(made.end(), entries_.begin(), entries_.end());
    append(made, 0, 4);
    return made;
  }
  std::uint32_t pixels_at() const { return static_cast<std::uint32_t>(8 + extra_.size()); }

  template <class Number>
  static void append(FileBytes& to, Number value, int bytes) {
    for (int i = 0; i < bytes; ++i)
      to.push_back(static_cast<std::uint8_t>(static_cast<std::uint64_t>(value) >> (8 * i)));
  }

 private:
  FileBytes entries_, extra_;
  std::uint16_t count_ = 0;
};

struct TiffForm {
  std::uint32_t width = 0, height = 0;
  std::uint32_t bits = 16, format = 1;  ///< format: 1 unsigned, 2 signed, 3 floating point
  std::string no_data;
  std::vector<double> transformation;
};

template <class Number>
FileBytes tiff_file(const TiffForm& form, const std::vector<Number>& values) {
  FileBytes pixels(values.size() * sizeof(Number));
  std::memcpy(pixels.data(), values.data(), pixels.size());
  TiffText tiff;
  tiff.entry(256, 4, 1, form.width);
  tiff.entry(257, 4, 1, form.height);
  tiff.entry(258, 3, 1, form.bits);
  tiff.entry(259, 3, 1, 1);
  tiff.entry(262, 3, 1, 1);
  TiffText lists;  // only to know how long the lists are
  if (!form.transformation.empty()) lists.doubles(34264, form.transformation);
  if (!form.no_data.empty()) lists.text(42113, form.no_data);
  tiff.entry(273, 4, 1, lists.pixels_at());
  tiff.entry(277, 3, 1, 1);
  tiff.entry(278, 4, 1, form.height);
  tiff.entry(279, 4, 1, static_cast<std::uint32_t>(pixels.size()));
  tiff.entry(339, 3, 1, form.format);
  if (!form.transformation.empty()) tiff.doubles(34264, form.transformation);
  if (!form.no_data.empty()) tiff.text(42113, form.no_data);
  return tiff.file(pixels);
}

/// Floating-point samples in tiles of 16 x 16, with Deflate, by libtiff.
inline FileBytes tiled_tiff_file(const std::vector<float>& values, std::uint32_t width) {
  const std::string path = testing::TempDir() + "seedmesh_tiled.tif";
  const auto height = static_cast<std::uint32_t>(values.size()) / width;
  TIFF* tiff = TIFFOpen(path.c_str(), "w");
  TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, width);
  TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, height);
  TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 32);
  TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
  TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  TIFFSetField(tiff, TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  TIFFSetField(tiff, TIFFTAG_TILEWIDTH, 16);
  TIFFSetField(tiff, TIFFTAG_TILELENGTH, 16);
  for (std::uint32_t z = 0; z < height; z += 16) {
    for (std::uint32_t x = 0; x < width; x += 16) {
      std::vector<float> tile(256, -1.0F);
      for (std::uint32_t k = 0; k < 16 && z + k < height; ++k) {
        for (std::uint32_t i = 0; i < 16 && x + i < width; ++i)
          tile[k * 16 + i] = values[(z + k) * width + x + i];
      }
      TIFFWriteTile(tiff, tile.data(), x, z, 0, 0);
    }
  }
  TIFFClose(tiff);
  std::ifstream in(path, std::ios::binary);
  FileBytes file((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  std::remove(path.c_str());
  return file;
}

}  // namespace seedmesh
