/// Kapoulkine, "EXT_meshopt_compression", https://github.com/KhronosGroup/glTF (2021); codecs of version 0
/// (vertices) and 1 (indices), which the extension fixes.
#include "core/gltf/compress/compress.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <cassert>
#include <cstring>
#include <memory>
#include <string_view>
#include <utility>

#include "core/base/array.h"
#include "core/gltf/json_writer.h"

namespace seedmesh::gltf {
namespace {

enum class Mode { attributes, triangles, indices };

Mode mode_of(Pool pool) {
  switch (pool) {
    case Pool::index2:
    case Pool::index4:
      return Mode::triangles;
    case Pool::sequence2:
    case Pool::sequence4:
      return Mode::indices;
    default:
      return Mode::attributes;
  }
}

std::string_view name_of(Mode mode) {
  switch (mode) {
    case Mode::attributes:
      return "ATTRIBUTES";
    case Mode::triangles:
      return "TRIANGLES";
    case Mode::indices:
      return "INDICES";
  }
  return "ATTRIBUTES";
}

std::string_view filter_of(Pool pool) {
  if (pool == Pool::octahedral8) return "OCTAHEDRAL";
  if (pool == Pool::exponential8) return "EXPONENTIAL";
  return {};
}

/// meshoptimizer stores the versions globally.
void choose_versions() {
  static const bool chosen = [] {
    meshopt_encodeVertexVersion(0);
    meshopt_encodeIndexVersion(1);
    return true;
  }();
  static_cast<void>(chosen);
}

/// The arrays of a view, concatenated.
Slice joined(std::vector<Slice> slices, std::uint64_t length, Job& job) {
  if (slices.size() == 1) return std::move(slices.front());
  auto block = std::make_shared<Array<std::byte>>(job);
  block->reserve(length);
  for (const Slice& slice : slices) block->append(slice.bytes);
  assert(block->size() == length);
  const auto whole = std::as_const(*block).span();
  return {std::move(block), whole};
}

/// Indices as 32-bit numbers; `buffer` holds them where they are narrower.
std::span<const unsigned> indices_of(std::span<const std::byte> bytes, std::uint32_t stride,
                                     Array<unsigned>& buffer) {
  if (stride == sizeof(unsigned))  // the array has this type
    return {reinterpret_cast<const unsigned*>(bytes.data()), bytes.size() / stride};
  Array<unsigned>& indices = buffer;
  indices.resize(bytes.size() / stride);
  for (std::size_t i = 0; i < indices.size(); ++i) {
    unsigned index = 0;
    std::memcpy(&index, bytes.data() + i * stride, stride);  // the low bytes come first
    indices[i] = index;
  }
  return std::as_const(indices).span();
}

/// The encoded stream. The buffer that the codec needs is at most a third larger than the stream.
Slice encoded(std::span<const std::byte> bytes, Pool pool, Job& job) {
  const std::uint32_t stride = stride_of(pool);
  const std::size_t count = bytes.size() / stride;
  auto out = std::make_shared<Array<unsigned char>>(job);
  std::size_t size = 0;
  if (mode_of(pool) == Mode::attributes) {
    out->resize(meshopt_encodeVertexBufferBound(count, stride));
    size = meshopt_encodeVertexBuffer(out->data(), out->size(), bytes.data(), count, stride);
  } else {
    Array<unsigned> buffer(job);
    const std::span<const unsigned> indices = indices_of(bytes, stride, buffer);
    const std::size_t vertices = std::size_t{*std::max_element(indices.begin(), indices.end())} + 1;
    if (mode_of(pool) == Mode::triangles) {
      out->resize(meshopt_encodeIndexBufferBound(count, vertices));
      size = meshopt_encodeIndexBuffer(out->data(), out->size(), indices.data(), count);
    } else {
      out->resize(meshopt_encodeIndexSequenceBound(count, vertices));
      size = meshopt_encodeIndexSequence(out->data(), out->size(), indices.data(), count);
    }
  }
  assert(size > 0);
  out->resize(size);
  out->shrink_to_fit();
  const auto whole = std::as_bytes(std::as_const(*out).span());
  return {std::move(out), whole};
}

/// Where the stream lies, and how to read it.
void append_extension(JsonWriter& json, const Bin::View& plain, const Bin::View& stored) {
  const std::uint32_t stride = stride_of(plain.pool);
  json.object("extensions", [&] {
    json.object("EXT_meshopt_compression", [&] {
      json.member("buffer", 0);
      json.member("byteOffset", stored.offset);
      json.member("byteLength", stored.length);
      json.member("byteStride", stride);
      json.member("count", plain.length / stride);
      json.member("mode", name_of(mode_of(plain.pool)));
      if (const std::string_view filter = filter_of(plain.pool); !filter.empty())
        json.member("filter", filter);
    });
  });
}

void append_view(JsonWriter& json, const Bin::View& plain, const Bin::View& stored, std::uint64_t fallback) {
  const bool compressed = target_of(plain.pool) != 0;
  json.object([&] {
    json.member("buffer", compressed ? 1 : 0);
    json.member("byteOffset", compressed ? fallback : stored.offset);
    json.member("byteLength", plain.length);
    if (compressed) {
      if (mode_of(plain.pool) == Mode::attributes) json.member("byteStride", stride_of(plain.pool));
      json.member("target", target_of(plain.pool));
      append_extension(json, plain, stored);
    }
  });
}

}  // namespace

Slice encoded_ahead(const Slice& plain, Pool pool, Job& job) {
  assert(Bin::has_own_view(plain.bytes.size()));
  choose_versions();
  Slice stream = encoded(plain.bytes, pool, job);
  stream.plain = plain.bytes.size();
  return stream;
}

Compressed compress(Bin& plain, Job& job) {
  choose_versions();
  Compressed result;
  std::vector<std::vector<Slice>> slices = plain.slices();
  plain.release();
  for (std::size_t i = 0; i < slices.size(); ++i) {
    job.check();
    const Bin::View& view = plain.views()[i];
    Slice slice = joined(std::move(slices[i]), view.length, job);
    const bool is_encoded = std::exchange(slice.plain, 0) > 0;
    if (target_of(view.pool) != 0 && !is_encoded) slice = encoded(slice.bytes, view.pool, job);
    result.bin.add(Pool::image, std::move(slice));  // its arrays never share a view
  }
  result.bin.arrange();
  JsonWriter json(result.views);
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const Bin::View& view = plain.views()[i];
    append_view(json, view, result.bin.views()[i], result.fallback);
    if (target_of(view.pool) != 0) result.fallback += (view.length + 3) / 4 * 4;
  }
  return result;
}

}  // namespace seedmesh::gltf
