#pragma once
/// Model -> glTF 2.0. The only room that includes tinygltf.
#include <string>

#include "core/gltf/payload.h"
#include "core/model/model.h"

namespace seedmesh {

/// glb: one binary file. gltf: one JSON file, buffer and images inside as base64. zip: name.gltf, name.bin
/// and textures/*.png stored uncompressed, name being Model::name reduced to file name characters; for models
/// whose nodes have coarser levels also name_LOD1.gltf, name_LOD1.bin and so on, which share the textures.
enum class Container { glb, gltf, zip };

/// What a file says in words that core glTF 2.0 does not have. Who cannot read such a word would show
/// something else, so the file requires it; only MSFT_lod may be overlooked: the finest level is then shown
/// alone.
struct Dialect {
  /// KHR_mesh_quantization and EXT_meshopt_compression: positions of 16 bits on a grid of the mesh (steps of
  /// a power of two, alike for meshes alike in size, so that their common edges stay common), normals and
  /// tangents of 10 bits an octahedral axis, texture coordinates of 16 bits, or of 2^-14 outside 0..1. What
  /// becomes equal is one vertex, what loses its area is left out. Lossless from there on.
  bool compressed = false;
  bool gpu_instances = false;  ///< EXT_mesh_gpu_instancing instead of a node for each copy
  bool lods_inside = false;    ///< MSFT_lod; of no effect in a zip, which has a file for each level
};

struct WriteOptions {
  Container container = Container::glb;
  std::string generator = {};  ///< goes to asset.generator
  Dialect dialect = {};
  /// Where given, count() of the model; gets what is left where the dialect leaves something out.
  ModelCounts* counts = nullptr;
};

/// Writes the whole model; takes it over, since the payload points into its arrays. Every accessor has min
/// and max where glTF wants them, every view of vertices or indices its target, everything is aligned to 4.
/// Without a dialect core glTF 2.0: instances become nodes that share a mesh; extensions (unlit, variants)
/// are never required. What no node shows (meshes, materials, textures, skins) is left out; a model without
/// meshes gives a scene without any. Model::extras and warnings go to asset.extras.
///
/// Promises of the caller, kept by finish(): names are UTF-8, unique and not empty; no number is NaN or
/// infinite; Mesh::bounds fits or is {0,0}. A node with a skin has joints and weights in all its primitives
/// and stands at the root (glTF ignores its transform).
///
/// Throws Stop (through job) before output_bytes is passed, or where the file would reach 4 GiB. Vertex and
/// index data are not copied for glb and zip; base64 takes 4/3 of them and gives each array back when it is
/// encoded. The compressed dialect makes its data anew: about 60 ns a vertex, one thread.
Payload write(Model model, const WriteOptions& options, Job& job);

/// The same in plain words.
Payload write(Model model, Container container, const std::string& generator, Job& job);

}  // namespace seedmesh
