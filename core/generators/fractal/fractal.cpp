#include "core/generators/fractal/fractal.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/attempt.h"
#include "core/base/math.h"
#include "core/generators/estimate.h"
#include "core/generators/fractal/chaos.h"
#include "core/generators/fractal/check.h"
#include "core/generators/fractal/element.h"
#include "core/generators/fractal/escape.h"
#include "core/generators/fractal/faces.h"
#include "core/generators/fractal/measure.h"
#include "core/generators/fractal/merged.h"
#include "core/generators/fractal/pieces.h"
#include "core/generators/fractal/scenes.h"
#include "core/generators/fractal/topology.h"
#include "core/generators/unused.h"
#include "core/schema/warning_list.h"
#include "generated/params/fractal.h"
#include "generated/params/fractal_unused.h"

namespace seedmesh::fractal {
namespace {

/// The lattice, if the surface is made of its cells.
std::optional<Lattice> visible_lattice(const FractalParams& params, const Instructions& instructions) {
  if (!is_cube(params) || params.surface == FractalSurface::pieces) return std::nullopt;
  return lattice_of(instructions);
}

/// Large numbers are rounded.
std::string number_of_triangles(double wanted) {
  constexpr double exact = 1e15;
  if (!std::isfinite(wanted)) return "more than 1e+300";
  if (wanted < exact) return number_text(wanted);
  std::array<char, 32> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), wanted, std::chars_format::scientific, 1);
  return "about " + std::string(text.data(), end.ptr);
}

/// Throws Stop before the grid is made, if the number of squares is known in closed form.
void refuse_too_many_squares(const Lattice& lattice, int rounds, const Job& job) {
  const auto limit = static_cast<double>(job.limits().triangles);
  const auto triangles = [&](int after) { return 2 * exposed_quads(lattice, after).value_or(0); };
  const auto keep = [&](int after) { return triangles(after) <= limit; };  // false for NaN
  if (keep(rounds)) return;
  int fewer = rounds;
  while (fewer > 0 && !keep(fewer)) --fewer;
  const double wanted = triangles(rounds);
  job.refuse(limit_issue(
      {Resource::triangles, job.limits().triangles, static_cast<std::uint64_t>(math::to_int64(wanted))},
      "needs " + number_of_triangles(wanted) + " triangles after " + std::to_string(rounds) +
          " rounds; the limit is " + std::to_string(job.limits().triangles) + ", which " +
          std::to_string(fewer) + " rounds keep",
      "/iterations"));
}

void scale_mesh(Solid& solid, double size) {
  solid.origin *= size;
  solid.cell *= size;
}

/// What all stages of a copy machine have in common.
struct CopyMachine {
  const FractalParams& params;
  Instructions instructions;
  Element element;
};

/// Adds one stage of a copy machine. Returns the number of edges at which four faces meet.
std::uint64_t add_stage(Model& model, int parent, const CopyMachine& machine, int rounds, Job& job) {
  const auto& [params, instructions, element] = machine;
  if (params.smallest > 0) {
    add_divided(model, parent, instructions, element, {rounds, params.size, params.smallest}, job);
    return 0;
  }
  const std::optional<Lattice> lattice = visible_lattice(params, instructions);
  if (!lattice) {
    add_pieces(model, parent, instructions, element, {rounds, params.size}, job);
    return 0;
  }
  const bool merges = params.surface == FractalSurface::merged;
  if (!merges) refuse_too_many_squares(*lattice, rounds, job);
  Solid solid = solid_of(*lattice, rounds, job);
  scale_mesh(solid, params.size);
  const SideColors sides = rainbow();
  const SideColors* colors = is_named(params, FractalElement::rainbow_cube) ? &sides : nullptr;
  const std::uint64_t edges = count_elements(solid.by_x, job).four_face_edges;
  add_mesh(model, parent, "cells",
           merges ? merged_faces(solid, colors, job) : exposed_faces(solid, colors, job));
  return edges;
}

Result<Model> generate_copies(const FractalParams& params, const GenerateContext& context) {
  Job& job = context.job;
  Result<Element> element = element_of(params, context);
  if (!element) return std::move(element).error();
  job.progress("mesh", 0);
  Model model;
  model.name = "fractal";
  model.materials = std::move(element->materials);
  model.warnings = std::move(element->warnings);
  const CopyMachine machine{params, instructions_of(params), *std::move(element)};
  std::uint64_t edges = 0;
  if (is_named(params, FractalElement::plate)) {
    each_stage(model, params, params.iterations, job, [&](int node, std::int64_t rounds) {
      add_mesh(model, node, "plate", koch_plate(static_cast<int>(rounds), params.size, job));
    });
    return model;
  }
  each_stage(model, params, params.iterations, job, [&](int node, std::int64_t rounds) {
    edges = add_stage(model, node, machine, static_cast<int>(rounds), job);
  });
  if (edges > 0) model.extras.push_back({"non_manifold_edges", std::to_string(edges)});
  return model;
}

Result<Model> generate_cloud(const FractalParams& params, const GenerateContext& context) {
  Job& job = context.job;
  const Instructions instructions = instructions_of(params);
  Model model;
  model.name = "fractal";
  std::vector<Primitive> element;
  if (params.cloud == FractalCloud::elements) {
    Result<Element> made = element_of(params, context);
    if (!made) return std::move(made).error();
    model.materials = std::move(made->materials);
    model.warnings = std::move(made->warnings);
    element = std::move(made->primitives);
  } else {
    model.materials.push_back(plain_material(params));
    model.materials.back().unlit = params.cloud == FractalCloud::points;
  }
  const Result<StartPoints> start = start_of(params, context);
  if (!start) return start.error();
  each_stage(model, params, params.points, job, [&](int node, std::int64_t count) {
    Cloud cloud = play(instructions, *start, static_cast<std::uint64_t>(count),
                       static_cast<std::uint32_t>(params.drop), job);
    job.progress("mesh", 0);
    for (glm::vec3& p : cloud.position) p *= static_cast<float>(params.size);
    add_cloud(model, node, params, std::move(cloud), element, job);
  });
  return model;
}

Result<Model> generate_escape(const FractalParams& params, Job& job) {
  job.progress("derive", 0);
  const EscapeField field = escape_field(params, job);
  job.progress("mesh", 0);
  Model model;
  model.name = "fractal";
  model.materials.push_back(plain_material(params));
  Node& node = model.nodes.emplace_back();
  node.name = "fractal";
  add_mesh(model, 0, "plate", escape_plate(params, field, job));
  return model;
}

/// Null if there is no number, or if it is infinite.
Json number_or_null(const std::optional<double>& number) {
  return number && std::isfinite(*number) ? Json(*number) : Json(nullptr);
}

Result<Model> generate_by_method(const FractalParams& params, const GenerateContext& context) {
  Job& job = context.job;
  switch (params.method) {
    case FractalMethod::frcm:
      return generate_cloud(params, context);
    case FractalMethod::escape:
      return generate_escape(params, job);
    default:
      return generate_copies(params, context);
  }
}

Json vector(const glm::vec3& v) { return Json::array({v.x + 0.0F, v.y + 0.0F, v.z + 0.0F}); }

/// Figures of one stage: after a number of rounds, or of points.
Measure measure_stage(const FractalParams& params, const StartPoints& start, std::int64_t amount, Job& job) {
  Measure result;
  if (params.method == FractalMethod::escape) {
    const auto side = static_cast<double>(params.escape.resolution);
    result.pieces = side * side;
    return result;
  }
  const Instructions instructions = instructions_of(params);
  const bool is_copied = params.method == FractalMethod::mrcm;
  if (is_copied && params.smallest > 0)
    return measure_divided(params, instructions, static_cast<int>(amount), job);
  result = measure(params, instructions, is_copied ? static_cast<int>(amount) : 0, job);
  if (is_copied) return result;
  const Cloud cloud = play(instructions, start, static_cast<std::uint64_t>(amount),
                           static_cast<std::uint32_t>(params.drop), job);
  const std::optional<double> dimension = result.dimension;
  result = {};
  result.pieces = static_cast<double>(amount);
  result.dimension = dimension;
  result.bounds = bounds_of(cloud.position.span());
  return result;
}

Json json_of(const Measure& measured) {
  Json bounds = nullptr;
  if (measured.bounds)
    bounds = {{"min", vector(measured.bounds->min)}, {"max", vector(measured.bounds->max)}};
  return Json{{"pieces", number_or_null(measured.pieces)},
              {"points", number_or_null(measured.points)},
              {"dimension", number_or_null(measured.dimension)},
              {"exposed_quads", number_or_null(measured.exposed_quads)},
              {"surface_area", number_or_null(measured.surface_area)},
              {"volume", number_or_null(measured.volume)},
              {"genus", number_or_null(measured.genus)},
              {"non_manifold_edges", number_or_null(measured.non_manifold_edges)},
              {"length", number_or_null(measured.length)},
              {"area", number_or_null(measured.area)},
              {"bounds", std::move(bounds)}};
}

std::vector<std::int64_t> stages_of(const FractalParams& params, std::int64_t otherwise) {
  if (params.stages.empty()) return {otherwise};
  return {params.stages.begin(), params.stages.end()};
}

/// Does every map have a volume? Flat copies have fewer triangles than the element.
bool presses_nothing_flat(const Instructions& instructions) {
  return std::ranges::none_of(instructions.maps,
                              [](const Affine& map) { return glm::determinant(map.linear) == 0; });
}

/// Triangles and bytes of one stage.
Estimate estimate_stage(const FractalParams& params, const Instructions& instructions, const Element& element,
                        int rounds, const Job& job) {
  if (params.smallest > 0) {
    const DividedCount count =
        count_divided(instructions, element, {rounds, params.size, params.smallest}, job);
    return {count.elements * element.elements, count.elements * element.bytes + 12 * count.points + 1000,
            presses_nothing_flat(instructions)};
  }
  if (const std::optional<Lattice> lattice = visible_lattice(params, instructions)) {
    refuse_too_many_squares(*lattice, rounds, job);
    const std::optional<double> squares = exposed_quads(*lattice, rounds);
    const std::uint64_t count =
        squares ? static_cast<std::uint64_t>(*squares) : count_exposed(solid_of(*lattice, rounds, job), job);
    // Vertices at edges are doubled for their texture coordinates; measured on the presets.
    constexpr std::uint64_t bytes_a_square = 100;
    return {2 * count, bytes_a_square * count + 1000, true};
  }
  const Plan plan = plan_of(instructions, element, rounds, job);
  const bool has_triangles = std::ranges::all_of(
      element.primitives, [](const Primitive& p) { return p.mesh.topology == Topology::triangles; });
  const std::uint64_t elements = static_cast<std::uint64_t>(plan.pieces) * element.elements;
  // The pipeline adds texture coordinates to elements without: 8 bytes to 24 of a vertex and those of its indices.
  const std::uint64_t bytes = has_triangles ? plan.bytes * 5 / 4 : plan.bytes;
  return {has_triangles ? elements : 0, bytes + 1000, presses_nothing_flat(instructions)};
}

/// The bytes of a small model, which is made, because copies share vertices in ways that the maps do not tell.
std::optional<std::uint64_t> bytes_of_small(const FractalParams& params, const Estimate& planned,
                                            const GenerateContext& context) {
  constexpr std::uint64_t most_triangles = 100'000, most_bytes = 3'000'000, bytes_a_node = 130;
  if (planned.triangles > most_triangles || planned.bytes > most_bytes) return std::nullopt;
  Job own = context.job.for_small_estimate(context.job.limits());
  std::optional<std::uint64_t> bytes;
  const bool is_made = attempt([&] {
    const Result<Model> model = generate_copies(params, {own, context.demand, context.generators, {}});
    if (!model) return;
    std::uint64_t nodes = model->nodes.size();
    for (const Node& node : model->nodes) nodes += node.instances.transforms.size();
    bytes = estimate_of_made(*model, context.demand).bytes + bytes_a_node * nodes;
  });
  return is_made ? bytes : std::nullopt;
}

Result<Appraisal> appraise_copies(const FractalParams& params, const GenerateContext& context) {
  Job& job = context.job;
  Appraisal appraisal;
  const Instructions instructions = instructions_of(params);
  Result<Element> element = element_of(params, context);
  if (!element) return std::move(element).error();
  appraisal.warnings = std::move(element->warnings);
  if (is_named(params, FractalElement::plate)) return appraisal;
  const bool is_merged = params.surface == FractalSurface::merged && params.smallest == 0;
  if (is_merged && visible_lattice(params, instructions)) return appraisal;
  Estimate sum{0, 0, true};
  for (const std::int64_t rounds : stages_of(params, params.iterations)) {
    const Estimate stage = estimate_stage(params, instructions, *element, static_cast<int>(rounds), job);
    sum = {sum.triangles + stage.triangles, sum.bytes + stage.bytes, sum.exact && stage.exact};
  }
  sum.bytes = bytes_of_small(params, sum, context).value_or(sum.bytes);
  appraisal.estimate = sum;
  return appraisal;
}

/// For clouds of points and reliefs. The size of other clouds is not known before they are made.
Appraisal appraise_others(const FractalParams& params, const Job& job) {
  Appraisal appraisal;
  if (params.method == FractalMethod::escape) {
    const auto n = static_cast<std::uint64_t>(params.escape.resolution);
    constexpr std::uint64_t bytes_a_sample =
        78;  // with the walls and the vertices doubled for texture coordinates
    appraisal.estimate = Estimate{2 * (n - 1) * (n - 1) + 12 * (n - 1), bytes_a_sample * n * n, true};
  } else if (params.cloud == FractalCloud::points) {
    std::uint64_t points = 0;
    for (const std::int64_t count : stages_of(params, params.points))
      points += static_cast<std::uint64_t>(count);
    if (points > job.limits().triangles) {
      job.refuse(limit_issue({Resource::points, job.limits().triangles, points},
                             "needs " + std::to_string(points) + " points; the limit is " +
                                 std::to_string(job.limits().triangles),
                             "/points"));
    }
    appraisal.estimate = Estimate{0, 16 * points + 1000, true};
  }
  return appraisal;
}

}  // namespace

std::vector<Issue> check(const FractalParams& params, const Limits& limits) {
  std::vector<Issue> issues = check_instructions(params);
  check_element(params, issues);
  check_stages(params, issues);
  if (static_cast<std::uint32_t>(params.iterations) > limits.iterations)
    issues.push_back(iterations_issue(static_cast<std::uint64_t>(params.iterations), limits));
  return issues;
}

std::vector<Warning> warnings_of(const FractalParams& params) {
  std::vector<Warning> warnings = warnings_of(unused_parameters(params));
  if (auto warning = warning_of_weights(params)) warnings.push_back(*std::move(warning));
  // Whether maps fill a lattice is more than x-applies-when can say.
  const bool is_merged = params.method == FractalMethod::mrcm && params.surface == FractalSurface::merged &&
                         params.smallest == 0;
  if (is_merged && !visible_lattice(params, instructions_of(params))) {
    warnings.push_back(
        {"/surface", "`surface` has no effect unless the maps fill cells of a lattice with cubes.", 0, 0});
  }
  return warnings;
}

Result<Model> generate(const FractalParams& params, const GenerateContext& context) {
  Job& job = context.job;
  job.progress("derive", 0);
  Result<Model> model = generate_by_method(params, context);
  if (!model) return model;
  const std::vector<Warning> unused = warnings_of(params);
  model->warnings.insert(model->warnings.begin(), unused.begin(), unused.end());
  return model;
}

Result<Json> derive(const FractalParams& params, const GenerateContext& context) {
  Job& job = context.job;
  const bool is_copied = params.method == FractalMethod::mrcm;
  const Result<StartPoints> start = is_copied ? StartPoints() : start_of(params, context);
  if (!start) return start.error();
  Json answer = json_of(measure_stage(params, *start, is_copied ? params.iterations : params.points, job));
  Json stages = Json::array();
  for (const std::int64_t amount : params.stages) {
    Json stage = json_of(measure_stage(params, *start, amount, job));
    stage[is_copied ? "iterations" : "points"] = amount;
    stages.push_back(std::move(stage));
  }
  answer["stages"] = std::move(stages);
  answer["warnings"] = warning_list(warnings_of(params));
  return answer;
}

Result<Appraisal> appraise(const FractalParams& params, const GenerateContext& context) {
  Job& job = context.job;
  Job own = job.for_child(job.seed());
  Result<Appraisal> appraisal = params.method == FractalMethod::mrcm
                                    ? appraise_copies(params, {own, {}, context.generators})
                                    : appraise_others(params, job);
  if (!appraisal) return appraisal;
  const std::vector<Warning> unused = warnings_of(params);
  appraisal->warnings.insert(appraisal->warnings.begin(), unused.begin(), unused.end());
  return appraisal;
}

Json vocabulary() {
  Json rows = Json::array();
  for (int i = 0; i <= static_cast<int>(FractalInstructions::koch_snowflake); ++i) {
    FractalParams params;
    params.instructions = static_cast<FractalInstructions>(i);
    const Instructions instructions = instructions_of(params);
    rows.push_back({{"name", instructions.name},
                    {"maps", instructions.maps.size()},
                    {"lattice", lattice_of(instructions).has_value()}});
  }
  return {{"instructions", std::move(rows)}};
}

}  // namespace seedmesh::fractal
