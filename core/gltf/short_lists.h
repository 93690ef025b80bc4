#pragma once
/// The lists of a document that stay short, written as text: extensions, variants, skins, samplers and
/// textures. Members of objects are in the order of their names.
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/gltf/lists.h"
#include "core/model/model.h"

namespace seedmesh::gltf {

/// Opens a member that is an array of objects, or goes on with it.
inline void open_entry(std::string& list) { list += list.empty() ? '[' : ','; }

/// Appends `key` and a JSON array that lacks the closing bracket; nothing where it is empty.
void append_list(std::string& out, std::string_view key, const std::string& list);

/// Appends a JSON array.
void append_numbers(std::string& out, std::span<const int> numbers);

/// Appends `key` and a JSON array of strings; nothing where there are none.
void append_names(std::string& out, std::string_view key, std::span<const std::string> names);

/// Appends the object of KHR_materials_variants with the names of all.
void append_variants(std::string& out, std::span<const std::string> variants);

/// Appends one skin object; `matrices`: the number of the accessor of its inverse bind matrices, or -1.
void append_skin(std::string& out, const Skin& skin, int matrices);

/// A texture is an image with a way of wrapping; both kinds of wrapping have one sampler each.
class TextureList {
 public:
  /// The number of the texture for a use, -1 for none; numbers its image.
  int number(const TextureUse& use, Numbering& images);

  // JSON arrays without the closing bracket, or empty.
  const std::string& samplers() const { return sampler_list_; }
  const std::string& textures() const { return texture_list_; }

 private:
  int sampler(bool repeat);

  std::map<std::pair<int, bool>, int> textures_;
  std::map<bool, int> samplers_;
  std::string sampler_list_, texture_list_;
};

}  // namespace seedmesh::gltf
