/// Levels of detail by distance and by budget.
#include <map>

#include "core/pipeline.h"
#include "tests/core/scene/support.h"
#include "tests/support/context.h"

namespace seedmesh {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;

Json grove(double size = 200) {
  return {{"ground", {{"size", size}}},
          {"layers",
           {{{"name", "tree"},
             {"model", {{"preset", "proctree_0"}, {"parameters", {{"mLevels", 3}, {"mSegments", 6}}}}},
             {"variants", 2},
             {"place", {{"method", "poisson"}, {"distance", 9}}}}}}};
}

Json seen_from(Json scene, double x, double y, double z) {
  scene["camera"] = {{"position", {x, y, z}}};
  return scene;
}

/// Generates a scene with the demand that the pipeline would pass.
Result<Model> demanded(const Json& json, const Demand& demand) {
  const Generator::Params params = read_scene_params(json);
  Job job(1, Job::Options{});
  try {
    return scene::generate(own(params), context_of(job, demand));
  } catch (const Stop& stop) {
    return Error{stop.code(), {stop.issue()}};
  }
}

Demand demand_of(int lods, bool impostor = false, CopyForm copies = CopyForm::any) {
  Demand demand;
  demand.lods = lods;
  demand.impostor = impostor;
  demand.copies = copies;
  return demand;
}

struct Shown {
  double distance;
  std::size_t triangles;
};

/// For every copy: its distance from the camera and the triangles of its mesh.
std::vector<Shown> copies_of(const Model& model, const glm::vec3& camera) {
  std::vector<Shown> shown;
  for (const Node& node : model.nodes) {
    if (node.mesh < 0 || node.name == "ground") continue;
    std::size_t triangles = 0;
    for (const Primitive& each : model.meshes[static_cast<std::size_t>(node.mesh)].primitives)
      triangles += each.mesh.elements();
    std::vector<Transform> copies = node.instances.transforms;
    if (copies.empty()) copies.push_back(node.transform);
    for (const Transform& copy : copies)
      shown.push_back({static_cast<double>(glm::length(copy.translation - camera)), triangles});
  }
  return shown;
}

std::vector<std::string> pointers_of(const Result<Model>& model) {
  std::vector<std::string> all;
  if (model) return all;
  for (const Issue& issue : model.error().issues) all.push_back(issue.pointer);
  return all;
}

TEST(SceneLevels, BecomeCoarserWithDistanceAndEndInImpostors) {
  const glm::vec3 camera(0, 2, 100);
  const Result<Model> model = demanded(seen_from(grove(), 0, 2, 100), {});
  ASSERT_TRUE(model);
  std::map<std::size_t, std::pair<double, double>> range;  // by triangles: nearest and farthest copy
  for (const Shown& each : copies_of(*model, camera)) {
    auto& [near, far] = range.try_emplace(each.triangles, each.distance, each.distance).first->second;
    near = std::min(near, each.distance);
    far = std::max(far, each.distance);
  }
  ASSERT_GE(range.size(), 4U);
  EXPECT_EQ(range.begin()->first, 12U) << "the farthest are impostors";
  EXPECT_GT(range.begin()->second.first, range.rbegin()->second.second)
      << "and farther than all of the finest";
}

const Node* named(const Model& model, const std::string& name) {
  const auto found = std::find_if(model.nodes.begin(), model.nodes.end(),
                                  [&](const Node& node) { return node.name == name; });
  return found == model.nodes.end() ? nullptr : &*found;
}

std::size_t triangles_of(const Model& model, int mesh) {
  std::size_t triangles = 0;
  for (const Primitive& each : model.meshes.at(static_cast<std::size_t>(mesh)).primitives)
    triangles += each.mesh.elements();
  return triangles;
}

Json hills(const char* mesh) {
  Json json = grove();
  json.erase("ground");
  json["terrain"] = {
      {"generator", "terrain"},
      {"parameters",
       {{"algorithm", "fbm"}, {"resolution", 65}, {"size", 100}, {"amplitude", 12}, {"mesh", mesh}}}};
  json["paths"] = {{{"points", {{-40, -40}, {40, 40}}}}};
  return json;
}

TEST(SceneLevels, AreAlsoMadeOfTheGround) {
  for (const char* mesh : {"grid", "rtin", "greedy"}) {
    Result<Model> model = demanded(hills(mesh), demand_of(3));
    ASSERT_TRUE(model) << mesh;
    Job job(1, Job::Options{});
    finish(*model, job);
    EXPECT_THAT(faults(*model), IsEmpty()) << mesh;
    const Node* ground = named(*model, "terrain_2");
    ASSERT_TRUE(ground) << mesh;
    ASSERT_EQ(ground->lods.size(), 2U) << mesh;
    EXPECT_LT(triangles_of(*model, ground->lods[0]), triangles_of(*model, ground->mesh)) << mesh;
    EXPECT_LT(triangles_of(*model, ground->lods[1]), triangles_of(*model, ground->lods[0])) << mesh;
    const Result<Model> plain = demanded(hills(mesh), demand_of(1));
    ASSERT_TRUE(plain) << mesh;
    EXPECT_EQ(count(*plain).triangles, count(*model).triangles) << mesh << ": the finest level is unchanged";
  }
}

TEST(SceneLevels, KeepTheBodiesOfABuildingApart) {
  for (const char* blueprint : {"villa", "temple", "church"}) {
    Result<Model> made =
        demanded({{"layers",
                   {{{"model", {{"generator", "building"}, {"parameters", {{"blueprint", blueprint}}}}},
                     {"place", {{"method", "scatter"}, {"count", 1}}}}}}},
                 demand_of(3));
    ASSERT_TRUE(made) << blueprint;
    Job job = job_of(1);
    finish(*made, job);
    EXPECT_THAT(faults(*made), IsEmpty()) << blueprint;
  }
}

TEST(SceneLevels, LiftPathsOverTheCoarserGround) {
  const Result<Model> model = demanded(hills("grid"), demand_of(3));
  ASSERT_TRUE(model);
  const Node* path = named(*model, "path");
  ASSERT_TRUE(path);
  ASSERT_EQ(path->lods.size(), 2U);
  const auto lowest = [&](int mesh) {
    return bounds_of(model->meshes[static_cast<std::size_t>(mesh)].primitives.at(0).mesh.position.span())
        .min.y;
  };
  EXPECT_GT(lowest(path->lods[0]), lowest(path->mesh));
  EXPECT_GT(lowest(path->lods[1]), lowest(path->lods[0]));
}

TEST(SceneLevels, KeepThePositionOfEveryPlant) {
  const Result<Model> model = demanded(seen_from(grove(), 0, 2, 100), {});
  ASSERT_TRUE(model);
  EXPECT_EQ(copies_of(*model, {}).size(), planted(grove()).layer(0).size());
}

TEST(SceneLevels, HaveNoImpostorsUnlessRequestedAndTextured) {
  Json json = seen_from(grove(), 0, 2, 100);
  Demand bare;
  bare.textures = 0;
  for (const bool by_texture : {true, false}) {
    if (!by_texture) json["camera"]["impostors"] = false;
    const Result<Model> model = demanded(json, by_texture ? bare : Demand{});
    ASSERT_TRUE(model);
    for (const Shown& each : copies_of(*model, {})) EXPECT_GT(each.triangles, 6U);
  }
}

TEST(SceneLevels, KeepABudgetAndUseMostOfIt) {
  std::uint64_t finest = 0;
  {
    const Result<Model> whole = demanded(grove(), {});
    ASSERT_TRUE(whole);
    finest = count(*whole).triangles;
  }
  for (const double share : {0.9, 0.6}) {
    for (const bool with_camera : {false, true}) {
      Demand demand;
      demand.most_triangles = static_cast<std::uint64_t>(static_cast<double>(finest) * share);
      if (with_camera) demand.most_triangles /= 8;
      const Result<Model> model = demanded(with_camera ? seen_from(grove(), 0, 2, 60) : grove(), demand);
      ASSERT_TRUE(model);
      const std::uint64_t drawn = count(*model).triangles;
      EXPECT_LE(drawn, demand.most_triangles);
      if (!with_camera) {
        EXPECT_GT(drawn, demand.most_triangles * 9 / 10);
      }
    }
  }
}

TEST(SceneLevels, ReportTheNumberOfPlantsAtEach) {
  const Result<Model> model = demanded(seen_from(grove(), 0, 2, 100), {});
  ASSERT_TRUE(model);
  for (const Extra& extra : model->extras) {
    if (extra.name != "layers") continue;
    const Json layer = Json::parse(extra.json)[0];
    std::size_t sum = layer["levels"]["impostors"];
    for (const Json& each : layer["levels"]["meshes"]) sum += each.get<std::size_t>();
    EXPECT_EQ(sum, layer["placed"].get<std::size_t>());
    EXPECT_EQ(layer["triangles"].get<std::uint64_t>() + 2, count(*model).triangles);
  }
}

TEST(SceneLevels, AreRefusedTogetherWithACamera) {
  const Json json = seen_from(grove(), 0, 2, 100);
  EXPECT_THAT(pointers_of(demanded(json, demand_of(3))), ElementsAre("/output/lods"));
  EXPECT_THAT(pointers_of(demanded(json, demand_of(1, true))), Contains("/output/impostor"));
  EXPECT_THAT(pointers_of(demanded(json, demand_of(1, false, CopyForm::merge))),
              ElementsAre("/output/instancing"));
}

TEST(SceneLevels, EndInAnImpostorOnRequest) {
  const Result<Model> model = demanded(grove(60), demand_of(2, true));
  ASSERT_TRUE(model);
  std::size_t plants = 0;
  for (const Node& node : model->nodes) {
    if (node.mesh < 0 || node.name == "ground") continue;
    ASSERT_EQ(node.lods.size(), 2U);
    EXPECT_TRUE(node.has_impostor);
    ++plants;
  }
  EXPECT_EQ(plants, 2U);
}

TEST(SceneLevels, GiveTheSameBytesWithAnyNumberOfThreads) {
  const auto file = [](int threads) {
    const Json body = {{"generator", "scene"},
                       {"seed", 5},
                       {"parameters", seen_from(grove(120), 0, 2, 60)},
                       {"output", {{"textures", 128}, {"max_triangles", 150'000}}}};
    const Result<Request> request = read_request(body.dump(), Limits{});
    EXPECT_TRUE(request);
    const Result<Product> product = produce(*request, {.threads = threads});
    EXPECT_TRUE(product) << product.error().issues.front().message;
    EXPECT_LE(product->statistics.triangles, 150'000U);
    return product->payload.text();
  };
  EXPECT_EQ(file(1), file(8));
}

TEST(SceneLevels, RefuseImpostorsWithoutAPlantAndReportPlantsThatAreTooSmall) {
  Json json = {
      {"layers", {{{"name", "stone"}, {"model", cube()}, {"place", {{"method", "scatter"}, {"count", 4}}}}}}};
  EXPECT_THAT(pointers_of(demanded(json, demand_of(1, true))), ElementsAre("/output/impostor"));
  json["layers"][0]["model"] = {
      {"generator", "lsystem"},
      {"parameters", {{"axiom", "F"}, {"productions", {"F -> F"}}, {"iterations", 1}, {"sides", 3}}}};
  const Result<Model> model = demanded(json, demand_of(1, true));
  ASSERT_TRUE(model);
  const auto tells = [](const Warning& each) { return each.pointer == "/output/impostor"; };
  EXPECT_EQ(std::count_if(model->warnings.begin(), model->warnings.end(), tells), 1);
}

}  // namespace
}  // namespace seedmesh
