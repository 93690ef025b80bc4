#include "core/gltf/write/document.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <optional>
#include <string_view>
#include <utility>

#include "core/base/array.h"
#include "core/gltf/compress/compress.h"
#include "core/gltf/json_writer.h"
#include "core/gltf/write/asset.h"
#include "core/gltf/write/lists.h"
#include "core/gltf/write/materials.h"
#include "core/gltf/write/nodes.h"
#include "core/model/build.h"

namespace seedmesh::gltf {
namespace {

/// Placeholder for a number that is not known yet. JSON escapes control characters, so no name contains it.
constexpr std::string_view view_mark = "\x01";

/// Writes the document list by list, as text.
class Describer {
 public:
  Describer(Model& model, Columns& columns, const DocumentOptions& options, Job& job)
      : model_(model),
        columns_(columns),
        options_(options),
        job_(job),
        accessors_(options.dialect.compressed ? Packing::tight : Packing::aligned),
        meshes_(model.meshes.size()),
        images_(2 * model.textures.size()),
        skins_(model.skins.size()),
        materials_{Numbering(model.materials.size())} {}

  /// Finds what each node shows at this level, and numbers meshes and skins.
  NodeMeshes show_nodes() {
    NodeMeshes shown;
    shown.exact = options_.dialect.compressed || options_.dialect.quantized;
    shown.parts = options_.parts;
    for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
      const Node& node = model_.nodes[i];
      const int mesh = mesh_of(node);
      shown.meshes.push_back(meshes_.use(mesh));
      if (mesh >= 0) skins_.use(node.skin);
      if (options_.dialect.lods_inside) shown.lods.push_back(lods_of(node, mesh));
      if (options_.dialect.physics) add_shape(node, shown);
      if (node.parent < 0) roots_.push_back(static_cast<int>(i));
    }
    shown.skins = skins_.numbers();
    if (std::any_of(shown.lods.begin(), shown.lods.end(), [](const auto& lods) { return !lods.empty(); })) {
      extensions_used_.emplace_back("MSFT_lod");
    }
    shape_meshes_ = shown.shape_meshes;
    if (!shape_meshes_.empty()) {
      extensions_used_.emplace_back("OMI_physics_body");
      extensions_used_.emplace_back("OMI_physics_shape");
    }
    const bool is_single = roots_.size() == 1 && roots_[0] == 0 && is_identity(model_.nodes[0].transform);
    if (options_.dialect.single_root && is_single) extensions_used_.emplace_back("GODOT_single_root");
    return shown;
  }

  /// Stores the copies of nodes as arrays where the dialect has them. Copies of a skinned mesh stay nodes.
  void add_copies(NodeMeshes& shown) {
    if (!options_.dialect.gpu_instances) return;
    for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
      std::vector<Transform>& copies = model_.nodes[i].instances.transforms;
      if (copies.empty() || shown.meshes[i] < 0 || model_.nodes[i].skin >= 0) continue;
      shown.copies[i] = copies_of(copies);
      if (options_.last) copies = {};
    }
    if (!shown.copies.empty()) require("EXT_mesh_gpu_instancing");
  }

  void add_meshes() {
    TextMeter meter(mesh_list_, job_);
    for (const std::size_t used : meshes_.used()) {
      append_mesh(mesh_list_, model_.meshes[used].name, columns_.meshes[used], accessors_, materials_);
      meter.step();
    }
    meter.finish();
  }

  void add_animations() {
    TextMeter meter(animation_list_, job_);
    for (std::size_t i = 0; i < model_.animations.size(); ++i) {
      if (model_.animations[i].channels.empty()) continue;
      append_animation(animation_list_, model_.animations[i], columns_.animations[i], accessors_);
      meter.step();
    }
    meter.finish();
  }

  void add_materials() {
    bool any_unlit = false, any_strength = false, any_transmission = false, any_specular = false;
    const TextureNumber texture_number = [this](const TextureUse& use) {
      return textures_.number(use, model_, images_);
    };
    for (const std::size_t used : materials_.numbering.used()) {
      const Material& material = model_.materials[used];
      append_material(material_list_, material, texture_number);
      any_unlit = any_unlit || material.unlit;
      any_strength = any_strength || emissive_strength(material) != 1;
      any_transmission = any_transmission || material.transmission > 0;
      any_specular = any_specular || material.has_specular();
    }
    if (textures_.needs_webp()) {
      require("EXT_texture_webp");
    } else if (textures_.has_webp()) {
      extensions_used_.emplace_back("EXT_texture_webp");
    }
    if (any_transmission) extensions_used_.emplace_back("KHR_materials_diffuse_transmission");
    if (any_strength) extensions_used_.emplace_back("KHR_materials_emissive_strength");
    if (any_specular) extensions_used_.emplace_back("KHR_materials_specular");
    if (any_unlit) extensions_used_.emplace_back("KHR_materials_unlit");
    if (materials_.any_variants) extensions_used_.emplace_back("KHR_materials_variants");
  }

  void add_skins() {
    for (const std::size_t used : skins_.used()) {
      const Skin& skin = model_.skins[used];
      const Column& matrices = columns_.inverse_binds[used];
      append_skin(skin_list_, skin, matrices.count > 0 ? accessors_.add(Pool::binds, matrices) : -1);
    }
  }

  /// Adds the images, and their bytes to the buffer unless they have uris.
  void add_images() {
    for (const std::size_t used : images_.used()) {
      const std::shared_ptr<const Image> image = image_numbered(model_, used);
      JsonWriter json(image_list_);
      json.object([&] {
        json.member("mimeType", image->mime);
        const std::string name = image_name(model_, options_.image_names, used);
        if (!name.empty()) json.member("name", name);
        if (!image->uri.empty()) {
          json.member("uri", image->uri);
        } else if (options_.image_uris.empty()) {
          const auto bytes = std::as_bytes(std::span(image->bytes));
          image_items_.push_back(accessors_.bin().add(Pool::image, {image, bytes}));
          json.key("bufferView");
          json.json(view_mark);
        } else {
          json.member("uri", options_.image_uris[used]);
        }
      });
    }
  }

  /// Arranges the buffer; nothing can be added afterwards.
  void arrange() {
    if (options_.last) release(columns_);
    Bin& bin = accessors_.bin();
    bin.arrange(accessors_.packing());
    for (const int item : image_items_) {
      image_list_.replace(image_list_.find(view_mark), view_mark.size(),
                          std::to_string(bin.location(item).view));
    }
    if (options_.dialect.compressed) return compress_views();
    if (options_.dialect.quantized && !mesh_list_.empty()) require("KHR_mesh_quantization");
    append_views(view_list_, bin, options_.dialect.quantized);
  }

  /// Appends the members that need no node list. Ordered by name, except for views and the lists that may be
  /// long.
  void append_members(JsonWriter& json, std::string& out) const {
    append_asset(json, model_, options_.generator);
    json.list("bufferViews", view_list_);
    append_extensions(json, materials_.any_variants ? model_.variants : std::vector<std::string>(),
                      shape_meshes_);
    append_names(json, "extensionsRequired", extensions_required_);
    append_names(json, "extensionsUsed", extensions_used_);
    json.list("materials", material_list_);
    json.list("samplers", textures_.samplers());
    json.member("scene", 0);
    json.array("scenes", [&] {
      json.object([&] {
        append_extras(json, options_.scene_extras);
        json.member("name", model_.name.empty() ? "scene" : model_.name);
        if (!roots_.empty()) json.values("nodes", roots_);
      });
    });
    json.list("skins", skin_list_);
    json.list("textures", textures_.textures());
    job_.spend(Resource::output_bytes, out.size());
    if (!accessors_.empty()) {
      json.key("accessors");
      accessors_.append(out, job_);
    }
    json.list("animations", animation_list_);
    json.list("bufferViews", compressed_.views);
    json.list("images", image_list_);
    json.list("meshes", mesh_list_);
  }

  Bin take_bin() { return std::move(options_.dialect.compressed ? compressed_.bin : accessors_.bin()); }
  std::uint64_t fallback() const { return compressed_.fallback; }
  const std::vector<std::size_t>& images() const { return images_.used(); }

 private:
  static void append_names(JsonWriter& json, std::string_view key, const std::vector<std::string>& names) {
    if (!names.empty()) json.values(key, names);
  }

  /// Turns the mesh of a collision shape, which the node showed, into a shape.
  static void add_shape(const Node& node, NodeMeshes& shown) {
    int& mesh = shown.meshes.back();
    const bool is_shape = node.collision != CollisionShape::none && mesh >= 0;
    shown.shapes.push_back(is_shape ? static_cast<int>(shown.shape_meshes.size()) : -1);
    if (!is_shape) return;
    shown.shape_meshes.push_back(mesh);
    mesh = -1;
  }

  void require(const char* extension) {
    extensions_used_.emplace_back(extension);
    extensions_required_.emplace_back(extension);
  }

  void compress_views() {
    compressed_ = compress(accessors_.bin(), job_);
    if (compressed_.fallback == 0) return;
    require("KHR_mesh_quantization");
    require("EXT_meshopt_compression");
  }

  /// Numbers of the coarser meshes of a node that shows `mesh`.
  std::vector<int> lods_of(const Node& node, int mesh) {
    std::vector<int> lods;
    for (const int lod : node.lods) {
      if (mesh >= 0 && (lod < 0 || !columns_.meshes[static_cast<std::size_t>(lod)].empty()))
        lods.push_back(meshes_.use(lod));
    }
    return lods;
  }

  template <class T>
  int add_column(Array<T> values, Component component, Lanes lanes, std::optional<Box> range = {}) {
    const std::size_t count = values.size();
    const bool is_share = component == Component::i16;
    copy_columns_.push_back({keep(std::move(values)), component, lanes, count, is_share});
    Column& column = copy_columns_.back();
    column.range = range;
    const int number = accessors_.add(vertex_pool(column), column);
    column.slice = {};
    return number;
  }

  /// Translations have their range, by which some clients cull. Rotations have 16 bits in compressed files; all readers of both extensions support them.
  CopyAccessors copies_of(const std::vector<Transform>& copies) {
    Array<glm::vec3> translation(job_, copies.size()), scale(job_, copies.size());
    bool turned = false, scaled = false;
    for (std::size_t i = 0; i < copies.size(); ++i) {
      translation[i] = copies[i].translation + 0.0F;
      scale[i] = copies[i].scale;
      scaled = scaled || scale[i] != glm::vec3(1);
      turned = turned || copies[i].rotation != glm::quat(1, 0, 0, 0);
    }
    CopyAccessors accessors;
    const Box range = bounds_of(translation.span());
    accessors.translation = add_column(std::move(translation), Component::f32, Lanes::vec3, range);
    if (turned && options_.dialect.compressed) {
      Array<glm::i16vec4> rotation(job_, copies.size());
      for (std::size_t i = 0; i < copies.size(); ++i) {
        const glm::quat& q = copies[i].rotation;
        for (int lane = 0; lane < 4; ++lane) {
          const float value = lane == 0 ? q.x : lane == 1 ? q.y : lane == 2 ? q.z : q.w;
          rotation[i][lane] =
              static_cast<std::int16_t>(std::floor(std::clamp(value, -1.0F, 1.0F) * 32'767 + 0.5F));
        }
      }
      accessors.rotation = add_column(std::move(rotation), Component::i16, Lanes::vec4);
    } else if (turned) {
      Array<glm::vec4> rotation(job_, copies.size());
      for (std::size_t i = 0; i < copies.size(); ++i) {
        const glm::quat& q = copies[i].rotation;
        rotation[i] = glm::vec4(q.x, q.y, q.z, q.w) + 0.0F;
      }
      accessors.rotation = add_column(std::move(rotation), Component::f32, Lanes::vec4);
    }
    if (scaled) accessors.scale = add_column(std::move(scale), Component::f32, Lanes::vec3);
    return accessors;
  }

  int mesh_of(const Node& node) const {
    int mesh = node.mesh;
    if (options_.lod > 0 && !node.lods.empty()) {
      mesh = node.lods[std::min(options_.lod, node.lods.size()) - 1];
    }
    return mesh >= 0 && !columns_.meshes[static_cast<std::size_t>(mesh)].empty() ? mesh : -1;
  }

  Model& model_;
  Columns& columns_;
  const DocumentOptions& options_;
  Job& job_;
  Accessors accessors_;
  Numbering meshes_, images_, skins_;
  MaterialUse materials_;
  std::vector<int> roots_, shape_meshes_;
  std::vector<std::string> extensions_used_, extensions_required_;
  // Lists without brackets.
  std::string mesh_list_, animation_list_, image_list_, view_list_, material_list_, skin_list_;
  TextureList textures_;
  std::vector<int> image_items_;
  std::deque<Column> copy_columns_;  ///< accessors point at them
  Compressed compressed_;
};

}  // namespace

const std::shared_ptr<const Image>& image_numbered(const Model& model, std::size_t number) {
  const std::size_t count = model.textures.size();
  return number < count ? model.textures[number] : model.textures[number - count]->webp;
}

std::string image_name(const Model& model, const std::vector<std::string>& names, std::size_t number) {
  return names.empty() ? image_numbered(model, number)->name : names[number];
}

Document describe(Model& model, Columns& columns, const DocumentOptions& options, Job& job) {
  Describer describer(model, columns, options, job);
  NodeMeshes shown = describer.show_nodes();
  describer.add_meshes();
  describer.add_copies(shown);
  describer.add_animations();
  describer.add_materials();
  describer.add_skins();
  describer.add_images();
  describer.arrange();

  Document document;
  std::string& head = document.head;
  head += '{';
  JsonWriter json(head);
  describer.append_members(json, head);
  if (!model.nodes.empty()) {
    json.key("nodes");
    append_nodes(head, model, shown, job);
  }
  document.images = describer.images();
  document.bin = describer.take_bin();
  document.tail = "}";
  if (document.bin.size() > 0) {
    json.key("buffers");
    head += "[{";
    json.member("byteLength", document.bin.size());
    document.tail = "}]}";
  }
  if (describer.fallback() > 0) {
    document.tail = "},{\"byteLength\":" + std::to_string(describer.fallback()) +
                    ",\"extensions\":{\"EXT_meshopt_compression\":{\"fallback\":true}}}]}";
  }
  return document;
}

}  // namespace seedmesh::gltf
