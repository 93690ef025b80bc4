#pragma once
/// What the models of a scene come to, before they are made and while they are: so that what passes a limit
/// is refused before the work, or after a small part of it, and always at the same place.
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/generators/appraisal.h"
#include "core/generators/scene/casts.h"

namespace seedmesh::scene {

/// Modules, shapes and triangles, as the Job counts them.
using Amounts = std::array<std::uint64_t, 3>;

/// What the job has spent so far.
Amounts spent_of(const Job& job);

class Forecast {
 public:
  /// Asks the ground and every model for its estimate. Makes nothing; models that cannot tell count as
  /// nothing yet. Owns neither.
  Forecast(const SceneParams& params, const Casting& casting, const Job& job);

  /// How many stand of each model, 0: it is not made; until this is known all are. `merges`: each of them
  /// becomes triangles of its own.
  void want(const std::vector<std::uint64_t>& stands, bool merges);
  /// What the ground has is counted as spent from now on.
  void know_ground() { ground_ = 0; }
  bool is_wanted(std::size_t cast) const { return rows_[cast].stands > 0; }

  const Casting& casting() const { return casting_; }

  /// The models to begin with, where there are many that do not know exactly what they have: the first of
  /// each layer. The others follow from them.
  std::vector<std::size_t> scouts() const;

  /// What a model has cost, all levels of detail together. Its siblings are expected to cost at least a part
  /// of it.
  void learn(std::size_t cast, const Amounts& spent);

  /// Throws Stop at the pointer of the model with which what the job has spent and what is expected to come
  /// passes a limit. Not while models are made.
  void refuse(const Job& job) const;

  /// The same after a part of the models has cost what the job has spent since `before`, and `parts` more of
  /// the same mixture are to come. Nothing where models of a layer differ in more than their seeds.
  void refuse(const Job& job, const Amounts& before, std::size_t parts) const;

  /// Where a limit belongs that is passed while models are made: of the layers that do not know what
  /// they cost the one that is expected to cost most.
  std::string blamed() const;

 private:
  struct Row {
    std::optional<Estimate> told;
    bool is_made = false;
    std::uint64_t stands = 1;
    Amounts least = {};  ///< that it costs
  };
  void expect(const Casting::Layer& layer, std::size_t scout, bool are_alike);
  std::uint64_t to_come(const Row& row, std::size_t resource) const;

  const SceneParams& params_;
  const Casting& casting_;
  Amounts limits_;
  std::uint64_t ground_ = 0;  ///< triangles of it that are sure
  bool merges_ = false;
  std::vector<Row> rows_;  ///< by Casting::casts
};

}  // namespace seedmesh::scene
