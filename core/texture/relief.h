#pragma once
/// A texture before it is pictures, and the pictures that are made of it.
#include <glm/vec3.hpp>
#include <memory>
#include <string>

#include "core/model/model.h"
#include "core/texture/field.h"

namespace seedmesh::texture {

/// What a painter fills; all values 0 .. 1.
struct Relief {
  Field height;  ///< 0 lowest
  Field tone;    ///< 0 the dark colour, 0.5 the main one, 1 the light one
  Field accent;  ///< how much of the accent's colour
  Field cover;   ///< what is there; size 1 where everything is
};

/// Colours in sRGB, 0 .. 1.
struct Ramp {
  glm::vec3 dark{0}, main{0.5F}, light{1}, accent{0};
};

/// From relief to pictures.
struct Finish {
  Ramp ramp;
  float depth = 0.02F;     ///< from height 0 to 1, as a share of the picture's width
  float rough_low = 0.9F;  ///< roughness at height 0
  float rough_high = 0.8F;
  float rough_accent = 0.9F;
  float shade = 0.6F;     ///< how much of the light is kept out of the lowest places
  bool is_grey = false;   ///< the colour picture has one channel: that of red
  bool is_small = false;  ///< files are kept small: values in coarser steps, more time for PNG
};

/// Three PNG files: colour (RGB, RGBA with the cover as alpha, or grey), normals (RGB, +y up in the picture,
/// glTF's tangent space), and occlusion, roughness, metallic (RGB, as glTF packs them; metallic is 0).
struct Maps {
  std::shared_ptr<const Image> color, normal, surface;
  std::size_t bytes() const { return color->bytes.size() + normal->bytes.size() + surface->bytes.size(); }
};

/// The pictures are named after `name`.
Maps make_maps(const Relief& relief, const Finish& finish, const std::string& name, const Job& job);

}  // namespace seedmesh::texture
