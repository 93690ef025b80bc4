/// The hash is XXH3 of 64 bits, whose values are fixed since xxHash 0.8.
#include "core/gltf/content_names.h"

#include <xxhash.h>

#include <array>
#include <map>
#include <memory>
#include <span>

#include "core/base/parallel.h"
#include "core/gltf/columns.h"

namespace seedmesh::gltf {
namespace {

constexpr std::size_t hash_digits = 8;

std::string spelled(std::uint64_t hash) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text(1, static_cast<char>('a' + static_cast<char>(hash % 6)));
  hash /= 6;
  for (; text.size() < hash_digits; hash >>= 4U) text += digits[hash & 15U];
  return text;
}

/// Hashes values one after the other. Arrays are preceded by their length.
class Hasher {
 public:
  Hasher() { XXH3_64bits_reset(state_.get()); }

  template <class T>
  void value(const T& given) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    XXH3_64bits_update(state_.get(), &given, sizeof(given));
  }
  void bytes(std::span<const std::byte> given) {
    value(given.size());
    XXH3_64bits_update(state_.get(), given.data(), given.size());
  }
  void text(std::string_view given) { bytes(std::as_bytes(std::span(given))); }
  template <class T>
  void array(const Array<T>& given) {
    bytes(std::as_bytes(std::span(given.data(), given.size())));
  }
  std::uint64_t digest() const { return XXH3_64bits_digest(state_.get()); }

 private:
  struct Free {
    void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
  };
  std::unique_ptr<XXH3_state_t, Free> state_{XXH3_createState()};
};

std::uint64_t hash_of(const Image& image) {
  Hasher hash;
  hash.text(image.mime);
  hash.text(image.uri);
  hash.bytes(std::as_bytes(std::span(image.bytes)));
  return hash.digest();
}

std::uint64_t hash_of(Material& material, const std::vector<std::uint64_t>& images) {
  Hasher hash;
  for (int i = 0; i < 4; ++i) hash.value(material.base_color[i]);
  for (int i = 0; i < 3; ++i) hash.value(material.emissive[i]);
  for (const float value : {material.metallic, material.roughness, material.alpha_cutoff}) hash.value(value);
  hash.value(material.alpha_mode);
  hash.value(material.double_sided);
  hash.value(material.unlit);
  if (material.specular < 1) hash.value(material.specular);
  if (material.specular_color != glm::vec3(1)) {
    for (int i = 0; i < 3; ++i) hash.value(material.specular_color[i]);
  }
  if (material.transmission > 0) {
    hash.value(material.transmission);
    for (int i = 0; i < 3; ++i) hash.value(material.transmission_color[i]);
  }
  for (const TextureUse* use : material.textures()) {
    hash.value(use->texture < 0 ? 0 : images[static_cast<std::size_t>(use->texture)]);
    hash.value(use->uv_set);
    hash.value(use->repeat);
  }
  return hash.digest();
}

void add(Hasher& hash, const Column& column) {
  hash.value(column.component);
  hash.value(column.lanes);
  hash.value(column.count);
  hash.value(column.normalized);
  hash.value(column.filter);
  hash.bytes(column.slice.bytes);
}

void add_packed(Hasher& hash, const Part& part) {
  for (const Attribute& attribute : part.attributes) {
    hash.text(attribute.semantic);
    hash.value(attribute.column);
  }
  for (const Column& column : part.columns) add(hash, column);
  if (part.index) add(hash, *part.index);
}

void add(Hasher& hash, const Mesh& mesh) {
  hash.value(mesh.topology);
  if (mesh.packed) return add_packed(hash, static_cast<const PackedPart&>(*mesh.packed).part);
  hash.array(mesh.position);
  hash.array(mesh.normal);
  for (const auto& uv : mesh.uv) hash.array(uv);
  hash.array(mesh.color);
  hash.array(mesh.tangent);
  hash.array(mesh.joints);
  hash.array(mesh.weights);
  hash.array(mesh.bone);
  if (!mesh.next_position.empty()) hash.array(mesh.next_position);
  hash.array(mesh.index.wide);
  hash.array(mesh.index.small);
}

std::uint64_t hash_of(const MeshGroup& group, const std::vector<std::uint64_t>& materials,
                      std::string_view form) {
  Hasher hash;
  hash.text(form);
  const auto add_material = [&](int material) {
    hash.value(material < 0 ? 0 : materials[static_cast<std::size_t>(material)]);
  };
  for (const Primitive& primitive : group.primitives) {
    add(hash, primitive.mesh);
    add_material(primitive.material);
    for (const int material : primitive.variant_materials) add_material(material);
  }
  return hash.digest();
}

/// "bark" -> "oak_bark"; "oak_bark" stays.
std::string with_stem(std::string_view stem, std::string_view name) {
  const bool has_it = name.starts_with(stem) && (name.size() == stem.size() || name[stem.size()] == '_');
  return has_it ? std::string(name) : std::string(stem) + '_' + std::string(name);
}

void name_roots(Model& model, const std::string& root) {
  for (Node& node : model.nodes) {
    if (node.parent >= 0 || node.collision != CollisionShape::none) continue;
    const bool continues = node.name.starts_with(model.name);
    node.name = continues ? root + node.name.substr(model.name.size()) : root + '_' + node.name;
  }
  model.name = root;
}

std::vector<std::uint64_t> image_hashes(const Model& model) {
  std::vector<std::uint64_t> hashes;
  for (const auto& image : model.textures) hashes.push_back(hash_of(*image));
  return hashes;
}

/// Lets all materials use the first of equal images. The others stay in the list without a use.
void share_images(Model& model, const std::vector<std::uint64_t>& hashes) {
  std::map<std::uint64_t, int> first;
  std::vector<int> shared;
  for (std::size_t i = 0; i < hashes.size(); ++i) {
    const auto [known, is_new] = first.try_emplace(hashes[i], static_cast<int>(i));
    const Image& mine = *model.textures[i];
    const Image& other = *model.textures[static_cast<std::size_t>(known->second)];
    const bool is_equal =
        is_new || (mine.mime == other.mime && mine.uri == other.uri && mine.bytes == other.bytes);
    shared.push_back(is_equal ? known->second : static_cast<int>(i));
  }
  for (Material& material : model.materials) {
    for (TextureUse* use : material.textures()) {
      if (use->texture >= 0) use->texture = shared[static_cast<std::size_t>(use->texture)];
    }
  }
}

}  // namespace

std::string short_hash(std::string_view bytes) { return spelled(XXH3_64bits(bytes.data(), bytes.size())); }

std::string long_hash(std::string_view bytes) {
  constexpr std::string_view digits = "0123456789abcdef";
  const std::uint64_t hash = XXH3_64bits(bytes.data(), bytes.size());
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += digits[hash >> static_cast<unsigned>(shift) & 15U];
  return text;
}

void name_by_content(Model& model, const ContentNames& names, const Job& job) {
  const std::vector<std::uint64_t> images = image_hashes(model);
  share_images(model, images);
  std::vector<std::uint64_t> materials;
  for (Material& material : model.materials) {
    materials.push_back(hash_of(material, images));
    material.name = with_stem(names.stem, material.name) + '_' + spelled(materials.back());
  }
  parallel_for(job, model.meshes.size(), 1, [&](std::size_t i, std::size_t, std::size_t) {
    job.check();
    MeshGroup& group = model.meshes[i];
    const std::uint64_t hash = hash_of(group, materials, names.form);
    group.name = with_stem(names.stem, group.name) + '_' + spelled(hash);
  });
  name_roots(model, names.root);
}

std::vector<std::string> image_names(const Model& model, std::string_view stem) {
  std::vector<std::string> names;
  const auto add = [&](const Image& image) {
    const std::string own = image.name.empty() ? "texture" : image.name;
    names.push_back(with_stem(stem, own) + '_' + spelled(hash_of(image)));
  };
  for (const auto& image : model.textures) add(*image);
  for (const auto& image : model.textures) {
    if (image->webp) {
      add(*image->webp);
    } else {
      names.emplace_back();
    }
  }
  return names;
}

}  // namespace seedmesh::gltf
