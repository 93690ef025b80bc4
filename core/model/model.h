#pragma once
/// A whole answer before it becomes glTF: nodes, meshes, materials, textures, skins, animations. Everything
/// refers by index into the vectors of the Model; -1 means none. Parents stand before their children in
/// `nodes`.
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/model/mesh.h"

namespace seedmesh {

/// Pixels ready to ship. Shared, because textures are cached across requests.
struct Image {
  std::string name;
  std::string mime = "image/png";
  std::vector<std::uint8_t> bytes;
};

struct TextureUse {
  int texture = -1;  ///< into Model::textures
  int uv_set = 0;
  bool repeat = true;
};

/// Textures that are made by seed once it is known how large they are wanted (core/texture/paint.h). They
/// take the place of the material's colour, roughness, alpha and side.
struct TextureRecipe {
  std::string kind;  ///< of texture_kinds(), as "oak_bark"; empty: none
  std::uint64_t seed = 0;
  std::optional<std::array<std::uint8_t, 3>> color;  ///< sRGB of the main colour; none: the kind's own
  glm::vec3 factor{1};  ///< linear; multiplies what is painted, so that several looks share one picture
};

/// A picture of meshes of the model from several sides, drawn once these have their textures
/// (core/texture/impostor.h).
struct ImpostorRecipe {
  struct Part {
    int mesh = -1;    ///< into Model::meshes
    glm::mat4 at{1};  ///< where it stands in the frame of the impostor
  };
  std::vector<Part> parts;  ///< empty: none
};

enum class AlphaMode { opaque, mask, blend };

struct Material {
  std::string name;
  glm::vec4 base_color{1, 1, 1, 1};  ///< linear
  float metallic = 0;
  float roughness = 1;
  glm::vec3 emissive{0};
  TextureUse base_color_texture, normal_texture, metallic_roughness_texture, occlusion_texture,
      emissive_texture;
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5F;
  bool double_sided = false;
  bool unlit = false;       ///< KHR_materials_unlit, never required
  TextureRecipe recipe;     ///< used up by paint()
  ImpostorRecipe impostor;  ///< used up by draw_impostors()
};

struct Primitive {
  Mesh mesh;
  int material = -1;
  std::vector<int> variant_materials;  ///< one per Model::variants, or empty
};

/// What a node shows: one primitive for each material.
struct MeshGroup {
  std::string name;
  std::vector<Primitive> primitives;
};

struct Transform {
  glm::vec3 translation{0};
  glm::quat rotation{1, 0, 0, 0};
  glm::vec3 scale{1};
};

/// Many copies of a node's mesh. `EXT_mesh_gpu_instancing` or child nodes, as output.instancing says.
struct Instances {
  std::vector<Transform> transforms;
};

enum class CollisionShape { none, box, capsule, sphere, convex };

/// A name and a value in JSON text, for the glTF member `extras`.
struct Extra {
  std::string name;
  std::string json;
};

struct Node {
  std::string name;
  int parent = -1;
  Transform transform;
  int mesh = -1;              ///< into Model::meshes
  std::vector<int> lods;      ///< coarser meshes after `mesh`, finest first; -1: there the node shows nothing
  bool has_impostor = false;  ///< the last of `lods` is a picture of the whole, or nothing beside it
  int skin = -1;
  Instances instances;  ///< empty: the node stands once
  CollisionShape collision = CollisionShape::none;
  std::vector<Extra> extras;
};

/// Joints are nodes; inverse_bind[i] belongs to joints[i].
struct Skin {
  std::string name;
  std::vector<int> joints;
  std::vector<glm::mat4> inverse_bind;
  int skeleton = -1;
};

enum class Path { translation, rotation, scale, weights };
enum class Interpolation { linear, step };

struct Channel {
  int node = -1;
  Path path = Path::translation;
  Interpolation interpolation = Interpolation::linear;
  int times = -1;             ///< into Animation::times; channels share key times
  std::vector<float> values;  ///< 3 (translation, scale) or 4 (rotation, xyzw) floats a key
};

struct Animation {
  std::string name;
  std::vector<std::vector<float>> times;  ///< seconds, rising
  std::vector<Channel> channels;
};

/// A remark on the request that does not refuse it.
struct Warning {
  std::string pointer;
  std::string message;
  int line = 0, column = 0;
};

struct Model {
  std::string name = "model";
  std::vector<Node> nodes;
  std::vector<MeshGroup> meshes;
  std::vector<Material> materials;
  std::vector<std::shared_ptr<const Image>> textures;
  std::vector<std::string> variants;  ///< names for KHR_materials_variants
  std::vector<Skin> skins;
  std::vector<Animation> animations;
  std::vector<Extra> extras;  ///< go to asset.extras
  std::vector<Warning> warnings;
};

struct ModelCounts {
  std::uint64_t triangles = 0, lines = 0, points = 0;  ///< as drawn: instances counted, coarser LODs not
  std::uint64_t vertices = 0;                          ///< as stored
  std::uint64_t bytes = 0;                             ///< of all vertex and index data as stored
};
ModelCounts count(const Model& model);

/// Box of everything that is drawn, node transforms and instances applied; {0,0} for an empty model.
Box bounds_of(const Model& model);

/// Linear value of an sRGB byte 0..255, after IEC 61966-2-1, by a table made with deterministic math.
float linear_of_srgb(std::uint8_t value);

}  // namespace seedmesh
