#pragma once
/// The models of a scene: for each layer its variants, and those of positions that have their own. Each is a
/// request by itself, with its seed, so that whoever gets the list of placements can ask for it alone.
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/base/job.h"
#include "core/generators/scene/stands.h"
#include "core/model/model.h"
#include "core/schema/child.h"

namespace seedmesh {
struct SceneLayer;
struct SceneParams;
}  // namespace seedmesh

namespace seedmesh::scene {

/// One model.
struct Cast {
  std::string name;     ///< of the layer and a number, unique
  std::string pointer;  ///< where its request stands in the parameters
  Child request;        ///< with its seed, and what `vary`, `age` and `season` make of it
};

struct Casting {
  std::vector<Cast> casts;
  /// By layer: the first of its variants and how many there are.
  struct Layer {
    std::uint32_t first = 0, count = 0;
    std::vector<std::uint32_t> by_position;  ///< which cast a position has; none: a variant of the layer
  };
  std::vector<Layer> layers;
  /// Pointers to parameters of layers that have an effect where a position has an age (x-full of the schema).
  std::vector<std::string> used_with_age;

  /// Which model stands there.
  std::uint32_t cast_of(std::size_t layer, const Stand& stand) const;
};

constexpr std::size_t most_casts = 4096;

/// Whether the warning says of a parameter that it has no effect, and it has one at another place.
bool is_used_elsewhere(const Casting& casting, const Warning& warning);

/// How many models there would be.
std::size_t count_casts(const SceneParams& params);

Casting casting_of(const SceneParams& params, const Job& job);

/// Is there such a parameter of this generator, by its schema? `path`: names with dots between.
bool has_parameter(std::string_view generator, std::string_view path);

/// The parameters of the request, one of them changed. `path` has_parameter().
std::string with_parameter(const std::string& parameters, std::string_view path, const std::string& json);

/// Is the parameter whole by its schema?
bool is_whole(std::string_view generator, std::string_view path);

class Forecast;

/// The models of all casts that are wanted, in their order, made on all threads of the job; none finished,
/// and those that are not wanted empty. `demand`: of plants; other models are made without growth. Where the
/// forecast says, a few are made first, and what they show to be too much is refused at once. `beside`: other
/// work that is done meanwhile, on one thread; may be empty. Stops at a limit point to a model.
Result<std::vector<Model>> models_of(Forecast& forecast, const Demand& demand, Job& job,
                                     const std::function<void()>& beside = {});

}  // namespace seedmesh::scene
