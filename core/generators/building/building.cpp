#include "core/generators/building/building.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/generators/building/bodies.h"
#include "core/generators/building/check.h"
#include "core/generators/building/derive.h"
#include "core/generators/building/ground.h"
#include "core/generators/building/operations.h"
#include "core/generators/building/picture_shapes.h"
#include "core/generators/child.h"
#include "core/geom/flatten.h"
#include "core/gltf/read.h"
#include "generated/params/building.h"

namespace seedmesh::building {
namespace {

constexpr std::size_t most_listed = 100'000;  ///< shapes in the answer of derive

/// Everything between the parameters and the shapes.
struct Work {
  Grammar grammar;
  PictureGrammar pictures;  ///< where there is a shape grammar
  std::vector<AssetBox> boxes;
  std::vector<Asset> assets;
  Model model;  ///< materials and textures of assets, and warnings
};

void add_asset(Work& work, const std::string& name, Model own, Job& job) {
  Asset asset;
  asset.primitives = flatten(own, job);
  if (std::erase_if(asset.primitives,
                    [](const Primitive& p) { return p.mesh.topology != Topology::triangles; }) > 0)
    own.warnings.push_back({"/assets/" + name, "lines and points of the asset are left out", 0, 0});
  const auto materials = static_cast<int>(work.model.materials.size()),
             textures = static_cast<int>(work.model.textures.size());
  for (Material& material : own.materials) {
    for (TextureUse* use :
         {&material.base_color_texture, &material.normal_texture, &material.metallic_roughness_texture,
          &material.occlusion_texture, &material.emissive_texture}) {
      if (use->texture >= 0) use->texture += textures;
    }
    work.model.materials.push_back(std::move(material));
  }
  work.model.textures.insert(work.model.textures.end(), own.textures.begin(), own.textures.end());
  work.model.warnings.insert(work.model.warnings.end(), own.warnings.begin(), own.warnings.end());
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

std::optional<Error> add_assets(Work& work, const BuildingParams& params, Job& job) {
  for (const auto& [name, given] : params.assets) {
    Result<Model> own = given.model ? generate_child(*given.model, "/assets/" + name + "/model",
                                                     job.rng().at("asset").at(name), job)
                                    : read_glb(*given.glb, "/assets/" + name + "/glb", job);
    if (!own) return std::move(own).error();
    add_asset(work, name, std::move(*own), job);
  }
  for (const PartRow& row : part_rows()) {
    work.boxes.push_back({std::string(row.name), glm::dvec3(0), row.size});
    Asset asset;
    asset.size = row.size;
    asset.row = &row;
    work.assets.push_back(std::move(asset));
  }
  return std::nullopt;
}

Shapes shapes_of(Work& work, const BuildingParams& params, Job& job) {
  if (params.shape_grammar) {
    const bool is_parallel = params.derivation.mode == BuildingMode::parallel;
    const DerivedPicture derived = derive_picture(work.pictures, params.iterations, is_parallel, job);
    work.grammar = grammar_of_names(work.pictures);
    return shapes_of_picture(work.pictures, derived, *params.shape_grammar, job);
  }
  Task plan;
  plan.grammar = &work.grammar;
  plan.text = rules_of(params);
  Solid footprint;
  if (!params.footprint.empty()) {
    footprint = footprint_of(params.footprint, plan.origin, plan.size);
    plan.footprint = &footprint;
  } else {
    plan.size = {params.size[0], params.size[1], params.size[2]};
    plan.origin = {-0.5 * plan.size.x, 0, -0.5 * plan.size.z};
  }
  for (const auto& [name, given] : params.attributes)
    plan.attributes.emplace(name, number_of(work.grammar.texts, given));
  if (params.iterations) plan.iterations = *params.iterations;
  plan.is_sequential = params.derivation.mode == BuildingMode::sequential;
  plan.is_depth_first = params.derivation.order == BuildingOrder::depth;
  if (params.repeat)
    plan.rounding = *params.repeat == BuildingRepeat::ceil ? Rounding::ceil : Rounding::nearest;
  plan.assets = work.boxes;
  plan.own_assets = params.assets.size();
  return derive_shapes(plan, job);
}

Json vector(const glm::dvec3& v) { return Json::array({v.x + 0.0, v.y + 0.0, v.z + 0.0}); }

Json described(const Shapes& shapes, const Grammar& grammar, std::uint32_t index) {
  const Shape& shape = shapes.shapes[index];
  const glm::dmat3& axes = shapes.axes[shape.axes];
  Json parameters = Json::array();
  for (std::uint32_t i = 0; i < shape.parameter_count; ++i) {
    const double value = shapes.parameters[shape.first_parameter + i];
    if (const std::string* text = shapes.texts.of(value))
      parameters.push_back(*text);
    else
      parameters.push_back(value);
  }
  Json parent = nullptr;
  if (shape.parent != none) parent = shape.parent;
  return {{"id", index},
          {"parent", std::move(parent)},
          {"symbol", grammar.symbols[shape.symbol].name},
          {"parameters", std::move(parameters)},
          {"active", shape.is_active},
          {"scope",
           {{"origin", vector(shape.origin)},
            {"axes", Json::array({vector(axes[0]), vector(axes[1]), vector(axes[2])})},
            {"size", vector(shape.size)}}}};
}

Json described(const std::map<std::string, Report>& reports) {
  Json out = Json::object();
  for (const auto& [key, report] : reports) {
    out[key] = {{"count", report.count},
                {"sum", report.sum},
                {"mean", report.sum / static_cast<double>(report.count)},
                {"min", report.least},
                {"max", report.greatest}};
  }
  return out;
}

Json described(const std::vector<Warning>& warnings) {
  Json list = Json::array();
  for (const Warning& warning : warnings) {
    Json row = {{"pointer", warning.pointer.empty() ? "" : "/parameters" + warning.pointer},
                {"message", warning.message}};
    if (warning.line > 0) {
      row["line"] = warning.line;
      row["column"] = warning.column;
    }
    list.push_back(std::move(row));
  }
  return list;
}

std::vector<std::string> symbol_names(const Grammar& grammar) {
  std::vector<std::string> names;
  for (const Symbol& symbol : grammar.symbols) names.push_back(symbol.name);
  return names;
}

void append(std::vector<Warning>& to, const std::vector<Warning>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

std::vector<Issue> check(const BuildingParams& params, const Limits& limits) {
  Grammar grammar;
  PictureGrammar pictures;
  return check_all(params, limits, grammar, pictures);
}

Result<Model> generate(const BuildingParams& params, Job& job) {
  Work work;
  std::vector<Issue> issues = check_all(params, job.limits(), work.grammar, work.pictures);
  if (!issues.empty()) return Error{Code::invalid, std::move(issues)};
  job.progress("derive", 0);
  if (auto refused = add_assets(work, params, job)) return std::move(*refused);
  const Shapes shapes = shapes_of(work, params, job);
  job.progress("mesh", 0);
  Model model = std::move(work.model);
  model.name = "building";
  append(model.warnings, work.grammar.warnings);
  append(model.warnings, shapes.warnings);
  Looks looks(model, params, shapes, job);
  looks.set_symbols(symbol_names(work.grammar));
  add_bodies(model, shapes, looks, work.assets, job.demand().share_organs ? Sharing::nodes : Sharing::few,
             job);
  if (!shapes.reports.empty()) model.extras.push_back({"reports", described(shapes.reports).dump()});
  return model;
}

Result<Json> derive(const BuildingParams& params, Job& job) {
  Work work;
  std::vector<Issue> issues = check_all(params, job.limits(), work.grammar, work.pictures);
  if (!issues.empty()) return Error{Code::invalid, std::move(issues)};
  if (auto refused = add_assets(work, params, job)) return std::move(*refused);
  const Shapes shapes = shapes_of(work, params, job);
  Json list = Json::array();
  for (std::uint32_t i = 0; i < shapes.shapes.size() && i < most_listed; ++i) {
    list.push_back(described(shapes, work.grammar, i));
    if ((i & 4095U) == 0) job.check();
  }
  std::vector<Warning> warnings = work.model.warnings;
  append(warnings, work.grammar.warnings);
  append(warnings, shapes.warnings);
  return Json{{"shapes", std::move(list)},
              {"count", shapes.shapes.size()},
              {"truncated", shapes.shapes.size() > most_listed},
              {"reports", described(shapes.reports)},
              {"warnings", described(warnings)}};
}

Result<Appraisal> appraise(const BuildingParams& params, const Job& job) {
  Appraisal appraisal;
  Grammar grammar;
  PictureGrammar pictures;
  std::vector<Issue> issues = check_all(params, job.limits(), grammar, pictures);
  if (!issues.empty()) return Error{Code::invalid, std::move(issues)};
  appraisal.warnings = grammar.warnings;
  return appraisal;
}

Json vocabulary() {
  Json rows = Json::array();
  for (const OperationRow& row : operations()) {
    std::size_t least = 0, most = 0;
    bool is_optional = false;
    for (const char c : row.arguments) {
      is_optional |= c == '|';
      if (c == '|') continue;
      ++most;
      if (!is_optional) ++least;
    }
    rows.push_back({{"name", row.name},
                    {"parameters", row.parameters},
                    {"arity", least},
                    {"most", most},
                    {"text", row.text},
                    {"example", row.example}});
  }
  Json materials = Json::array();
  for (const std::string_view name : built_in_materials()) materials.push_back(name);
  return {{"building_operations", std::move(rows)}, {"building_materials", std::move(materials)}};
}

}  // namespace seedmesh::building
