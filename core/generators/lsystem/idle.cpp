#include "core/generators/lsystem/idle.h"

#include <algorithm>
#include <string>

#include "generated/params/lsystem.h"

namespace seedmesh::lsystem {
namespace {

/// Defaults are not told from what is left out.
class Finder {
 public:
  Finder(const LsystemParams& params, std::vector<Warning>& warnings) : p_(params), warnings_(warnings) {}

  void run() {
    look_at_width_rule();
    look_at_lines();
    look_at_rules();
    if (p_.weather) look_at_weather(*p_.weather);
    for (std::size_t i = 0; i < p_.materials.size(); ++i)
      look_at_material(p_.materials[i], "/materials/" + std::to_string(i));
  }

 private:
  void warn_if(bool is_idle, std::string pointer, const std::string& reason) {
    if (is_idle) warnings_.push_back({std::move(pointer), "has no effect: " + reason, 0, 0});
  }

  void look_at_width_rule() {
    using Rule = LsystemParams::WidthRule;
    const auto warn = [&](const char* name, bool is_given, std::initializer_list<Rule> rules) {
      std::string owners;
      for (const Rule each : rules) owners += (owners.empty() ? "" : " and ") + std::string(text_of(each));
      warn_if(is_given && std::find(rules.begin(), rules.end(), p_.width_rule) == rules.end(),
              std::string("/") + name,
              "it belongs to the width rule" + std::string(rules.size() > 1 ? "s " : " ") + owners +
                  ", and the rule is " + std::string(text_of(p_.width_rule)));
    };
    warn("width_factor", p_.width_factor != defaults_.width_factor, {Rule::branch_factor});
    warn("tip_width", p_.tip_width != defaults_.tip_width, {Rule::longest_chain, Rule::pipe_model});
    warn("pipe_exponent", p_.pipe_exponent != defaults_.pipe_exponent, {Rule::pipe_model});
  }

  void look_at_lines() {
    if (p_.style != LsystemParams::Style::lines) return;
    const std::string reason = "it belongs to the style tubes, and the style is lines";
    warn_if(p_.sides != defaults_.sides, "/sides", reason);
    warn_if(p_.stacks != defaults_.stacks, "/stacks", reason);
    warn_if(p_.adapt, "/adapt", reason);
  }

  void look_at_rules() {
    warn_if(p_.decomposition.empty() && p_.decomposition_depth != defaults_.decomposition_depth,
            "/decomposition_depth", "there is no `decomposition`");
    warn_if(p_.interpretation.empty() && p_.interpretation_depth != defaults_.interpretation_depth,
            "/interpretation_depth", "there is no `interpretation`");
  }

  void look_at_weather(const LsystemWeather& weather) {
    const LsystemWeather calm;
    warn_if(weather.wind == 0 && weather.direction != calm.direction, "/weather/direction", "`wind` is 0");
    warn_if(
        weather.wind == 0 && weather.rain == 0 && weather.snow == 0 && weather.stiffness != calm.stiffness,
        "/weather/stiffness", "there is neither `wind` nor `rain` nor `snow`");
  }

  void look_at_material(const LsystemMaterial& material, const std::string& pointer) {
    const auto& images = material.images;
    const bool has_image = !images.color.empty(), is_given = material.texture_seed != 0;
    warn_if(is_given && has_image, pointer + "/texture_seed", "the image `images.color` takes its place");
    warn_if(is_given && !has_image && material.texture == LsystemTexture::none, pointer + "/texture_seed",
            "there is no `texture`");
    warn_if(images.cut_out && !has_image && images.normal.empty() && images.surface.empty(),
            pointer + "/images/cut_out", "there is no image");
  }

  const LsystemParams& p_;
  const LsystemParams defaults_;
  std::vector<Warning>& warnings_;
};

}  // namespace

void warn_of_idle(const LsystemParams& params, std::vector<Warning>& warnings) {
  Finder(params, warnings).run();
}

}  // namespace seedmesh::lsystem
