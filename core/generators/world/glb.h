#pragma once
/// A small writer of binary glTF for tiles. The writer of models offers neither translations of double precision nor
/// a quantization step that the caller chooses; tiles need both.
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/schema/json.h"

namespace seedmesh::world {

struct Asset;

/// The path from a tile to the directory of the files that tiles share.
constexpr char shared_files[] = "../../../a/";

struct TileVertex {
  std::int16_t x = 0, y = 0, z = 0;  ///< position in steps; +Y up
  std::int16_t unused = 0;
  std::int8_t normal[4] = {0, 127, 0, 0};
  std::uint8_t color[4] = {255, 255, 255, 255};  ///< linear
};
static_assert(sizeof(TileVertex) == 16);

struct TileMesh {
  std::vector<TileVertex> vertices;
  std::vector<std::uint32_t> indices;  ///< triangles, counter-clockwise from outside
};

/// The name and the roughness of a material.
struct Surface {
  std::string_view name;
  double roughness = 1;
};
inline constexpr Surface ground_surface{"ground", 1}, water_surface{"water", 0.15};

class Glb {
 public:
  /// `translation`: of the root node.
  explicit Glb(const std::array<double, 3>& translation);

  /// Adds a material and returns its index.
  int add_material(std::string_view name, double roughness, bool two_sided = false);
  /// Adds a material with a colour texture from a file that tiles share, and returns its index.
  int add_material(std::string_view name, double roughness, const std::string& image);
  /// Adds a material of leaves, with a colour texture with alpha from a file that tiles
  /// share, and returns its index. Materials with the same image share their texture.
  int add_leaf_material(std::string_view name, const std::string& image);
  /// Adds a node with one mesh of quantized vertices: metres = height * up + step * position. `coordinates`: of
  /// the texture, two for each vertex, or none.
  void add_mesh(std::string_view name, const TileMesh& mesh, int material, double step, double height,
                const std::vector<float>& coordinates = {});
  /// Triangles with one material. `order`: number of the accessor of their indices.
  struct Part {
    int order = -1, material = -1;
  };
  /// The parts of a mesh, and the number of the accessor of its texture coordinates; -1: none.
  struct Parts {
    std::vector<Part> parts;
    int coordinates = -1;
  };
  /// Like add_mesh() above, with triangle indices and texture coordinates from accessors.
  void add_mesh(std::string_view name, const std::vector<TileVertex>& vertices, const Parts& parts,
                double step, double height);
  /// Adds the indices of triangles over `vertices` vertices, and returns the index of their accessor.
  int add_indices(const std::vector<std::uint32_t>& indices, std::size_t vertices);
  /// Like add_indices(), with corners of 16 bits at a part of another buffer.
  int add_shared_indices(int buffer, std::size_t offset, std::size_t count);
  /// Adds texture coordinates at a part of another buffer and returns the index of their accessor.
  int add_shared_coordinates(int buffer, std::size_t offset, std::size_t count);
  /// Adds a buffer in a file of shared_files and returns its index.
  int add_shared_buffer(const std::string& file, std::size_t bytes);
  /// Adds a shared model and returns the indices of its meshes. An asset that was added before is not added again.
  std::vector<int> add_asset(const Asset& asset);
  int add_view(int buffer, std::size_t offset, std::size_t bytes, std::size_t stride, int target);
  /// Appends bytes to the file's own buffer, aligned to 4 bytes, and returns the index of their view.
  int add_bytes(const void* data, std::size_t bytes, std::size_t stride, int target);
  int add_accessor(Json accessor);
  int add_node(Json node);  ///< below the root
  int add_gltf_mesh(Json mesh);
  void use_extension(std::string_view name);

  /// The bytes of the file as it is now.
  std::size_t size() const;
  std::string text() &&;

 private:
  Json json_;
  std::string bytes_;
  int texture_of(const std::string& image);

  std::map<std::string, std::vector<int>> assets_;  ///< meshes by hash
  std::map<std::string, int> textures_;             ///< by the path of their image
};

}  // namespace seedmesh::world
