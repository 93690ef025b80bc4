#include "core/gltf/document.h"

#include <tiny_gltf.h>
#include <algorithm>
#include <cassert>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "core/gltf/json_text.h"
#include "core/gltf/materials.h"
#include "core/gltf/nodes.h"

namespace seedmesh::gltf {
namespace {

constexpr int array_buffer = 34962, element_array_buffer = 34963;

/// Numbers of a list that leaves out what nobody uses, given in order of first use.
class Numbering {
 public:
  explicit Numbering(std::size_t size) : numbers_(size, -1) {}
  int use(int index) {
    if (index < 0) return -1;
    int& number = numbers_[static_cast<std::size_t>(index)];
    if (number < 0) {
      number = static_cast<int>(used_.size());
      used_.push_back(static_cast<std::size_t>(index));
    }
    return number;
  }
  const std::vector<int>& numbers() const { return numbers_; }
  const std::vector<std::size_t>& used() const { return used_; }

 private:
  std::vector<int> numbers_;
  std::vector<std::size_t> used_;
};

int type_of(Lanes lanes) {
  switch (lanes) {
    case Lanes::scalar:
      return TINYGLTF_TYPE_SCALAR;
    case Lanes::vec2:
      return TINYGLTF_TYPE_VEC2;
    case Lanes::vec3:
      return TINYGLTF_TYPE_VEC3;
    case Lanes::vec4:
      return TINYGLTF_TYPE_VEC4;
    case Lanes::mat4:
      return TINYGLTF_TYPE_MAT4;
  }
  return TINYGLTF_TYPE_SCALAR;
}

int mode_of(Topology topology) {
  switch (topology) {
    case Topology::triangles:
      return TINYGLTF_MODE_TRIANGLES;
    case Topology::lines:
      return TINYGLTF_MODE_LINE;
    case Topology::points:
      return TINYGLTF_MODE_POINTS;
  }
  return TINYGLTF_MODE_TRIANGLES;
}

const char* name_of(Path path) {
  switch (path) {
    case Path::translation:
      return "translation";
    case Path::rotation:
      return "rotation";
    case Path::scale:
      return "scale";
    case Path::weights:
      return "weights";
  }
  return "translation";
}

/// Fills a tinygltf model list by list. Accessors and images name their place in the buffer by the array's
/// number until all arrays are known and `finish` has arranged them.
class Describer {
 public:
  Describer(const Model& model, const Columns& columns, const DocumentOptions& options)
      : model_(model),
        columns_(columns),
        options_(options),
        meshes_(model.meshes.size()),
        materials_(model.materials.size()),
        images_(model.textures.size()),
        skins_(model.skins.size()) {
    out_.asset.version = "2.0";
    out_.asset.generator = options.generator;
  }

  /// What each node shows at this level; numbers meshes and skins.
  Shown show_nodes() {
    Shown shown;
    tinygltf::Scene scene;
    scene.name = model_.name.empty() ? "scene" : model_.name;
    for (std::size_t i = 0; i < model_.nodes.size(); ++i) {
      const Node& node = model_.nodes[i];
      const int mesh = mesh_of(node);
      shown.meshes.push_back(meshes_.use(mesh));
      if (mesh >= 0) skins_.use(node.skin);
      if (node.parent < 0) scene.nodes.push_back(static_cast<int>(i));
    }
    shown.skins = skins_.numbers();
    out_.defaultScene = 0;
    out_.scenes.push_back(std::move(scene));
    return shown;
  }

  void add_meshes() {
    for (const std::size_t used : meshes_.used()) {
      tinygltf::Mesh& mesh = out_.meshes.emplace_back();
      mesh.name = model_.meshes[used].name;
      for (const Part& part : columns_.meshes[used]) mesh.primitives.push_back(primitive_of(part));
    }
    if (!variants_used_) return;
    tinygltf::Value::Array variants;
    for (const std::string& name : model_.variants) {
      variants.emplace_back(tinygltf::Value::Object{{"name", tinygltf::Value(name)}});
    }
    out_.extensions["KHR_materials_variants"] =
        tinygltf::Value(tinygltf::Value::Object{{"variants", tinygltf::Value(std::move(variants))}});
    out_.extensionsUsed.push_back("KHR_materials_variants");
  }

  void add_materials() {
    const TextureNumber texture_number = [this](const TextureUse& use) { return texture_of(use); };
    for (const std::size_t used : materials_.used()) {
      const Material& material = model_.materials[used];
      out_.materials.push_back(material_of(material, texture_number));
      unlit_used_ = unlit_used_ || material.unlit;
    }
    if (unlit_used_) out_.extensionsUsed.push_back("KHR_materials_unlit");
  }

  void add_skins() {
    for (const std::size_t used : skins_.used()) {
      const Skin& skin = model_.skins[used];
      tinygltf::Skin& described = out_.skins.emplace_back();
      described.name = skin.name;
      described.joints = skin.joints;
      described.skeleton = skin.skeleton;
      const Column& matrices = columns_.inverse_binds[used];
      if (matrices.count > 0) described.inverseBindMatrices = add_accessor(Pool::binds, matrices);
    }
  }

  void add_animations() {
    for (std::size_t i = 0; i < model_.animations.size(); ++i) {
      const Animation& animation = model_.animations[i];
      if (animation.channels.empty()) continue;
      tinygltf::Animation& described = out_.animations.emplace_back();
      described.name = animation.name;
      std::map<int, int> inputs;  // key times that channels share are one accessor
      for (std::size_t c = 0; c < animation.channels.size(); ++c) {
        const Channel& channel = animation.channels[c];
        const auto [input, is_new] = inputs.try_emplace(channel.times, -1);
        const Tracks& tracks = columns_.animations[i];
        if (is_new) {
          input->second = add_accessor(Pool::keys, tracks.times[static_cast<std::size_t>(channel.times)]);
        }
        tinygltf::AnimationSampler& sampler = described.samplers.emplace_back();
        sampler.input = input->second;
        sampler.output = add_accessor(Pool::keys, tracks.values[c]);
        sampler.interpolation = channel.interpolation == Interpolation::step ? "STEP" : "LINEAR";
        tinygltf::AnimationChannel& target = described.channels.emplace_back();
        target.sampler = static_cast<int>(c);
        target.target_node = channel.node;
        target.target_path = name_of(channel.path);
      }
    }
  }

  /// The images as JSON text, empty where there are none. Adds their bytes to the buffer unless they have
  /// uris.
  std::string add_images() {
    std::string text;
    for (const std::size_t used : images_.used()) {
      const std::shared_ptr<const Image>& image = model_.textures[used];
      text += text.empty() ? '[' : ',';
      text += "{\"mimeType\":";
      append_string(text, image->mime);
      if (!image->name.empty()) {
        text += ",\"name\":";
        append_string(text, image->name);
      }
      if (options_.image_uris.empty()) {
        // Images come last in the buffer, one view each, so the view's number is known only after arrange().
        image_items_.push_back(bin_.add(Pool::image, {image, std::as_bytes(std::span(image->bytes))}));
        text += ",\"bufferView\":" + std::string(view_mark);
      } else {
        text += ",\"uri\":";
        append_string(text, options_.image_uris[used]);
      }
      text += '}';
    }
    if (!text.empty()) text += ']';
    return text;
  }

  /// Arranges the buffer and completes accessors, views and the text of the images.
  Bin finish(std::string& images) {
    bin_.arrange();
    for (tinygltf::Accessor& accessor : out_.accessors) {
      const Bin::Place place = bin_.place(accessor.bufferView);
      accessor.bufferView = place.view;
      accessor.byteOffset = static_cast<std::size_t>(place.offset);
    }
    for (const Bin::View& view : bin_.views()) {
      tinygltf::BufferView& described = out_.bufferViews.emplace_back();
      described.buffer = 0;
      described.byteOffset = static_cast<std::size_t>(view.offset);
      described.byteLength = static_cast<std::size_t>(view.length);
      described.byteStride = view.stride;
      described.target = target_of(view.pool);
    }
    for (const int item : image_items_) {
      images.replace(images.find(view_mark), view_mark.size(), std::to_string(bin_.place(item).view));
    }
    return std::move(bin_);
  }

  const std::vector<std::size_t>& images() const { return images_.used(); }

  /// The JSON that tinygltf makes of all this: one object on one line.
  std::string text() const {
    std::ostringstream stream;
    stream.imbue(std::locale::classic());
    tinygltf::TinyGLTF().WriteGltfSceneToStream(&out_, stream, false, false);
    std::string text = std::move(stream).str();
    while (!text.empty() && text.back() != '}') text.pop_back();
    return text;
  }

 private:
  /// Stands for a number that is not known yet. A control character is always escaped in JSON, so no name
  /// holds it.
  static constexpr std::string_view view_mark = "\x01";

  int mesh_of(const Node& node) const {
    int mesh = node.mesh;
    if (options_.lod > 0 && !node.lods.empty()) {
      mesh = node.lods[std::min(options_.lod, node.lods.size()) - 1];
    }
    return mesh >= 0 && !columns_.meshes[static_cast<std::size_t>(mesh)].empty() ? mesh : -1;
  }

  static int target_of(Pool pool) {
    switch (pool) {
      case Pool::vertex4:
      case Pool::vertex8:
      case Pool::vertex12:
      case Pool::vertex16:
        return array_buffer;
      case Pool::index2:
      case Pool::index4:
        return element_array_buffer;
      case Pool::keys:
      case Pool::binds:
      case Pool::image:
        return 0;
    }
    return 0;
  }

  int add_accessor(Pool pool, const Column& column) {
    tinygltf::Accessor& accessor = out_.accessors.emplace_back();
    accessor.bufferView = bin_.add(pool, column.slice);
    accessor.componentType = static_cast<int>(column.component);
    accessor.type = type_of(column.lanes);
    accessor.count = column.count;
    accessor.normalized = column.normalized;
    for (const float each : column.min) accessor.minValues.push_back(shortest(each));
    for (const float each : column.max) accessor.maxValues.push_back(shortest(each));
    return static_cast<int>(out_.accessors.size()) - 1;
  }

  tinygltf::Primitive primitive_of(const Part& part) {
    tinygltf::Primitive primitive;
    primitive.mode = mode_of(part.topology);
    primitive.material = materials_.use(part.material);
    std::vector<int> accessors;
    for (const Column& column : part.columns) accessors.push_back(add_accessor(vertex_pool(column), column));
    for (const Attribute& each : part.attributes) {
      primitive.attributes[std::string(each.semantic)] = accessors[each.column];
    }
    if (part.index) primitive.indices = add_accessor(index_pool(*part.index), *part.index);
    add_variants(primitive, part);
    return primitive;
  }

  /// One mapping for each material, with all variants that show it.
  void add_variants(tinygltf::Primitive& primitive, const Part& part) {
    std::map<int, tinygltf::Value::Array> mappings;
    for (std::size_t variant = 0; variant < part.variant_materials.size(); ++variant) {
      const int material = materials_.use(part.variant_materials[variant]);
      if (material >= 0) mappings[material].emplace_back(static_cast<int>(variant));
    }
    if (mappings.empty()) return;
    tinygltf::Value::Array list;
    for (auto& [material, variants] : mappings) {
      list.emplace_back(tinygltf::Value::Object{{"material", tinygltf::Value(material)},
                                                {"variants", tinygltf::Value(std::move(variants))}});
    }
    primitive.extensions["KHR_materials_variants"] =
        tinygltf::Value(tinygltf::Value::Object{{"mappings", tinygltf::Value(std::move(list))}});
    variants_used_ = true;
  }

  /// A texture is an image with a way of wrapping; both kinds of wrapping have one sampler each.
  int texture_of(const TextureUse& use) {
    if (use.texture < 0) return -1;
    const auto [texture, is_new] = textures_.try_emplace({use.texture, use.repeat}, 0);
    if (!is_new) return texture->second;
    const auto [sampler, is_new_sampler] =
        samplers_.try_emplace(use.repeat, static_cast<int>(out_.samplers.size()));
    if (is_new_sampler) {
      tinygltf::Sampler& described = out_.samplers.emplace_back();
      described.magFilter = TINYGLTF_TEXTURE_FILTER_LINEAR;
      described.minFilter = TINYGLTF_TEXTURE_FILTER_LINEAR_MIPMAP_LINEAR;
      described.wrapS = use.repeat ? TINYGLTF_TEXTURE_WRAP_REPEAT : TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
      described.wrapT = described.wrapS;
    }
    texture->second = static_cast<int>(out_.textures.size());
    tinygltf::Texture& described = out_.textures.emplace_back();
    described.source = images_.use(use.texture);
    described.sampler = sampler->second;
    return texture->second;
  }

  const Model& model_;
  const Columns& columns_;
  const DocumentOptions& options_;
  tinygltf::Model out_;
  Bin bin_;
  Numbering meshes_, materials_, images_, skins_;
  std::map<std::pair<int, bool>, int> textures_;
  std::map<bool, int> samplers_;
  std::vector<int> image_items_;
  bool variants_used_ = false;
  bool unlit_used_ = false;
};

/// asset.extras as a JSON object, empty if there is nothing to say.
std::string asset_extras(const Model& model) {
  std::string text;
  for (const Extra& extra : model.extras) {
    text += text.empty() ? '{' : ',';
    append_string(text, extra.name);
    text += ':' + extra.json;
  }
  if (!model.warnings.empty()) {
    nlohmann::ordered_json warnings = nlohmann::ordered_json::array();
    for (const Warning& warning : model.warnings) {
      nlohmann::ordered_json& entry = warnings.emplace_back();
      entry["pointer"] = warning.pointer;
      entry["message"] = warning.message;
      if (warning.line > 0) entry["line"] = warning.line;
      if (warning.column > 0) entry["column"] = warning.column;
    }
    text += text.empty() ? '{' : ',';
    text += "\"warnings\":" + warnings.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
  if (!text.empty()) text += '}';
  return text;
}

/// Puts `extras` into the asset. A quote inside a name is always escaped, so the first `"asset":{` is the key
/// itself.
void add_to_asset(std::string& text, const std::string& extras) {
  if (extras.empty()) return;
  constexpr std::string_view key = "\"asset\":{";
  const std::size_t place = text.find(key);
  assert(place != std::string::npos);
  text.insert(place + key.size(), "\"extras\":" + extras + ',');
}

}  // namespace

Document describe(const Model& model, const Columns& columns, const DocumentOptions& options, Job& job) {
  Document document;
  Describer describer(model, columns, options);
  const Shown shown = describer.show_nodes();
  describer.add_meshes();
  describer.add_materials();
  describer.add_skins();
  describer.add_animations();
  std::string images = describer.add_images();
  document.bin = describer.finish(images);
  document.images = describer.images();
  job.check();

  std::string& head = document.head;
  head = describer.text();
  add_to_asset(head, asset_extras(model));
  head.pop_back();  // the brace that closes the document goes to the tail
  document.tail = "}";
  if (!images.empty()) head += ",\"images\":" + images;
  job.spend(Resource::output_bytes, head.size());
  if (!model.nodes.empty()) {
    head += ",\"nodes\":";
    append_nodes(head, model, shown, job);
  }
  if (document.bin.size() > 0) {
    head += ",\"buffers\":[{\"byteLength\":" + std::to_string(document.bin.size());
    document.tail = "}]}";
  }
  return document;
}

}  // namespace seedmesh::gltf
