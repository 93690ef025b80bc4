#include "core/generators/scene/forecast.h"

#include <algorithm>
#include <variant>

#include "core/base/math.h"
#include "core/generators/child.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

// An inexact value counts with this part only, so that no scene is refused that would fit: an estimate before
// work, or a sibling of a model that differs only in its seed.
constexpr std::uint64_t part = 2;
// With at least this number of models, a sample is generated first.
constexpr std::size_t many = 12;

constexpr std::array<Resource, 3> resources = {Resource::modules, Resource::shapes, Resource::triangles};
constexpr std::array<const char*, 3> names = {"modules", "shapes", "triangles"};
constexpr std::size_t triangles = 2;

/// Returns true where the variants of a layer differ only in their seeds.
bool are_alike(const SceneLayer& layer) {
  return layer.vary.empty() && !(layer.age && std::holds_alternative<std::array<double, 2>>(*layer.age));
}

std::uint64_t product_of(std::uint64_t a, std::uint64_t b, std::uint64_t most) {
  return b > 0 && a > most / b ? most : a * b;
}

}  // namespace

Amounts spent_of(const Job& job) {
  Amounts spent{};
  for (std::size_t r = 0; r < spent.size(); ++r) spent[r] = job.spent(resources[r]);
  return spent;
}

Forecast::Forecast(const SceneParams& params, const VariantTable& variant_table,
                   const GenerateContext& context)
    : params_(params),
      variant_table_(variant_table),
      limits_{context.job.limits().modules, context.job.limits().shapes, context.job.limits().triangles} {
  if (params.terrain) {
    GenerateContext plain = context;
    plain.demand.textures = 0;  // which are no part of the triangles, but of the time
    const Result<Appraisal> own = appraise_child(*params.terrain, "/terrain", Rng(0), plain);
    if (own && own->estimate && own->estimate->exact) ground_ = own->estimate->triangles;
  }
  for (const ModelVariant& variant : variant_table.variants) {
    // Variants that differ only in their seeds have the same estimate as the first, so it is computed once.
    const auto of = [number = rows_.size()](const VariantTable::Layer& layer) {
      return number > layer.first && number < layer.first + layer.count;
    };
    const auto layer = std::find_if(variant_table.layers.begin(), variant_table.layers.end(), of);
    if (layer != variant_table.layers.end() &&
        are_alike(params.layers[static_cast<std::size_t>(layer - variant_table.layers.begin())]) &&
        !(rows_[layer->first].estimate && rows_[layer->first].estimate->exact)) {
      const Row first = rows_[layer->first];
      rows_.push_back(first);
      continue;
    }
    Row row;
    const Result<Appraisal> appraisal = appraise_child(variant.request, variant.pointer, Rng(0), context);
    if (appraisal && appraisal->estimate) {
      row.estimate = appraisal->estimate;
      row.least[triangles] = row.estimate->exact ? row.estimate->triangles : row.estimate->triangles / part;
    }
    rows_.push_back(row);
  }
}

void Forecast::set_counts(const std::vector<std::uint64_t>& placements, bool merges) {
  merges_ = merges;
  for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].placements = placements[i];
}

std::vector<std::size_t> Forecast::samples() const {
  std::vector<std::size_t> first;
  std::size_t unsure = 0;
  for (const VariantTable::Layer& layer : variant_table_.layers) {
    std::vector<std::size_t> open;
    for (std::size_t i = layer.first; i < layer.first + layer.count; ++i) {
      if (is_needed(i) && !(rows_[i].estimate && rows_[i].estimate->exact)) open.push_back(i);
    }
    unsure += open.size();
    if (open.size() > 2 || (merges_ && !open.empty())) first.push_back(open.front());
  }
  if (unsure < many && !merges_) first.clear();
  return first;
}

void Forecast::record(std::size_t variant, const Amounts& spent) {
  rows_[variant].is_made = true;
  rows_[variant].least = spent;
  for (std::size_t k = 0; k < variant_table_.layers.size(); ++k) {
    const VariantTable::Layer& layer = variant_table_.layers[k];
    if (variant >= layer.first && variant < layer.first + layer.count)
      expect(layer, variant, are_alike(params_.layers[k]));
  }
}

/// Predicts the other variants of a layer from one that has been generated.
void Forecast::expect(const VariantTable::Layer& layer, std::size_t sample, bool are_alike) {
  const Row& known = rows_[sample];
  for (std::size_t i = layer.first; i < layer.first + layer.count; ++i) {
    Row& row = rows_[i];
    if (row.is_made) continue;
    const bool is_exact = row.estimate && row.estimate->exact;
    double share = are_alike ? 1 : 0;
    if (row.estimate && known.estimate && known.estimate->triangles > 0)
      share = static_cast<double>(row.estimate->triangles) / static_cast<double>(known.estimate->triangles);
    for (std::size_t r = 0; r < resources.size(); ++r) {
      if (share <= 0 || (r == triangles && is_exact)) continue;
      const double least = static_cast<double>(known.least[r]) * share / static_cast<double>(part);
      row.least[r] =
          static_cast<std::uint64_t>(math::to_int64(std::min(least, static_cast<double>(limits_[r]) + 1)));
    }
  }
}

std::uint64_t Forecast::remaining_cost(const Row& row, std::size_t resource) const {
  const std::uint64_t most = limits_[resource] + 1;
  if (row.placements == 0) return 0;
  const std::uint64_t copies = merges_ && resource == triangles && row.placements > 1 ? row.placements : 0;
  return product_of(row.least[resource], copies + (row.is_made ? 0 : 1), most);
}

void Forecast::refuse(const Job& job) const {
  const Amounts spent = spent_of(job);
  for (std::size_t r = 0; r < resources.size(); ++r) {
    std::uint64_t sum = spent[r];
    const auto stop = [&](const std::string& pointer) {
      job.refuse(limit_issue({resources[r], limits_[r], sum},
                             "the models up to this one need at least " + std::to_string(sum) + " " +
                                 names[r] + "; the limit is " + std::to_string(limits_[r]),
                             pointer));
    };
    if (r == triangles) sum += std::min(ground_, limits_[r] + 1);
    if (sum > limits_[r]) stop("/terrain");
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      sum += std::min(remaining_cost(rows_[i], r), limits_[r] + 1);
      if (sum > limits_[r]) stop(variant_table_.variants[i].pointer);
    }
  }
}

void Forecast::refuse(const Job& job, const Amounts& before, std::size_t parts) const {
  constexpr double least = 0.8;  // lower bound of the cost of the next part, as a share
  if (!std::all_of(params_.layers.begin(), params_.layers.end(), are_alike)) return;
  const Amounts spent = spent_of(job);
  for (std::size_t r = 0; r < resources.size(); ++r) {
    const double now = static_cast<double>(spent[r]), last = now - static_cast<double>(before[r]);
    const double sum = now + least * last * static_cast<double>(parts);
    if (sum <= static_cast<double>(limits_[r])) continue;
    const auto needed = static_cast<std::uint64_t>(math::to_int64(sum));
    job.refuse(limit_issue({resources[r], limits_[r], needed},
                           "its models need about " + std::to_string(needed) + " " + names[r] +
                               "; the limit is " + std::to_string(limits_[r]),
                           limit_pointer()));
  }
}

std::string Forecast::limit_pointer() const {
  // Exact estimates fit, so the limit belongs to one of the others, if there are any.
  const bool any_unsure = std::any_of(rows_.begin(), rows_.end(), [](const Row& row) {
    return row.placements > 0 && !(row.estimate && row.estimate->exact);
  });
  double most = -1;
  std::string pointer;
  for (const VariantTable::Layer& layer : variant_table_.layers) {
    double sum = 0;
    std::string own;
    const auto add = [&](std::size_t variant) {
      if (variant >= rows_.size() || !is_needed(variant)) return;
      const Row& row = rows_[variant];
      if (any_unsure && row.estimate && row.estimate->exact) return;
      for (std::size_t r = 0; r < resources.size(); ++r)
        sum += static_cast<double>(row.least[r]) / (static_cast<double>(limits_[r]) + 1);
      if (own.empty()) own = variant_table_.variants[variant].pointer;
    };
    for (std::size_t i = layer.first; i < layer.first + layer.count; ++i) add(i);
    for (const std::uint32_t variant : layer.by_position) add(variant);
    if (own.empty() || sum <= most) continue;
    most = sum;
    pointer = own;
  }
  return pointer;
}

}  // namespace seedmesh::scene
