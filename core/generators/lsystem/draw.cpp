#include "core/generators/lsystem/draw.h"

#include <algorithm>
#include <array>

namespace seedmesh::lsystem {

double Drawing::spread(std::uint64_t key, Spread of, double amount) {
  Rng rng = Rng(key).at(static_cast<std::uint64_t>(of));
  return rng.uniform(-amount, amount);
}

Drawing::Drawing(const Grammar& grammar, const LsystemParams& params, Skeleton* skeleton,
                 const GenerateContext& context)
    : grammar_(grammar),
      params_(params),
      job_(context.job),
      code_(grammar, context.job),
      variables_(grammar.variables),
      turtle_(skeleton,
              params.width.value +
                  spread(context.job.rng().at("width").key(), Spread::width, params.width.spread),
              context.job),
      yaw_{params.angle.yaw, math::sincos_degrees(params.angle.yaw)},
      pitch_{params.angle.pitch, math::sincos_degrees(params.angle.pitch)},
      roll_{params.angle.roll, math::sincos_degrees(params.angle.roll)} {
  for (const auto& [name, surface] : params.surfaces) surfaces_.push_back(&surface);
  std::vector<Tropism> tropisms;
  for (const auto& each : params.tropism) {
    const auto& to = each.direction;
    tropisms.push_back({{to[0], to[1], to[2]}, each.elasticity, each.step});
  }
  if (!tropisms.empty()) turtle_.set_tropisms(std::move(tropisms));
  const bool moves = params.weather || params.environment || context.demand.growth;
  if (moves) turtle_.track_anchors();
  if (!params.contours.empty()) turtle_.draw_contours();
  const bool has_own_widths = params.width_rule == LsystemParams::WidthRule::symbols ||
                              params.width_rule == LsystemParams::WidthRule::decrement;
  // Queries test collisions with bark, which lines do not have.
  const bool asked = std::any_of(grammar.kinds.begin(), grammar.kinds.end(),
                                 [](const Kind& kind) { return is_query(kind.command); });
  if (params.style == LsystemParams::Style::lines && has_own_widths && !moves && !asked) turtle_.draw_wires();
}

bool Drawing::needs_keys(const Grammar& grammar, const LsystemParams& params) {
  return grammar.productions.random || grammar.interpretation.random || params.angle.spread > 0 ||
         params.step.spread > 0;
}

void Drawing::module(KindId kind, const double* parameters, std::uint64_t key, std::uint32_t step) {
  turtle_.set_width_reduction(
      params_.width_rule == LsystemParams::WidthRule::decrement ? step * params_.width_decrement : 0);
  interpret(kind, parameters, {key, 0}, 0);
}

void Drawing::grow(const Module& module, double step, PartialGrowth grown) {
  turtle_.set_width_reduction(
      params_.width_rule == LsystemParams::WidthRule::decrement ? step * params_.width_decrement : 0);
  growth_ = grown;
  turtle_.set_share(grown.share);
  interpret(module.kind, module.parameters, module.keys, 0);
  growth_ = {};
  shapes_.clear();
  turtle_.set_share(1);
  turtle_.set_tropism_share(1);
}

void Drawing::fade(const Module& module, double step, double share) {
  const std::int16_t color = turtle_.color();
  const std::uint8_t contour = turtle_.contour();
  const bool is_joined = turtle_.is_joined();
  grow(module, step, {share, 0, 1});
  if (is_joined) turtle_.rejoin();
  turtle_.set_color(color);
  turtle_.set_contour(contour);
}

/// Draws a module or its interpretation, which never enters the word.
void Drawing::interpret(KindId kind, const double* parameters, Keys keys, std::uint32_t depth) {
  const Rules& rules = grammar_.interpretation;
  if (depth >= static_cast<std::uint32_t>(params_.interpretation_depth) || !rules.rewrites(kind)) {
    return execute(grammar_.kinds[kind], parameters, keys);
  }
  if ((++interpreted_ & 4095U) == 0) job_.check();
  const auto stream = [depth](std::uint64_t key) { return key == 0 ? 0 : key_at(key, 20 + depth); };
  const Keys own{stream(keys.own), stream(keys.before)};  // 0 stays 0: no keys
  const RewriteStreams draws(own.own, depth);
  std::vector<double> changed;  // slots after the statements before a condition
  const auto slots_of = [&](const Production& each) {
    if (each.before.count == 0 && variables_.empty()) return parameters;
    changed = variables_;
    changed.insert(changed.end(), parameters, parameters + grammar_.kinds[kind].arity);
    changed.resize(std::max<std::size_t>(grammar_.most_slots, changed.size()));
    code_.run(each.before, changed.data(), draws.stream.at(5), [](const Template&, std::uint64_t) {});
    return static_cast<const double*>(changed.data());
  };
  const Production* production = choose(grammar_, rules.candidates(kind), draws, slots_of, job_);
  if (!production) return execute(grammar_.kinds[kind], parameters, keys);
  const double* slots = slots_of(*production);
  if (!variables_.empty()) keep_variables(changed);
  if (production->code.count > 0) return write_interpreted(*production, slots, own, depth);
  for (const Template& each : grammar_.successor(production->successor)) {
    std::array<double, 64> arguments;
    const auto key_of = [&each](std::uint64_t key) { return key == 0 ? 0 : child_key(key, each); };
    const Keys child{key_of(own.own), key_of(own.before)};
    fill_arguments(grammar_, each, slots, child.own, arguments.data(), job_);
    interpret(each.kind, arguments.data(), child, depth + 1);
  }
}

/// Draws a successor with statements.
void Drawing::write_interpreted(const Production& production, const double* parameters, Keys own,
                                std::uint32_t depth) {
  std::vector<double> slots(grammar_.most_slots);
  const bool is_whole = production.before.count > 0 || !variables_.empty();
  const std::uint32_t known = is_whole ? grammar_.most_slots : production.bound;
  std::copy(parameters, parameters + known, slots.data());
  code_.run(production.code, slots.data(), RewriteStreams(own.own, depth).code(),
            [&](const Template& each, std::uint64_t turn) {
              std::array<double, 64> arguments;
              const auto key_of = [&](std::uint64_t key) { return key == 0 ? 0 : code_key(key, each, turn); };
              const Keys child{key_of(own.own), key_of(own.before)};
              fill_arguments(grammar_, each, slots.data(), child.own, arguments.data(), job_);
              interpret(each.kind, arguments.data(), child, depth + 1);
            });
  if (!variables_.empty()) keep_variables(slots);
}

}  // namespace seedmesh::lsystem
