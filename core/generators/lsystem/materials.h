#pragma once
/// Maps colour indices to materials: those of the request, or a built-in palette.
#include <vector>

#include "core/base/job.h"
#include "core/model/model.h"
#include "generated/params/lsystem.h"

namespace seedmesh::lsystem {

/// The visible sides of faces; `none` is for lines, which have no texture coordinates.
enum class Sides { one, both, none };

/// Checks what the schema cannot express: a material needs a colour, a texture or a colour image.
void check_materials(const LsystemParams& params, std::vector<Issue>& issues);

/// Whether a material has a generated texture, or an image of colour or normals. These textures have to
/// repeat a whole number of times around a limb.
bool wraps_images(const LsystemParams& params);

/// Returns the colour index in the built-in palette of an organ of this shape that has no colour of its own: that of leaves,
/// petals or berries, or -1, the turtle's.
std::int16_t palette_color_of(LsystemShape shape);

/// Creates materials on first use: one for each colour index, number of visible sides and kind of texture.
class MaterialSet {
 public:
  /// Reads the images of the request into `model`. Throws Stop (Code::invalid) for a damaged image.
  MaterialSet(Model& model, const LsystemParams& params, const Job& job);

  /// Returns the index of the material for a colour, in the list of the request or else in the palette. Colours past
  /// the end of the list use the last material.
  std::int16_t index_of(std::int16_t color) const { return std::min(color, last_); }

  /// Returns the index of a material in Model::materials. `recipe` may be empty; otherwise it is the texture
  /// for materials without a texture of their own. Materials of lines have no textures, with a warning if the request
  /// has any.
  int material(std::int16_t color, Sides sides, const TextureRecipe& recipe = {});

 private:
  struct Made {
    std::size_t index;
    Sides sides;
    std::string kind;
    int material;
  };
  struct Textures {
    int color = -1, normal = -1, surface = -1;
  };

  Material make(std::size_t index) const;
  void set_textures(Material& material, std::size_t index) const;
  void drop_textures(Material& material, std::size_t index);
  int load(const std::string& uri, const std::string& name, const std::string& pointer, const Job& job);

  Model& model_;
  const LsystemParams& params_;
  std::int16_t last_;
  std::vector<Textures> textures_;  ///< for each material of the request
  std::vector<Made> made_;
};

}  // namespace seedmesh::lsystem
