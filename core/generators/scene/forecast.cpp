#include "core/generators/scene/forecast.h"

#include <algorithm>
#include <variant>

#include "core/base/math.h"
#include "core/generators/child.h"
#include "generated/params/scene.h"

namespace seedmesh::scene {
namespace {

// What is not known exactly counts with this part, so that no scene is refused that would fit: an estimate
// before work, a model beside one that differs in nothing but its seed, an estimate beside one that was
// tried.
constexpr std::uint64_t part = 2;
// Models that one of them is worth waiting for; fewer are made at once.
constexpr std::size_t many = 12;

constexpr std::array<Resource, 3> resources = {Resource::modules, Resource::shapes, Resource::triangles};
constexpr std::array<const char*, 3> names = {"modules", "shapes", "triangles"};
constexpr std::size_t triangles = 2;

/// Do the models of a layer differ in their seeds alone?
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

Forecast::Forecast(const SceneParams& params, const Casting& casting, const Job& job)
    : params_(params),
      casting_(casting),
      limits_{job.limits().modules, job.limits().shapes, job.limits().triangles} {
  if (params.terrain) {
    const Result<Appraisal> own = appraise_child(*params.terrain, "/terrain", Rng(0), job);
    if (own && own->estimate && own->estimate->exact) ground_ = own->estimate->triangles;
  }
  for (const Cast& cast : casting.casts) {
    // What its first model cannot tell exactly, the others of a layer that differ in their seeds cannot
    // either: they count like it, and nothing is asked again.
    const auto of = [number = rows_.size()](const Casting::Layer& layer) {
      return number > layer.first && number < layer.first + layer.count;
    };
    const auto layer = std::find_if(casting.layers.begin(), casting.layers.end(), of);
    if (layer != casting.layers.end() &&
        are_alike(params.layers[static_cast<std::size_t>(layer - casting.layers.begin())]) &&
        !(rows_[layer->first].told && rows_[layer->first].told->exact)) {
      const Row first = rows_[layer->first];
      rows_.push_back(first);
      continue;
    }
    Row row;
    const Result<Appraisal> appraisal = appraise_child(cast.request, cast.pointer, Rng(0), job);
    if (appraisal && appraisal->estimate) {
      row.told = appraisal->estimate;
      row.least[triangles] = row.told->exact ? row.told->triangles : row.told->triangles / part;
    }
    rows_.push_back(row);
  }
}

void Forecast::want(const std::vector<std::uint64_t>& stands, bool merges) {
  merges_ = merges;
  for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].stands = stands[i];
}

std::vector<std::size_t> Forecast::scouts() const {
  std::vector<std::size_t> first;
  std::size_t unsure = 0;
  for (const Casting::Layer& layer : casting_.layers) {
    std::vector<std::size_t> open;
    for (std::size_t i = layer.first; i < layer.first + layer.count; ++i) {
      if (is_wanted(i) && !(rows_[i].told && rows_[i].told->exact)) open.push_back(i);
    }
    unsure += open.size();
    if (open.size() > 2 || (merges_ && !open.empty())) first.push_back(open.front());
  }
  if (unsure < many && !merges_) first.clear();
  return first;
}

void Forecast::learn(std::size_t cast, const Amounts& spent) {
  rows_[cast].is_made = true;
  rows_[cast].least = spent;
  for (std::size_t k = 0; k < casting_.layers.size(); ++k) {
    const Casting::Layer& layer = casting_.layers[k];
    if (cast >= layer.first && cast < layer.first + layer.count)
      expect(layer, cast, are_alike(params_.layers[k]));
  }
}

/// Of the others of a layer by one that is made.
void Forecast::expect(const Casting::Layer& layer, std::size_t scout, bool are_alike) {
  const Row& known = rows_[scout];
  for (std::size_t i = layer.first; i < layer.first + layer.count; ++i) {
    Row& row = rows_[i];
    if (row.is_made) continue;
    const bool is_exact = row.told && row.told->exact;
    double share = are_alike ? 1 : 0;
    if (row.told && known.told && known.told->triangles > 0)
      share = static_cast<double>(row.told->triangles) / static_cast<double>(known.told->triangles);
    for (std::size_t r = 0; r < resources.size(); ++r) {
      if (share <= 0 || (r == triangles && is_exact)) continue;
      const double least = static_cast<double>(known.least[r]) * share / static_cast<double>(part);
      row.least[r] =
          static_cast<std::uint64_t>(math::to_int64(std::min(least, static_cast<double>(limits_[r]) + 1)));
    }
  }
}

std::uint64_t Forecast::to_come(const Row& row, std::size_t resource) const {
  const std::uint64_t most = limits_[resource] + 1;
  if (row.stands == 0) return 0;
  const std::uint64_t copies = merges_ && resource == triangles && row.stands > 1 ? row.stands : 0;
  return product_of(row.least[resource], copies + (row.is_made ? 0 : 1), most);
}

void Forecast::refuse(const Job& job) const {
  const Amounts spent = spent_of(job);
  for (std::size_t r = 0; r < resources.size(); ++r) {
    std::uint64_t sum = spent[r];
    const auto stop = [&](const std::string& pointer) {
      Job::refuse("the models up to this one need at least " + std::to_string(sum) + " " + names[r] +
                      "; the limit is " + std::to_string(limits_[r]),
                  pointer);
    };
    if (r == triangles) sum += std::min(ground_, limits_[r] + 1);
    if (sum > limits_[r]) stop("/terrain");
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      sum += std::min(to_come(rows_[i], r), limits_[r] + 1);
      if (sum > limits_[r]) stop(casting_.casts[i].pointer);
    }
  }
}

void Forecast::refuse(const Job& job, const Amounts& before, std::size_t parts) const {
  constexpr double least = 0.8;  // of one part in the next
  if (!std::all_of(params_.layers.begin(), params_.layers.end(), are_alike)) return;
  const Amounts spent = spent_of(job);
  for (std::size_t r = 0; r < resources.size(); ++r) {
    const double now = static_cast<double>(spent[r]), last = now - static_cast<double>(before[r]);
    const double sum = now + least * last * static_cast<double>(parts);
    if (sum <= static_cast<double>(limits_[r])) continue;
    Job::refuse("its models need about " + std::to_string(math::to_int64(sum)) + " " + names[r] +
                    "; the limit is " + std::to_string(limits_[r]),
                blamed());
  }
}

std::string Forecast::blamed() const {
  // What is known exactly fitted: it is one of the others, if there are any.
  const bool any_unsure = std::any_of(rows_.begin(), rows_.end(), [](const Row& row) {
    return row.stands > 0 && !(row.told && row.told->exact);
  });
  double most = -1;
  std::string pointer;
  for (const Casting::Layer& layer : casting_.layers) {
    double sum = 0;
    std::string own;
    const auto add = [&](std::size_t cast) {
      if (cast >= rows_.size() || !is_wanted(cast)) return;
      const Row& row = rows_[cast];
      if (any_unsure && row.told && row.told->exact) return;
      for (std::size_t r = 0; r < resources.size(); ++r)
        sum += static_cast<double>(row.least[r]) / (static_cast<double>(limits_[r]) + 1);
      if (own.empty()) own = casting_.casts[cast].pointer;
    };
    for (std::size_t i = layer.first; i < layer.first + layer.count; ++i) add(i);
    for (const std::uint32_t cast : layer.by_position) add(cast);
    if (own.empty() || sum <= most) continue;
    most = sum;
    pointer = own;
  }
  return pointer;
}

}  // namespace seedmesh::scene
