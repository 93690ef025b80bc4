#include "core/generators/lsystem/idle.h"

#include <algorithm>
#include <string>

#include "core/generators/idle.h"
#include "generated/params/lsystem.h"

namespace seedmesh::lsystem {
namespace {

void look_at_width_rule(const LsystemParams& params, IdleParameters& idle) {
  using Rule = LsystemParams::WidthRule;
  const LsystemParams defaults;  // are not told from what is left out
  const auto warn = [&](const char* name, bool is_given, std::initializer_list<Rule> rules) {
    std::string owners;
    for (const Rule each : rules) owners += (owners.empty() ? "" : " and ") + std::string(text_of(each));
    idle.warn_if(is_given && std::find(rules.begin(), rules.end(), params.width_rule) == rules.end(),
                 std::string("/") + name,
                 "it belongs to the width rule" + std::string(rules.size() > 1 ? "s " : " ") + owners +
                     ", and the rule is " + std::string(text_of(params.width_rule)));
  };
  warn("width_factor", params.width_factor != defaults.width_factor, {Rule::branch_factor});
  warn("tip_width", params.tip_width != defaults.tip_width, {Rule::longest_chain, Rule::pipe_model});
  warn("pipe_exponent", params.pipe_exponent != defaults.pipe_exponent, {Rule::pipe_model});
}

void look_at_lines(const LsystemParams& params, IdleParameters& idle) {
  if (params.style != LsystemParams::Style::lines) return;
  const LsystemParams defaults;
  const std::string reason = "it belongs to the style tubes, and the style is lines";
  idle.warn_if(params.sides != defaults.sides, "/sides", reason);
  idle.warn_if(params.stacks != defaults.stacks, "/stacks", reason);
  idle.warn_if(params.adapt, "/adapt", reason);
}

void look_at_rules(const LsystemParams& params, IdleParameters& idle) {
  const LsystemParams defaults;
  idle.warn_if(params.decomposition.empty() && params.decomposition_depth != defaults.decomposition_depth,
               "/decomposition_depth", "there is no `decomposition`");
  idle.warn_if(params.interpretation.empty() && params.interpretation_depth != defaults.interpretation_depth,
               "/interpretation_depth", "there is no `interpretation`");
}

void look_at_weather(const LsystemWeather& weather, IdleParameters& idle) {
  const LsystemWeather calm;
  idle.warn_if(weather.wind == 0 && weather.direction != calm.direction, "/weather/direction", "`wind` is 0");
  idle.warn_if(
      weather.wind == 0 && weather.rain == 0 && weather.snow == 0 && weather.stiffness != calm.stiffness,
      "/weather/stiffness", "there is neither `wind` nor `rain` nor `snow`");
}

void look_at_material(const LsystemMaterial& material, const std::string& pointer, IdleParameters& idle) {
  const auto& images = material.images;
  const bool has_image = !images.color.empty(), is_given = material.texture_seed != 0;
  idle.warn_if(is_given && has_image, pointer + "/texture_seed", "the image `images.color` takes its place");
  idle.warn_if(is_given && !has_image && material.texture == LsystemTexture::none, pointer + "/texture_seed",
               "there is no `texture`");
  idle.warn_if(images.cut_out && !has_image && images.normal.empty() && images.surface.empty(),
               pointer + "/images/cut_out", "there is no image");
}

}  // namespace

std::vector<Warning> idle_parameters(const LsystemParams& params) {
  IdleParameters idle;
  look_at_width_rule(params, idle);
  look_at_lines(params, idle);
  look_at_rules(params, idle);
  if (params.weather) look_at_weather(*params.weather, idle);
  for (std::size_t i = 0; i < params.materials.size(); ++i)
    look_at_material(params.materials[i], "/materials/" + std::to_string(i), idle);
  return idle.take();
}

}  // namespace seedmesh::lsystem
