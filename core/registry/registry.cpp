#include "core/registry/registry.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/generators/building/building.h"
#include "core/generators/city/city.h"
#include "core/generators/fractal/encode.h"
#include "core/generators/fractal/fractal.h"
#include "core/generators/lsystem/lsystem.h"
#include "core/generators/scene/scene.h"
#include "core/generators/terrain/terrain.h"
#include "core/generators/tree/tree.h"
#include "core/generators/world/world.h"
#include "generated/params/building.h"
#include "generated/params/city.h"
#include "generated/params/fractal.h"
#include "generated/params/lsystem.h"
#include "generated/params/scene.h"
#include "generated/params/terrain.h"
#include "generated/params/tree.h"
#include "generated/params/world.h"

namespace seedmesh {
namespace {

Result<Payload> payload_of(Result<Payload> made) { return made; }
Result<Payload> payload_of(Result<Array<std::uint8_t>> made) {
  if (!made) return std::move(made).error();
  auto kept = std::make_shared<const Array<std::uint8_t>>(*std::move(made));
  const auto bytes = std::as_bytes(kept->span());
  Payload payload;
  payload.add(std::move(kept), bytes);
  return payload;
}

/// Turns the typed functions of one generator into those of a row.
template <class Own, auto read_own, auto write_own, auto check_own, auto generate_own, auto derive_own,
          auto appraise_own, auto vocabulary_own>
struct Row {
  using Params = Generator::Params;

  static const Own& own(const Params& params) { return *static_cast<const Own*>(params.get()); }

  static Params read(const Json& json, std::string_view pointer, IssueList& errors,
                     const Generator::VisitChild& visit) {
    auto params = std::make_shared<Own>(read_own(json, pointer, errors));
    if constexpr (requires { children_of(*params); }) {
      if (visit) std::ranges::for_each(children_of(*params), visit);
    }
    return params;
  }
  static Json write(const Params& params) { return write_own(own(params)); }
  static std::vector<Issue> check(const Params& params, const CheckContext& context) {
    if constexpr (requires { check_own(own(params), context); }) {
      return check_own(own(params), context);
    } else if constexpr (requires { check_own(own(params), context.job.limits(), &context.job); }) {
      return check_own(own(params), context.job.limits(), &context.job);
    } else {
      return check_own(own(params), context.job.limits());
    }
  }
  static Result<Model> generate(const Params& params, const GenerateContext& context) {
    return generate_own(own(params), context);
  }
  static Result<Json> derive(const Params& params, const GenerateContext& context) {
    return derive_own(own(params), context);
  }
  static Result<Appraisal> appraise(const Params& params, const GenerateContext& context) {
    return appraise_own(own(params), context);
  }

  /// Adds the functions to a row that has the name and the properties.
  static constexpr Generator row(Generator generator) {
    generator.read = read;
    generator.write = write;
    generator.check = check;
    generator.generate = generate;
    generator.derive = derive;
    generator.appraise = appraise;
    generator.vocabulary = vocabulary_own;
    return generator;
  }

  /// For generators whose requests can share work.
  template <auto prepare_own>
  static constexpr Generator prepared(Generator generator) {
    generator = row(generator);
    generator.prepare = [](const Params& params, const CheckContext& context) {
      return prepare_own(own(params), context);
    };
    return generator;
  }

  /// For generators with output formats beside models.
  template <auto encode_own>
  static constexpr Generator row(Generator generator) {
    generator = row(generator);
    generator.encode = [](const Params& params, const WantedFormat& format, const GenerateContext& context) {
      return payload_of(encode_own(own(params), format, context));
    };
    return generator;
  }

  /// For generators whose formats can conflict with parameters.
  template <auto encode_own, auto check_format_own>
  static constexpr Generator row(Generator generator) {
    generator = row<encode_own>(generator);
    generator.check_format = [](const Params& params, const WantedFormat& format) {
      return check_format_own(own(params), format);
    };
    return generator;
  }
};

constexpr OwnFormat terrain_formats[] = {
    {"png16", true}, {"png8"}, {"rgb24"}, {"rgba32"}, {"r16", true},
};

constexpr OwnFormat fractal_formats[] = {
    {"ply"},
    {"png16"},
    {"png8"},
};

constexpr std::string_view levels_of_rules =
    "rules have their own levels if they declare `attr lod = 0` and use it (docs/buildings.md)";

constexpr OwnFormat city_formats[] = {
    {"geojson"},
};

constexpr OwnFormat scene_formats[] = {
    {"placements", false, true},
};

/// In the order of the gallery: the most popular first.
constexpr Generator rows[] = {
    Row<TreeParams, read_tree, write_tree, tree::check, tree::generate, tree::derive, tree::appraise,
        tree::vocabulary>::row({.name = "tree",
                                .grows = true,
                                .sways = true,
                                .has_collision = true,
                                .has_impostor = true}),
    Row<LsystemParams, read_lsystem, write_lsystem, lsystem::check, lsystem::generate, lsystem::derive,
        lsystem::appraise, lsystem::vocabulary>::row({.name = "lsystem",
                                                      .grows = true,
                                                      .has_collision = true,
                                                      .has_impostor = true}),
    Row<BuildingParams, read_building, write_building, building::check, building::generate, building::derive,
        building::appraise, building::vocabulary>::prepared<building::prepare>({.name = "building",
                                                                                .has_collision = true,
                                                                                .repeats_parts = true,
                                                                                .own_levels =
                                                                                    levels_of_rules}),
    Row<TerrainParams, read_terrain, write_terrain, terrain::check, terrain::generate, terrain::derive,
        terrain::appraise, terrain::vocabulary>::row<terrain::encode,
                                                     terrain::check_format>(
        {.name = "terrain", .prefers_simplification = true, .formats = terrain_formats}),
    Row<SceneParams, read_scene, write_scene, scene::check, scene::generate, scene::derive, scene::appraise,
        scene::vocabulary>::row<scene::encode>({.name = "scene",
                                                .grows = true,
                                                .has_impostor = true,
                                                .keeps_budget = true,
                                                .formats = scene_formats}),
    Row<CityParams, read_city, write_city, city::check, city::generate, city::derive, city::appraise,
        city::vocabulary>::row<city::encode>({.name = "city",
                                              .has_collision = true,
                                              .formats = city_formats}),
    Row<FractalParams, read_fractal, write_fractal, fractal::check, fractal::generate, fractal::derive,
        fractal::appraise,
        fractal::vocabulary>::row<fractal::encode, fractal::check_format>({.name = "fractal",
                                                                           .formats = fractal_formats}),
    Row<WorldParams, read_world, write_world, world::check, world::generate, world::derive, world::appraise,
        world::vocabulary>::row({.name = "world"}),
};

}  // namespace

GeneratorList generators() { return rows; }

}  // namespace seedmesh
