/// PLY: Turk, "The PLY Polygon File Format" (1994).
#include "core/generators/fractal/encode.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "core/generators/fractal/chaos.h"
#include "core/generators/fractal/escape.h"
#include "core/texture/png.h"
#include "generated/params/fractal.h"

namespace seedmesh::fractal {
namespace {

constexpr std::size_t bytes_of_point = 15;

void put_float(std::uint8_t* out, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value + 0.0F);
  for (unsigned shift = 0; shift < 32; shift += 8) *out++ = static_cast<std::uint8_t>(bits >> shift);
}

Result<Array<std::uint8_t>> ply_of(const FractalParams& params, const GenerateContext& context) {
  Job& job = context.job;
  const Result<StartPoints> start = start_of(params, context);
  if (!start) return start.error();
  const Cloud cloud = play(instructions_of(params), *start, static_cast<std::uint64_t>(params.points),
                           static_cast<std::uint32_t>(params.drop), job);
  const std::size_t count = cloud.position.size();
  const std::string head = "ply\nformat binary_little_endian 1.0\ncomment Seedmesh fractal\nelement vertex " +
                           std::to_string(count) +
                           "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
                           "property uchar green\nproperty uchar blue\nend_header\n";
  job.spend(Resource::output_bytes, head.size() + bytes_of_point * count);
  Array<std::uint8_t> file(job, head.size() + bytes_of_point * count);
  std::memcpy(file.data(), head.data(), head.size());
  std::uint8_t* out = file.data() + head.size();
  for (std::size_t i = 0; i < count; ++i, out += bytes_of_point) {
    if (i % 4096 == 0) job.check();
    for (int axis = 0; axis < 3; ++axis)
      put_float(out + 4 * axis, cloud.position[i][axis] * static_cast<float>(params.size));
    const Color& color = params.palette[cloud.map[i] % params.palette.size()];
    out[12] = color.red;
    out[13] = color.green;
    out[14] = color.blue;
  }
  return file;
}

Array<std::uint8_t> grey_of(const EscapeField& field, const Job& job) {
  Array<std::uint16_t> pixels(job, field.value.size());
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i] = static_cast<std::uint16_t>(field.value[i] * 65535.0F + 0.5F);
  const texture::PictureView picture{field.side, field.side, 1, 16, std::as_bytes(pixels.span())};
  return texture::encode_png(picture, texture::PngEffort::streamed, job);
}

Array<std::uint8_t> colored(const FractalParams& params, const EscapeField& field, const Job& job) {
  Array<std::uint8_t> pixels(job, 3 * field.value.size());
  for (std::size_t i = 0; i < field.value.size(); ++i) {
    if (i % 4096 == 0) job.check();
    const Color color = escape_color(params, field.value[i]);
    pixels[3 * i] = color.red;
    pixels[3 * i + 1] = color.green;
    pixels[3 * i + 2] = color.blue;
  }
  const texture::PictureView picture{field.side, field.side, 3, 8, std::as_bytes(pixels.span())};
  return texture::encode_png(picture, texture::PngEffort::streamed, job);
}

}  // namespace

Result<Array<std::uint8_t>> encode(const FractalParams& params, const WantedFormat& format,
                                   const GenerateContext& context) {
  Job& job = context.job;
  if (format.format == "ply") return ply_of(params, context);
  const EscapeField field = escape_field(params, job);
  return format.format == "png16" ? grey_of(field, job) : colored(params, field, job);
}

std::vector<Issue> check_format(const FractalParams& params, const WantedFormat& form) {
  const std::string found = "found \"" + std::string(text_of(params.method)) + "\"";
  std::vector<Issue> issues;
  if (form.format != "ply") {
    if (params.method != FractalMethod::escape)
      issues.emplace_back(conflict_with({"output/format"}), "/method",
                          found + ", but an image is made of \"escape\"");
    return issues;
  }
  if (params.method != FractalMethod::frcm) {
    issues.emplace_back(conflict_with({"output/format"}), "/method",
                        found + ", but a PLY file contains the points of \"frcm\"");
  }
  if (!params.stages.empty()) {
    issues.emplace_back(conflict_with({"output/format"}), "/stages",
                        "found stages in the format ply, which has one point cloud; expected none");
  }
  return issues;
}

}  // namespace seedmesh::fractal
