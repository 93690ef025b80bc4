#pragma once
/// Grounds by class (grass, rock, scree, sand, snow, soil, litter), each with textures that repeat each two metres. They
/// multiply the vertex colours, which contain the colours of the land at low resolution.
///
/// Texture coordinates are in set 1. Gentle ground is mapped from above. Ground steeper than 50 degrees is
/// mapped from the side that it faces (box mapping). No texture is therefore stretched by more than 1.8.
#include <vector>

#include "core/generators/terrain/ground_shares.h"
#include "core/generators/terrain/refined_mesh.h"
#include "core/model/model.h"

namespace seedmesh::terrain {

class GroundClasses {
 public:
  /// Finds the classes that cover at least a hundredth of the field, and adds their materials to the model: `plain`
  /// with the textures of the class.
  /// `field` and `colors` are borrowed; `world` is the window of the field in its world, whose tiles have equal
  /// colours at common borders. 40 ns for each of at most 65,536 samples.
  GroundClasses(const Field& field, const Window& world, const Sites& sites, const GroundColors& colors,
                const Material& plain, Model& model);

  /// Returns the mesh in one primitive for each class, with texture coordinates in set 1 and tangents. Vertices between
  /// classes or sides are duplicated. Vertex colours are brighter, to make up for the grey of the textures,
  /// and vary more than those of ground without details. About 100 ns a vertex.
  std::vector<Primitive> divide(const Mesh& mesh, const Sites& sites, const Job& job) const;
  /// Returns the same of a refined mesh. Its small forms replace the bumps of the normals.
  std::vector<Primitive> divide(const RefinedMesh& refined, const Sites& sites, const Job& job) const;

 private:
  using Kind = GroundShares::Kind;
  struct Used {
    Kind kind;
    int material;
    float lighter;  ///< factor of vertex colours that makes up for the grey of the texture
  };
  /// The site of a vertex and its position in the world in metres, a random number 0 .. 1 of its own, and the share of
  /// the bumps that it has.
  struct Spot {
    Site site;
    glm::dvec2 at{0};
    float own = 0, bumps = 1;
  };
  GroundShares shares(const Site& site) const { return ground_shares(colors_, site); }
  std::size_t use_of(const GroundShares& shares) const;
  std::vector<std::uint8_t> uses_of(const Mesh& mesh, const Array<GroundShares>& own, const Job& job) const;
  float own_number(std::int32_t x, std::int32_t z) const;
  Spot spot_of_sample(const Sites& sites, const glm::vec3& position) const;
  Spot spot_between(const VertexSite& site, const glm::vec3& position) const;
  template <class SpotOf>
  std::vector<Primitive> divided(const Mesh& mesh, const SpotOf& spot_of, const Job& job) const;

  const Field& field_;
  Window world_;
  const GroundColors& colors_;
  std::vector<Used> used_;
};

}  // namespace seedmesh::terrain
