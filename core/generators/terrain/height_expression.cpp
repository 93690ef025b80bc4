#include "core/generators/terrain/height_expression.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <deque>

#include "core/base/math.h"

namespace seedmesh::terrain {
namespace {

constexpr std::size_t most_calls = 64;  // of noise functions in one expression
constexpr int most_octaves = 16;

struct NoiseName {
  std::string_view name;
  NoiseKind kind;
  bool has_octaves;
};
constexpr std::array<NoiseName, 4> noise_names{{{"noise", NoiseKind::rolling, false},
                                                {"fbm", NoiseKind::rolling, true},
                                                {"ridged", NoiseKind::ridged, true},
                                                {"billow", NoiseKind::billow, true}}};

const NoiseName* noise_named(const lang::Token& token) {
  if (token.kind != lang::TokenKind::name) return nullptr;
  const auto* const found = std::ranges::find(noise_names, token.text, &NoiseName::name);
  return found == noise_names.end() ? nullptr : found;
}

}  // namespace

/// The text while its noise calls are replaced by names, the last call first, so that inner calls come before outer ones.
struct HeightExpression::Source {
  std::vector<lang::Token> tokens;
  lang::Names names;
  std::vector<lang::TextError>& errors;
  std::deque<std::string> call_names;  ///< tokens point to them
};

HeightExpression::HeightExpression(std::string_view text, lang::Names names, std::uint32_t slots,
                                   std::vector<lang::TextError>& errors)
    : slots_(slots) {
  const std::size_t before = errors.size();
  Source source{lang::tokenize(text, 0, text.size(), errors), std::move(names), errors, {}};
  for (const lang::Token& token : source.tokens) {
    if (token.kind == lang::TokenKind::name) used_.emplace_back(token.text);
  }
  take_noise_calls(source);
  if (errors.size() > before) return;
  std::size_t at = 0;
  height_ = program_.parse(source.tokens, at, source.names, errors);
  if (errors.size() == before && source.tokens[at].kind != lang::TokenKind::end) {
    errors.push_back({source.tokens[at].offset, "found " + lang::in_quotes(source.tokens[at]) +
                                                    ", expected an operator or the end of the expression"});
  }
}

void HeightExpression::take_noise_calls(Source& source) {
  for (std::size_t at = source.tokens.size(); at-- > 0;) {
    const bool is_call = noise_named(source.tokens[at]) != nullptr && at + 1 < source.tokens.size() &&
                         lang::is_symbol(source.tokens[at + 1], "(");
    if (is_call && !take_call(source, at)) return;
  }
}

/// Replaces the call at a token by a name for its value. False after an error.
bool HeightExpression::take_call(Source& source, std::size_t at) {
  std::vector<lang::Token>& tokens = source.tokens;
  if (calls_.size() == most_calls) {
    source.errors.push_back({tokens[at].offset,
                             "found more than " + std::to_string(most_calls) + " calls of noise functions",
                             IssueKind::out_of_range});
    return false;
  }
  std::vector<lang::Expression> arguments;
  const std::size_t before = source.errors.size();
  std::size_t now = at + 2;
  while (true) {
    arguments.push_back(program_.parse(tokens, now, source.names, source.errors));
    if (source.errors.size() > before) return false;
    if (lang::is_symbol(tokens[now], ")")) break;
    if (!lang::is_symbol(tokens[now], ",")) {
      source.errors.push_back({tokens[now].offset, "found " + lang::in_quotes(tokens[now]) +
                                                       ", expected an operator, `,` or `)`"});
      return false;
    }
    ++now;
  }
  if (!check_call(source, at, std::move(arguments))) return false;
  // No text can contain this name.
  source.call_names.push_back("\x01" + std::to_string(calls_.size()));
  const std::string& name = source.call_names.back();
  source.names.bind_slot(name, slots_ + static_cast<std::uint32_t>(calls_.size()) - 1);
  tokens[at].text = name;
  tokens[at].length = name.size();
  tokens.erase(tokens.begin() + static_cast<std::ptrdiff_t>(at) + 1,
               tokens.begin() + static_cast<std::ptrdiff_t>(now) + 1);
  return true;
}

bool HeightExpression::check_call(Source& source, std::size_t at, std::vector<lang::Expression> arguments) {
  const lang::Token& called = source.tokens[at];
  const NoiseName& function = *noise_named(called);
  const std::size_t more = function.has_octaves ? 1 : 0;
  if (arguments.size() < 2 + more || arguments.size() > 3 + more) {
    source.errors.push_back({called.offset,
                             lang::in_quotes(called) + " takes " + (more > 0 ? "3 or 4" : "2 or 3") +
                                 " arguments, found " + std::to_string(arguments.size()),
                             IssueKind::out_of_range});
    return false;
  }
  NoiseCall call{function.kind, 1, {}};
  if (function.has_octaves) {
    const lang::Expression& octaves = arguments.back();
    const bool is_valid = octaves.is_constant && octaves.value >= 1 && octaves.value <= most_octaves &&
                          octaves.value == static_cast<double>(math::to_int64(octaves.value));
    if (!is_valid) {
      source.errors.push_back({called.offset,
                               "the last argument of " + lang::in_quotes(called) +
                                   " is the number of octaves, expected a constant whole number from 1 to " +
                                   std::to_string(most_octaves),
                               IssueKind::out_of_range});
      return false;
    }
    call.octaves = math::to_int32(octaves.value);
    arguments.pop_back();
  }
  call.position = std::move(arguments);
  calls_.push_back(std::move(call));
  return true;
}

bool HeightExpression::draws() const {
  if (program_.draws(height_)) return true;
  return std::ranges::any_of(calls_, [&](const NoiseCall& call) {
    return std::ranges::any_of(call.position, [&](const lang::Expression& e) { return program_.draws(e); });
  });
}

bool HeightExpression::uses(std::string_view name) const {
  return std::ranges::find(used_, name) != used_.end();
}

HeightRows::HeightRows(const HeightExpression& expression, Rng noise)
    : expression_(expression),
      noise_(noise),
      height_(expression.program_, expression.height_),
      rows_(expression.slots_ + expression.calls_.size(), nullptr),
      coordinates_(3 * lang::RowEvaluator::width) {
  for (std::size_t i = 0; i < expression.calls_.size(); ++i) {
    const HeightExpression::NoiseCall& call = expression.calls_[i];
    Noise& own = calls_.emplace_back();
    own.plan.kind = call.kind;
    own.plan.octaves = call.octaves;
    own.plan.amplitude = 1;
    for (const lang::Expression& each : call.position) own.position.emplace_back(expression.program_, each);
    own.value.resize(lang::RowEvaluator::width);
  }
  for (std::size_t i = 0; i < calls_.size(); ++i) rows_[expression.slots_ + i] = calls_[i].value.data();
}

void HeightRows::fill(Noise& noise, std::size_t count, std::span<Rng> rngs) {
  constexpr std::size_t width = lang::RowEvaluator::width;
  double* const x = coordinates_.data();
  for (std::size_t i = 0; i < noise.position.size(); ++i)
    noise.position[i].run(rows_, count, rngs, x + i * width);
  if (noise.position.size() == 2)
    return noise_in_plane(noise.plan, {x, count}, {x + width, count}, noise_, noise.value.data());
  SpaceNoise in_space(noise.plan, noise_);
  for (std::size_t i = 0; i < count; ++i)
    noise.value[i] = in_space.at({x[i], x[width + i], x[2 * width + i]});
}

void HeightRows::run(std::span<const double* const> slots, std::size_t count, std::span<Rng> rngs,
                     double* out) {
  std::copy_n(slots.begin(), std::min(slots.size(), std::size_t{expression_.slots_}), rows_.begin());
  for (Noise& each : calls_) fill(each, count, rngs);
  height_.run(rows_, count, rngs, out);
}

std::string error_about_name(std::string_view behind, bool is_plane) {
  struct Row {
    std::string_view name;
    const char* on_plane;
    const char* on_sphere;  ///< null: the name is known there
  };
  static constexpr const char *of_layers = "only the expressions of layers have it",
                              *of_spheres = "only the shape sphere has it";
  static constexpr Row rows[] = {{"z", "a plane has x, to the east, and y, to the north", nullptr},
                                 {"latitude", of_spheres, nullptr},
                                 {"longitude", of_spheres, nullptr},
                                 {"slope", of_layers, "a sphere has no slope"},
                                 {"height", of_layers, of_layers}};
  for (const auto& [name, on_plane, on_sphere] : rows) {
    const char* const reason = is_plane ? on_plane : on_sphere;
    const auto next = static_cast<unsigned char>(behind.size() > name.size() ? behind[name.size()] : ' ');
    const bool is_name = behind.starts_with(name) && next != '_' && next != '(' && std::isalnum(next) == 0;
    if (is_name && reason) return "unknown name " + lang::in_quotes(name) + "; " + reason;
  }
  return "";
}

}  // namespace seedmesh::terrain
