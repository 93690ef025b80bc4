#pragma once
/// Predicts the cost of the models of a scene before and while they are generated. A scene that exceeds a
/// limit is refused before the work or after a small part of it, and always with the same pointer.
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/generators/api.h"
#include "core/generators/scene/model_variants.h"

namespace seedmesh::scene {

/// Numbers of modules, shapes and triangles, as Job counts them.
using Amounts = std::array<std::uint64_t, 3>;

/// Returns what the job has spent so far.
Amounts spent_of(const Job& job);

class Forecast {
 public:
  /// Reads the estimates of the ground and of every variant. Generates nothing; variants without estimate
  /// count as 0. Owns neither argument.
  Forecast(const SceneParams& params, const VariantTable& variant_table, const GenerateContext& context);

  /// Sets the number of placements of each variant. A variant with 0 placements is not generated. Before this
  /// call, each variant counts as placed once. With `merges`, every placement counts with its own triangles.
  void set_counts(const std::vector<std::uint64_t>& placements, bool merges);
  /// Removes the ground from the expected cost, because the job has spent it.
  void spend_ground() { ground_ = 0; }
  bool is_needed(std::size_t variant) const { return rows_[variant].placements > 0; }

  const VariantTable& variant_table() const { return variant_table_; }

  /// Returns the variants to generate first if many have no exact estimate. They are the first variants of
  /// layers; the cost of the others is predicted from them.
  std::vector<std::size_t> samples() const;

  /// Records the cost of a variant with all levels of detail. The other variants of its layer are then
  /// expected to cost at least a fixed share of it, scaled by their estimates.
  void record(std::size_t variant, const Amounts& spent);

  /// Throws Stop if the spent and the expected cost together exceed a limit. Its pointer is that of the variant
  /// at which the sum passes the limit, or "/terrain" for the ground. Must not be called while models are
  /// generated.
  void refuse(const Job& job) const;

  /// The same after one part of the variants has been generated. Its cost is what the job has spent since
  /// `before`, and `parts` further parts of about this cost follow. Does nothing where the variants of a
  /// layer differ in more than their seeds.
  void refuse(const Job& job, const Amounts& before, std::size_t parts) const;

  /// Returns the pointer for a limit that is exceeded during generation: among layers without exact estimate,
  /// the one with the largest expected cost.
  std::string limit_pointer() const;

 private:
  struct Row {
    std::optional<Estimate> estimate;
    bool is_made = false;
    std::uint64_t placements = 1;
    Amounts least = {};  ///< lower bound of its cost
  };
  void expect(const VariantTable::Layer& layer, std::size_t sample, bool are_alike);
  std::uint64_t remaining_cost(const Row& row, std::size_t resource) const;

  const SceneParams& params_;
  const VariantTable& variant_table_;
  Amounts limits_;
  std::uint64_t ground_ = 0;  ///< lower bound of its triangles
  bool merges_ = false;
  std::vector<Row> rows_;  ///< indexed by VariantTable::variants
};

}  // namespace seedmesh::scene
