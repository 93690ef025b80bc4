#include "core/generators/building/building.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/generators/building/bodies.h"
#include "core/generators/building/check.h"
#include "core/generators/building/collision.h"
#include "core/generators/building/derive.h"
#include "core/generators/building/estimate.h"
#include "core/generators/building/figure_shapes.h"
#include "core/generators/building/footprint.h"
#include "core/generators/building/shapes_json.h"
#include "core/generators/building/split_mesh.h"
#include "core/generators/building/unused.h"
#include "core/generators/child.h"
#include "core/geom/mesh/flatten.h"
#include "core/gltf/read/read.h"
#include "core/model/build.h"
#include "core/model/levels.h"
#include "core/schema/warning_list.h"
#include "generated/params/building.h"

namespace seedmesh::building {
namespace {

constexpr std::size_t most_listed = 100'000;  ///< shapes in the answer of derive
constexpr std::string_view lod_attribute = "lod";

/// The intermediate results between parameters and shapes.
struct Work {
  std::shared_ptr<const RuleSet> rules;  ///< of a shape grammar, once it is derived, the names
  FigureGrammar figures;                 ///< where there is a shape grammar
  std::vector<AssetBox> boxes;
  std::vector<Asset> assets;
  Model model;  ///< materials and textures of assets, and warnings
};

/// With the prepared rules, if the context has those of the parameters.
Work work_of(const BuildingParams& params, const GenerateContext& context) {
  auto prepared = std::static_pointer_cast<const RuleSet>(context.prepared);
  if (prepared && !has_rules_of(*prepared, params)) prepared = nullptr;
  Work work;
  work.rules = std::move(prepared);
  return work;
}

/// `name` has to outlive the work.
void add_asset(Work& work, const std::string& name, Model own, Job& job) {
  Asset asset;
  asset.primitives = flatten(own, job);
  if (std::erase_if(asset.primitives,
                    [](const Primitive& p) { return p.mesh.topology != Topology::triangles; }) > 0)
    own.warnings.push_back({"/assets/" + name, "the asset has lines or points, which are left out", 0, 0});
  const int materials = move_materials(work.model, own);
  glm::dvec3 low(1e300), high(-1e300);
  for (Primitive& primitive : asset.primitives) {
    if (primitive.material >= 0) {
      primitive.material += materials;
    } else {
      primitive.material = static_cast<int>(work.model.materials.size());
      work.model.materials.emplace_back().name = name;
    }
    const Box box = bounds_of(primitive.mesh.position.span());
    low = glm::min(low, glm::dvec3(box.min));
    high = glm::max(high, glm::dvec3(box.max));
  }
  if (asset.primitives.empty()) low = high = glm::dvec3(0);
  asset.low = low;
  asset.size = high - low;
  work.boxes.push_back({name, asset.low, asset.size});
  work.assets.push_back(std::move(asset));
}

std::optional<Error> add_assets(Work& work, const BuildingParams& params, const GenerateContext& context) {
  Job& job = context.job;
  for (const auto& [name, given] : params.assets) {
    Result<Model> own = given.model ? generate_child(*given.model, "/assets/" + name + "/model",
                                                     job.rng().at("asset").at(name), context)
                                    : read_glb(*given.glb, "/assets/" + name + "/glb", job);
    if (!own) return std::move(own).error();
    add_asset(work, name, std::move(*own), job);
  }
  for (const PartRow& row : part_rows()) {
    work.boxes.push_back({row.name, glm::dvec3(0), row.size});
    Asset asset;
    asset.size = row.size;
    asset.row = &row;
    work.assets.push_back(std::move(asset));
  }
  return std::nullopt;
}

/// Options of one derivation besides the request.
struct DerivationOptions {
  std::optional<double> lod;
  bool is_listed = false;
  std::uint64_t most_shapes = ~std::uint64_t{0};
};

Shapes shapes_of(Work& work, const BuildingParams& params, const GenerateContext& context,
                 const DerivationOptions& options = {}) {
  Job& job = context.job;
  if (params.shape_grammar) {
    const bool is_parallel = params.derivation.mode == BuildingMode::parallel;
    const DerivedFigure derived =
        derive_figure(*params.shape_grammar, work.figures, params.iterations, is_parallel, job);
    auto names = std::make_shared<RuleSet>();
    names->text = rule_text("");
    names->grammar = grammar_of_names(work.figures);
    work.rules = std::move(names);
    return shapes_of_figure(work.figures, derived, *params.shape_grammar, job);
  }
  Task plan;
  const Grammar& grammar = work.rules->grammar;
  Texts texts = grammar.texts;
  plan.grammar = &grammar;
  plan.texts = &texts;
  plan.text = &work.rules->text;
  plan.roofs = work.rules->roofs.get();
  plan.tables = &params.tables;
  plan.files = file_names(params);
  plan.is_blueprint = !params.rules;
  Solid footprint;
  if (!params.footprint.empty()) {
    footprint = footprint_of(params.footprint, plan.origin, plan.size);
    plan.footprint = &footprint;
  } else {
    plan.size = {params.size[0], params.size[1], params.size[2]};
    plan.origin = {-0.5 * plan.size.x, 0, -0.5 * plan.size.z};
  }
  for (const auto& [name, given] : params.attributes) plan.attributes.emplace(name, value_of(texts, given));
  const EditTree edits = edits_of(params, grammar, texts);
  plan.edits = &edits;
  if (options.lod) plan.attributes[std::string(lod_attribute)] = {*options.lod, 0};
  plan.most_shapes = options.most_shapes;
  plan.keeps_choices = options.is_listed;
  plan.keeps_masses = context.demand.collision != CollisionNames::none;
  if (params.iterations) plan.iterations = *params.iterations;
  plan.has_strict_weights = params.weights == BuildingWeights::strict;
  plan.stays_inside = params.restrict == BuildingRestrict::split;
  plan.is_sequential = params.derivation.mode == BuildingMode::sequential;
  plan.is_depth_first = params.derivation.order == BuildingOrder::depth;
  if (params.repeat)
    plan.rounding = *params.repeat == BuildingRepeat::ceil ? Rounding::ceil : Rounding::nearest;
  plan.assets = work.boxes;
  plan.own_assets = params.assets.size();
  return derive_shapes(plan, job);
}

/// The values of the attribute `lod` of the grammar for the levels after the finest. Empty if the grammar has
/// no such attribute or the output has one level. They end with the range of the attribute.
std::vector<double> lods_of(const Grammar& grammar, const BuildingParams& params, int levels) {
  const auto found = std::ranges::find(grammar.attributes, lod_attribute, &Attribute::name);
  if (levels < 2 || found == grammar.attributes.end() || found->is_constant ||
      !found->value.expression.is_constant || found->value.expression.text != 0)
    return {};
  const auto given = params.attributes.find(std::string(lod_attribute));
  double value = found->value.expression.value;
  if (given != params.attributes.end()) {
    const double* const number = std::get_if<double>(&given->second);
    if (number == nullptr) return {};
    value = *number;
  }
  std::vector<double> lods;
  while (static_cast<int>(lods.size()) + 1 < levels) {
    value += 1;
    if (found->has_range && value > found->high) break;
    if (!found->choices.empty() &&
        std::ranges::find(found->choices, lang::TaggedValue{value, 0}) == found->choices.end())
      break;
    lods.push_back(value);
  }
  return lods;
}

Sharing sharing_of(const Demand& demand) {
  if (demand.copies == CopyForm::merge) return Sharing::merged;
  return demand.share_organs ? Sharing::nodes : Sharing::if_smaller;
}

std::uint64_t triangles_of(const Model& model, std::span<const int> meshes) {
  std::uint64_t triangles = 0;
  for (const int mesh : meshes)
    triangles += seedmesh::triangles_of(model.meshes[static_cast<std::size_t>(mesh)]);
  return triangles;
}

/// Adds nodes with levels of detail. The derivation runs again for each value of `lod`; a level without fewer
/// triangles than the level before is left out.
void add_levels(Model& model, Work& work, const BuildingParams& params, const Shapes& finest,
                MaterialTable& materials, const GenerateContext& context) {
  Job& job = context.job;
  const std::vector<double> lods = lods_of(work.rules->grammar, params, context.demand.lods);
  std::vector<std::vector<int>> levels;
  levels.push_back(add_level(model, finest, materials, work.assets, {.sharing = Sharing::if_smaller}, job));
  for (const double lod : lods) {
    const Shapes shapes = shapes_of(work, params, context, {.lod = lod});
    materials.use(shapes);
    const std::size_t meshes = model.meshes.size();
    levels.push_back(add_level(model, shapes, materials, work.assets, {.least = levels[0].size()}, job));
    if (triangles_of(model, levels.back()) < triangles_of(model, *(levels.end() - 2))) continue;
    model.meshes.resize(meshes);  // the rules make no coarser model for this value
    levels.pop_back();
  }
  materials.use(finest);
  // All levels need as many meshes, so that meshes of levels with fewer layers are split.
  std::size_t layers = 0;
  for (const std::vector<int>& level : levels) layers = std::max(layers, level.size());
  for (std::vector<int>& level : levels) {
    for (std::size_t i = 0; i < level.size() && level.size() < layers;) {
      std::optional<MeshGroup> half = split_in_half(model.meshes[static_cast<std::size_t>(level[i])], job);
      if (!half) {
        ++i;
        continue;
      }
      level.push_back(add_mesh(model, *std::move(half)));
    }
  }
  for (const std::vector<int>& level : levels) layers = std::min(layers, level.size());
  if (layers == 0) return;
  for (const std::vector<int>& level : levels) {
    // If that is not possible, the other levels join their last meshes.
    auto& last = model.meshes[static_cast<std::size_t>(level[layers - 1])].primitives;
    for (std::size_t i = layers; i < level.size(); ++i) {
      std::vector<Primitive> more =
          std::exchange(model.meshes[static_cast<std::size_t>(level[i])].primitives, {});
      std::ranges::move(more, std::back_inserter(last));
    }
  }
  for (std::size_t i = 0; i < layers; ++i) {
    Node& node = add_node(model, "layer", 0);
    for (const std::vector<int>& level : levels) seedmesh::add_level(node, level[i]);
  }
}

void append(std::vector<Warning>& to, const std::vector<Warning>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// Null for a shape grammar, whose derivation sets a grammar with names alone.
const Grammar* grammar_of(const BuildingParams& params, const Work& work) {
  return params.shape_grammar || !work.rules ? nullptr : &work.rules->grammar;
}

/// Moves warnings of built-in rules, whose text the request does not have, to /blueprint.
void point_at_blueprint(const BuildingParams& params, std::vector<Warning>& warnings) {
  for (Warning& warning : warnings) {
    if (params.blueprint && warning.pointer == "/rules") warning = {"/blueprint", warning.message, 0, 0};
  }
}

}  // namespace

std::vector<Issue> check(const BuildingParams& params, const Limits& limits, const Job* job) {
  Work work;
  return check_all(params, {limits, job}, work.rules, work.figures);
}

Generator::Prepared prepare(const BuildingParams& params, const CheckContext& context) {
  Work work;
  if (params.shape_grammar) return nullptr;
  return check_all(params, {context.job.limits(), &context.job}, work.rules, work.figures).empty()
             ? work.rules
             : nullptr;
}

Result<Model> generate(const BuildingParams& params, const GenerateContext& context) {
  Job& job = context.job;
  Work work = work_of(params, context);
  std::vector<Issue> issues = check_all(params, {job.limits(), &job}, work.rules, work.figures);
  if (!issues.empty()) return Error{Code::invalid, std::move(issues)};
  job.progress("derive", 0);
  if (auto refused = add_assets(work, params, context)) return std::move(*refused);
  const Shapes shapes = shapes_of(work, params, context);
  job.progress("mesh", 0);
  Model model = std::move(work.model);
  model.name = "building";
  append(model.warnings, unused_settings(params, grammar_of(params, work)));
  append(model.warnings, work.rules->grammar.warnings);
  append(model.warnings, shapes.warnings);
  append(model.warnings, missing_edits(params, shapes));
  if (auto warning = nothing_drawn(shapes); warning && !params.shape_grammar)
    model.warnings.push_back(*std::move(warning));
  MaterialTable materials(model, params, shapes, context);
  materials.set_symbols(work.rules->grammar.symbols);
  if (lods_of(work.rules->grammar, params, context.demand.lods).empty()) {
    add_bodies(model, shapes, materials, work.assets, sharing_of(context.demand), job);
  } else {
    add_levels(model, work, params, shapes, materials, context);
  }
  if (auto warning = materials.unused_facade_image()) model.warnings.push_back(*std::move(warning));
  add_collision(model, shapes, context);
  point_at_blueprint(params, model.warnings);
  if (!shapes.reports.empty()) model.extras.push_back({"reports", json_of(shapes.reports).dump()});
  return model;
}

Result<Json> derive(const BuildingParams& params, const GenerateContext& context) {
  Job& job = context.job;
  Work work = work_of(params, context);
  std::vector<Issue> issues = check_all(params, {job.limits(), &job}, work.rules, work.figures);
  if (!issues.empty()) return Error{Code::invalid, std::move(issues)};
  if (auto refused = add_assets(work, params, context)) return std::move(*refused);
  const Shapes shapes = shapes_of(work, params, context, {.lod = std::nullopt, .is_listed = true});
  Json list = json_of(shapes, work.rules->grammar, work.rules->text, most_listed, job);
  std::vector<Warning> warnings = work.model.warnings;
  append(warnings, unused_settings(params, grammar_of(params, work)));
  append(warnings, work.rules->grammar.warnings);
  append(warnings, shapes.warnings);
  append(warnings, missing_edits(params, shapes));
  return Json{{"shapes", std::move(list)},
              {"count", shapes.shapes.size()},
              {"truncated", shapes.shapes.size() > most_listed},
              {"reports", json_of(shapes.reports)},
              {"warnings", warning_list(warnings)}};
}

/// The size of the file with all levels, of which `shapes` is the finest.
static std::optional<Estimate> estimate_of_file(Work& work, const BuildingParams& params,
                                                const Shapes& shapes, const GenerateContext& context) {
  Job& own = context.job;
  const GenerateContext sketch{own, {}, context.generators};
  const Demand& demand = context.demand;
  const std::vector<double> lods = lods_of(work.rules->grammar, params, demand.lods);
  Model model;
  MaterialTable materials(model, params, shapes, context);
  materials.set_symbols(work.rules->grammar.symbols);
  // The file contains the merged meshes of all levels.
  const CopyForm copies = lods.empty() ? demand.copies : CopyForm::merge;
  std::optional<Estimate> sum =
      estimate_of(shapes, materials, {copies, demand.share_organs, demand.tangents}, own);
  for (const double lod : lods) {
    const Shapes level = shapes_of(work, params, sketch, {.lod = lod, .most_shapes = most_estimated_shapes});
    materials.use(level);
    const std::optional<Estimate> more =
        estimate_of(level, materials, {CopyForm::merge, false, demand.tangents}, own);
    if (!more || !sum || level.shapes.size() > most_estimated_shapes) return std::nullopt;
    add_bytes(*sum, *more);
  }
  if (sum) add_images_of(*sum, model, demand.textures);
  return sum;
}

Result<Appraisal> appraise(const BuildingParams& params, const GenerateContext& context) {
  Job& job = context.job;
  Appraisal appraisal;
  Work work = work_of(params, context);
  std::vector<Issue> issues = check_all(params, {job.limits(), &job}, work.rules, work.figures);
  if (!issues.empty()) return Error{Code::invalid, std::move(issues)};
  appraisal.warnings = unused_settings(params, grammar_of(params, work));
  if (work.rules) append(appraisal.warnings, work.rules->grammar.warnings);
  // Requests with assets or with very many shapes have no estimate.
  if (!params.assets.empty()) return appraisal;
  Job own = job.for_estimate();
  const GenerateContext sketch{own, {}, context.generators};
  if (auto refused = add_assets(work, params, sketch)) return std::move(*refused);
  const Shapes shapes = shapes_of(work, params, sketch, {.lod = {}, .most_shapes = most_estimated_shapes});
  append(appraisal.warnings, shapes.warnings);
  if (shapes.shapes.size() <= most_estimated_shapes)
    append(appraisal.warnings, missing_edits(params, shapes));
  if (auto warning = nothing_drawn(shapes); warning && !params.shape_grammar)
    appraisal.warnings.push_back(*std::move(warning));
  point_at_blueprint(params, appraisal.warnings);
  if (shapes.shapes.size() > most_estimated_shapes) return appraisal;
  appraisal.estimate = estimate_of_file(work, params, shapes, {own, context.demand, context.generators});
  return appraisal;
}

}  // namespace seedmesh::building
