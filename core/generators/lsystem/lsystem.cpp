#include "core/generators/lsystem/lsystem.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/base/attempt.h"
#include "core/generators/lsystem/build_model.h"
#include "core/generators/lsystem/context_free_derivation.h"
#include "core/generators/lsystem/contours.h"
#include "core/generators/lsystem/draw.h"
#include "core/generators/lsystem/drawing_cache.h"
#include "core/generators/lsystem/fractional_iterations.h"
#include "core/generators/lsystem/growth.h"
#include "core/generators/lsystem/materials.h"
#include "core/generators/lsystem/open_systems.h"
#include "core/generators/lsystem/shape.h"
#include "core/generators/lsystem/shared_parts.h"
#include "core/generators/lsystem/surfaces.h"
#include "core/generators/lsystem/text.h"
#include "core/generators/lsystem/welded.h"
#include "core/generators/lsystem/word.h"
#include "core/generators/lsystem/word_warnings.h"
#include "core/schema/warning_list.h"

namespace seedmesh::lsystem {
namespace {

// largest word in the response of derive, in bytes
constexpr std::size_t longest_text = std::size_t{16} << 20U;
constexpr std::uint64_t most_appraised = 50'000;  // segments; drawing them takes milliseconds
// Models of this size are made in about ten milliseconds.
constexpr std::uint64_t most_made_modules = 50'000, most_made_triangles = 200'000;
constexpr std::uint64_t modules_a_line = 5;  // of most curves

Result<Grammar> compiled(const LsystemParams& params, const Job& job) {
  std::vector<Issue> issues;
  Grammar grammar = compile(params, job.seed(), job.limits(), issues, &job);
  if (!issues.empty()) return Error{Code::invalid, std::move(issues)};
  return grammar;
}

/// Returns the number of derivation steps: all iterations, or up to the age of the plant.
std::uint32_t steps_of(const LsystemParams& params) {
  if (!params.age || params.timed) return static_cast<std::uint32_t>(params.iterations);
  return math::to_uint32(std::ceil(*params.age));
}

/// Returns the share of the last step that has passed.
double share_of(const LsystemParams& params) {
  if (!params.age || params.timed) return 1;
  return 1 - (std::ceil(*params.age) - *params.age);
}

/// Returns the parameter that is responsible for an exceeded limit: the number of steps, or the axiom without
/// steps.
const char* pointer_of_size(const LsystemParams& params) {
  return steps_of(params) > 0 ? "/iterations" : "/axiom";
}

/// Refuses a request that is certain to exceed the limit, before memory is used.
void refuse_explosion(const Grammar& grammar, std::uint32_t steps, const Job& job) {
  const std::uint64_t least = least_modules(grammar, steps);
  if (least <= job.limits().modules) return;
  const std::string amount = least >= saturated ? "more than 4 * 10^18" : std::to_string(least);
  job.refuse(limit_issue({Resource::modules, job.limits().modules, least},
                         "the word has " + amount + " modules after " + std::to_string(steps) +
                             " steps; the limit is " + std::to_string(job.limits().modules),
                         "/iterations"));
}

/// Derives `steps` steps and passes every module of the last word to the sink, in order.
template <class Sink>
void run(const Grammar& grammar, const LsystemParams& params, std::uint32_t steps, Sink& sink, Job& job) {
  const bool keyed = Drawing::needs_keys(grammar, params);
  if (grammar.is_context_free()) {
    ContextFreeDerivation<Sink>(grammar, steps, keyed, job, sink).run();
    return;
  }
  const Word word = derive_word(grammar, steps, keyed, job);
  if constexpr (requires { sink.set_variables(word.variables); }) sink.set_variables(word.variables);
  const double nothing = 0;
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (i % 4096 == 0) job.check();
    sink.module(word.kind[i], word.parameter.empty() ? &nothing : word.parameter.data() + word.at[i],
                word.key.empty() ? 0 : word.key[i], word.born.empty() ? 0 : word.born[i]);
  }
}

template <class Sink>
void run(const Grammar& grammar, const LsystemParams& params, Sink& sink, Job& job) {
  run(grammar, params, steps_of(params), sink, job);
}

/// Draws the plant at its age.
void draw(const Grammar& grammar, const LsystemParams& params, Drawing& drawing,
          const GenerateContext& context) {
  Job& job = context.job;
  const double share = share_of(params);
  if (share == 1 && drawing.can_record() && DrawingCache::fits(grammar, params, steps_of(params))) {
    DrawingCache cache(grammar, params, steps_of(params), drawing, context);
    return run(grammar, params, cache, job);
  }
  if (share == 1) return run(grammar, params, drawing, job);
  const std::uint32_t whole = steps_of(params) - 1;
  FractionalStep fractional(grammar, drawing, whole, share);
  if (!grammar.productions.context) return run(grammar, params, whole, fractional, job);
  fractional.word(derive_word(grammar, whole, Drawing::needs_keys(grammar, params), job), job);
}

void write(const Word& word, TextWriter& writer) {
  const double nothing = 0;
  for (std::size_t i = 0; i < word.size(); ++i)
    writer.module(word.kind[i], word.parameter.empty() ? &nothing : word.parameter.data() + word.at[i]);
}

struct TextOnly {
  TextWriter& text;
  void module(KindId kind, const double* parameters, std::uint64_t /*key*/, std::uint32_t /*step*/) {
    text.module(kind, parameters);
  }
};

/// Writes the text and draws, in one pass.
struct TextAndDrawing {
  TextWriter& text;
  Drawing& drawing;
  void set_variables(const std::vector<double>& variables) { drawing.set_variables(variables); }
  void module(KindId kind, const double* parameters, std::uint64_t key, std::uint32_t step) {
    text.module(kind, parameters);
    drawing.module(kind, parameters, key, step);
  }
};

std::uint64_t drawn(const Grammar& grammar, const std::vector<std::uint64_t>& counts) {
  std::uint64_t segments = 0;
  for (std::size_t kind = 0; kind < counts.size(); ++kind) {
    const Command command = grammar.kinds[kind].command;
    if (command == Command::draw || command == Command::draw_plain)
      segments += std::min(saturated, counts[kind]);
  }
  return segments;
}

std::uint64_t branches(const Grammar& grammar, const std::vector<std::uint64_t>& counts) {
  std::uint64_t sum = 0;
  for (std::size_t kind = 0; kind < counts.size(); ++kind) {
    if (grammar.kinds[kind].command == Command::push) sum += std::min(saturated, counts[kind]);
  }
  return sum;
}

/// Refuses a drawing that is certain to exceed the limit. Other drawings are refused when they reach it.
void refuse_too_many_segments(const Grammar& grammar, const LsystemParams& params, Drawing& drawing,
                              const Job& job) {
  const std::uint64_t most = most_segments(params, job.limits());
  drawing.set_most_segments(most);
  const bool polygons = std::any_of(grammar.kinds.begin(), grammar.kinds.end(),
                                    [](const Kind& kind) { return kind.command == Command::polygon_open; });
  if (polygons || !grammar.interpretation.productions.empty())
    return;  // F can be a polygon vertex or invisible
  const std::uint64_t segments = drawn(grammar, exact_counts(grammar, steps_of(params)));
  if (segments > most) {
    job.refuse(limit_issue({Resource::segments, most, segments},
                           "draws " + std::to_string(segments) + " segments, which exceed the limit of " +
                               std::to_string(job.limits().triangles) +
                               " triangles; use fewer sides or the style lines",
                           "/iterations"));
  }
}

void warn_of_braces(const Drawing& drawing, std::vector<Warning>& warnings) {
  lsystem::warn_of_braces(drawing.open_polygons(), drawing.stray_closings(), warnings);
}

Json vector(const glm::dvec3& v) { return Json::array({v.x + 0.0, v.y + 0.0, v.z + 0.0}); }

Json described(const Turtle& turtle, const TurtleReport& report) {
  return {{"segments", report.segments},
          {"total_length", report.total_length},
          {"position", vector(turtle.position())},
          {"heading", vector(turtle.frame().heading)},
          {"left", vector(turtle.frame().left)},
          {"up", vector(turtle.frame().up)},
          {"bounds", {{"min", vector(report.min)}, {"max", vector(report.max)}}}};
}

/// Derives the plant for its word. For a fractional age, the drawing uses a second derivation of one step
/// fewer.
void grow_and_tell(Grammar& grammar, const LsystemParams& params, TextWriter& writer, Json& turtle,
                   const GenerateContext& context) {
  Job& job = context.job;
  OpenSystems systems(params, context);
  systems.grow(grammar, steps_of(params));
  write(systems.word(), writer);
  std::optional<OpenSystems> younger;
  if (share_of(params) != 1) younger.emplace(params, context).grow(grammar, steps_of(params) - 1);
  const OpenSystems& drawn_in = younger ? *younger : systems;
  Skeleton skeleton(job);
  Drawing drawing(grammar, params, drawn_in.cuts() ? &skeleton : nullptr, context);
  drawn_in.draw(grammar, drawing, share_of(params));
  warn_of_braces(drawing, grammar.warnings);
  turtle = described(drawing.turtle(), drawn_in.report(drawing.turtle(), skeleton));
}

}  // namespace

std::vector<Issue> check(const LsystemParams& params, const Limits& limits) {
  std::vector<Issue> issues;
  compile(params, 0, limits, issues);
  check_environment(params, issues);
  check_materials(params, issues);
  check_surfaces(params, issues);
  check_contours(params, issues);
  return issues;
}

Result<Model> generate(const LsystemParams& params, const GenerateContext& context) {
  Job& job = context.job;
  Result<Grammar> grammar = compiled(params, job);
  if (!grammar) return std::move(grammar).error();
  job.progress("derive", 0);
  if (has_shared_parts(*grammar, params, steps_of(params), context)) {
    const Job::PointerScope scope(job, pointer_of_size(params));
    Model model = shared_model(*grammar, params, steps_of(params), context);
    std::ranges::move(grammar->warnings, std::back_inserter(model.warnings));
    return model;
  }
  refuse_explosion(*grammar, steps_of(params), job);
  Skeleton skeleton(job);
  std::unique_ptr<OpenSystems> systems;
  {
    const Job::PointerScope scope(job, pointer_of_size(params));
    Drawing drawing(*grammar, params, &skeleton, context);
    if (OpenSystems::needed(*grammar, params)) {
      systems = std::make_unique<OpenSystems>(params, context);
      const double share = share_of(params);
      systems->grow(*grammar, share == 1 ? steps_of(params) : steps_of(params) - 1);
      drawing.set_most_segments(most_segments(params, job.limits()));
      systems->draw(*grammar, drawing, share);
      systems->cut(skeleton);
    } else {
      refuse_too_many_segments(*grammar, params, drawing, job);
      draw(*grammar, params, drawing, context);
    }
    warn_of_braces(drawing, grammar->warnings);
  }
  shape(skeleton, params, job);
  if (params.style == LsystemParams::Style::tubes) warn_of_thick(skeleton.limbs, grammar->warnings);
  job.progress("mesh", 0);
  Model model = build_model(std::move(skeleton), params, context);
  if (systems) systems->add_others(model);
  warn_of_welded(params, model.warnings);
  warn_of_whole(params, model.warnings);
  for (Warning& warning : grammar->warnings) model.warnings.push_back(std::move(warning));
  return model;
}

Result<Json> derive(const LsystemParams& params, const GenerateContext& context) {
  Job& job = context.job;
  Result<Grammar> grammar = compiled(params, job);
  if (!grammar) return std::move(grammar).error();
  const bool shares = has_shared_parts(*grammar, params, steps_of(params), context);
  if (!shares) refuse_explosion(*grammar, steps_of(params), job);
  Skeleton top(job);  // of a drawing with shared parts, without them
  Drawing drawing(*grammar, params, shares ? &top : nullptr, context);
  TextWriter writer(*grammar, longest_text);
  std::vector<std::uint64_t> counts;
  Json turtle;
  {
    const Job::PointerScope scope(job, pointer_of_size(params));
    if (OpenSystems::needed(*grammar, params)) {
      grow_and_tell(*grammar, params, writer, turtle, context);
      counts = writer.counts();
    } else if (is_plain(*grammar)) {
      if (shares) {
        measure_shared(*grammar, params, steps_of(params), drawing, context);
      } else {
        draw(*grammar, params, drawing, context);
      }
      const Array<char> text = plain_text(*grammar, steps_of(params), longest_text, job);
      writer.text.assign(text.begin(), text.end());
      counts = exact_counts(*grammar, steps_of(params));
    } else if (share_of(params) != 1) {
      TextOnly text{writer};
      run(*grammar, params, text, job);
      draw(*grammar, params, drawing, context);
      counts = writer.counts();
    } else {
      TextAndDrawing both{writer, drawing};
      run(*grammar, params, both, job);
      counts = writer.counts();
    }
  }
  if (turtle.is_null()) {
    turtle = described(drawing.turtle(), drawing.turtle().report());
    warn_of_braces(drawing, grammar->warnings);
  }
  std::map<std::string, std::uint64_t> by_symbol;
  std::uint64_t length = 0, bytes = 0;
  for (std::size_t kind = 0; kind < counts.size(); ++kind) {
    if (counts[kind] == 0) continue;
    by_symbol[grammar->kinds[kind].symbol] += counts[kind];
    length += counts[kind];
    bytes += counts[kind] * grammar->kinds[kind].symbol.size();
  }
  return Json{{"iterations", params.iterations},
              {"length", length},
              {"counts", by_symbol},
              {"truncated", writer.truncated || (is_plain(*grammar) && bytes > writer.text.size())},
              {"string", std::move(writer.text)},
              {"turtle", std::move(turtle)},
              {"warnings", warning_list(grammar->warnings)}};
}

/// Estimates tubes or welded bark from the drawn limbs, because their size depends on widths, bends and repeats.
static Estimate estimate_of_drawn(const Grammar& grammar, const LsystemParams& params, const Job& job) {
  Job own = job.for_estimate();
  Skeleton skeleton(own);
  const GenerateContext sketch{own};
  Drawing drawing(grammar, params, &skeleton, sketch);
  draw(grammar, params, drawing, sketch);
  shape(skeleton, params, own);
  return estimate_of(skeleton, params, own);
}

/// Generates a small model and counts it, because random choices, conditions or organs determine its size. Returns
/// nullopt for a model that takes longer than an estimate may.
static std::optional<Estimate> estimate_of_made(const LsystemParams& params, const GenerateContext& context) {
  Limits limits = context.job.limits();
  const std::uint64_t by_line = params.style == LsystemParams::Style::lines ? modules_a_line : 1;
  limits.modules = std::min(limits.modules, by_line * most_made_modules);
  limits.triangles = std::min(limits.triangles, most_made_triangles);
  Job own = context.job.for_small_estimate(limits);
  std::optional<Estimate> estimate;
  const bool is_small = attempt([&] {
    const Result<Model> model =
        generate(params, {own, {.textures = context.demand.textures}, context.generators});
    if (!model) return;
    estimate = estimate_of_made(*model, context.demand);
  });
  return is_small ? estimate : std::nullopt;
}

Result<Appraisal> appraise(const LsystemParams& params, const GenerateContext& context) {
  Job& job = context.job;
  Result<Grammar> grammar = compiled(params, job);
  if (!grammar) return std::move(grammar).error();
  Appraisal appraisal;
  appraisal.warnings = grammar->warnings;
  if (has_shared_parts(*grammar, params, steps_of(params), context)) return appraisal;
  warn_of_whole(params, appraisal.warnings);
  refuse_explosion(*grammar, steps_of(params), job);
  if (OpenSystems::needed(*grammar, params)) return appraisal;
  const std::vector<std::uint64_t> counts = exact_counts(*grammar, steps_of(params));
  const bool is_counted = !counts.empty() && grammar->interpretation.productions.empty();
  if (is_counted && share_of(params) == 1) warn_of_word(*grammar, counts, appraisal.warnings);
  // How many points lines share is known only when they are drawn.
  const bool is_lines = params.style == LsystemParams::Style::lines;
  if (!is_counted || !params.surfaces.empty() || (is_lines && drawn(*grammar, counts) <= most_made_modules))
    appraisal.estimate = estimate_of_made(params, context);
  if (is_counted && !appraisal.estimate) {
    const std::uint64_t segments = drawn(*grammar, counts);
    if (!is_lines && segments <= most_appraised) {
      appraisal.estimate = estimate_of_drawn(*grammar, params, job);
    } else if (is_lines || !params.weld) {
      appraisal.estimate = estimate_of(segments, std::min(segments, 1 + branches(*grammar, counts)), params);
    }
  }
  warn_of_welded(params, appraisal.warnings);
  return appraisal;
}

/// In written form, a frame is one parameter.
static Json arity_of(const CommandRow& row) {
  if (row.parameters == "(frame)") return Json::array({1, 1});
  if (row.parameters == "(frame,object)") return Json::array({2, 2});
  return Json::array({row.least, row.most});
}

Json vocabulary() {
  Json rows = Json::array();
  for (const CommandRow& row : commands()) {
    rows.push_back({{"symbol", row.symbol},
                    {"parameters", row.parameters},
                    {"arity", arity_of(row)},
                    {"text", row.text},
                    {"example", row.example}});
  }
  return {{"turtle", std::move(rows)}};
}

}  // namespace seedmesh::lsystem
