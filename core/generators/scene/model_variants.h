#pragma once
/// The model variants of a scene. They are the variants of each layer, and the models that explicit positions
/// have of their own. Each variant is a complete request with a seed, so a client that has the list of
/// placements can request it separately.
#include <functional>
#include <string>
#include <vector>

#include "core/generators/api.h"
#include "core/generators/scene/candidate_positions.h"
#include "core/model/model.h"
#include "core/schema/child.h"

namespace seedmesh {
struct SceneLayer;
struct SceneParams;
}  // namespace seedmesh

namespace seedmesh::scene {

/// A model of the scene.
struct ModelVariant {
  std::string name;     ///< name of the layer and a number, unique
  std::string pointer;  ///< pointer to its request in the parameters
  Child request;        ///< request with its seed, and the values of `vary`, `age` and `season`
};

struct VariantTable {
  std::vector<ModelVariant> variants;
  /// By layer: index of its first variant, and their number.
  struct Layer {
    std::uint32_t first = 0, count = 0;
    /// Variant of each explicit position; none: a variant of the layer
    std::vector<std::uint32_t> by_position;
  };
  std::vector<Layer> layers;
  /// Pointers of layer parameters that have an effect only where a position has an age (x-full of the
  /// schema).
  std::vector<std::string> used_with_age;

  /// Returns the index of the variant of a placement.
  std::uint32_t variant_at(std::size_t layer, const Placement& placement) const;
};

constexpr std::size_t most_variants = 4096;

/// Returns true for a "no effect" warning about a parameter that has an effect elsewhere in the scene.
bool is_used_elsewhere(const VariantTable& variant_table, const Warning& warning);

/// Returns true if a predicate holds for the name of the generator of any model of the layers.
bool any_generator(const SceneParams& params, const std::function<bool(const std::string& name)>& predicate);

/// Returns the number of variants of a scene.
std::size_t count_variants(const SceneParams& params);

VariantTable variant_table_of(const SceneParams& params, const Job& job);

/// Returns true where the schema of the generator has this parameter. `path`: names separated by dots.
bool has_parameter(std::string_view generator, std::string_view path);

/// Returns the parameters with one value replaced. Requires has_parameter() for `path`.
std::string with_parameter(const std::string& parameters, std::string_view path, const std::string& json);

/// Returns true where the schema declares the parameter an integer.
bool is_whole(std::string_view generator, std::string_view path);

class Forecast;

/// Generates all variants with placements, in order, on all threads of the job. Models are not finished;
/// variants without placements are empty. `demand` applies to plants; other models are generated without
/// growth. Where `forecast` requests samples, these are generated first, and an excessive scene is refused
/// early. `background` is other work that runs on one thread at the same time; it may be empty. A Stop at a
/// limit points to a model.
Result<std::vector<Model>> models_of(Forecast& forecast, const Demand& demand, const GenerateContext& context,
                                     const std::function<void()>& background = {});

}  // namespace seedmesh::scene
