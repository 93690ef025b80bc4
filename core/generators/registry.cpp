#include "core/generators/registry.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/generators/building/building.h"
#include "core/generators/fractal/encode.h"
#include "core/generators/fractal/fractal.h"
#include "core/generators/lsystem/lsystem.h"
#include "core/generators/scene/scene.h"
#include "core/generators/terrain/terrain.h"
#include "core/generators/tree/tree.h"
#include "generated/params/building.h"
#include "generated/params/fractal.h"
#include "generated/params/lsystem.h"
#include "generated/params/scene.h"
#include "generated/params/terrain.h"
#include "generated/params/tree.h"

namespace seedmesh {
namespace {

/// What a generator can do beyond making a still model.
struct Traits {
  bool grows = false, sways = false, has_collision = false;
  bool has_impostor = false, keeps_budget = false;
  bool parts = false, joins_triangles = false;
  std::string_view own_levels = {};
};

Result<Payload> payload_of(Result<Payload> made) { return made; }
Result<Payload> payload_of(Result<Array<std::uint8_t>> made) {
  if (!made) return std::move(made).error();
  auto kept = std::make_shared<const Array<std::uint8_t>>(*std::move(made));
  const auto bytes = std::as_bytes(kept->span());
  Payload payload;
  payload.add(std::move(kept), bytes);
  return payload;
}

/// The functions of one generator as the compiler sees them, turned to those of a row.
template <class Own, auto read_own, auto write_own, auto check_own, auto generate_own, auto derive_own,
          auto appraise_own, auto vocabulary_own>
struct Row {
  using Params = Generator::Params;

  static const Own& own(const Params& params) { return *static_cast<const Own*>(params.get()); }

  static Params read(const Json& json, std::string_view pointer, Faults& faults,
                     const Generator::Settle& settle) {
    auto params = std::make_shared<Own>(read_own(json, pointer, faults));
    if constexpr (requires { children_of(*params); }) {
      if (settle) std::ranges::for_each(children_of(*params), settle);
    }
    return params;
  }
  static Json write(const Params& params) { return write_own(own(params)); }
  static std::vector<Issue> check(const Params& params, const Limits& limits) {
    return check_own(own(params), limits);
  }
  static Result<Model> generate(const Params& params, Job& job) { return generate_own(own(params), job); }
  static Result<Json> derive(const Params& params, Job& job) { return derive_own(own(params), job); }
  static Result<Appraisal> appraise(const Params& params, const Job& job) {
    return appraise_own(own(params), job);
  }

  static constexpr Generator named(std::string_view name, Traits traits = {}) {
    return {.name = name,
            .grows = traits.grows,
            .sways = traits.sways,
            .has_collision = traits.has_collision,
            .has_impostor = traits.has_impostor,
            .keeps_budget = traits.keeps_budget,
            .parts = traits.parts,
            .joins_triangles = traits.joins_triangles,
            .own_levels = traits.own_levels,
            .read = read,
            .write = write,
            .check = check,
            .generate = generate,
            .derive = derive,
            .appraise = appraise,
            .vocabulary = vocabulary_own};
  }

  /// For those that have forms of their own.
  template <auto encode_own>
  static constexpr Generator named(std::string_view name, std::span<const OwnForm> forms,
                                   Traits traits = {}) {
    Generator generator = named(name, traits);
    generator.forms = forms;
    generator.encode = [](const Params& params, const WantedForm& form, Job& job) {
      if constexpr (requires { encode_own(own(params), form, job); }) {
        return payload_of(encode_own(own(params), form, job));
      } else {
        return payload_of(encode_own(own(params), form.format, job));
      }
    };
    return generator;
  }

  /// For those whose forms and parameters may not fit.
  template <auto encode_own, auto check_form_own>
  static constexpr Generator named(std::string_view name, std::span<const OwnForm> forms,
                                   Traits traits = {}) {
    Generator generator = named<encode_own>(name, forms, traits);
    generator.check_form = [](const Params& params, const WantedForm& form) {
      return check_form_own(own(params), form);
    };
    return generator;
  }
};

constexpr OwnForm terrain_forms[] = {
    {"png16", "image/png", "png", true},
    {"png8", "image/png", "png"},
    {"rgb24", "image/png", "png"},
    {"rgba32", "image/png", "png"},
    {"r16", "application/octet-stream", "r16", true},
};

constexpr OwnForm fractal_forms[] = {
    {"ply", "application/octet-stream", "ply"},
    {"png16", "image/png", "png"},
    {"png8", "image/png", "png"},
};

constexpr std::string_view levels_of_rules =
    "rules make levels of their own where they declare `attr lod = 0` and ask for it (docs/buildings.md)";

constexpr OwnForm scene_forms[] = {
    {"placements", "application/zip", "zip", false, true},
};

/// In the order in which the gallery shows them: what most look for comes first.
constexpr Generator rows[] = {
    Row<TreeParams, read_tree, write_tree, tree::check, tree::generate, tree::derive, tree::appraise,
        tree::vocabulary>::named("tree",
                                 {.grows = true, .sways = true, .has_collision = true, .has_impostor = true}),
    Row<LsystemParams, read_lsystem, write_lsystem, lsystem::check, lsystem::generate, lsystem::derive,
        lsystem::appraise, lsystem::vocabulary>::named("lsystem", {.grows = true, .has_impostor = true}),
    Row<BuildingParams, read_building, write_building, building::check, building::generate, building::derive,
        building::appraise, building::vocabulary>::named("building", {.has_collision = true,
                                                                      .parts = true,
                                                                      .own_levels = levels_of_rules}),
    Row<TerrainParams, read_terrain, write_terrain, terrain::check, terrain::generate, terrain::derive,
        terrain::appraise,
        terrain::vocabulary>::named<terrain::encode, terrain::check_form>("terrain", terrain_forms,
                                                                          {.joins_triangles = true}),
    Row<SceneParams, read_scene, write_scene, scene::check, scene::generate, scene::derive, scene::appraise,
        scene::vocabulary>::named<scene::encode>("scene", scene_forms,
                                                 {.grows = true, .has_impostor = true, .keeps_budget = true}),
    Row<FractalParams, read_fractal, write_fractal, fractal::check, fractal::generate, fractal::derive,
        fractal::appraise, fractal::vocabulary>::named<fractal::encode, fractal::check_form>("fractal",
                                                                                             fractal_forms),
};

}  // namespace

std::span<const Generator> generators() { return rows; }

const Generator* find_generator(std::string_view name) {
  for (const Generator& generator : rows) {
    if (generator.name == name) return &generator;
  }
  return nullptr;
}

}  // namespace seedmesh
