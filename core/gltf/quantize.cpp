/// Octahedral normals: Cigolle et al., "A Survey of Efficient Representations for Independent Unit Vectors",
/// JCGT 2014, in the form of EXT_meshopt_compression's filters.
#include "core/gltf/quantize.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/array.h"
#include "core/gltf/folds.h"
#include "core/gltf/mend.h"
#include "core/gltf/separate.h"

namespace seedmesh::gltf {
namespace {

constexpr std::size_t look_every = 65'536;
constexpr int normal_bits = 10;
constexpr int finest_exponent = -14;  ///< of texture coordinates: a 16th of a texel of 1,024
constexpr int mantissa_bits = 23;

/// A signed integer that stands for -1..1.
std::int16_t signed_of(double value, int bits) {
  const double most = (1 << (bits - 1)) - 1;
  return static_cast<std::int16_t>(std::floor(std::clamp(value, -1.0, 1.0) * most + 0.5));
}

void quantize_positions(Column& column, const Grid& grid, Job& job) {
  Array<glm::u16vec4> steps(job, column.count);
  const glm::dvec3 origin(grid.origin);
  const double scale = 1.0 / static_cast<double>(grid.step);
  glm::u16vec4 low(65'535), high(0);
  for (std::size_t i = 0; i < column.count; ++i) {
    if (i % look_every == 0) job.check();
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
    if (i % look_every == 0) job.check();
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
    if (i % look_every == 0) job.check();
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

float farthest_of(const Column& column, bool& inside) {
  float farthest = 0;
  inside = true;
  for (std::size_t i = 0; i < column.count * 2; ++i) {
    const auto value = load<float>(column.slice, i);
    farthest = std::max(farthest, std::abs(value));
    inside = inside && value >= 0 && value <= 1;
  }
  return farthest;
}

void quantize_uv(Column& column, Job& job) {
  bool inside = true;
  const float farthest = farthest_of(column, inside);
  if (inside) {
    Array<glm::u16vec2> shares(job, column.count);
    for (std::size_t i = 0; i < column.count; ++i) {
      const glm::dvec2 uv(load<glm::vec2>(column.slice, i));
      shares[i] = glm::u16vec2(static_cast<std::uint16_t>(std::floor(uv.x * 65'535 + 0.5)),
                               static_cast<std::uint16_t>(std::floor(uv.y * 65'535 + 0.5)));
    }
    column.slice = keep(std::move(shares));
    column.component = Component::u16;
    column.normalized = true;
    return;
  }
  // All lanes of the column share one exponent, so that equal coordinates stay equal.
  int exponent = 0;
  std::frexp(farthest, &exponent);
  exponent = std::max(exponent - mantissa_bits + 1, finest_exponent);
  Array<std::uint32_t> packed(job, column.count * 2);
  for (std::size_t i = 0; i < packed.size(); ++i) {
    const double value = std::ldexp(static_cast<double>(load<float>(column.slice, i)), -exponent);
    const auto mantissa = static_cast<std::int32_t>(std::floor(value + 0.5));
    packed[i] =
        static_cast<std::uint32_t>(exponent) << 24U | (static_cast<std::uint32_t>(mantissa) & 0xFFFFFFU);
  }
  column.slice = keep(std::move(packed));
  column.filter = Filter::exponential;
}

/// Positions come last: they are still asked for afterwards as they were.
void quantize_columns(Part& part, const Grid& grid, Job& job) {
  for (const Attribute& attribute : part.attributes) {
    Column& column = part.columns[attribute.column];
    if (column.component != Component::f32 || column.filter != Filter::none) continue;
    if (attribute.semantic == "NORMAL" || attribute.semantic == "TANGENT") {
      quantize_directions(column, job);
    } else if (attribute.semantic.starts_with("TEXCOORD")) {
      quantize_uv(column, job);
    }
  }
  quantize_positions(part.columns.front(), grid, job);
}

// --- What became equal ---

/// The indices, as they are where they are wide, else widened in `room`.
std::span<const std::uint32_t> corners_of(const Column& index, Array<std::uint32_t>& room) {
  if (index.component == Component::u32)
    return {reinterpret_cast<const std::uint32_t*>(index.slice.bytes.data()), index.count};
  Array<std::uint32_t>& corners = room;
  corners.resize(index.count);
  for (std::size_t i = 0; i < index.count; ++i) {
    corners[i] = load<std::uint16_t>(index.slice, i);
  }
  return std::as_const(corners).span();
}

/// For each vertex the first that has all its bytes, or empty where all differ; `kept` of them stay.
Array<unsigned> firsts_of(const Part& part, std::span<const std::uint32_t> corners, std::size_t& kept,
                          Job& job) {
  const std::size_t vertices = part.columns.front().count;
  std::vector<meshopt_Stream> streams;
  for (const Column& column : part.columns)
    streams.push_back({column.slice.bytes.data(), column.stride(), column.stride()});
  constexpr unsigned unused = 0xFFFFFFFFU;
  Array<unsigned> place(job, vertices);
  kept = meshopt_generateVertexRemapMulti(place.data(), corners.data(), corners.size(), vertices,
                                          streams.data(), streams.size());
  if (kept == vertices) return Array<unsigned>(job);
  Array<unsigned> first(job, vertices, unused);
  for (std::size_t i = 0; i < vertices; ++i) {
    if (place[i] != unused) first[place[i]] = std::min(first[place[i]], static_cast<unsigned>(i));
  }
  for (unsigned& each : place) each = each == unused ? unused : first[each];
  return place;
}

template <std::size_t bytes>
Slice picked_bytes(const Slice& slice, const Array<std::uint32_t>& vertices, Job& job) {
  using Element = std::array<std::byte, bytes>;
  Array<Element> out(job, vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) out[i] = load<Element>(slice, vertices[i]);
  return keep(std::move(out));
}

}  // namespace

Slice picked(const Column& column, const Array<std::uint32_t>& vertices, Job& job) {
  switch (column.stride()) {
    case 4:
      return picked_bytes<4>(column.slice, vertices, job);
    case 8:
      return picked_bytes<8>(column.slice, vertices, job);
    case 12:
      return picked_bytes<12>(column.slice, vertices, job);
    default:
      return picked_bytes<16>(column.slice, vertices, job);
  }
}

OctahedralNormal octahedral(const glm::dvec3& n) {
  const double length = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  const double x = length > 0 ? n.x / length : 0, y = length > 0 ? n.y / length : 0;
  const bool below = n.z < 0;
  const double u = below ? (1 - std::abs(y)) * (x >= 0 ? 1 : -1) : x;
  const double v = below ? (1 - std::abs(x)) * (y >= 0 ? 1 : -1) : y;
  return {signed_of(u, normal_bits), signed_of(v, normal_bits), signed_of(1, normal_bits), 0};
}

namespace {

/// Vertices in the order of their first use, without those that nobody uses; indices as narrow as they can
/// be.
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
    column.slice = picked(column, vertices, job);
    column.count = vertices.size();
  }
  Column& position = part.columns.front();
  glm::u16vec4 low(65'535), high(0);
  for (std::size_t i = 0; i < position.count; ++i) {
    low = glm::min(low, load<glm::u16vec4>(position.slice, i));
    high = glm::max(high, load<glm::u16vec4>(position.slice, i));
  }
  position.range = Box{glm::vec3(low), glm::vec3(high)};
  if (!part.index) return;
  part.index->count = corners.size();
  if (vertices.size() <= 65'535) {
    Array<std::uint16_t> narrow(job, corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) narrow[i] = static_cast<std::uint16_t>(corners[i]);
    part.index->slice = keep(std::move(narrow));
    part.index->component = Component::u16;
  } else {
    part.index->slice = keep(std::move(corners));
    part.index->component = Component::u32;
  }
}

/// Points that are equal in everything are one.
void clean_points(Part& part, Job& job) {
  const std::size_t count = part.columns.front().count;
  Array<std::uint32_t> corners(job, (count + 2) / 3 * 3);  // the library counts in triangles
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

/// The columns of a part begin with its positions (take_columns).
void clean(Part& part, Job& job) {
  if (part.topology == Topology::points && !part.index) return clean_points(part, job);
  if (part.topology != Topology::triangles || !part.index) return;
  job.check();
  Array<std::uint32_t> corners(job);
  const std::span<const std::uint32_t> given = corners_of(*part.index, corners);
  const std::size_t vertices = part.columns.front().count, before = given.size();
  std::size_t kept = 0;
  const Array<unsigned> first = firsts_of(part, given, kept, job);
  // Mostly nothing is to be done, and then nothing is copied.
  if (kept == vertices && !any_flat(part.columns.front(), given)) return;
  if (corners.empty()) corners.append(given);
  part.index->slice = {};  // rewrite() makes another of the corners
  if (!first.empty()) {
    for (std::uint32_t& corner : corners) corner = first[corner];
  }
  drop_flat(part.columns.front(), corners);
  if (corners.size() < before) drop_folds(part.columns.front(), corners, job);
  rewrite(part, corners, job);
}

}  // namespace

void quantize(Part& part, const Grid& grid, Job& job) {
  const std::vector<std::size_t> inward = corners_looking_inward(part, job);
  Slice exact = part.columns.front().slice;
  quantize_columns(part, grid, job);
  const bool is_closed = separate(part, exact, job);
  if (!is_closed) keep_positions(part.columns.front(), exact, grid, job);
  exact = {};
  mend_normals(part, inward, job);
  if (is_closed) clean(part, job);
}

void quantize(Columns& columns, const std::vector<Grid>& grids, Job& job) {
  for (std::size_t i = 0; i < columns.meshes.size(); ++i) {
    for (Part& part : columns.meshes[i]) {
      if (!part.is_packed) quantize(part, grids[i], job);
    }
    std::erase_if(columns.meshes[i], [](const Part& part) { return part.index && part.index->count == 0; });
  }
}

}  // namespace seedmesh::gltf
