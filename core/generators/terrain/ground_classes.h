#pragma once
/// Grounds by class (grass, rock, scree, sand, snow, soil), each with textures that repeat each two metres. They
/// multiply the vertex colours, which contain the colours of the land at low resolution.
///
/// Texture coordinates are in set 1. Gentle ground is mapped from above, ground steeper than 50 degrees from the
/// side that it faces (box mapping), so that no texture is stretched by more than 1.8.
#include <optional>
#include <vector>

#include "core/generators/terrain/colors.h"
#include "core/model/model.h"

namespace seedmesh::terrain {

class GroundClasses {
 public:
  /// Finds the classes that cover at least a hundredth of the field, and adds their materials to the model: `plain`
  /// with the textures of the class.
  /// `field` and `colors` are borrowed; `world` is the window of the field in its world, whose tiles have equal
  /// colours at common borders. 40 ns for each of at most 65,536 samples.
  GroundClasses(PaletteName palette, const Field& field, const Window& world, const Sites& sites,
                const GroundColors& colors, const Material& plain, Model& model);

  /// Returns the mesh in one primitive for each class, with texture coordinates in set 1 and tangents. Vertices between
  /// classes or sides are duplicated. Vertex colours are brightened by what the grey textures darken, and vary more
  /// than those of ground without details. About 100 ns a vertex.
  std::vector<Primitive> divide(const Mesh& mesh, const Sites& sites, const Job& job) const;

 private:
  enum Kind { grass, soil, rock, scree, sand, snow, kind_count };
  struct Shares {
    float of[kind_count] = {};
  };
  struct Used {
    Kind kind;
    int material;
    float lighter;  ///< factor of vertex colours that makes up for the grey of the texture
  };
  Shares shares(const Site& site) const;
  std::size_t use_of(const Shares& shares) const;

  PaletteName palette_;
  const Field& field_;
  Window world_;
  const GroundColors& colors_;
  std::vector<Used> used_;
};

}  // namespace seedmesh::terrain
