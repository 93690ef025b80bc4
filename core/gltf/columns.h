#pragma once
/// The arrays of a model on their way into the buffer of a glTF file. A column is what one accessor
/// describes.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/model/model.h"

namespace seedmesh::gltf {

/// Bytes with what keeps them alive. Copies share the bytes.
struct Slice {
  std::shared_ptr<const void> owner;
  std::span<const std::byte> bytes;
  std::uint64_t plain = 0;  ///< how many they were before they were encoded (compress.h); 0: they are not

  std::uint64_t size() const { return plain > 0 ? plain : bytes.size(); }
};

/// Numbers as OpenGL names their types, which glTF took over.
enum class Component : int { u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

enum class Lanes : int { scalar = 1, vec2 = 2, vec3 = 3, vec4 = 4, mat4 = 16 };

/// How the bytes of a compressed column differ from what its accessor tells: see EXT_meshopt_compression.
enum class Filter { none, octahedral, exponential };

struct Column {
  Slice slice = {};
  Component component = Component::f32;
  Lanes lanes = Lanes::scalar;
  std::size_t count = 0;    ///< elements of `lanes` numbers each; never 0 in a document
  bool normalized = false;  ///< integers stand for 0..1, or -1..1 with a sign
  Filter filter = Filter::none;
  std::optional<Box> range = {};  ///< where glTF wants it (positions, key times: in x)

  std::uint32_t stride() const { return static_cast<std::uint32_t>(slice.size() / count); }
};

/// A name of glTF ("POSITION") for a column of the part. Two names may share a column.
struct Attribute {
  std::string_view semantic;
  std::size_t column = 0;
};

/// What becomes one primitive.
struct Part {
  Topology topology = Topology::triangles;
  std::vector<Column> columns = {};
  std::vector<Attribute> attributes = {};
  std::optional<Column> index = {};
  int material = -1;
  std::vector<int> variant_materials = {};
  bool is_packed = false;  ///< quantized, and its great arrays encoded
};

struct Tracks {
  std::vector<Column> times;   ///< as Animation::times
  std::vector<Column> values;  ///< of each sampler; channels with equal values at equal times share one
  std::vector<int> sampler;    ///< of each channel of the animation
  std::vector<int> channel;    ///< of each sampler, the first channel that uses it
};

/// Everything of a model that is stored as numbers in a buffer; the vectors run beside those of the model.
struct Columns {
  std::vector<std::vector<Part>> meshes;  ///< a mesh's primitives that have vertices
  std::vector<Column> inverse_binds;      ///< as Model::skins
  std::vector<Tracks> animations;         ///< as Model::animations
};

/// Moves a container to where payloads can share it.
template <class Container>
Slice keep(Container numbers) {
  auto kept = std::make_shared<const Container>(std::move(numbers));
  const auto bytes = std::as_bytes(std::span(kept->data(), kept->size()));
  return {std::move(kept), bytes};
}

/// What is kept of a packed mesh for take_columns().
struct PackedPart : PackedMesh {
  Part part;
};

/// Takes the arrays of one primitive.
Part take_part(Primitive& primitive);

/// Takes the arrays out of `model` (which keeps all else) without copying any of them. The range of the
/// positions is Mesh::bounds where it is set; else they are read through once. A texture coordinate set that
/// is missing below one that is there (glTF wants them without gaps) shares the column of the nearest set
/// that exists.
Columns take_columns(Model& model);

/// Lets go of the bytes of all columns; what is told of them stays.
void let_go(Columns& columns);

}  // namespace seedmesh::gltf
