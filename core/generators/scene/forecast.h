#pragma once
/// What the models of a scene come to, before they are made and while they are: so that what passes the limit
/// on triangles is refused before the work, or after a small part of it, and always at the same place.
#include <cstdint>
#include <optional>
#include <vector>

#include "core/generators/appraisal.h"
#include "core/generators/scene/casts.h"

namespace seedmesh::scene {

class Forecast {
 public:
  /// Asks the ground and every model for its estimate. Makes nothing; models that cannot tell count as
  /// nothing yet. Owns neither.
  Forecast(const SceneParams& params, const Casting& casting, const Job& job);

  /// How often each model counts, 0: it is not made; until this is known all count once.
  void want(const std::vector<std::uint64_t>& times);
  bool is_wanted(std::size_t cast) const { return rows_[cast].times > 0; }

  const Casting& casting() const { return casting_; }

  /// The models to begin with: the first of each layer that has several, or counts one more than once, and
  /// does not know exactly what they have. The others follow from them.
  std::vector<std::size_t> scouts() const;

  /// What a model turned out to have, all levels of detail together. Its siblings are expected to have
  /// at least a part of it.
  void learn(std::size_t cast, std::uint64_t triangles);

  /// Throws Stop at the pointer of the model with which what is expected at least passes the limit.
  void refuse() const;

  /// Where a limit belongs that is passed while models are made: the one with which the limit is expected to
  /// be passed, or else the layer that has most.
  std::string blamed() const;

 private:
  struct Row {
    std::optional<Estimate> told;
    std::optional<std::uint64_t> made;
    std::uint64_t times = 1;
    std::uint64_t least = 0;  ///< triangles that are expected at least, once

    std::uint64_t all(std::uint64_t limit) const;
  };
  struct Passed {
    std::string pointer;
    std::uint64_t triangles = 0;
  };
  std::optional<Passed> passed() const;

  const SceneParams& params_;
  const Casting& casting_;
  std::uint64_t limit_;
  std::uint64_t ground_ = 0;  ///< triangles of it that are sure
  std::vector<Row> rows_;     ///< by Casting::casts
};

}  // namespace seedmesh::scene
