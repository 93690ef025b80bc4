#include "core/gltf/compress/quantize.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/array.h"
#include "core/gltf/compress/flat_triangles.h"
#include "core/gltf/compress/merged_points.h"
#include "core/gltf/compress/quantized_normals.h"
#include "core/gltf/compress/vertex_data.h"

namespace seedmesh::gltf {
namespace {

constexpr int finest_exponent = -14;  ///< of texture coordinates: a 16th of a texel of 1,024
constexpr int mantissa_bits = 23;

void quantize_positions(Column& column, const Grid& grid, Job& job) {
  Array<glm::u16vec4> steps(job, column.count);
  const glm::dvec3 origin(grid.origin);
  const double scale = 1.0 / static_cast<double>(grid.step);
  glm::u16vec4 low(65'535), high(0);
  for (std::size_t i = 0; i < column.count; ++i) {
    if (i % check_interval == 0) job.check();
    const glm::dvec3 at = (glm::dvec3(load<glm::vec3>(column.slice, i)) - origin) * scale;
    for (int axis = 0; axis < 3; ++axis) {
      steps[i][axis] = static_cast<std::uint16_t>(std::clamp(std::floor(at[axis] + 0.5), 0.0, 65'535.0));
    }
    steps[i].w = 0;
    low = glm::min(low, steps[i]);
    high = glm::max(high, steps[i]);
  }
  column.slice = keep(std::move(steps));
  column.component = Component::u16;
  column.range = Box{glm::vec3(low), glm::vec3(high)};
}

/// The exact positions as floats, in the space of the grid.
void keep_positions(Column& column, const Slice& exact, const Grid& grid, Job& job) {
  Array<glm::vec3> steps(job, column.count);
  const glm::dvec3 origin(grid.origin);
  const double scale = 1.0 / static_cast<double>(grid.step);
  for (std::size_t i = 0; i < column.count; ++i) {
    if (i % check_interval == 0) job.check();
    steps[i] = glm::vec3((glm::dvec3(load<glm::vec3>(exact, i)) - origin) * scale) + 0.0F;
  }
  column.range = bounds_of(steps.span());
  column.slice = keep(std::move(steps));
  column.component = Component::f32;
}

/// Unit vectors of three lanes, or of four where the last is a sign.
void quantize_directions(Column& column, Job& job) {
  Array<OctahedralNormal> packed(job, column.count);
  const bool has_sign = column.lanes == Lanes::vec4;
  for (std::size_t i = 0; i < column.count; ++i) {
    if (i % check_interval == 0) job.check();
    const glm::dvec3 n = has_sign ? glm::dvec3(load<glm::vec4>(column.slice, i))
                                  : glm::dvec3(load<glm::vec3>(column.slice, i));
    packed[i] = octahedral(n);
    if (has_sign) packed[i][3] = signed_of(static_cast<double>(load<glm::vec4>(column.slice, i).w), 16);
  }
  column.slice = keep(std::move(packed));
  column.component = Component::i16;
  column.normalized = true;
  column.filter = Filter::octahedral;
}

/// The same with 16 bits for each lane, which readers need no filter for.
void quantize_lanes(Column& column, Job& job) {
  constexpr int bits = 16;
  Array<glm::i16vec4> packed(job, column.count);
  const bool has_sign = column.lanes == Lanes::vec4;
  for (std::size_t i = 0; i < column.count; ++i) {
    if (i % check_interval == 0) job.check();
    const glm::dvec4 n = has_sign ? glm::dvec4(load<glm::vec4>(column.slice, i))
                                  : glm::dvec4(glm::dvec3(load<glm::vec3>(column.slice, i)), 0);
    for (int lane = 0; lane < 4; ++lane) packed[i][lane] = signed_of(n[lane], bits);
  }
  column.slice = keep(std::move(packed));
  column.component = Component::i16;
  column.normalized = true;
}

float farthest_of(const Column& column, bool& inside, const Job& job) {
  float farthest = 0;
  inside = true;
  for (std::size_t i = 0; i < column.count * 2; ++i) {
    if (i % check_interval == 0) job.check();
    const auto value = load<float>(column.slice, i);
    farthest = std::max(farthest, std::abs(value));
    inside = inside && value >= 0 && value <= 1;
  }
  return farthest;
}

void quantize_uv(Column& column, Job& job, Encoding encoding) {
  bool inside = true;
  const float farthest = farthest_of(column, inside, job);
  if (inside) {
    Array<glm::u16vec2> shares(job, column.count);
    for (std::size_t i = 0; i < column.count; ++i) {
      if (i % check_interval == 0) job.check();
      const glm::dvec2 uv(load<glm::vec2>(column.slice, i));
      shares[i] = glm::u16vec2(static_cast<std::uint16_t>(std::floor(uv.x * 65'535 + 0.5)),
                               static_cast<std::uint16_t>(std::floor(uv.y * 65'535 + 0.5)));
    }
    column.slice = keep(std::move(shares));
    column.component = Component::u16;
    column.normalized = true;
    return;
  }
  if (encoding == Encoding::plain) return;
  // All lanes of the column share one exponent, so that equal coordinates stay equal.
  int exponent = 0;
  std::frexp(farthest, &exponent);
  exponent = std::max(exponent - mantissa_bits + 1, finest_exponent);
  Array<std::uint32_t> packed(job, column.count * 2);
  for (std::size_t i = 0; i < packed.size(); ++i) {
    if (i % check_interval == 0) job.check();
    const double value = std::ldexp(static_cast<double>(load<float>(column.slice, i)), -exponent);
    const auto mantissa = static_cast<std::int32_t>(std::floor(value + 0.5));
    packed[i] =
        static_cast<std::uint32_t>(exponent) << 24U | (static_cast<std::uint32_t>(mantissa) & 0xFFFFFFU);
  }
  column.slice = keep(std::move(packed));
  column.filter = Filter::exponential;
}

/// Quantizes the positions last: the others need them exact.
void quantize_columns(Part& part, const Grid& grid, Job& job, Encoding encoding) {
  for (const Attribute& attribute : part.attributes) {
    Column& column = part.columns[attribute.column];
    if (column.component != Component::f32 || column.filter != Filter::none) continue;
    if (attribute.semantic == "NORMAL" || attribute.semantic == "TANGENT") {
      if (encoding == Encoding::filtered) {
        quantize_directions(column, job);
      } else {
        quantize_lanes(column, job);
      }
    } else if (attribute.semantic.starts_with("TEXCOORD")) {
      quantize_uv(column, job, encoding);
    }
  }
  if (!grid.is_exact) quantize_positions(part.columns.front(), grid, job);
}

/// The indices as 32-bit numbers; `buffer` holds them where they are 16 bits wide.
std::span<const std::uint32_t> corners_of(const Column& index, Array<std::uint32_t>& buffer) {
  if (index.component == Component::u32)
    return {reinterpret_cast<const std::uint32_t*>(index.slice.bytes.data()), index.count};
  buffer.resize(index.count);
  for (std::size_t i = 0; i < index.count; ++i) buffer[i] = load<std::uint16_t>(index.slice, i);
  return std::as_const(buffer).span();
}

/// For each vertex the first with equal bytes in all columns; empty where all vertices differ. `kept` becomes
/// the number of different vertices.
Array<unsigned> firsts_of(const Part& part, std::span<const std::uint32_t> corners, std::size_t& kept,
                          Job& job) {
  const std::size_t vertices = part.columns.front().count;
  std::vector<meshopt_Stream> streams;
  for (const Column& column : part.columns)
    streams.push_back({column.slice.bytes.data(), column.stride(), column.stride()});
  constexpr unsigned unused = 0xFFFFFFFFU;
  job.check();
  Array<unsigned> place(job, vertices);
  kept = meshopt_generateVertexRemapMulti(place.data(), corners.data(), corners.size(), vertices,
                                          streams.data(), streams.size());
  job.check();
  if (kept == vertices) return Array<unsigned>(job);
  Array<unsigned> first(job, vertices, unused);
  for (std::size_t i = 0; i < vertices; ++i) {
    if (place[i] != unused) first[place[i]] = std::min(first[place[i]], static_cast<unsigned>(i));
  }
  for (unsigned& each : place) each = each == unused ? unused : first[each];
  return place;
}

/// Orders the vertices by their first use and drops those that no corner uses.
void rewrite(Part& part, Array<std::uint32_t>& corners, Job& job) {
  constexpr std::uint32_t unused = 0xFFFFFFFFU;
  Array<std::uint32_t> place(job, part.columns.front().count, unused), vertices(job);
  for (std::uint32_t& corner : corners) {
    if (place[corner] == unused) {
      place[corner] = static_cast<std::uint32_t>(vertices.size());
      vertices.push_back(corner);
    }
    corner = place[corner];
  }
  for (Column& column : part.columns) {
    job.check();
    column.slice = selected(column, vertices, job);
    column.count = vertices.size();
  }
  Column& position = part.columns.front();
  glm::u16vec4 low(65'535), high(0);
  for (std::size_t i = 0; i < position.count; ++i) {
    if (i % check_interval == 0) job.check();
    low = glm::min(low, load<glm::u16vec4>(position.slice, i));
    high = glm::max(high, load<glm::u16vec4>(position.slice, i));
  }
  position.range = Box{glm::vec3(low), glm::vec3(high)};
  if (!part.index) return;
  set_index(part, std::move(corners), vertices.size(), job);
}

/// Joins points that are equal in all columns.
void clean_points(Part& part, Job& job) {
  const std::size_t count = part.columns.front().count;
  Array<std::uint32_t> corners(job, (count + 2) / 3 * 3);  // meshoptimizer requires whole triangles
  for (std::size_t i = 0; i < corners.size(); ++i)
    corners[i] = static_cast<std::uint32_t>(std::min(i, count - 1));
  std::size_t different = 0;
  const Array<unsigned> first = firsts_of(part, corners.span(), different, job);
  if (different == count) return;
  Array<std::uint32_t> kept(job);
  for (std::size_t i = 0; i < count; ++i) {
    if (first[i] == i) kept.push_back(first[i]);
  }
  rewrite(part, kept, job);
}

/// Joins equal vertices and drops triangles that have become flat or doubled. The first column of a part
/// holds its positions (take_columns).
void clean(Part& part, Job& job) {
  if (part.topology == Topology::points && !part.index) return clean_points(part, job);
  if (part.topology != Topology::triangles || !part.index) return;
  job.check();
  Array<std::uint32_t> corners(job);
  const std::span<const std::uint32_t> given = corners_of(*part.index, corners);
  const std::size_t vertices = part.columns.front().count, before = given.size();
  std::size_t kept = 0;
  const Array<unsigned> first = firsts_of(part, given, kept, job);
  // In most parts nothing changes, and then nothing is copied.
  if (kept == vertices && !has_flat_triangle(part.columns.front(), given)) return;
  if (corners.empty()) corners.append(given);
  part.index->slice = {};  // rewrite() stores another
  if (!first.empty()) {
    for (std::uint32_t& corner : corners) corner = first[corner];
  }
  job.check();
  drop_flat_triangles(part.columns.front(), corners);
  if (corners.size() < before) drop_doubled_triangles(part.columns.front(), corners, job);
  rewrite(part, corners, job);
}

}  // namespace

void quantize(Part& part, const Grid& grid, Job& job, Encoding encoding) {
  if (grid.is_exact) return quantize_columns(part, grid, job, encoding);
  const std::vector<std::size_t> inward = inward_corners(part, job);
  Slice exact = part.columns.front().slice;
  quantize_columns(part, grid, job, encoding);
  const bool is_closed = split_merged_points(part, exact, job);
  if (!is_closed) keep_positions(part.columns.front(), exact, grid, job);
  exact = {};
  repair_quantized_normals(part, inward, job);
  if (is_closed) clean(part, job);
}

void quantize(Columns& columns, const std::vector<Grid>& grids, Job& job, Encoding encoding) {
  for (std::size_t i = 0; i < columns.meshes.size(); ++i) {
    for (Part& part : columns.meshes[i]) {
      if (!part.is_packed) quantize(part, grids[i], job, encoding);
    }
    std::erase_if(columns.meshes[i], [](const Part& part) { return part.index && part.index->count == 0; });
  }
}

}  // namespace seedmesh::gltf
