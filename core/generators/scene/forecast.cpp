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
constexpr std::uint64_t part_of_estimate = 2, part_of_sibling = 2;

/// Do the models of a layer differ in their seeds alone?
bool are_alike(const SceneLayer& layer) {
  return layer.vary.empty() && !(layer.age && std::holds_alternative<std::array<double, 2>>(*layer.age));
}

}  // namespace

Forecast::Forecast(const SceneParams& params, const Casting& casting, const Job& job)
    : params_(params), casting_(casting), limit_(job.limits().triangles) {
  if (params.terrain) {
    const Result<Appraisal> own = appraise_child(*params.terrain, "/terrain", Rng(0), job);
    if (own && own->estimate && own->estimate->exact) ground_ = own->estimate->triangles;
  }
  for (const Cast& cast : casting.casts) {
    Row row;
    const Result<Appraisal> appraisal = appraise_child(cast.request, cast.pointer, Rng(0), job);
    if (appraisal && appraisal->estimate) {
      row.told = appraisal->estimate;
      row.least = row.told->exact ? row.told->triangles : row.told->triangles / part_of_estimate;
    }
    rows_.push_back(row);
  }
}

/// As often as it counts; one more than the limit where that is passed.
std::uint64_t Forecast::Row::all(std::uint64_t limit) const {
  if (times == 0 || least == 0) return 0;
  return least > limit / times ? limit + 1 : least * times;
}

void Forecast::want(const std::vector<std::uint64_t>& times) {
  for (std::size_t i = 0; i < rows_.size(); ++i) rows_[i].times = times[i];
}

std::vector<std::size_t> Forecast::scouts() const {
  std::vector<std::size_t> first;
  for (const Casting::Layer& layer : casting_.layers) {
    std::vector<std::size_t> open;
    for (std::size_t i = layer.first; i < layer.first + layer.count; ++i) {
      if (is_wanted(i) && !(rows_[i].told && rows_[i].told->exact)) open.push_back(i);
    }
    const bool is_worth_it =
        open.size() > 2 || (!open.empty() && rows_[open.front()].times > open.size());
    if (is_worth_it) first.push_back(open.front());
  }
  return first;
}

void Forecast::learn(std::size_t cast, std::uint64_t triangles) {
  rows_[cast].made = rows_[cast].least = triangles;
  for (std::size_t k = 0; k < casting_.layers.size(); ++k) {
    const Casting::Layer& layer = casting_.layers[k];
    if (cast < layer.first || cast >= layer.first + layer.count) continue;
    for (std::size_t i = layer.first; i < layer.first + layer.count; ++i) {
      Row& row = rows_[i];
      if (row.made || (row.told && row.told->exact)) continue;
      const std::optional<Estimate>& here = rows_[cast].told;
      if (row.told && here && here->triangles > 0) {
        const double share =
            static_cast<double>(triangles) / static_cast<double>(here->triangles) / part_of_sibling;
        row.least = static_cast<std::uint64_t>(math::to_int64(
            std::min(static_cast<double>(row.told->triangles) * share, static_cast<double>(limit_) + 1)));
      } else if (are_alike(params_.layers[k])) {
        row.least = triangles / part_of_sibling;
      }
    }
  }
}

std::optional<Forecast::Passed> Forecast::passed() const {
  std::uint64_t sum = std::min(ground_, limit_ + 1);
  if (sum > limit_) return Passed{"/terrain", ground_};
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    sum += rows_[i].all(limit_);
    if (sum > limit_) return Passed{casting_.casts[i].pointer, sum};
  }
  return std::nullopt;
}

void Forecast::refuse() const {
  const std::optional<Passed> found = passed();
  if (!found) return;
  Job::refuse("the models up to this one need at least " + std::to_string(found->triangles) +
                  " triangles; the limit is " + std::to_string(limit_),
              found->pointer);
}

std::string Forecast::blamed() const {
  if (const std::optional<Passed> found = passed()) return found->pointer;
  std::uint64_t most = 0;
  std::string pointer;
  for (const Casting::Layer& layer : casting_.layers) {
    std::uint64_t sum = 0;
    std::string own;
    const auto add = [&](std::size_t cast) {
      if (cast >= rows_.size() || !is_wanted(cast)) return;
      sum += rows_[cast].all(limit_);
      if (own.empty()) own = casting_.casts[cast].pointer;
    };
    for (std::size_t i = layer.first; i < layer.first + layer.count; ++i) add(i);
    for (const std::uint32_t cast : layer.by_position) add(cast);
    if (pointer.empty() || sum > most) {
      most = sum;
      pointer = own;
    }
  }
  return pointer;
}

}  // namespace seedmesh::scene
