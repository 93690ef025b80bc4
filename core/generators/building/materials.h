#pragma once
/// Materials by name: those of the request, built-in ones, and plain colours.
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

#include "core/generators/api.h"
#include "core/generators/building/shapes.h"
#include "core/model/model.h"
#include "core/texture/wall.h"

namespace seedmesh {
struct BuildingParams;
}

namespace seedmesh::building {

/// Adds materials to the model when they are first used. The material of a shape is the first of these that exists:
/// its material by name, its colour, the material with the name of its symbol (Wall, Roof, Window, ...), plain
/// plaster. If `textures` of the request selects it, materials with names such as brick get textures made by seed
/// (core/texture/wall.h) in the current colour. Built-in parts have textures in blueprints only, except glass, which also
/// has one with `textures: made`.
class MaterialTable {
 public:
  MaterialTable(Model& model, const BuildingParams& params, const Shapes& shapes,
                const GenerateContext& context);
  /// From now on, uses other shapes of the same request, such as those of another level of detail.
  void use(const Shapes& shapes) {
    shapes_ = &shapes;
    made_.clear();
  }
  int material_of(const Shape& shape);
  /// Returns the material of a role of a built-in part. Stone has the current colour, and so have frames and
  /// doors in the material "painted", unless `materials` of the request have the role.
  int material_of_part(std::string_view role, const Style& style);
  /// Returns the size of one tile in metres if the material has textures, and so needs texture coordinates; else
  /// null.
  const glm::dvec2* tile_of(int material) const;
  /// Returns true if vertices with this material need tangents.
  bool has_normal_map(int material) const;
  /// Returns a warning if no shape had the facade picture of the request.
  std::optional<Warning> unused_facade_image() const;

 private:
  struct MaterialRequest {
    const std::string& name;
    const std::string* color;  ///< the current colour; may be null
    bool is_role;              ///< whether the name is a role of a part
  };
  int make(const MaterialRequest& request);
  int facade_material();
  /// Whether a shape is an upright flat face, which the facade picture may cover.
  bool is_upright(const Shape& shape) const;
  const texture::WallKind* surface_of(const MaterialRequest& request) const;
  int load(const std::string& uri, const std::string& name, const std::string& pointer, const Job& job);

  Model& model_;
  const BuildingParams& params_;
  const Shapes* shapes_;
  bool has_textures_;  ///< the output has textures
  struct Textures {
    int color = -1, normal = -1, surface = -1;
  };
  std::map<std::string, Textures, std::less<>> textures_;
  std::map<std::tuple<std::uint32_t, std::uint32_t, bool>, int> made_;  ///< style, symbol, upright
  int facade_image_ = -1, facade_material_ = -1;
  std::map<std::string, int> by_name_;
  std::map<int, glm::dvec2> tiles_;
  const std::vector<Symbol>* symbols_ = nullptr;

 public:
  /// Sets the symbols, which shapes have as numbers. They have to outlive the table.
  void set_symbols(const std::vector<Symbol>& symbols) { symbols_ = &symbols; }
  const std::string& symbol(const Shape& shape) const { return (*symbols_)[shape.symbol].name; }
};

/// Adds an issue for each image of a material that is not a valid data URI.
void check_materials(const BuildingParams& params, std::vector<Issue>& issues);

/// Returns the names of built-in materials.
std::vector<std::string_view> built_in_materials();

}  // namespace seedmesh::building
