#pragma once
/// Materials by name: those of the request, built-in ones, and plain colours.
#include <map>
#include <string>
#include <string_view>

#include "core/base/job.h"
#include "core/generators/building/shapes.h"
#include "core/model/model.h"
#include "core/texture/wall.h"

namespace seedmesh {
struct BuildingParams;
}

namespace seedmesh::building {

/// Gives each look a material of the model when it is first asked for. A shape's look: its material by name,
/// else its colour, else what its symbol is called (Wall, Roof, Window, ...), else plain plaster. Where
/// `textures` of the request says so, materials with names as brick get pictures made by seed
/// (core/texture/wall.h), in the colour in force; parts have none.
class Looks {
 public:
  Looks(Model& model, const BuildingParams& params, const Shapes& shapes, const Job& job);
  /// Other shapes of the same request from here on, as those of another level of detail.
  void show(const Shapes& shapes) {
    shapes_ = &shapes;
    made_.clear();
  }
  int material_of(const Shape& shape);
  /// Of a role of a built-in part. What is of stone has the colour in force, unless `materials` say what
  /// stone is.
  int material_of_part(std::string_view role, const Style& style);
  /// Metres of one tile, where the material has pictures: texture coordinates are needed then.
  const glm::dvec2* tile_of(int material) const;

 private:
  struct Asked {
    const std::string& name;
    const std::string* color;  ///< in force; may be null
    bool is_role;              ///< of a part
  };
  int make(const Asked& asked);
  const texture::WallKind* surface_of(const Asked& asked) const;
  int load(const std::string& uri, const std::string& name, const std::string& pointer, const Job& job);

  Model& model_;
  const BuildingParams& params_;
  const Shapes* shapes_;
  bool has_textures_;  ///< the answer has any
  struct Pictures {
    int color = -1, normal = -1, surface = -1;
  };
  std::map<std::string, Pictures, std::less<>> pictures_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> made_;  ///< style and symbol
  std::map<std::string, int> by_name_;
  std::map<int, glm::dvec2> tiles_;
  std::vector<std::string> symbols_;

 public:
  /// The names of symbols, which a shape knows by number alone.
  void set_symbols(std::vector<std::string> names) { symbols_ = std::move(names); }
  const std::string& symbol(const Shape& shape) const { return symbols_[shape.symbol]; }
};

/// Data URIs that are none, with pointers.
void check_looks(const BuildingParams& params, std::vector<Issue>& issues);

/// The built-in names.
std::vector<std::string_view> built_in_materials();

}  // namespace seedmesh::building
