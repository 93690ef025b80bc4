#pragma once
/// The arrays of a model in the form that glTF stores. A column contains the data of one accessor.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/model/model.h"

namespace seedmesh::gltf {

/// Bytes and their owner. Copies share the bytes.
struct Slice {
  std::shared_ptr<const void> owner;
  std::span<const std::byte> bytes;
  std::uint64_t plain = 0;  ///< number of bytes before encoding (compress.h); 0: not encoded

  std::uint64_t size() const { return plain > 0 ? plain : bytes.size(); }
};

/// Component types by their OpenGL numbers, as in glTF.
enum class Component : int { u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

enum class Lanes : int { scalar = 1, vec2 = 2, vec3 = 3, vec4 = 4, mat4 = 16 };

/// The decoding filter of a compressed column: see EXT_meshopt_compression.
enum class Filter { none, octahedral, exponential };

struct Column {
  Slice slice = {};
  Component component = Component::f32;
  Lanes lanes = Lanes::scalar;
  std::size_t count = 0;    ///< elements with `lanes` components each; never 0 in a document
  bool normalized = false;  ///< unsigned integers represent 0..1, and signed integers -1..1
  Filter filter = Filter::none;
  std::optional<Box> range = {};  ///< for positions, and for key times (in x)

  std::uint32_t stride() const { return static_cast<std::uint32_t>(slice.size() / count); }
};

/// A glTF semantic ("POSITION") and its column in the part. Two semantics may share a column.
struct Attribute {
  std::string_view semantic;
  std::size_t column = 0;
};

/// The data of one primitive.
struct Part {
  Topology topology = Topology::triangles;
  std::vector<Column> columns = {};
  std::vector<Attribute> attributes = {};
  std::optional<Column> index = {};
  int material = -1;
  std::vector<int> variant_materials = {};
  bool is_packed = false;  ///< quantized, and its large arrays encoded
};

struct Tracks {
  std::vector<Column> times;  ///< parallel to Animation::times
  std::vector<Column>
      values;  ///< one for each sampler; channels with equal values at equal times share a sampler
  std::vector<int> sampler;  ///< for each channel the number of its sampler
  std::vector<int> channel;  ///< for each sampler the first channel that uses it
};

/// All arrays of a model. The vectors are parallel to those of the model.
struct Columns {
  std::vector<std::vector<Part>> meshes;  ///< for each mesh, those of its primitives that are not empty
  std::vector<Column> inverse_binds;      ///< parallel to Model::skins
  std::vector<Tracks> animations;         ///< parallel to Model::animations
};

/// Moves a container into shared ownership.
template <class Container>
Slice keep(Container numbers) {
  auto kept = std::make_shared<const Container>(std::move(numbers));
  const auto bytes = std::as_bytes(std::span(kept->data(), kept->size()));
  return {std::move(kept), bytes};
}

/// A packed mesh, for take_columns().
struct PackedPart : PackedMesh {
  Part part;
};

/// Moves the arrays out of one primitive.
Part take_part(Primitive& primitive);

/// Moves the arrays out of `model` without copying them; all else stays. The range of the positions is
/// Mesh::bounds where it is set, otherwise it is computed. glTF allows no gaps in texture coordinate sets: a
/// missing set below an existing one shares the column of the nearest set.
Columns take_columns(Model& model);

/// Releases the bytes of all columns; their descriptions stay.
void release(Columns& columns);

}  // namespace seedmesh::gltf
