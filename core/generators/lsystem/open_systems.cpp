#include "core/generators/lsystem/open_systems.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/generators/child.h"
#include "core/generators/lsystem/build_model.h"
#include "core/generators/lsystem/fractional_iterations.h"
#include "core/generators/lsystem/shape.h"
#include "core/gltf/read/read.h"
#include "core/model/append.h"

namespace seedmesh::lsystem {
namespace {

using SolidParams = LsystemParams::Solid;

constexpr std::string_view own_name = "lsystem";

glm::dvec3 vector_of(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

SolidShape shape_of(SolidParams const& given) {
  switch (given.solid_shape) {
    case LsystemParams::SolidShape::box:
      return SolidShape::box;
    case LsystemParams::SolidShape::sphere:
      return SolidShape::sphere;
    case LsystemParams::SolidShape::cylinder:
      return SolidShape::cylinder;
    case LsystemParams::SolidShape::cone:
      return SolidShape::cone;
    case LsystemParams::SolidShape::mesh:
      return SolidShape::mesh;
  }
  return SolidShape::box;
}

Model model_of(const SolidParams& given, const std::string& pointer, Rng stream,
               const GenerateContext& context) {
  Job& job = context.job;
  Result<Model> model = given.model ? generate_child(*given.model, pointer + "/model", stream, context)
                                    : read_glb(*given.glb, pointer + "/glb", job);
  if (!model) job.refuse(model.error().issues.front());
  return std::move(*model);
}

void draw_module(const Word& word, std::size_t i, Drawing& drawing) {
  constexpr double nothing = 0;
  drawing.module(word.kind[i], word.parameter.empty() ? &nothing : word.parameter.data() + word.at[i],
                 word.key.empty() ? 0 : word.key[i], word.born.empty() ? 0U : std::uint32_t{word.born[i]});
}

void draw_word(const Word& word, Drawing& drawing, const Job& job) {
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (i % 4096 == 0) job.check();
    draw_module(word, i, drawing);
  }
}

/// Measures the centre lines of limbs.
TurtleReport report_of(const Limbs& limbs) {
  TurtleReport report;
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (limbs.parent[i] == Limbs::none) continue;
    const glm::dvec3 from = limbs.position[limbs.parent[i]], to = limbs.position[i];
    if (report.segments++ == 0) report.min = report.max = from;
    report.total_length += std::sqrt(glm::dot(to - from, to - from));
    report.min = glm::min(report.min, glm::min(from, to));
    report.max = glm::max(report.max, glm::max(from, to));
  }
  return report;
}

/// Returns for each joint the number of its limb, which is the first joint of the limb.
Array<std::uint32_t> limbs_by_joint(const Limbs& limbs) {
  Array<std::uint32_t> limb = limbs.parent.empty_array_of<std::uint32_t>();
  for (std::uint32_t i = 0; i < limbs.size(); ++i) {
    const bool is_first = limbs.parent[i] == Limbs::none || limbs.starts_limb[i];
    limb.push_back(is_first ? i : limb[limbs.parent[i]]);
  }
  return limb;
}

Membership membership_of(LsystemParams::Membership given) {
  switch (given) {
    case LsystemParams::Membership::centre:
      return Membership::centre;
    case LsystemParams::Membership::whole:
      return Membership::whole;
    case LsystemParams::Membership::clipped:
      return Membership::clipped;
  }
  return Membership::centre;
}

}  // namespace

void check_environment(const LsystemParams& params, std::vector<Issue>& issues) {
  if (!params.environment) return;
  for (std::size_t i = 0; i < params.environment->solids.size(); ++i) {
    const SolidParams& solid = params.environment->solids[i];
    const std::string pointer = "/environment/solids/" + std::to_string(i);
    const bool is_mesh = solid.solid_shape == LsystemParams::SolidShape::mesh;
    if (is_mesh && solid.model.has_value() == solid.glb.has_value()) {
      issues.emplace_back(conflict_with({"model", "glb", "shape"}), pointer,
                          "a mesh has either `model` or `glb`");
    } else if (!is_mesh && (solid.model || solid.glb)) {
      issues.emplace_back(conflict_with({"model", "glb", "shape"}), pointer,
                          "found a model; only the shape mesh has one");
    }
    if (solid.glb && !is_glb_uri(*solid.glb)) {
      issues.emplace_back(IssueKind::invalid_value, pointer + "/glb",
                          "found no data URI of a GLB; expected data:model/gltf-binary;base64,...");
    }
    if (solid.role == LsystemParams::Role::host && !is_mesh) {
      issues.emplace_back(conflict_with({"role"}), pointer + "/shape",
                          "a host is part of the model and must be a mesh");
    }
  }
  for (std::size_t i = 0; i < params.environment->companions.size(); ++i) {
    const std::string pointer = "/environment/companions/" + std::to_string(i) + "/system";
    const Child& child = params.environment->companions[i].system;
    if (child.generator.empty()) continue;
    if (child.generator != own_name) {
      issues.emplace_back(IssueKind::invalid_value, pointer + "/generator",
                          "found " + child.generator + "; a companion must be an lsystem");
      continue;
    }
    IssueList errors;
    const LsystemParams system = read_lsystem(Json::parse(child.parameters), "", errors);
    if (errors.empty() && system.age && !system.timed && *system.age != std::floor(*system.age)) {
      issues.emplace_back(IssueKind::invalid_value, pointer + "/parameters/age",
                          "the age of a companion must be a whole number of iterations");
    }
    if (errors.empty() && system.environment) {
      issues.emplace_back(conflict_with({"system"}), pointer + "/parameters/environment",
                          "a companion uses this environment and cannot have its own");
    }
  }
}

struct OpenSystems::Host {
  Model model;
  Transform at;
};

/// One of the L-systems. The first plant uses the parameters and the grammar of the request.
struct OpenSystems::Plant {
  struct Query {
    std::size_t module;
    GrowthTip tip;
    Frame frame;
    std::size_t depth;                  ///< number of open brackets around it
    std::uint32_t ahead = Limbs::none;  ///< first joint drawn after it on its branch
  };

  Plant(const LsystemParams& given, Job own_job) : params(given), job(std::move(own_job)) {}

  LsystemParams params;
  Job job;
  glm::dvec3 position{0};
  std::uint32_t number = 0;
  std::unique_ptr<Grammar> own_grammar;
  const Grammar* grammar = nullptr;
  std::unique_ptr<Derivation> derivation;
  std::uint32_t steps = 0;
  std::vector<Query> queries;
  std::vector<std::size_t> waiting;  ///< queries of open branches that have no later joint yet
  std::vector<std::uint32_t> alive;  ///< joints of the last drawing that remain, ascending
};

OpenSystems::~OpenSystems() = default;

OpenSystems::OpenSystems(const LsystemParams& params, const GenerateContext& context)
    : params_(params), context_(context), job_(context.job), known_(std::make_unique<ShareCache>(job_)) {
  Job& job = context.job;
  Surroundings::Options options;
  const auto environment = params.environment.value_or(LsystemParams::Environment{});
  for (std::size_t i = 0; i < environment.solids.size(); ++i) {
    const SolidParams& given = environment.solids[i];
    const std::string pointer = "/environment/solids/" + std::to_string(i);
    Solid solid{shape_of(given), vector_of(given.position), vector_of(given.size), nullptr};
    if (solid.shape == SolidShape::mesh) {
      Model model = model_of(given, pointer, job.rng().at("solid").at(i), context);
      solid.mesh = std::make_shared<MeshField>(model, solid.size, solid.position, job);
      if (solid.mesh->triangles() == 0)
        job.refuse({IssueKind::invalid_value, pointer, "the model has no triangles"});
      if (given.role == LsystemParams::Role::host) {
        Transform at;
        at.translation = glm::vec3(solid.position);
        at.scale = glm::vec3(solid.size);
        hosts_.push_back({std::move(model), at});
      }
    }
    (given.role == LsystemParams::Role::guide ? options.guides : options.obstacles)
        .push_back(std::move(solid));
  }
  options.clearance = environment.clearance;
  if (environment.light) {
    const auto& light = *environment.light;
    options.shadow = {light.cell, light.shade, light.falloff, light.layers};
  }
  surroundings_ = std::make_unique<Surroundings>(std::move(options), job);

  plants_.push_back(std::make_unique<Plant>(params, job));
  for (std::size_t i = 0; i < environment.companions.size(); ++i) {
    const auto& companion = environment.companions[i];
    IssueList errors;
    LsystemParams own = read_lsystem(Json::parse(companion.system.parameters), "", errors);
    const std::uint64_t seed = companion.system.seed.value_or(job.rng().at("companion").at(i).key());
    auto plant = std::make_unique<Plant>(
        own, job.for_child(seed, "/environment/companions/" + std::to_string(i) + "/system/parameters"));
    plant->position = vector_of(companion.position);
    plant->number = static_cast<std::uint32_t>(i + 1);
    plant->steps =
        static_cast<std::uint32_t>(own.age && !own.timed ? std::ceil(*own.age) : double(own.iterations));
    std::vector<Issue> issues;
    plant->own_grammar = std::make_unique<Grammar>(compile(plant->params, seed, job.limits(), issues));
    plant->grammar = plant->own_grammar.get();
    plants_.push_back(std::move(plant));
  }
}

GenerateContext OpenSystems::context_of(Plant& plant) const {
  return {plant.job, context_.demand, context_.generators};
}

bool OpenSystems::needed(const Grammar& grammar, const LsystemParams& params) {
  const auto asks = [](const Kind& kind) { return is_query(kind.command); };
  return params.environment || std::ranges::any_of(grammar.kinds, asks);
}

void OpenSystems::grow(const Grammar& grammar, std::uint32_t steps) {
  plants_[0]->grammar = &grammar;
  plants_[0]->steps = steps;
  std::uint32_t most = 0;
  for (auto& plant : plants_) {
    plant->derivation = std::make_unique<Derivation>(*plant->grammar, true, plant->job);
    most = std::max(most, plant->steps);
  }
  answer_queries();
  for (std::uint32_t step = 0; step < most; ++step) {
    for (auto& plant : plants_)
      if (step < plant->steps) plant->derivation->step();
    answer_queries();
  }
  for (auto& plant : plants_) job_.spend(Resource::modules, plant->derivation->word.size());
}

void OpenSystems::answer_queries() {
  std::vector<GrownInternode> grown;
  for (auto& plant : plants_) draw_and_prune(*plant, grown);
  surroundings_->set_internodes(grown);
  for (auto& plant : plants_) write_answers(*plant);
}

/// Sets the next joint of the queries on this branch. Joints from `before` on are new.
void OpenSystems::follow(Plant& plant, const Turtle& turtle, const Limbs& limbs, std::size_t before) {
  std::vector<std::size_t>& waiting = plant.waiting;
  const auto depth = [&] { return plant.queries[waiting.back()].depth; };
  while (!waiting.empty() && depth() > turtle.depth()) waiting.pop_back();
  std::uint32_t first = turtle.last_joint();
  if (waiting.empty() || first == Limbs::none || first < before) return;
  while (limbs.parent[first] != Limbs::none && limbs.parent[first] >= before) first = limbs.parent[first];
  for (; !waiting.empty() && depth() == turtle.depth(); waiting.pop_back())
    plant.queries[waiting.back()].ahead = first;
}

/// Draws and prunes a plant, and collects its queries.
void OpenSystems::draw_and_prune(Plant& plant, std::vector<GrownInternode>& grown) {
  Skeleton skeleton(plant.job);
  Drawing drawing(*plant.grammar, plant.params, &skeleton, context_of(plant));
  drawing.start_at(plant.position);
  const Word& word = plant.derivation->word;
  drawing.set_variables(word.variables);
  Limbs& limbs = skeleton.limbs;
  plant.queries.clear();
  plant.waiting.clear();
  for (std::size_t i = 0; i < word.size(); ++i) {
    if (i % 4096 == 0) job_.check();
    const Kind& kind = plant.grammar->kinds[word.kind[i]];
    if (is_query(kind.command)) {
      const Turtle& turtle = drawing.turtle();
      GrowthTip tip{turtle.position(), turtle.frame().heading, 0.5 * turtle.width(), plant.number,
                    turtle.last_joint()};
      if (!turtle.begins_limb()) tip.limb = tip.joint;
      plant.waiting.push_back(plant.queries.size());
      plant.queries.push_back({i, tip, turtle.frame(), turtle.depth()});
      continue;
    }
    const std::size_t before = limbs.size();
    draw_module(word, i, drawing);
    follow(plant, drawing.turtle(), limbs, before);
  }
  const Array<std::uint32_t> limb = limbs_by_joint(limbs);
  for (Plant::Query& each : plant.queries) {
    GrowthTip& tip = each.tip;
    if (tip.limb != Limbs::none) tip.limb = limb[tip.limb];
    if (each.ahead != Limbs::none) tip.limb_ahead = limb[each.ahead];
  }
  skeleton.outlines.outline.resize(0);  // only the limbs are of interest here
  skeleton.organs.organ.resize(0);
  limbs.key.resize(limbs.size());  // index of the joint before pruning
  for (std::size_t i = 0; i < limbs.size(); ++i) limbs.key[i] = i;
  cut(skeleton);
  plant.alive.clear();
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    const auto joint = static_cast<std::uint32_t>(limbs.key[i]);
    plant.alive.push_back(joint);
    if (limbs.parent[i] == Limbs::none) continue;
    const auto parent = static_cast<std::uint32_t>(limbs.key[limbs.parent[i]]);
    grown.push_back({limbs.position[limbs.parent[i]], limbs.position[i], limbs.radius[i], plant.number, joint,
                     parent, limb[joint], limb[parent]});
  }
}

void OpenSystems::write_answers(Plant& plant) {
  Word& word = plant.derivation->word;
  for (const Plant::Query& each : plant.queries) {
    const Kind& kind = plant.grammar->kinds[word.kind[each.module]];
    double* answer = word.parameter.data() + word.at[each.module];
    const GrowthTip& tip = each.tip;
    const auto set = [&](std::uint32_t at, double value) {
      if (at < kind.arity) answer[at] = value + 0.0;  // -0 becomes 0
    };
    const auto fill = [&](std::uint32_t from, const glm::dvec3& v) {
      for (std::uint32_t k = 0; k < 3; ++k) set(from + k, v[static_cast<int>(k)]);
    };
    switch (kind.command) {
      case Command::ask_position:
        fill(0, tip.position);
        break;
      case Command::ask_heading:
        fill(0, each.frame.heading);
        break;
      case Command::ask_left:
        fill(0, each.frame.left);
        break;
      case Command::ask_up:
        fill(0, each.frame.up);
        break;
      default: {
        const bool remains = tip.joint == Limbs::none || std::ranges::binary_search(plant.alive, tip.joint);
        const double length = answer[0];
        set(0, remains && surroundings_->is_free(tip, length) ? 1 : 0);
        if (kind.arity > 1) set(1, surroundings_->signed_distance_at(tip.position));
        if (kind.arity > 2) set(2, surroundings_->signed_distance_at(tip.position + tip.heading * length));
        if (kind.arity > 3) set(3, remains ? surroundings_->light_at(tip.position) : 0);
        if (kind.arity > 4) fill(4, surroundings_->toward_surface(tip.position));
      }
    }
  }
}

const Word& OpenSystems::word() const { return plants_[0]->derivation->word; }

void OpenSystems::draw(const Grammar& grammar, Drawing& drawing, double share) const {
  const Plant& plant = *plants_[0];
  const Word& word = plant.derivation->word;
  drawing.set_variables(word.variables);
  if (share < 1) return FractionalStep(grammar, drawing, plant.steps, share).word(word, job_);
  draw_word(word, drawing, job_);
}

void OpenSystems::cut(Skeleton& skeleton) const {
  const auto membership =
      params_.environment ? membership_of(params_.environment->membership) : Membership::centre;
  prune(skeleton, *surroundings_, membership, known_.get(), job_);
}

TurtleReport OpenSystems::report(const Turtle& turtle, Skeleton& skeleton) const {
  if (!cuts()) return turtle.report();
  const TurtleReport whole = report_of(skeleton.limbs);
  cut(skeleton);
  const TurtleReport left = report_of(skeleton.limbs);
  const bool same = left.segments == whole.segments && left.total_length == whole.total_length;
  return same ? turtle.report() : left;  // the turtle's values are more precise: doubles, not floats
}

void OpenSystems::add_others(Model& model) {
  for (std::size_t i = 1; i < plants_.size(); ++i) {
    Plant& plant = *plants_[i];
    Skeleton skeleton(plant.job);
    Drawing drawing(*plant.grammar, plant.params, &skeleton, context_of(plant));
    drawing.start_at(plant.position);
    drawing.set_variables(plant.derivation->word.variables);
    draw_word(plant.derivation->word, drawing, job_);
    cut(skeleton);
    shape(skeleton, plant.params, plant.job);
    Model own = build_model(std::move(skeleton), plant.params, context_of(plant));
    for (Warning& warning : own.warnings)
      warning.pointer.insert(0, "/environment/companions/" + std::to_string(i - 1) + "/system/parameters");
    append(model, std::move(own), 0, {});
  }
  for (Host& host : hosts_) append(model, std::move(host.model), 0, host.at);
  hosts_.clear();
}

}  // namespace seedmesh::lsystem
