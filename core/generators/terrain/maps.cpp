#include "core/generators/terrain/maps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/terrain/flow.h"
#include "core/generators/terrain/game_engines.h"
#include "core/generators/terrain/noise.h"
#include "core/generators/terrain/plan.h"
#include "generated/params/terrain.h"

namespace seedmesh::terrain {
namespace {

constexpr std::size_t rows_a_chunk = 16;
constexpr std::int32_t ground_side = 512;

std::size_t bytes_of(Encoding encoding) {
  constexpr std::array<std::size_t, 6> sizes{1, 2, 3, 4, 2, 2};
  return sizes[static_cast<std::size_t>(encoding)];
}

/// The value of a share 0..1, of as many bits as the encoding has.
std::uint64_t quantised(double share, std::size_t bytes) {
  const auto greatest = static_cast<double>((std::uint64_t{1} << (8 * bytes)) - 1);
  return static_cast<std::uint64_t>(math::to_int64(std::floor(std::clamp(share, 0.0, 1.0) * greatest + 0.5)));
}

Array<std::uint8_t> as_png(std::int32_t width, std::int32_t depth, int channels, int bits,
                           const Array<std::uint8_t>& bytes, const Job& job) {
  return texture::encode_png({static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(depth), channels,
                              bits, std::as_bytes(bytes.span())},
                             texture::PngEffort::streamed, job);
}

/// Calls pixel(x, z) of a field for every pixel of a picture, in samples, and stores what it gives.
template <class Pixel>
texture::Picture drawn(const Field& field, std::int32_t side, int channels, const Job& job,
                       const Pixel& pixel) {
  texture::Picture picture;
  picture.width = picture.height = static_cast<std::uint32_t>(side);
  picture.channels = channels;
  const auto width = static_cast<std::size_t>(side), each = static_cast<std::size_t>(channels);
  picture.bytes = Array<std::uint8_t>(job, width * width * each);
  parallel_for(job, width, rows_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
    for (std::size_t row = begin; row < end; ++row) {
      job.check();
      const double z = (static_cast<double>(row) + 0.5) / side * (field.depth - 1);
      for (std::size_t i = 0; i < width; ++i) {
        const double x = (static_cast<double>(i) + 0.5) / side * (field.width - 1);
        pixel(x, z, picture.bytes.data() + (row * width + i) * each);
      }
    }
  });
  return picture;
}

/// The four samples around a place and their weights.
struct Between {
  std::int32_t x, z;
  float u, v;
  Between(const Field& field, double at_x, double at_z)
      : x(std::min(math::to_int32(std::floor(at_x)), field.width - 2)),
        z(std::min(math::to_int32(std::floor(at_z)), field.depth - 2)),
        u(static_cast<float>(at_x - x)),
        v(static_cast<float>(at_z - z)) {}
  template <class Value>
  Value mix(const Value& nw, const Value& ne, const Value& sw, const Value& se) const {
    const Value north = nw + (ne - nw) * u, south = sw + (se - sw) * u;
    return north + (south - north) * v;
  }
};

Site site_between(const Field& field, const Sites& sites, double x, double z) {
  const Between at(field, x, z);
  const Site nw = sites.at(at.x, at.z), ne = sites.at(at.x + 1, at.z), sw = sites.at(at.x, at.z + 1),
             se = sites.at(at.x + 1, at.z + 1);
  Site site;
  for (float Site::*each : {&Site::height, &Site::slope, &Site::hollow, &Site::patch})
    site.*each = at.mix(nw.*each, ne.*each, sw.*each, se.*each);
  return site;
}

std::uint8_t byte_of(float share) {
  return static_cast<std::uint8_t>(
      math::to_int32(std::floor(static_cast<double>(std::clamp(share, 0.0F, 1.0F)) * 255 + 0.5)));
}

struct GroundLook {
  glm::vec3 dark, light;  ///< linear
  NoiseKind kind;
  int cells;  ///< of the first octave, a side
  double gain;
};
constexpr std::size_t ground_kinds = 4;

const std::array<GroundLook, ground_kinds>& ground_looks() {
  static const std::array<GroundLook, ground_kinds> all{{
      {{0.10F, 0.09F, 0.085F}, {0.30F, 0.28F, 0.26F}, NoiseKind::ridged, 4, 0.62},
      {{0.035F, 0.075F, 0.018F}, {0.16F, 0.22F, 0.06F}, NoiseKind::billow, 24, 0.75},
      {{0.46F, 0.36F, 0.22F}, {0.66F, 0.55F, 0.37F}, NoiseKind::rolling, 12, 0.8},
      {{0.72F, 0.77F, 0.84F}, {0.93F, 0.95F, 0.98F}, NoiseKind::rolling, 4, 0.55},
  }};
  return all;
}

/// Masks from 0 to 1.
Array<float> mask_of(const TerrainParams& params, const Field& field, const Job& job) {
  const auto wide = static_cast<std::size_t>(field.width), deep = static_cast<std::size_t>(field.depth);
  Array<float> mask(job, wide * deep);
  const Sites sites(field, window_of(params), job.rng().at("terrain"), job);
  Array<float> area;
  if (params.heightmap.map == TerrainMap::flow) {
    Field bare(job, field.width, field.depth, 0);
    for (std::int32_t z = 0; z < field.depth; ++z)
      std::copy(field.row(z), field.row(z) + field.width, bare.row(z));
    area = gathered(bare, drainage_of(bare, job), job);
  }
  const double largest = math::log(static_cast<double>(wide * deep));
  parallel_for(job, deep, rows_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
    job.check();
    for (std::size_t i = begin * wide; i < end * wide; ++i) {
      const auto x = static_cast<std::int32_t>(i % wide), z = static_cast<std::int32_t>(i / wide);
      const Site site = sites.at(x, z);
      double value = 0;
      if (params.heightmap.map == TerrainMap::slope)
        value = math::atan2(static_cast<double>(site.slope), 1) / (math::pi / 2);
      if (params.heightmap.map == TerrainMap::curvature) value = 0.5 - static_cast<double>(site.hollow);
      if (params.heightmap.map == TerrainMap::flow) value = math::log(static_cast<double>(area[i])) / largest;
      if (params.heightmap.map == TerrainMap::water)
        value = static_cast<double>(site.height) < params.water_level.value_or(0) ? 1 : 0;
      mask[i] = static_cast<float>(value);
    }
  });
  return mask;
}

Error refused(std::string pointer, std::string message) {
  return Error{Code::invalid, {{IssueKind::invalid_value, std::move(pointer), std::move(message)}}};
}

bool is_picture(TerrainMap map) { return map >= TerrainMap::normal; }
bool is_ground(TerrainMap map) { return map >= TerrainMap::rock; }

Array<std::uint8_t> file_of(const texture::Picture& picture, const Job& job) {
  return texture::encode_png(picture.view(), texture::PngEffort::small, job);
}

/// A normal map, colours or splat weights.
Array<std::uint8_t> picture_file(const TerrainParams& params, const Field& field, const Range& range,
                                 const Job& job) {
  const TerrainHeightmap& given = params.heightmap;
  const Sites sites(field, window_of(params), job.rng().at("terrain"), job);
  const GroundColors ground_colors(
      palette_of(params), params.tile ? nominal_range(params) : range,
      static_cast<float>(params.water_level.value_or(static_cast<double>(range.low))));
  const std::int32_t side = params.texture > 0 ? params.texture : std::min(field.width, 4096);
  if (given.map == TerrainMap::normal) return file_of(normal_picture(field, sites, side, job), job);
  if (given.map == TerrainMap::color)
    return file_of(color_picture(field, sites, ground_colors, side, job), job);
  return file_of(splat_picture(field, sites, ground_colors, side, job), job);
}

Encoding encoding_of(std::string_view format, const TerrainHeightmap& given) {
  if (format == "png16") return Encoding::grey16;
  if (format == "png8") return Encoding::grey8;
  if (format == "rgb24") return Encoding::rgb24;
  if (format == "rgba32") return Encoding::rgba32;
  return given.byte_order == TerrainByteOrder::little ? Encoding::raw_little : Encoding::raw_big;
}

/// Where a field that has the wrong size can be given another.
const char* size_pointer(const TerrainParams& params) {
  return params.resample ? "/resample" : "/output/profile";
}

/// What the engine of the profile does not take.
void add_engine_issues(const TerrainParams& params, const WantedFormat& form, std::vector<Issue>& issues) {
  const auto add_issue = [&](IssueCause cause, const char* pointer, std::string message) {
    issues.emplace_back(std::move(cause), pointer, std::move(message));
  };
  const std::string profile(form.profile);
  const std::optional<GameEngine> engine = game_engine_of(form.profile);
  if (!engine) {
    return add_issue(IssueKind::not_available, "/output/profile",
                     "found " + profile + "; height maps have the conventions of core, unity and unreal");
  }
  const TerrainHeightmap& given = params.heightmap;
  if (engine == GameEngine::unity && form.format != "r16") {
    add_issue(conflict_with({"profile"}), "/output/format",
              "found " + std::string(form.format) + "; Unity reads raw heights: r16");
  }
  if (given.map != TerrainMap::height) {
    add_issue(conflict_with({"output/profile"}), "/heightmap/map",
              "found " + std::string(text_of(given.map)) + "; the profile " + profile +
                  " is for heights; other maps need the profile core");
  }
  if (given.byte_order != TerrainByteOrder::little) {
    add_issue(conflict_with({"output/profile"}), "/heightmap/byte_order",
              "found big; the profile " + profile + " has the low byte first");
  }
  if (engine == GameEngine::unity && given.flip) {
    add_issue(conflict_with({"output/profile"}), "/heightmap/flip",
              "the profile unity has the southern row first as it is");
  }
  if (params.algorithm == TerrainAlgorithm::image) return;  // whose size is known when it is read
  const int side = finished_side(params);
  if (std::string wrong = size_error(*engine, side, side); !wrong.empty())
    add_issue(IssueKind::invalid_value, size_pointer(params), std::move(wrong));
}

}  // namespace

Array<std::uint8_t> encoded(const Numbers& numbers, Encoding encoding, const Job& job) {
  const std::size_t bytes = bytes_of(encoding);
  const auto width = static_cast<std::size_t>(numbers.width), depth = static_cast<std::size_t>(numbers.depth);
  Array<std::uint8_t> out(job, width * depth * bytes);
  const double span = numbers.high - numbers.low;
  parallel_for(job, depth, rows_a_chunk, [&](std::size_t begin, std::size_t end, std::size_t) {
    job.check();
    for (std::size_t row = begin; row < end; ++row) {
      const float* from = numbers.values.data() + (numbers.flip ? depth - 1 - row : row) * width;
      std::uint8_t* to = out.data() + row * width * bytes;
      for (std::size_t i = 0; i < width; ++i, to += bytes) {
        const std::uint64_t value =
            quantised(span > 0 ? (static_cast<double>(from[i]) - numbers.low) / span : 0, bytes);
        for (std::size_t k = 0; k < bytes; ++k) {
          const std::size_t position = encoding == Encoding::raw_little ? k : bytes - 1 - k;
          to[position] = static_cast<std::uint8_t>(value >> (8 * k));
        }
        // PNG's writer takes 16 bits in the order of the machine.
        if (encoding == Encoding::grey16) {
          const auto word = static_cast<std::uint16_t>(value);
          std::copy_n(reinterpret_cast<const std::uint8_t*>(&word), 2, to);
        }
      }
    }
  });
  switch (encoding) {
    case Encoding::grey8:
      return as_png(numbers.width, numbers.depth, 1, 8, out, job);
    case Encoding::grey16:
      return as_png(numbers.width, numbers.depth, 1, 16, out, job);
    case Encoding::rgb24:
      return as_png(numbers.width, numbers.depth, 3, 8, out, job);
    case Encoding::rgba32:
      return as_png(numbers.width, numbers.depth, 4, 8, out, job);
    default:
      return out;
  }
}

texture::Picture color_picture(const Field& field, const Sites& sites, const GroundColors& ground_colors,
                               std::int32_t side, const Job& job) {
  return drawn(field, side, 3, job, [&](double x, double z, std::uint8_t* out) {
    const glm::u8vec3 color = srgb_of(ground_colors.color(site_between(field, sites, x, z)));
    out[0] = color.r;
    out[1] = color.g;
    out[2] = color.b;
  });
}

texture::Picture normal_picture(const Field& field, const Sites& sites, std::int32_t side, const Job& job) {
  return drawn(field, side, 3, job, [&](double x, double z, std::uint8_t* out) {
    const Between at(field, x, z);
    const glm::vec2 slope = at.mix(sites.gradient(at.x, at.z), sites.gradient(at.x + 1, at.z),
                                   sites.gradient(at.x, at.z + 1), sites.gradient(at.x + 1, at.z + 1));
    const float length = std::sqrt(1 + slope.x * slope.x + slope.y * slope.y);
    out[0] = byte_of(0.5F - 0.5F * slope.x / length);
    out[1] = byte_of(0.5F + 0.5F * slope.y / length);
    out[2] = byte_of(0.5F + 0.5F / length);
  });
}

texture::Picture splat_picture(const Field& field, const Sites& sites, const GroundColors& ground_colors,
                               std::int32_t side, const Job& job) {
  return drawn(field, side, 4, job, [&](double x, double z, std::uint8_t* out) {
    const Cover cover = ground_colors.cover(site_between(field, sites, x, z));
    out[0] = byte_of(cover.rock);
    out[2] = byte_of(cover.sand);
    out[3] = byte_of(cover.snow);
    // Grass takes what rounding left, so that the four sum to 255.
    out[1] = static_cast<std::uint8_t>(std::max(0, 255 - out[0] - out[2] - out[3]));
  });
}

texture::Picture ground_texture(GroundKind kind, std::int32_t side, Rng rng, const Job& job) {
  const GroundLook& look = ground_looks()[static_cast<std::size_t>(kind)];
  NoisePlan plan;
  plan.kind = look.kind;
  plan.octaves = 5;
  plan.amplitude = 0.5;
  plan.gain = look.gain;
  plan.wavelength = static_cast<double>(side) / look.cells;
  plan.repeat = look.cells;
  Field field =
      noisy(plan, {0, 0, side, side}, 1, rng.at("ground").at(static_cast<std::uint64_t>(kind)), job);
  normalise(field, 0, 1, job);
  return drawn(field, side, 3, job, [&](double x, double z, std::uint8_t* out) {
    // Samples are pixels here, so that the last one borders on the first.
    const float share =
        field.at(math::to_int32(x / (side - 1) * side), math::to_int32(z / (side - 1) * side));
    const glm::u8vec3 color = srgb_of(look.dark + (look.light - look.dark) * share);
    out[0] = color.r;
    out[1] = color.g;
    out[2] = color.b;
  });
}

std::vector<Issue> format_errors(const TerrainParams& params, const WantedFormat& form) {
  std::vector<Issue> issues;
  const auto add_issue = [&](IssueCause cause, const char* pointer, std::string message) {
    issues.emplace_back(std::move(cause), pointer, std::move(message));
  };
  const TerrainHeightmap& given = params.heightmap;
  if (params.shape != TerrainShape::plane) {
    add_issue(
        IssueKind::not_available, "/shape",
        "a " + std::string(text_of(params.shape)) + " has no height map; its formats are glb, gltf and zip");
  }
  if (params.refine) {
    add_issue(conflict_with({}), "/refine",
              "a height map has the samples of the field alone; expected a request without refine");
  }
  if (is_picture(given.map) && form.format != "png8") {
    add_issue(conflict_with({"output/format"}), "/heightmap/map",
              std::string(text_of(given.map)) +
                  " is an image in colours, which requires the format png8; found " +
                  std::string(form.format));
  }
  if (is_picture(given.map) && given.flip) {
    add_issue(conflict_with({"map"}), "/heightmap/flip",
              "found true with the map " + std::string(text_of(given.map)) +
                  ", an image for texture coordinates, which begin in the north-west");
  }
  if (given.map == TerrainMap::water && !params.water_level)
    add_issue(conflict_with({"water_level"}), "/heightmap/map", "there is no water; give a water_level");
  if (params.tile && given.map == TerrainMap::height && (!given.low || !given.high)) {
    add_issue(
        missing_for({"low", "high", "map", "tile"}), "/heightmap",
        "low and high are missing: tiles of one world need the same values, or their heights would differ "
        "at the borders");
  }
  if (form.profile != "core") add_engine_issues(params, form, issues);
  return issues;
}

Result<Array<std::uint8_t>> map_file(const TerrainParams& params, const WantedFormat& form, Job& job) {
  if (std::vector<Issue> issues = format_errors(params, form); !issues.empty())
    return Error{Code::invalid, std::move(issues)};
  const TerrainHeightmap& given = params.heightmap;
  const Rng rng = job.rng().at("terrain");
  if (is_ground(given.map)) {
    const auto kind =
        static_cast<GroundKind>(static_cast<int>(given.map) - static_cast<int>(TerrainMap::rock));
    return file_of(ground_texture(kind, params.texture > 0 ? params.texture : ground_side, rng, job), job);
  }
  job.progress("derive", 0);
  Result<Field> made = field_of(params, job);
  if (!made) return made.error();
  const std::optional<GameEngine> engine = game_engine_of(form.profile);
  if (engine) {
    if (std::string wrong = size_error(*engine, made->width, made->depth); !wrong.empty())
      return refused(size_pointer(params), std::move(wrong));
  }
  const Range range = range_of(*made, job);
  if (is_picture(given.map)) return picture_file(params, *made, range, job);
  job.progress("encode", 0);
  Numbers numbers;
  numbers.width = made->width;
  numbers.depth = made->depth;
  numbers.flip = given.flip || engine == GameEngine::unity;
  if (given.map == TerrainMap::height) {
    numbers.values = cropped(std::move(*made), 0, job).heights;
    numbers.low = given.low.value_or(static_cast<double>(range.low));
    numbers.high = given.high.value_or(static_cast<double>(range.high));
    if (numbers.low > numbers.high)
      return refused("/heightmap", "low is above the highest height or high below the lowest");
  } else {
    numbers.values = mask_of(params, *made, job);
  }
  return encoded(numbers, encoding_of(form.format, given), job);
}

}  // namespace seedmesh::terrain
