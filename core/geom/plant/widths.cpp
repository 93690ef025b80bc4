#include "core/geom/plant/widths.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"

namespace seedmesh {
namespace {

constexpr std::size_t check_interval = 4096;

bool continues(const Limbs& limbs, std::size_t joint) {
  return limbs.parent[joint] != Limbs::none && !limbs.starts_limb[joint];
}

/// x^e, without logarithms for the exponents of areas and volumes.
double power(double x, double e) {
  if (e == 2) return x * x;
  if (e == 3) return x * x * x;
  return math::pow(x, e);
}

double root(double x, double e) {
  if (e == 2) return std::sqrt(x);
  if (e == 3) return math::cbrt(x);
  return math::pow(x, 1 / e);
}

double share_of(const Limbs& limbs, std::size_t joint) {
  return limbs.share.empty() ? 1 : double{limbs.share[joint]};
}

}  // namespace

void narrow_by_order(Limbs& limbs, double factor, Job& job) {
  std::vector<float> by_order{1};
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (i % check_interval == 0) job.check();
    while (by_order.size() <= limbs.order[i])
      by_order.push_back(static_cast<float>(by_order.back() * factor));
    limbs.radius[i] *= by_order[limbs.order[i]];
    limbs.base_radius[i] =
        continues(limbs, i) ? limbs.radius[limbs.parent[i]] : limbs.base_radius[i] * by_order[limbs.order[i]];
  }
}

void widen_by_longest_chain(Limbs& limbs, const ChainWidths& widths, Job& job) {
  Array<double> beyond(job, limbs.size(), 0.0);  // internodes in the longest chain after a joint
  double longest = 0;
  for (std::size_t i = limbs.size(); i-- > 0;) {
    if (i % check_interval == 0) job.check();
    longest = std::max(longest, beyond[i]);
    if (limbs.parent[i] == Limbs::none) continue;
    double& before = beyond[limbs.parent[i]];
    before = std::max(before, beyond[i] + share_of(limbs, i));
  }
  const double a_link = longest == 0 ? 0 : (widths.base - widths.tip) / longest;
  const auto radius = [&](double links) { return static_cast<float>(widths.tip + a_link * links); };
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (i % check_interval == 0) job.check();
    limbs.radius[i] = radius(beyond[i]);
    limbs.base_radius[i] =
        radius(limbs.parent[i] == Limbs::none ? beyond[i] : beyond[i] + share_of(limbs, i));
  }
}

void widen_by_pipes(Limbs& limbs, const PipeWidths& widths, Job& job) {
  Array<double> pipes(job, limbs.size(), 0.0);  // sum of r^exponent of what grows from a joint
  const double tip = power(widths.tip, widths.exponent);
  // The share of a tip that exists along the fullest chain from a joint: only what is missing ends here.
  Array<float> above(job, limbs.share.size(), 0.0F);
  for (std::size_t i = limbs.size(); i-- > 0;) {
    if (i % check_interval == 0) job.check();
    if (above.empty()) {
      if (pipes[i] == 0) pipes[i] = tip;
    } else {
      const float share = limbs.share[i], missing = 1 - above[i];
      pipes[i] += tip * double{std::min(share, missing)};
      if (limbs.parent[i] != Limbs::none) {
        float& below = above[limbs.parent[i]];
        below = std::max(below, std::min(1.0F, share + above[i]));
      }
    }
    if (limbs.parent[i] != Limbs::none) pipes[limbs.parent[i]] += pipes[i];
    limbs.radius[i] = static_cast<float>(root(pipes[i], widths.exponent));
    limbs.base_radius[i] = limbs.radius[i];
  }
}

}  // namespace seedmesh
