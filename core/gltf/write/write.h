#pragma once
/// Model -> glTF 2.0.
#include <string>
#include <vector>

#include "core/gltf/payload.h"
#include "core/model/model.h"

namespace seedmesh {

/// glb: one binary file. gltf: one JSON file with buffer and images as base64. zip: name.gltf, name.bin and
/// textures/* without compression, where name is Model::name in characters of file names. Models with
/// levels of detail also have name_LOD1.gltf, name_LOD1.bin and so on, which share the textures.
enum class Container { glb, gltf, zip };

/// The glTF extensions that a file uses. The file requires them, because a reader without them would show
/// another model. MSFT_lod alone is optional: readers without it show the finest level.
struct Dialect {
  /// KHR_mesh_quantization and EXT_meshopt_compression. Positions have 16 bits on a grid whose step is a
  /// power of two. Meshes of similar size therefore share grid points on common edges. Normals and tangents
  /// have 10 bits for each octahedral axis, texture coordinates 16 bits, or steps of 2^-14 outside 0..1.
  /// Vertices that become equal are joined, and triangles that lose their area are dropped. The compression
  /// itself is lossless. Translations and scales of nodes are written as doubles, so that readers with
  /// doubles get the points of the grid exactly.
  bool compressed = false;
  bool gpu_instances = false;  ///< EXT_mesh_gpu_instancing instead of a node for each copy
  bool lods_inside = false;    ///< MSFT_lod; ignored in a zip, which has a file for each level
  /// KHR_mesh_quantization alone, for readers without a decoder: positions on the same grid, normals and tangents
  /// with 16 bits for each axis, texture coordinates with 16 bits, or floats outside 0..1. Meshes with copies
  /// keep float positions, so that the translation of a copy is the position of its origin.
  bool quantized = false;
  /// OMI_physics_shape and OMI_physics_body: collision shapes become shapes of a static body, which is their
  /// parent node, and are not visible meshes. These extensions are optional.
  bool physics = false;
  bool single_root = false;  ///< GODOT_single_root where the scene has one root without a transform; optional
};

struct WriteOptions {
  Container container = Container::glb;
  std::string generator = {};  ///< goes to asset.generator
  Dialect dialect = {};
  /// Names of images: `<stem>_<name>_<hash>` (core/gltf/content_names.h). Empty: their own names.
  std::string image_stem = {};
  std::vector<Extra> scene_extras = {};  ///< extras of the scene of each file
  /// Null, or count() of the model; updated where the dialect drops vertices or triangles.
  ModelCounts* counts = nullptr;
  /// In metres. The steps of quantized meshes are chosen for an extent of at least this. Tiles of one world give
  /// one value, which is at least the extent of each, so that their borders are equal to the bit.
  float least_extent = 0;
};

/// Writes a model. The payload owns the arrays of the model and points into them. Accessors have min and max
/// where glTF requires them, views of vertices and indices have a target, and everything is aligned to 4
/// bytes. Without a dialect the file is core glTF 2.0: instances become nodes that share a mesh, and the
/// extensions unlit and variants are optional. Meshes, materials, textures and skins that no node shows are
/// left out. Model::extras and warnings go to asset.extras.
///
/// The caller has called finish(): names are UTF-8, unique and not empty; numbers are finite; Mesh::bounds
/// fits or is {0,0}. A node with a skin has joints and weights in all its primitives and is a root, because
/// glTF ignores its transform.
///
/// Throws Stop (through job) before the output exceeds limits.output_bytes, or if the file would reach 4 GiB.
/// Vertex and index data are not copied for glb and zip. base64 takes 4/3 of their size and releases each
/// array once it is encoded. The compressed dialect takes about 60 ns for a vertex, on one thread.
Payload write(Model model, const WriteOptions& options, Job& job);

/// The same without extensions.
Payload write(Model model, Container container, const std::string& generator, Job& job);

}  // namespace seedmesh
