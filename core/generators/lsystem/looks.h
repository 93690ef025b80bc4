#pragma once
/// Colour index -> Material: the request's materials, or a palette of our own.
#include <vector>

#include "core/base/job.h"
#include "core/model/model.h"
#include "generated/params/lsystem.h"

namespace seedmesh::lsystem {

enum class Sides { one, both };

/// What the schema cannot say of the materials: a look needs a colour, a texture or an image of its colour.
void check_looks(const LsystemParams& params, std::vector<Issue>& issues);

/// True when some material has a picture, which is to go a whole number of times round a limb.
bool wraps_pictures(const LsystemParams& params);

/// Materials made as they are asked for: one for each colour index and for whether both sides are seen.
class Wardrobe {
 public:
  /// Reads the request's images into `model`; throws Stop (Code::invalid) for one that is damaged.
  Wardrobe(Model& model, const LsystemParams& params, const Job& job);

  /// Indices past the end of the list keep its last look.
  std::int16_t look_of(std::int16_t color) const { return std::min(color, last_); }

  /// The number of a material. `recipe`, where its kind is not empty, is a texture that the look gets unless
  /// it has one of its own.
  int material(std::int16_t color, Sides sides, const TextureRecipe& recipe = {});

 private:
  struct Made {
    std::size_t index;
    Sides sides;
    std::string kind;
    int material;
  };
  struct Pictures {
    int color = -1, normal = -1, surface = -1;
  };

  Material look(std::size_t index) const;
  void put_pictures_on(Material& material, std::size_t index) const;
  int load(const std::string& uri, const std::string& name, const std::string& pointer, const Job& job);

  Model& model_;
  const LsystemParams& params_;
  std::int16_t last_;
  std::vector<Pictures> pictures_;  ///< of each of the request's materials
  std::vector<Made> made_;
};

}  // namespace seedmesh::lsystem
