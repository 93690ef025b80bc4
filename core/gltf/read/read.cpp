/// Spec: Khronos, "glTF 2.0 Specification" (2021): GLB 4, accessors 3.6.2, meshes 3.7.2, nodes 3.5.
#include "core/gltf/read/read.h"

#include <cmath>
#include <map>

#include "core/base/math.h"
#include "core/gltf/read/accessor.h"
#include "core/gltf/read/bytes.h"
#include "core/gltf/read/file.h"
#include "core/model/empty_mesh.h"

namespace seedmesh {
namespace {

using gltf::Unreadable;

constexpr std::string_view uri_starts[] = {"data:model/gltf-binary;base64,",
                                           "data:application/octet-stream;base64,"};
constexpr double least_area = 1e-12;  ///< of the squared diagonal: below it a triangle is none

glm::dmat4 matrix_of(const tinygltf::Node& node) {
  glm::dmat4 matrix(1);
  if (node.matrix.size() == 16) {
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
    return matrix;
  }
  if (node.rotation.size() == 4) {
    matrix =
        glm::mat4_cast(glm::dquat(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]));
  }
  if (node.scale.size() == 3) {
    for (int axis = 0; axis < 3; ++axis) matrix[axis] *= node.scale[static_cast<std::size_t>(axis)];
  }
  if (node.translation.size() == 3)
    matrix[3] = glm::dvec4(node.translation[0], node.translation[1], node.translation[2], 1);
  return matrix;
}

/// A primitive of the file as one node shows it.
struct Shown {
  const tinygltf::Primitive* primitive;
  glm::dmat4 matrix;
};

/// Every primitive of triangles that the scene shows, by material. Walks without recursion; a node that is
/// met twice would be no tree.
class Scene {
 public:
  Scene(const tinygltf::Model& file, Job& job) : file_(file), job_(job), seen_(file.nodes.size(), false) {
    if (file.scenes.empty() && file.nodes.empty()) {
      for (const tinygltf::Mesh& mesh : file.meshes) add(mesh, glm::dmat4(1));
      return;
    }
    const int scene = file.defaultScene >= 0 ? file.defaultScene : 0;
    if (static_cast<std::size_t>(scene) >= file.scenes.size()) throw Unreadable{"it has no scene"};
    std::vector<std::pair<int, glm::dmat4>> open;
    for (const int root : file.scenes[static_cast<std::size_t>(scene)].nodes)
      open.emplace_back(root, glm::dmat4(1));
    while (!open.empty()) {
      const auto [number, around] = open.back();
      open.pop_back();
      visit(number, around, open);
    }
  }

  std::map<int, std::vector<Shown>> by_material;
  bool has_other_kinds = false;

 private:
  void visit(int number, const glm::dmat4& around, std::vector<std::pair<int, glm::dmat4>>& open) {
    const auto index = static_cast<std::size_t>(number);
    if (number < 0 || index >= file_.nodes.size())
      throw Unreadable{"it refers to node " + std::to_string(number) + ", which does not exist"};
    if (seen_[index]) throw Unreadable{"node " + std::to_string(number) + " occurs twice in the scene"};
    seen_[index] = true;
    const tinygltf::Node& node = file_.nodes[index];
    const glm::dmat4 matrix = around * matrix_of(node);
    if (node.mesh >= 0) {
      if (static_cast<std::size_t>(node.mesh) >= file_.meshes.size())
        throw Unreadable{"it refers to mesh " + std::to_string(node.mesh) + ", which does not exist"};
      add(file_.meshes[static_cast<std::size_t>(node.mesh)], matrix);
    }
    for (const int child : node.children) open.emplace_back(child, matrix);
    job_.check();
  }

  void add(const tinygltf::Mesh& mesh, const glm::dmat4& matrix) {
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      const bool triangles = primitive.mode == -1 || (primitive.mode >= TINYGLTF_MODE_TRIANGLES &&
                                                      primitive.mode <= TINYGLTF_MODE_TRIANGLE_FAN);
      if (!triangles) {
        has_other_kinds = true;
        continue;
      }
      const int material =
          primitive.material >= 0 && static_cast<std::size_t>(primitive.material) < file_.materials.size()
              ? primitive.material
              : -1;
      by_material[material].push_back({&primitive, matrix});
    }
  }

  const tinygltf::Model& file_;
  Job& job_;
  std::vector<bool> seen_;
};

/// Joins the primitives of one material into one mesh.
class Joining {
 public:
  Joining(const tinygltf::Model& file, const std::vector<Shown>& parts, Job& job) : file_(file), job_(job) {
    mesh_ = empty_mesh(job);
    mesh_.uv[0] = Array<glm::vec2>(job);
    mesh_.color = Array<glm::u8vec4>(job);
    for (const Shown& part : parts) {
      has_uv_ |= part.primitive->attributes.contains("TEXCOORD_0");
      has_color_ |= part.primitive->attributes.contains("COLOR_0");
    }
    for (const Shown& part : parts) add(part);
  }

  Mesh take() { return std::move(mesh_); }

 private:
  gltf::Accessor attribute(const tinygltf::Primitive& primitive, const char* name) const {
    const auto found = primitive.attributes.find(name);
    return found == primitive.attributes.end() ? gltf::Accessor{} : gltf::accessor_of(file_, found->second);
  }

  void add(const Shown& part) {
    const tinygltf::Primitive& primitive = *part.primitive;
    const gltf::Accessor position = attribute(primitive, "POSITION");
    if (position.count == 0 || position.lanes != 3) throw Unreadable{"a primitive has no positions"};
    const Array<std::uint32_t> corners = gltf::triangles_of(file_, primitive, position.count, job_);
    job_.spend(Resource::triangles, corners.size() / 3);

    Array<glm::dvec3> placed(job_, position.count);
    for (std::size_t i = 0; i < position.count; ++i) {
      if (i % 4096 == 0) job_.check();
      placed[i] = glm::dvec3(part.matrix * glm::dvec4(glm::dvec3(position.at(i)), 1));
      for (int axis = 0; axis < 3; ++axis) {
        if (!(std::abs(placed[i][axis]) <= gltf::farthest))
          throw Unreadable{"a position is not a number up to 1,000,000"};
      }
    }
    write(part, placed, corners);
  }

  /// One vertex for each that is used, or three for each triangle where there are no normals to share.
  void write(const Shown& part, const Array<glm::dvec3>& placed, const Array<std::uint32_t>& corners) {
    constexpr std::uint32_t none = 0xFFFFFFFFU;
    const gltf::Accessor normal = attribute(*part.primitive, "NORMAL");
    const gltf::Accessor uv = attribute(*part.primitive, "TEXCOORD_0");
    const gltf::Accessor color = attribute(*part.primitive, "COLOR_0");
    for (const gltf::Accessor* each : {&normal, &uv, &color}) {
      if (each->count != 0 && each->count != placed.size())
        throw Unreadable{"the attributes of a primitive differ in length"};
    }
    const bool smooth = normal.count != 0 && normal.lanes == 3;
    const glm::dmat3 turn(part.matrix);
    const double determinant = glm::determinant(turn);
    const glm::dmat3 normal_turn = determinant != 0 ? glm::transpose(glm::inverse(turn)) : turn;
    const double smallest = least_area * squared_diagonal(placed);
    Array<std::uint32_t> place(job_, placed.size(), none);
    for (std::size_t t = 0; t + 2 < corners.size(); t += 3) {
      if (t % 3072 == 0) job_.check();
      std::uint32_t ids[3] = {corners[t], corners[t + 1], corners[t + 2]};
      if (determinant < 0) std::swap(ids[1], ids[2]);  // a mirror turns triangles inside out
      const glm::dvec3 across = glm::cross(placed[ids[1]] - placed[ids[0]], placed[ids[2]] - placed[ids[0]]);
      const double area = glm::length(across) / 2;
      if (!(area > smallest)) continue;
      const glm::dvec3 face = across / (2 * area);
      for (const std::uint32_t id : ids) {
        if (!smooth || place[id] == none) {
          place[id] = static_cast<std::uint32_t>(mesh_.position.size());
          glm::dvec3 up = face;
          if (smooth) up = math::unit(normal_turn * glm::dvec3(normal.at(id)), face);
          mesh_.position.push_back(glm::vec3(placed[id]));
          mesh_.normal.push_back(glm::vec3(up));
          if (has_uv_) mesh_.uv[0].push_back(uv.count ? glm::vec2(uv.at(id)) : glm::vec2(0));
          if (has_color_) mesh_.color.push_back(color.count ? gltf::color_at(color, id) : glm::u8vec4(255));
        }
        mesh_.index.wide.push_back(place[id]);
      }
    }
  }

  static double squared_diagonal(const Array<glm::dvec3>& points) {
    glm::dvec3 low = points[0], high = points[0];
    for (const glm::dvec3& p : points) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    return glm::dot(high - low, high - low);
  }

  const tinygltf::Model& file_;
  Job& job_;
  Mesh mesh_;
  bool has_uv_ = false, has_color_ = false;
};

float within(double value, double low, double high, double otherwise) {
  return static_cast<float>(value >= low && value <= high ? value : otherwise);
}

Material material_of(const tinygltf::Material& given) {
  Material material;
  material.name = given.name;
  const tinygltf::PbrMetallicRoughness& surface = given.pbrMetallicRoughness;
  for (int i = 0; i < 4 && surface.baseColorFactor.size() == 4; ++i)
    material.base_color[i] = within(surface.baseColorFactor[static_cast<std::size_t>(i)], 0, 1, 1);
  for (int i = 0; i < 3 && given.emissiveFactor.size() == 3; ++i)
    material.emissive[i] = within(given.emissiveFactor[static_cast<std::size_t>(i)], 0, 1, 0);
  material.metallic = within(surface.metallicFactor, 0, 1, 1);
  material.roughness = within(surface.roughnessFactor, 0, 1, 1);
  material.double_sided = given.doubleSided;
  if (given.alphaMode == "MASK") material.alpha_mode = AlphaMode::mask;
  if (given.alphaMode == "BLEND") material.alpha_mode = AlphaMode::blend;
  material.alpha_cutoff = within(given.alphaCutoff, 0, 1, 0.5);
  return material;
}

Model model_of(std::span<const std::byte> bytes, const std::string& pointer, Job& job) {
  const std::string_view text = gltf::checked_json(bytes);
  const gltf::Charge charge(job, gltf::parsing_cost(bytes, text));
  const gltf::ReadFile read = gltf::parsed(bytes, text, job);
  const tinygltf::Model& file = read.file;
  Model model;
  model.name = "mesh";
  for (const tinygltf::Material& material : file.materials) model.materials.push_back(material_of(material));
  const Scene scene(file, job);
  MeshGroup group;
  group.name = "mesh";
  for (const auto& [material, parts] : scene.by_material) {
    Mesh mesh = Joining(file, parts, job).take();
    if (mesh.elements() > 0) group.primitives.push_back({std::move(mesh), material, {}});
  }
  if (group.primitives.empty()) throw Unreadable{"its scene has no triangles"};
  model.meshes.push_back(std::move(group));
  Node& node = model.nodes.emplace_back();
  node.name = "mesh";
  node.mesh = 0;
  std::vector<std::string> unused = read.unused_parts;
  if (scene.has_other_kinds) unused.emplace_back("points and lines");
  for (const std::string& part : unused)
    model.warnings.push_back({pointer, "the " + part + " of the GLB are skipped"});
  return model;
}

}  // namespace

bool is_glb_uri(std::string_view text) {
  for (const std::string_view start : uri_starts) {
    if (text.starts_with(start)) return true;
  }
  return false;
}

Result<Model> read_glb(std::span<const std::byte> bytes, const std::string& pointer, Job& job) {
  try {
    return model_of(bytes, pointer, job);
  } catch (const Unreadable& refusal) {
    return Error{Code::invalid,
                 {{IssueKind::invalid_value, pointer, "the GLB cannot be used: " + refusal.message}}};
  }
}

Result<Model> read_glb(std::string_view data_uri, const std::string& pointer, Job& job) {
  for (const std::string_view start : uri_starts) {
    if (!data_uri.starts_with(start)) continue;
    try {
      const Array<std::byte> bytes = gltf::bytes_of_base64(data_uri.substr(start.size()), job);
      return read_glb(bytes.span(), pointer, job);
    } catch (const Unreadable& refusal) {
      return Error{Code::invalid,
                   {{IssueKind::invalid_value, pointer, "the GLB cannot be used: " + refusal.message}}};
    }
  }
  return Error{
      Code::invalid,
      {{IssueKind::invalid_value, pointer, "expected a GLB as \"data:model/gltf-binary;base64,…\""}}};
}

}  // namespace seedmesh
