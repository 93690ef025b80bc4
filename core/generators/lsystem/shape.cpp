#include "core/generators/lsystem/shape.h"

#include "core/base/math.h"
#include "core/geom/plant/weather.h"
#include "core/geom/plant/widths.h"

namespace seedmesh::lsystem {
namespace {

void set_widths(Limbs& limbs, const LsystemParams& params, Job& job) {
  switch (params.width_rule) {
    case LsystemParams::WidthRule::symbols:
    case LsystemParams::WidthRule::decrement:
      return;  // the turtle has set the widths
    case LsystemParams::WidthRule::branch_factor:
      return narrow_by_order(limbs, params.width_factor, job);
    case LsystemParams::WidthRule::longest_chain:
      return widen_by_longest_chain(limbs, {0.5 * params.width.value, 0.5 * params.tip_width}, job);
    case LsystemParams::WidthRule::pipe_model:
      return widen_by_pipes(limbs, {0.5 * params.tip_width, params.pipe_exponent}, job);
  }
}

/// Makes each internode a cylinder of its own radius. Where the radius changes, a new limb begins.
void make_cylinders(Limbs& limbs, LsystemParams::WidthRule rule, Job& job) {
  const bool is_widest_first = rule == LsystemParams::WidthRule::longest_chain;
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (i % 4096 == 0) job.check();
    const std::uint32_t parent = limbs.parent[i];
    if (parent == Limbs::none) continue;
    float& own = limbs.radius[i];
    if (is_widest_first) own = limbs.base_radius[i];
    limbs.base_radius[i] = own;
    if (limbs.parent[parent] != Limbs::none && limbs.radius[parent] != own) limbs.starts_limb[i] = 1;
  }
}

Weather weather_of(const LsystemParams::Weather& given) {
  constexpr double pascals_a_gigapascal = 1e9;
  const math::SinCos to = math::sincos_degrees(given.direction);
  Weather weather;
  weather.wind = glm::dvec3{to.cos, 0, -to.sin} * given.wind;
  weather.snow = given.snow;
  weather.rain = given.rain;
  weather.stiffness = given.stiffness * pascals_a_gigapascal;
  return weather;
}

}  // namespace

void shape(Skeleton& skeleton, const LsystemParams& params, Job& job) {
  set_widths(skeleton.limbs, params, job);
  skeleton.limbs.share = Array<float>(job);
  const bool has_tubes = params.style == LsystemParams::Style::tubes && !params.weld;
  if (has_tubes && params.taper == LsystemParams::Taper::none)
    make_cylinders(skeleton.limbs, params.width_rule, job);
  if (params.weather) bend(skeleton, weather_of(*params.weather), job);
}

}  // namespace seedmesh::lsystem
