#pragma once
/// The lists of a document, written as text: accessors, meshes, animations, views, skins, samplers, textures.
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/base/job.h"
#include "core/gltf/bin.h"
#include "core/gltf/columns.h"
#include "core/model/model.h"

namespace seedmesh::gltf {

/// New numbers for the used elements of a list, in the order of their first use.
class Numbering {
 public:
  explicit Numbering(std::size_t size) : numbers_(size, -1) {}
  int use(int index);                                           ///< -1 stays -1
  const std::vector<int>& numbers() const { return numbers_; }  ///< for each index its new number, or -1
  const std::vector<std::size_t>& used() const {
    return used_;
  }  ///< the used indices in the order of their numbers

 private:
  std::vector<int> numbers_;
  std::vector<std::size_t> used_;
};

/// The accessors of a document, and with them the contents of its buffer.
class Accessors {
 public:
  explicit Accessors(Packing packing) : packing_(packing) {}
  Packing packing() const { return packing_; }

  /// Stores the column in the buffer and returns the number of its accessor. Keeps a pointer to `column`.
  int add(Pool pool, const Column& column);

  Bin& bin() { return bin_; }
  bool empty() const { return rows_.empty(); }

  /// Appends the JSON array. Call it after the buffer has been arranged.
  void append(std::string& out, Job& job) const;

 private:
  struct Row {
    int item = -1;
    const Column* column = nullptr;
  };
  Packing packing_;
  std::vector<Row> rows_;
  Bin bin_;
};

/// The materials that primitives use. `any_variants` is true if a primitive has a material for each variant.
struct MaterialUse {
  Numbering numbering;
  bool any_variants = false;
};

/// Appends one mesh object, makes an accessor of each column and numbers the materials.
void append_mesh(std::string& out, const std::string& name, const std::vector<Part>& parts,
                 Accessors& accessors, MaterialUse& materials);

/// Appends one animation object; samplers with the same key times share the accessor.
void append_animation(std::string& out, const Animation& animation, const Tracks& tracks,
                      Accessors& accessors);

/// Appends one skin object; `matrices`: the number of the accessor of its inverse bind matrices, or -1.
void append_skin(std::string& out, const Skin& skin, int matrices);

/// A texture is an image with a wrap mode. Each of the two wrap modes has one sampler.
class TextureList {
 public:
  /// Returns the number of the texture for a use, -1 for none. Adds the numbers of its image and of its WebP
  /// form (EXT_texture_webp) to `images`; image_numbered() defines these numbers.
  int number(const TextureUse& use, const Model& model, Numbering& images);
  bool has_webp() const { return has_webp_; }      ///< a texture is WebP, or has such a form
  bool needs_webp() const { return needs_webp_; }  ///< a texture is only WebP

  // Lists without brackets.
  const std::string& samplers() const { return sampler_list_; }
  const std::string& textures() const { return texture_list_; }

 private:
  int sampler(bool repeat);

  std::map<std::pair<int, bool>, int> textures_;
  std::map<bool, int> samplers_;
  std::string sampler_list_, texture_list_;
  bool has_webp_ = false, needs_webp_ = false;
};

/// Appends the views of a buffer that has been arranged: a list without brackets. `has_strides`: every view
/// of vertices states its stride, which is required where elements have padding.
void append_views(std::string& out, const Bin& bin, bool has_strides = false);

}  // namespace seedmesh::gltf
