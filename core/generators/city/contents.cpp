#include "core/generators/city/contents.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/generators/child.h"
#include "core/generators/city/city_model.h"
#include "core/generators/city/furniture_models.h"
#include "core/generators/city/house_requests.h"
#include "core/generators/city/landmarks.h"
#include "core/generators/city/model_copies.h"
#include "core/generators/city/objects.h"
#include "core/generators/city/solid_builder.h"
#include "core/generators/city/yard_borders.h"
#include "core/generators/scene/model_levels.h"
#include "core/texture/file_size.h"
#include "generated/params/city.h"

namespace seedmesh::city {
namespace {

using glm::dvec2;

constexpr std::uint64_t bytes_a_copy = 150;
constexpr std::uint64_t bytes_a_border_triangle = 76;  ///< two vertices of 35 bytes and an index

Transform transform_at(const dvec2& position, double height, double turn, double scale = 1) {
  Transform at;
  at.translation = {static_cast<float>(position.x), static_cast<float>(height),
                    static_cast<float>(0 - position.y)};
  const math::SinCos half = math::sincos_degrees(turn / 2);
  at.rotation = glm::quat(static_cast<float>(half.cos), 0, static_cast<float>(half.sin), 0);
  at.scale = glm::vec3(static_cast<float>(scale));
  return at;
}

/// A model with its copies: a request, or a built-in model.
struct Contents {
  std::string name;
  const char* group = "";
  const Child* request = nullptr;  ///< null: the built-in model `number` of `kind`
  std::string pointer, kind;
  std::uint32_t number = 0;
  std::uint64_t key = 0;  ///< key of a request without a seed
  std::vector<Copy> copies;
};

Result<Model> model_of(const Contents& each, const Demand& demand, const GenerateContext& context) {
  if (!each.request) return built_in_model(each.kind, each.number, context.job);
  return generate_child(*each.request, each.pointer, Rng(each.key), context, demand);
}

/// All contents that are not houses, in order.
std::vector<Contents> other_contents(const Surface& surface, const CityParams& params, const Chunks& chunks,
                                     const Job& job) {
  const CityPlan& plan = surface.plan();
  std::vector<Contents> all;
  for (const Landmark& landmark : plan.landmarks) {
    Contents each;
    each.name = "landmark_" + std::to_string(all.size());
    each.group = "landmarks";
    each.request = &landmark.request;
    each.pointer = landmark.pointer + "/model";
    const std::uint32_t block = landmark.part == no_index ? no_index : plan.parts[landmark.part].block;
    double height = landmark.part == no_index ? 0 : surface.height(landmark.part, landmark.position),
           lowest = 0;
    if (const auto footing = footing_of(landmark)) height = surface.floor_height(*footing, lowest);
    each.copies.push_back(
        {transform_at(landmark.position, height, landmark.turn), chunks.at(landmark.position, block)});
    all.push_back(std::move(each));
  }
  std::vector<ObjectKind> kinds = street_furniture(plan, params, job);
  const std::size_t furniture = kinds.size();
  for (ObjectKind& kind : trees_of(plan, params, job)) kinds.push_back(std::move(kind));
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const ObjectKind& kind = kinds[k];
    const std::size_t first = all.size();
    for (std::uint32_t model = 0; model < kind.model_count(); ++model) {
      Contents each;
      each.name = kind.name + "_" + std::to_string(model);
      each.group = k < furniture ? "furniture" : "trees";
      each.kind = kind.name;
      each.number = model;
      if (!kind.models.empty()) each.request = &kind.models[model];
      each.pointer = kind.pointer + "/" + std::to_string(model);
      each.key = job.rng().at(kind.name).at(model).key();
      all.push_back(std::move(each));
    }
    for (const CityObject& object : kind.objects) {
      all[first + object.model].copies.push_back(
          {transform_at(object.position, surface.height(object.part, object.position), object.turn,
                        object.scale),
           chunks.at(object.position, plan.parts[object.part].block)});
    }
  }
  std::erase_if(all, [](const Contents& each) { return each.copies.empty(); });
  return all;
}

std::vector<Copy> copies_of(const SharedHouse& house, const Surface& surface, const Chunks& chunks) {
  const CityPlan& plan = surface.plan();
  std::vector<Copy> copies;
  for (const std::uint32_t number : house.lots) {
    const Lot& lot = plan.lots[number];
    double lowest = 0;
    copies.push_back(
        {transform_at(lot.house->position, surface.floor_height(lot.footing(), lowest), lot.house->turn),
         chunks.at(lot.house->position, plan.parts[lot.part].block)});
  }
  return copies;
}

/// What the houses of each rule have in common, such as the grammar of a blueprint.
std::map<std::uint32_t, Generator::Prepared> prepared_rules(const std::vector<SharedHouse>& houses,
                                                            const GenerateContext& context) {
  std::map<std::uint32_t, Generator::Prepared> prepared;
  for (const SharedHouse& house : houses) {
    const auto [at, is_new] = prepared.try_emplace(house.rule);
    if (is_new) at->second = prepare_child(house.request, context);
  }
  return prepared;
}

bool has_parts(const Contents& each, const GenerateContext& context) {
  const Generator* generator =
      each.request ? find_generator(context.generators, each.request->generator) : nullptr;
  return generator && generator->repeats_parts;
}

/// Makes models on all threads and adds them in order.
template <class Make, class Add>
std::optional<Error> make_and_add(Job& job, std::size_t count, const Make& make, const Add& add) {
  // Models of one batch are in memory at the same time. A single thread has nothing to wait for: with one model at a
  // time, the memory of each is used again while it is in the cache.
  const std::size_t batch = has_threads(job) ? 256 : 1;
  for (std::size_t begin = 0; begin < count; begin += batch) {
    const std::size_t size = std::min(batch, count - begin);
    std::vector<std::optional<Result<Model>>> made(size);
    parallel_for(job, size, 1,
                 [&](std::size_t i, std::size_t, std::size_t) { made[i].emplace(make(begin + i)); });
    for (std::size_t i = 0; i < size; ++i) {
      if (!*made[i]) return std::move(*made[i]).error();
      add(begin + i, std::move(**made[i]));
      made[i].reset();
    }
  }
  return std::nullopt;
}

/// Adds what all copies of a model add to an estimate.
void add_copies(Estimate& estimate, const LevelInfo& info, const Estimate& own, const ViewPoint& view,
                const std::vector<Copy>& copies) {
  for (const Copy& copy : copies) estimate.triangles += info.triangles[view.level(info, copy.at)];
  add_bytes(estimate, own);
  estimate.bytes += bytes_a_copy * copies.size();
}

/// Adds the bytes that a model gains when copies of its meshes are merged into one mesh, as in extract_levels().
void grow_to_one_mesh(Estimate& own, const Model& made) {
  std::uint64_t once = 0;
  for (const MeshGroup& group : made.meshes) {
    for (const Primitive& each : group.primitives) once += each.mesh.elements();
  }
  if (once == 0 || own.triangles <= once) return;
  own.bytes += (own.bytes - image_bytes(own)) * (own.triangles - once) / once;
}

/// A house that was made, from which others of the same rule and number of floors are estimated.
struct HouseSample {
  double width = 0, depth = 0;
  LevelInfo info;
  Estimate own;
};

/// The levels of another house: what has windows grows with its walls, the mass alone does not.
LevelInfo scaled(const HouseSample& sample, const House& house) {
  constexpr std::uint64_t most_of_a_mass = 300;
  LevelInfo info = sample.info;
  const double own = house.width * house.width + house.depth * house.depth;
  const double made = sample.width * sample.width + sample.depth * sample.depth;
  info.radius = std::sqrt(std::max(0.0, info.radius * info.radius + (own - made) / 4));
  const double walls = (house.width + house.depth) / (sample.width + sample.depth);
  for (std::uint64_t& each : info.triangles) {
    if (each > most_of_a_mass)
      each = static_cast<std::uint64_t>(math::to_uint32(static_cast<double>(each) * walls));
  }
  return info;
}

}  // namespace

std::optional<Error> add_contents(Model& model, ChunkNodes& nodes, const Chunks& chunks,
                                  const Surface& surface, const CityParams& params,
                                  const GenerateContext& context) {
  Job& job = context.job;
  const CityPlan& plan = surface.plan();
  const ViewPoint view(params);
  CopyWriter writer(model, nodes, view, context);
  Demand demand;
  demand.lods = level_count(view, context.demand);
  const auto vertices = context.demand.packs ? scene::Vertices::quantized : scene::Vertices::exact;
  const std::vector<SharedHouse> houses = shared_houses(plan, params);
  const std::map<std::uint32_t, Generator::Prepared> prepared = prepared_rules(houses, context);
  // Levels and collision bodies need a node for each building.
  constexpr std::size_t most_single = 2000;
  if (houses.size() > most_single && context.demand.lods == 1 &&
      context.demand.collision == CollisionNames::none)
    writer.merge_single();
  auto error = make_and_add(
      job, houses.size(),
      [&](std::size_t i) {
        return generate_prepared(houses[i].request, "/buildings", Rng(0), context, demand,
                                 prepared.at(houses[i].rule));
      },
      [&](std::size_t i, Model made) {
        scene::separate_bodies(made, vertices);
        writer.add(std::move(made), "building_" + std::to_string(model.meshes.size()), "buildings",
                   copies_of(houses[i], surface, chunks), CopyWriter::Bodies::boxes);
      });
  if (error) return error;
  writer.write_merged("buildings", "houses");
  const std::vector<Contents> others = other_contents(surface, params, chunks, job);
  error = make_and_add(
      job, others.size(), [&](std::size_t i) { return model_of(others[i], demand, context); },
      [&](std::size_t i, Model made) {
        if (has_parts(others[i], context)) scene::separate_bodies(made, vertices);
        const bool is_landmark = others[i].kind.empty();
        for (Warning& each : made.warnings) model.warnings.push_back(std::move(each));
        writer.add(std::move(made), others[i].name, others[i].group, others[i].copies,
                   is_landmark ? CopyWriter::Bodies::boxes : CopyWriter::Bodies::none);
      });
  if (error) return error;
  add_yard_borders(model, nodes, chunks, surface, params, job);
  return std::nullopt;
}

std::optional<Error> estimate_contents(Estimate& estimate, const Surface& surface, const CityParams& params,
                                       const GenerateContext& context) {
  Job& job = context.job;
  const CityPlan& plan = surface.plan();
  const Chunks chunks(plan, params);
  const ViewPoint view(params);
  Demand demand;
  demand.lods = level_count(view, context.demand);
  texture::TextureSizes textures;
  add_ground_textures(textures, surface, params);
  const auto measured = [&](Result<Model> made) {
    Estimate own = estimate_of_made(*made, context.demand);
    grow_to_one_mesh(own, *made);
    return std::pair<LevelInfo, Estimate>(level_info_of(*std::move(made), job), std::move(own));
  };
  // Windows are a whole number, and with a camera the levels of houses depend on their sizes.
  constexpr double width_of_class = 2;
  const auto width_class = [](const House& house) { return math::to_int32(house.width / width_of_class); };
  std::map<std::array<int, 3>, HouseSample> samples;
  for (const SharedHouse& shared : shared_houses(plan, params)) {
    const House& house = *plan.lots[shared.lots[0]].house;
    const auto [sample, is_new] =
        samples.try_emplace({static_cast<int>(house.rule), house.floors, width_class(house)});
    if (is_new) {
      Result<Model> made = generate_child(shared.request, "/buildings", Rng(0), context, demand);
      if (!made) return made.error();
      auto [info, own] = measured(std::move(made));
      sample->second = {house.width, house.depth, std::move(info), std::move(own)};
    }
    const LevelInfo info = scaled(sample->second, house);
    add_copies(estimate, info, sample->second.own, view, copies_of(shared, surface, chunks));
  }
  for (const Contents& each : other_contents(surface, params, chunks, job)) {
    Result<Model> made = model_of(each, demand, context);
    if (!made) return made.error();
    const auto [info, own] = measured(std::move(made));
    add_copies(estimate, info, own, view, each.copies);
  }
  for (const BorderPiece& piece : yard_borders(surface, params, job)) {
    const std::uint64_t triangles = yard_border_triangles(piece, params.yards->border);
    estimate.triangles += triangles;
    estimate.bytes += bytes_a_border_triangle * triangles;
  }
  add_images(estimate, textures.images(context.demand.textures));
  return std::nullopt;
}

}  // namespace seedmesh::city
