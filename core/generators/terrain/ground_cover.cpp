#include "core/generators/terrain/ground_cover.h"

#include <algorithm>

#include "core/base/math.h"
#include "core/generators/terrain/plan.h"
#include "generated/params/terrain.h"

namespace seedmesh::terrain {

GroundColors colors_of(const TerrainParams& params, const Range& range) {
  const auto level = static_cast<float>(params.water_level.value_or(static_cast<double>(range.low)));
  return {palette_of(params), params.tile ? nominal_range(params) : range, level};
}

GroundCover::GroundCover(const TerrainParams& params, const Field& field,
                         std::shared_ptr<const RefinedGround> refined, const Job& job)
    : colors_(colors_of(params, range_of(field, job))),
      refined_(std::move(refined)),
      width_(field.width),
      depth_(field.depth),
      cell_(field.cell),
      shares_(job) {
  const Sites sites(field, window_of(params), job.rng().at("terrain"), job);
  shares_.reserve(static_cast<std::size_t>(width_) * static_cast<std::size_t>(depth_));
  for (std::int32_t z = 0; z < depth_; ++z) {
    job.check();
    for (std::int32_t x = 0; x < width_; ++x) shares_.push_back(ground_shares(colors_, sites.at(x, z)));
  }
}

GroundShares GroundCover::at(double x, double z) const {
  if (refined_ && refined_->contains(x, z)) {
    RefinedGround::Sampler sampler(*refined_);
    return ground_shares(colors_, sampler.at(x, z).site);
  }
  const double column = std::clamp(x / cell_, 0.0, width_ - 1.0),
               row = std::clamp(z / cell_, 0.0, depth_ - 1.0);
  const std::int32_t i = std::min(math::to_int32(column), width_ - 2),
                     j = std::min(math::to_int32(row), depth_ - 2);
  return bilinear(
      [&](std::int32_t a, std::int32_t b) {
        return shares_[static_cast<std::size_t>(j + b) * static_cast<std::size_t>(width_) +
                       static_cast<std::size_t>(i + a)];
      },
      static_cast<float>(column - i), static_cast<float>(row - j));
}

}  // namespace seedmesh::terrain
