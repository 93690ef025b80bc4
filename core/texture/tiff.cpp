// TIFF files; see decode.h. Tags of GeoTIFF are those of OGC 19-008r4.
#include <tiffio.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>

#include "core/texture/decode.h"

namespace seedmesh::texture {
namespace {

constexpr std::uint32_t tag_pixel_scale = 33550, tag_transformation = 34264, tag_no_data = 42113;
// Bytes of one allocation of libtiff.
constexpr tmsize_t largest_allocation = tmsize_t{1} << 28;
// Directories compress their data at most by about this factor.
constexpr std::uint64_t densest = 4096;

/// The file in memory, and the first message about it.
struct Source {
  std::span<const std::byte> bytes;
  std::uint64_t at = 0;
  std::array<char, 160> library_message{};
};

int on_error(TIFF* /*tiff*/, void* data, const char* /*module*/, const char* format, va_list arguments) {
  auto* source = static_cast<Source*>(data);
  if (source->library_message[0] == 0)
    std::vsnprintf(source->library_message.data(), source->library_message.size(), format, arguments);
  return 1;
}
int on_warning(TIFF* /*tiff*/, void* /*data*/, const char* /*module*/, const char* /*format*/,
               va_list /*arguments*/) {
  return 1;
}

tmsize_t read_bytes(thandle_t handle, void* to, tmsize_t size) {
  auto* source = static_cast<Source*>(handle);
  if (size <= 0 || source->at >= source->bytes.size()) return 0;
  const std::size_t count =
      std::min<std::size_t>(static_cast<std::size_t>(size), source->bytes.size() - source->at);
  std::memcpy(to, source->bytes.data() + source->at, count);
  source->at += count;
  return static_cast<tmsize_t>(count);
}
tmsize_t write_bytes(thandle_t /*handle*/, void* /*from*/, tmsize_t /*size*/) { return 0; }
toff_t seek(thandle_t handle, toff_t offset, int from) {
  auto* source = static_cast<Source*>(handle);
  const std::uint64_t base = from == SEEK_SET ? 0 : from == SEEK_CUR ? source->at : source->bytes.size();
  source->at = base + offset;
  return source->at;
}
int close_source(thandle_t /*handle*/) { return 0; }
toff_t size_of(thandle_t handle) { return static_cast<Source*>(handle)->bytes.size(); }

using Options = std::unique_ptr<TIFFOpenOptions, decltype(&TIFFOpenOptionsFree)>;
using Handle = std::unique_ptr<TIFF, decltype(&TIFFClose)>;

Handle open(Source& source) {
  const Options options(TIFFOpenOptionsAlloc(), TIFFOpenOptionsFree);
  if (!options) return {nullptr, TIFFClose};
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), largest_allocation);
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), on_error, &source);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), on_warning, &source);
  // "m": no memory mapping.
  return {TIFFClientOpenExt("picture", "rm", &source, read_bytes, write_bytes, seek, close_source, size_of,
                            nullptr, nullptr, options.get()),
          TIFFClose};
}

struct Layout {
  std::uint32_t width = 0, height = 0;
  std::uint16_t bits = 1, channels = 1, format = SAMPLEFORMAT_UINT, photometric = PHOTOMETRIC_MINISBLACK,
                planar = PLANARCONFIG_CONTIG, compression = COMPRESSION_NONE,
                orientation = ORIENTATION_TOPLEFT;
  std::size_t sample_bytes() const { return bits / 8U; }
  /// Channels that lie side by side in the data.
  std::size_t together() const { return planar == PLANARCONFIG_CONTIG ? channels : 1U; }
};

Layout layout_of(TIFF* tiff) {
  Layout layout;
  TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &layout.width);
  TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &layout.height);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &layout.bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &layout.channels);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &layout.format);
  TIFFGetField(tiff, TIFFTAG_PHOTOMETRIC, &layout.photometric);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &layout.planar);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_COMPRESSION, &layout.compression);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_ORIENTATION, &layout.orientation);
  return layout;
}

/// What keeps a file from being read; empty where nothing does.
std::string obstacle(const Layout& layout, std::size_t file_bytes) {
  constexpr std::array<int, 6> compressions{COMPRESSION_NONE,     COMPRESSION_LZW,
                                            COMPRESSION_DEFLATE,  COMPRESSION_ADOBE_DEFLATE,
                                            COMPRESSION_PACKBITS, COMPRESSION_ZSTD};
  const auto found = [](int number, const char* text) { return "found " + std::to_string(number) + text; };
  if (std::find(compressions.begin(), compressions.end(), layout.compression) == compressions.end()) {
    return found(layout.compression,
                 " as the compression; expected none, LZW, Deflate, PackBits or Zstandard");
  }
  const bool is_float = layout.format == SAMPLEFORMAT_IEEEFP;
  const bool is_integer = layout.format == SAMPLEFORMAT_UINT || layout.format == SAMPLEFORMAT_INT ||
                          layout.format == SAMPLEFORMAT_VOID;
  const bool fits = is_float ? layout.bits == 32 || layout.bits == 64
                             : is_integer && (layout.bits == 8 || layout.bits == 16 || layout.bits == 32);
  if (!fits) {
    return found(
        layout.bits,
        " bits of a sample; expected integers of 8, 16 or 32 bits, or floating-point numbers of 32 or 64");
  }
  if (layout.channels < 1 || layout.channels > 8) return found(layout.channels, " channels; expected 1 to 8");
  if (layout.orientation != ORIENTATION_TOPLEFT && layout.orientation != ORIENTATION_BOTLEFT)
    return found(layout.orientation, " as the orientation; expected 1 or 4");
  const std::uint64_t bytes =
      std::uint64_t{layout.width} * layout.height * layout.channels * layout.sample_bytes();
  if (bytes > densest * file_bytes)
    return "it is truncated: " + std::to_string(file_bytes) + " bytes cannot hold its pixels";
  return "";
}

/// The numbers of a tag that libtiff does not define; null if it is missing or no list of at least `least` doubles.
const double* doubles_of(TIFF* tiff, std::uint32_t tag, std::uint32_t least) {
  const TIFFField* field = TIFFFindField(tiff, tag, TIFF_ANY);
  if (!field || TIFFFieldDataType(field) != TIFF_DOUBLE || TIFFFieldReadCount(field) != TIFF_VARIABLE2)
    return nullptr;
  std::uint32_t count = 0;
  const double* values = nullptr;
  return TIFFGetField(tiff, tag, &count, &values) != 0 && count >= least ? values : nullptr;
}

/// Whether the first row is the southern one.
bool is_south_first(TIFF* tiff, const Layout& layout) {
  if (const double* matrix = doubles_of(tiff, tag_transformation, 16)) return matrix[5] > 0;
  if (const double* scale = doubles_of(tiff, tag_pixel_scale, 3); scale && scale[1] < 0) return true;
  return layout.orientation == ORIENTATION_BOTLEFT;
}

std::optional<double> no_data_of(TIFF* tiff) {
  const TIFFField* field = TIFFFindField(tiff, tag_no_data, TIFF_ANY);
  if (!field || TIFFFieldDataType(field) != TIFF_ASCII || TIFFFieldReadCount(field) != TIFF_VARIABLE2)
    return std::nullopt;
  std::uint32_t count = 0;
  const char* text = nullptr;
  if (TIFFGetField(tiff, tag_no_data, &count, &text) == 0 || !text || count == 0) return std::nullopt;
  const char* end = text + count;
  while (text < end && *text == ' ') ++text;
  double value = 0;
  if (std::from_chars(text, end, value).ec != std::errc()) return std::nullopt;
  return value;
}

/// Calls take(data, x, y, width, height) for each strip or tile of the first plane; `data` has rows of `row_bytes`.
template <class Take>
bool each_block(TIFF* tiff, const Layout& layout, const Job& job, const Take& take) {
  const bool is_tiled = TIFFIsTiled(tiff) != 0;
  const tmsize_t size = is_tiled ? TIFFTileSize(tiff) : TIFFStripSize(tiff);
  std::uint32_t wide = layout.width, deep = layout.height;
  if (is_tiled) {
    TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &wide);
    TIFFGetField(tiff, TIFFTAG_TILELENGTH, &deep);
  } else {
    TIFFGetFieldDefaulted(tiff, TIFFTAG_ROWSPERSTRIP, &deep);
    deep = std::min(deep, layout.height);
  }
  const std::uint64_t row_bytes = std::uint64_t{wide} * layout.together() * layout.sample_bytes();
  if (size <= 0 || size > largest_allocation || wide == 0 || deep == 0 ||
      row_bytes * deep > static_cast<std::uint64_t>(size))
    return false;
  Array<std::uint8_t> data(job, static_cast<std::size_t>(size));
  std::uint32_t number = 0;
  for (std::uint32_t y = 0; y < layout.height; y += deep) {
    for (std::uint32_t x = 0; x < layout.width; x += wide, ++number) {
      job.check();
      const std::uint32_t rows = std::min(deep, layout.height - y);
      const auto needed = static_cast<tmsize_t>(row_bytes * (is_tiled ? deep : rows));
      const tmsize_t got = is_tiled ? TIFFReadEncodedTile(tiff, number, data.data(), size)
                                    : TIFFReadEncodedStrip(tiff, number, data.data(), needed);
      if (got < needed) return false;
      take(data.data(), x, y, std::min(wide, layout.width - x), rows, static_cast<std::size_t>(row_bytes));
    }
  }
  return true;
}

template <class Number>
double number_at(const std::uint8_t* at) {
  Number value;
  std::memcpy(&value, at, sizeof(value));
  return static_cast<double>(value);
}

double sample_at(const std::uint8_t* at, const Layout& layout) {
  if (layout.format == SAMPLEFORMAT_IEEEFP)
    return layout.bits == 32 ? number_at<float>(at) : number_at<double>(at);
  const bool has_sign = layout.format == SAMPLEFORMAT_INT;
  if (layout.bits == 8) return has_sign ? number_at<std::int8_t>(at) : number_at<std::uint8_t>(at);
  if (layout.bits == 16) return has_sign ? number_at<std::int16_t>(at) : number_at<std::uint16_t>(at);
  return has_sign ? number_at<std::int32_t>(at) : number_at<std::uint32_t>(at);
}

bool is_picture(const Layout& layout) {
  return (layout.format == SAMPLEFORMAT_UINT || layout.format == SAMPLEFORMAT_VOID) && layout.bits <= 16;
}

struct Palette {
  std::uint16_t *red = nullptr, *green = nullptr, *blue = nullptr;
};

bool read_picture(TIFF* tiff, const Layout& layout, const Job& job, Picture& picture) {
  Palette palette;
  const bool has_palette = layout.photometric == PHOTOMETRIC_PALETTE;
  if (has_palette && (layout.bits != 8 ||
                      TIFFGetField(tiff, TIFFTAG_COLORMAP, &palette.red, &palette.green, &palette.blue) == 0))
    return false;
  const bool is_grey = layout.together() < 3;
  picture.width = layout.width;
  picture.height = layout.height;
  picture.bits = layout.bits;
  picture.channels = has_palette ? 3 : is_grey ? 1 : layout.together() == 3 ? 3 : 4;
  const auto channels = static_cast<std::size_t>(picture.channels);
  const std::size_t bytes = layout.sample_bytes(), stride = layout.together() * bytes;
  picture.bytes = Array<std::uint8_t>(job, channels * bytes * layout.width * layout.height);
  const auto take = [&](const std::uint8_t* data, std::uint32_t x, std::uint32_t y, std::uint32_t wide,
                        std::uint32_t deep, std::size_t row_bytes) {
    for (std::uint32_t row = 0; row < deep; ++row) {
      std::uint8_t* to = picture.bytes.data() + (std::size_t{y + row} * layout.width + x) * channels * bytes;
      for (std::uint32_t i = 0; i < wide; ++i, to += channels * bytes) {
        const std::uint8_t* from = data + row * row_bytes + i * stride;
        if (has_palette) {
          to[0] = static_cast<std::uint8_t>(palette.red[*from] >> 8U);
          to[1] = static_cast<std::uint8_t>(palette.green[*from] >> 8U);
          to[2] = static_cast<std::uint8_t>(palette.blue[*from] >> 8U);
          continue;
        }
        std::memcpy(to, from, channels * bytes);
        // White is 0: all bits are inverted.
        for (std::size_t k = 0; layout.photometric == PHOTOMETRIC_MINISWHITE && k < bytes; ++k)
          to[k] = static_cast<std::uint8_t>(~to[k]);
      }
    }
  };
  return each_block(tiff, layout, job, take);
}

bool read_samples(TIFF* tiff, const Layout& layout, const Job& job, Samples& samples) {
  samples.width = layout.width;
  samples.height = layout.height;
  samples.values = Array<float>(job, std::size_t{layout.width} * layout.height);
  const std::size_t stride = layout.together() * layout.sample_bytes();
  return each_block(tiff, layout, job,
                    [&](const std::uint8_t* data, std::uint32_t x, std::uint32_t y, std::uint32_t wide,
                        std::uint32_t deep, std::size_t row_bytes) {
                      for (std::uint32_t row = 0; row < deep; ++row) {
                        float* to = samples.values.data() + std::size_t{y + row} * layout.width + x;
                        for (std::uint32_t i = 0; i < wide; ++i) {
                          constexpr double most = 3.0e38;  // beyond it, a double is no float
                          to[i] = static_cast<float>(std::clamp(
                              sample_at(data + row * row_bytes + i * stride, layout), -most, most));
                        }
                      }
                    });
}

template <class Value>
void flip_rows(Value* first, std::size_t row, std::uint32_t rows) {
  for (std::uint32_t y = 0; y < rows / 2; ++y)
    std::swap_ranges(first + y * row, first + (y + 1) * row, first + (rows - 1 - y) * row);
}

}  // namespace

Result<Decoded> decode_tiff(std::span<const std::byte> file, const PngLimits& limits, const Job& job) {
  Source source{file};
  const Handle tiff = open(source);
  const auto damaged = [&] {
    const std::string why =
        source.library_message[0] != 0 ? source.library_message.data() : "its pixels cannot be read";
    return detail::refused_picture("the TIFF is damaged: " + why);
  };
  if (!tiff) return damaged();
  const Layout layout = layout_of(tiff.get());
  if (auto error = detail::size_error("TIFF", layout.width, layout.height, limits)) return *std::move(error);
  if (const std::string why = obstacle(layout, file.size()); !why.empty())
    return detail::refused_picture("the TIFF cannot be read: " + why);
  Decoded decoded;
  decoded.no_data = no_data_of(tiff.get());
  const bool flips = is_south_first(tiff.get(), layout);
  if (is_picture(layout)) {
    Picture& picture = decoded.picture.emplace();
    if (!read_picture(tiff.get(), layout, job, picture)) return damaged();
    if (flips) flip_rows(picture.bytes.data(), picture.bytes.size() / picture.height, picture.height);
  } else {
    Samples& samples = decoded.samples.emplace();
    if (!read_samples(tiff.get(), layout, job, samples)) return damaged();
    if (flips) flip_rows(samples.values.data(), samples.width, samples.height);
  }
  return decoded;
}

}  // namespace seedmesh::texture
