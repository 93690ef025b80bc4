#include "core/gltf/short_lists.h"

#include "core/gltf/json_text.h"

namespace seedmesh::gltf {
namespace {

// As OpenGL numbers them.
constexpr int linear = 9729, linear_mipmap_linear = 9987, repeated = 10497, clamped_to_edge = 33071;

}  // namespace

void append_list(std::string& out, std::string_view key, const std::string& list) {
  if (list.empty()) return;
  out += key;
  out += list;
  out += ']';
}

void append_numbers(std::string& out, std::span<const int> numbers) {
  out += '[';
  for (const int& number : numbers) {
    if (&number != numbers.data()) out += ',';
    append_integer(out, number);
  }
  out += ']';
}

void append_names(std::string& out, std::string_view key, std::span<const std::string> names) {
  std::string list;
  for (const std::string& name : names) {
    open_entry(list);
    append_string(list, name);
  }
  append_list(out, key, list);
}

void append_variants(std::string& out, std::span<const std::string> variants) {
  std::string list;
  for (const std::string& name : variants) {
    open_entry(list);
    list += "{\"name\":";
    append_string(list, name);
    list += '}';
  }
  out += "{\"variants\":";
  out += list.empty() ? "[" : list;
  out += "]}";
}

void append_skin(std::string& out, const Skin& skin, int matrices) {
  out += '{';
  if (matrices >= 0) {
    out += "\"inverseBindMatrices\":";
    append_integer(out, matrices);
    out += ',';
  }
  out += "\"joints\":";
  append_numbers(out, skin.joints);
  if (!skin.name.empty()) {
    out += ",\"name\":";
    append_string(out, skin.name);
  }
  if (skin.skeleton >= 0) {
    out += ",\"skeleton\":";
    append_integer(out, skin.skeleton);
  }
  out += '}';
}

int TextureList::sampler(bool repeat) {
  const auto [place, is_new] = samplers_.try_emplace(repeat, static_cast<int>(samplers_.size()));
  if (!is_new) return place->second;
  const std::string wrap = std::to_string(repeat ? repeated : clamped_to_edge);
  open_entry(sampler_list_);
  sampler_list_ += "{\"magFilter\":" + std::to_string(linear) +
                   ",\"minFilter\":" + std::to_string(linear_mipmap_linear) + ",\"wrapS\":" + wrap +
                   ",\"wrapT\":" + wrap + '}';
  return place->second;
}

int TextureList::number(const TextureUse& use, Numbering& images) {
  if (use.texture < 0) return -1;
  const auto [place, is_new] =
      textures_.try_emplace({use.texture, use.repeat}, static_cast<int>(textures_.size()));
  if (!is_new) return place->second;
  open_entry(texture_list_);
  texture_list_ += "{\"sampler\":";
  append_integer(texture_list_, sampler(use.repeat));
  texture_list_ += ",\"source\":";
  append_integer(texture_list_, images.use(use.texture));
  texture_list_ += '}';
  return place->second;
}

}  // namespace seedmesh::gltf
