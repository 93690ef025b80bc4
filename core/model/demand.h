#pragma once
/// What the requested output requires of a model: levels of detail, animation, wind, collision shapes.
#include <cstdint>

namespace seedmesh {

/// Naming convention of collision shapes; none: the model has no collision shapes.
enum class CollisionNames { none, plain, unreal, godot };

/// How repeated parts are written; any: the output profile decides.
enum class CopyForm { any, nodes, gpu, merge };

/// A demand contains only what the row of the generator in the registry offers: the pipeline refuses other requests.
struct Demand {
  int lods = 1;                   ///< levels of detail, 1 to 5
  bool two_sided_leaves = false;  ///< the engine of the profile flips the normals of back faces itself
  bool share_organs = false;  ///< leaves and other organs are nodes that share a mesh, not one merged mesh
  bool growth = false;        ///< the animation "growth"
  bool wind = false;          ///< wind weights in TEXCOORD_2 and TEXCOORD_3
  CollisionNames collision = CollisionNames::none;
  int textures = 512;                ///< width and height in texels; 0: no textures
  bool tangents = true;              ///< of the output; a generator may write them where that is cheap
  bool impostor = false;             ///< an impostor is the coarsest level of each plant of a scene
  CopyForm copies = CopyForm::any;   ///< form of repeated parts of a scene or a building
  std::uint64_t most_triangles = 0;  ///< the budget; 0: none
  bool first_fit = false;            ///< of the levels, only the first one within most_triangles remains
  std::uint32_t most_bones = 240;    ///< largest number of bones of the animation "growth"
  bool packs = false;  ///< no later stage reads finished meshes, so they may be packed (gltf/compress/pack.h)
};

}  // namespace seedmesh
