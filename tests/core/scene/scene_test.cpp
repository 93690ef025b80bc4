/// Whole scenes: shared models, ranges, errors, lists.
#include "core/gltf/write/write.h"
#include "core/pipeline.h"
#include "tests/core/scene/support.h"
#include "tests/support/context.h"

namespace seedmesh {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

Json bush(int iterations) {
  return {{"generator", "lsystem"},
          {"parameters",
           {{"axiom", "A"},
            {"productions", {"A -> F[+(ran(20,40))A][-(ran(20,40))A]"}},
            {"iterations", iterations},
            {"constants", {{"r", 1}}}}}};
}

Json forest() {
  return {{"ground", {{"size", 30}}},
          {"layers",
           {{{"name", "bush"},
             {"model", bush(3)},
             {"variants", 3},
             {"place", {{"distance", 3}}},
             {"scale", {0.5, 1.5}}}}}};
}

std::string file_of(const Json& json, int threads) {
  const Result<Request> request =
      read_request(Json{{"generator", "scene"}, {"seed", 5}, {"parameters", json}}.dump(), Limits{});
  EXPECT_TRUE(request);
  const Result<Product> product = produce(*request, {.threads = threads});
  EXPECT_TRUE(product);
  return product->payload.text();
}

TEST(Scene, MakesEachModelOnceAndSharesIt) {
  const Result<Model> model = scene_of(forest());
  ASSERT_TRUE(model);
  EXPECT_THAT(faults(*model), IsEmpty());
  EXPECT_EQ(model->meshes.size(), 4U);  // the ground and three variants
  std::size_t copies = 0, nodes = 0;
  for (const Node& node : model->nodes) {
    copies += node.instances.transforms.size();
    nodes += node.instances.transforms.empty() ? 0U : 1U;
  }
  const Planted made = planted(forest());
  EXPECT_EQ(nodes, 3U);
  EXPECT_EQ(copies, made.layer(0).size());
  EXPECT_EQ(model->materials.size(), 2U);  // all variants share the bark
}

TEST(Scene, PutsCopiesIntoChunksByArea) {
  Json json = forest();
  json["chunks"] = 2;
  const Result<Model> model = scene_of(json);
  ASSERT_TRUE(model);
  std::size_t copies = 0;
  for (const Node& node : model->nodes) {
    if (node.name != "bush_1_0_1") continue;
    for (const Transform& t : node.instances.transforms) {
      ++copies;
      EXPECT_LE(t.translation.x, 0);
      EXPECT_GE(t.translation.z, 0);
    }
  }
  EXPECT_GT(copies, 2U);
}

TEST(Scene, GivesTheSameBytesWithAnyNumberOfThreads) {
  Json json = forest();
  json.erase("ground");
  json["terrain"] = {{"generator", "terrain"}, {"parameters", {{"iterations", 5}, {"size", 40}}}};
  json["layers"].push_back({{"model", {{"preset", "menger_sponge"}, {"parameters", {{"iterations", 1}}}}},
                            {"place", {{"method", "scatter"}, {"count", 40}}}});
  EXPECT_EQ(file_of(json, 1), file_of(json, 8));
}

TEST(Scene, DrawsRangesForEachVariantAndKeepsWholeNumbersWhole) {
  Json json = forest();
  json["layers"][0]["variants"] = 40;
  json["layers"][0]["vary"] = {{{"parameter", "iterations"}, {"from", 1}, {"to", 4}},
                               {{"parameter", "constants.r"}, {"from", 0.5}, {"to", 2}},
                               {{"parameter", "style"}, {"among", {"tubes", "lines"}}}};
  const Json models = derived_scene(json)["models"];
  std::set<int> iterations;
  std::set<std::string> styles;
  std::set<double> constants;
  for (const auto& [name, request] : models.items()) {
    const Json& parameters = request["parameters"];
    ASSERT_TRUE(parameters["iterations"].is_number_integer()) << parameters;
    iterations.insert(parameters["iterations"].get<int>());
    styles.insert(parameters.value("style", "tubes"));
    constants.insert(parameters["constants"]["r"].get<double>());
  }
  EXPECT_THAT(iterations, ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(styles, ElementsAre("lines", "tubes"));
  EXPECT_EQ(constants.size(), 40U);
  EXPECT_GE(*constants.begin(), 0.5);
  EXPECT_LE(*constants.rbegin(), 2);
}

TEST(Scene, ListsRequestsForItsModels) {
  const Json answer = derived_scene(forest(), 1);
  Json request = answer["models"]["bush_1"];
  const Result<Request> read = read_request(request.dump(), Limits{});
  ASSERT_TRUE(read);
  const Result<Product> alone = produce(*read, {});
  ASSERT_TRUE(alone);
  const Result<Model> whole = scene_of(forest());
  ASSERT_TRUE(whole);
  for (const MeshGroup& group : whole->meshes) {
    if (group.name != "bush_1") continue;
    EXPECT_EQ(alone->statistics.vertices, group.primitives.at(0).mesh.position.size());
  }
}

TEST(Scene, ListsTheContentOfTheModel) {
  const Json answer = derived_scene(forest());
  const Planted made = planted(forest());
  ASSERT_EQ(answer["placements"].size(), made.layer(0).size());
  for (std::size_t i = 0; i < made.layer(0).size(); ++i) {
    const Json& each = answer["placements"][i];
    EXPECT_FLOAT_EQ(each["translation"][0].get<float>(), static_cast<float>(made.layer(0)[i].at.x));
    EXPECT_TRUE(answer["models"].contains(each["model"]));
    EXPECT_EQ(each["rotation"].size(), 4U);
  }
  EXPECT_EQ(answer["layers"][0]["placed"], made.layer(0).size());
}

TEST(Scene, GivesPositionsTheirOwnAgeAndModel) {
  const Json json = {{"ground", {{"size", 30}}},
                     {"layers",
                      {{{"name", "tree"},
                        {"model", bush(4)},
                        {"variants", 1},
                        {"place",
                         {{"method", "positions"},
                          {"positions",
                           {{{"at", {-5, 0}}},
                            {{"at", {0, 0}}, {"age", 2.5}},
                            {{"at", {5, 1}}, {"model", cube(2)}, {"turn", 90}}}}}}}}}};
  const Json answer = derived_scene(json);
  ASSERT_EQ(answer["placements"].size(), 3U);
  EXPECT_EQ(answer["placements"][0]["model"], "tree_0");
  EXPECT_EQ(answer["placements"][1]["model"], "tree_at_1");
  EXPECT_EQ(answer["models"]["tree_at_1"]["parameters"]["age"], 2.5);
  EXPECT_EQ(answer["models"]["tree_at_2"]["generator"], "fractal");
  EXPECT_NEAR(answer["placements"][2]["rotation"][1].get<double>(), std::sqrt(0.5), 1e-6);
  const Result<Model> model = scene_of(json);
  ASSERT_TRUE(model);
  EXPECT_THAT(faults(*model), IsEmpty());
}

TEST(Scene, GrowsAllPlantsToItsAgeButNoneBeyondItsOwn) {
  Json json = forest();
  json["layers"][0]["place"] = {{"method", "positions"},
                                {"positions", {{{"at", {0, 0}}}, {{"at", {3, 0}}, {"age", 1}}}}};
  json["layers"][0]["variants"] = 1;
  json["age"] = 2;
  Json models = derived_scene(json)["models"];
  EXPECT_EQ(models["bush_0"]["parameters"]["age"], 2);
  EXPECT_EQ(models["bush_at_1"]["parameters"]["age"], 1);
  json["age"] = 50;
  models = derived_scene(json)["models"];
  EXPECT_EQ(models["bush_0"]["parameters"]["age"], 3);  // its iterations
}

TEST(Scene, PutsAllPlantsIntoOneSeason) {
  const Json json = {
      {"season", "autumn"},
      {"layers",
       {{{"name", "tree"},
         {"model", {{"preset", "proctree_0"}}},
         {"variants", 1},
         {"place", {{"distance", 9}}}},
        {{"name", "bush"}, {"model", bush(2)}, {"variants", 1}, {"place", {{"distance", 9}}}}}}};
  const Json models = derived_scene(json)["models"];
  EXPECT_EQ(models["tree_0"]["parameters"]["season"], "autumn");
  EXPECT_FALSE(models["bush_0"]["parameters"].contains("season"));
}

TEST(Scene, RefusesScenesInsideAnywhere) {
  const Json scene = {{"generator", "scene"}, {"parameters", Json::object()}};
  const Json hidden = {{"generator", "fractal"}, {"parameters", {{"element", {{"model", scene}}}}}};
  const auto with = [](const Json& model) {
    return Json{{"layers", {{{"model", model}, {"place", {{"distance", 3}}}}}}};
  };
  EXPECT_THAT(scene_errors(with(scene)), ElementsAre(StartsWith("/layers/0/model/generator: found a scene")));
  EXPECT_THAT(scene_errors(with(hidden)),
              ElementsAre(StartsWith("/layers/0/model/parameters/element/model/generator: found a scene")));
  EXPECT_THAT(scene_errors({{"terrain", scene}}), ElementsAre(StartsWith("/terrain/generator: found scene")));
}

TEST(Scene, ReportsAllErrorsAtOnce) {
  const Json json = {
      {"ground", {{"size", 10}}},
      {"terrain", {{"generator", "terrain"}, {"parameters", {{"shape", "sphere"}, {"algorithm", "fbm"}}}}},
      {"layers",
       {{{"name", "a"}, {"model", cube()}, {"place", {{"method", "rows"}, {"distance", 2}}}},
        {{"name", "a"},
         {"model", bush(3)},
         {"vary",
          {{{"parameter", "iterations"}, {"from", 1}, {"to", 5000}},
           {{"parameter", "iteration"}, {"from", 1}, {"to", 2}}}},
         {"place", {{"distance", 1}, {"near", {{{"layer", "b"}, {"to", 3}}}}}},
         {"scale", {2, 1}}},
        {{"model", cube()},
         {"age", 3},
         {"foundation", Json::object()},
         {"place", {{"distance", 1}, {"area", {{0, 0}, {1, 1}, {2, 2}}}}}}}}};
  EXPECT_THAT(
      scene_errors(json),
      testing::UnorderedElementsAre(
          HasSubstr("/ground: found both"), HasSubstr("/terrain/parameters/shape: found a sphere"),
          HasSubstr("/layers/0/place/distance: has no effect with the method rows"),
          HasSubstr("/layers/0/place: the method rows needs `spacing`"), HasSubstr("/layers/1/name: found a"),
          AllOf(HasSubstr("/layers/1/vary/0/to: the model refuses it"), HasSubstr("5000")),
          HasSubstr("/layers/1/vary/1/parameter: lsystem has no parameter \"iteration\""),
          HasSubstr("/layers/1/place/near/0/layer: "), HasSubstr("/layers/1/scale: the first value is above"),
          HasSubstr("/layers/2/age: fractal has no parameter age"), HasSubstr("/layers/2/foundation: "),
          HasSubstr("/layers/2/place/area: the polygon has no area")));
}

TEST(Scene, RefusesModelsThatAreTooLargeTogetherBeforeItMakesAny) {
  const Json sponge = {{"preset", "menger_sponge"}, {"parameters", {{"iterations", 3}}}};  // 36,096 triangles
  const Json json = {{"layers",
                      {{{"model", sponge}, {"variants", 2}, {"place", {{"distance", 9}}}},
                       {{"model", sponge}, {"variants", 2}, {"place", {{"distance", 9}}}}}}};
  Job::Options options;
  options.limits.triangles = 100'000;
  const Generator::Params params = read_scene_params(json);
  Job job(1, options);
  try {
    (void)scene::generate(own(params), context_of(job));
    FAIL();
  } catch (const Stop& stop) {
    EXPECT_EQ(stop.code(), Code::limit);
    EXPECT_EQ(stop.issue().pointer, "/layers/1/model");
    EXPECT_EQ(job.spent(Resource::triangles), 0U);
    EXPECT_EQ(job.budget()->used(), 0U);
  }
}

TEST(Scene, PointsAtTheModelThatFails) {
  Json json = forest();
  json["layers"][0]["model"]["parameters"]["axiom"] = "A(1)F(1/0)";
  const Result<Model> model = scene_of(json);
  ASSERT_FALSE(model);
  EXPECT_THAT(model.error().issues.front().pointer, StartsWith("/layers/0/model/parameters/"));
}

TEST(Scene, WithoutLayersIsItsGround) {
  const Result<Model> model = scene_of(Json::object());
  ASSERT_TRUE(model);
  EXPECT_EQ(model->meshes.size(), 1U);
  EXPECT_THAT(faults(*model), IsEmpty());
  const Result<Model> disc = scene_of({{"ground", {{"outline", "disc"}}}});
  ASSERT_TRUE(disc);
  EXPECT_THAT(faults(*disc), IsEmpty());
}

TEST(Scene, DrawsPathsOverHillsWithoutDefects) {
  const Result<Model> model =
      scene_of({{"terrain", {{"generator", "terrain"}, {"parameters", {{"iterations", 5}, {"size", 60}}}}},
                {"paths",
                 {{{"points", {{-30, 0}, {0, 8}, {2, 9}, {2, -20}}}},
                  {{"points", {{0, 0}, {9, 9}}}, {"shown", false}}}}});
  ASSERT_TRUE(model);
  EXPECT_THAT(faults(*model), IsEmpty());
  EXPECT_EQ(model->meshes.size(), 2U);
}

TEST(Scene, ListsTheFilesOfItsModels) {
  const Result<Request> request = read_request(
      Json{{"generator", "scene"}, {"parameters", forest()}, {"output", {{"format", "placements"}}}}.dump(),
      Limits{});
  ASSERT_TRUE(request);
  const Result<Product> product = produce(*request, {});
  ASSERT_TRUE(product);
  const std::string zip = product->payload.text();
  EXPECT_EQ(product->media_type, "application/zip");
  EXPECT_THAT(zip, StartsWith("PK"));
  const std::size_t begin = zip.find("{\"models\":"), end = zip.find("\n]}\n");
  ASSERT_NE(begin, std::string::npos);
  const Json list = Json::parse(zip.substr(begin, end + 4 - begin));
  EXPECT_EQ(list["models"]["bush_2"]["file"], "models/bush_2.glb");
  EXPECT_NE(zip.find("models/bush_2.glb"), std::string::npos);
  const Json answer = derived_scene(forest(), 0);
  ASSERT_EQ(list["placements"].size(), answer["placements"].size());
  for (std::size_t i = 0; i < answer["placements"].size(); ++i) {
    EXPECT_EQ(list["placements"][i]["model"], answer["placements"][i]["model"]);
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_FLOAT_EQ(list["placements"][i]["rotation"][k].get<float>(),
                      answer["placements"][i]["rotation"][k].get<float>());
    }
  }
}

TEST(Scene, PassesLevelsOfDetailOn) {
  const Generator::Params params = read_scene_params(forest());
  Job job = job_of(1);
  Demand demand;
  demand.lods = 3;
  Result<Model> model = scene::generate(own(params), context_of(job, demand));
  ASSERT_TRUE(model);
  std::size_t with_levels = 0;
  for (const Node& node : model->nodes) with_levels += node.lods.size() == 2 ? 1U : 0U;
  EXPECT_EQ(with_levels, 3U);
  finish(*model, job);
  EXPECT_THAT(faults(*model), IsEmpty());
}

TEST(Scene, DoesNotWarnOfAMatureAgeThatAPositionUses) {
  const auto warnings = [](const Json& positions) {
    const Json tree = {{"generator", "tree"}, {"parameters", {{"Levels", 1}, {"mature_age", 12}}}};
    const Json place = {{"method", "positions"}, {"positions", positions}};
    const Json layer = {{"model", tree}, {"variants", 1}, {"place", place}};
    const Result<Model> model = scene_of({{"ground", {{"size", 30}}}, {"layers", {layer}}});
    EXPECT_TRUE(model);
    std::vector<std::string> pointers;
    for (const Warning& each : model->warnings) pointers.push_back(each.pointer);
    return pointers;
  };
  const Json grown = {{"at", {0, 0}}}, young = {{"at", {5, 0}}, {"age", 4}};
  EXPECT_THAT(warnings(Json::array({grown})), ElementsAre("/layers/0/model/parameters/mature_age"));
  EXPECT_THAT(warnings(Json::array({grown, young})), IsEmpty());
}

TEST(Scene, CountsTheTrianglesOfPathsBeforeTheyAreMade) {
  const Json terrain = {{"generator", "terrain"}, {"parameters", {{"iterations", 8}, {"size", 100}}}};
  const Json across = {{"points", {{-50, 0}, {50, 0}}}, {"width", 100}};
  Job::Options options;
  options.limits.triangles = 2 * 256 * 256 + 300'000;
  options.limits.memory_bytes = 64 << 20U;
  Json json = {{"terrain", terrain}, {"paths", {{{"points", {{-9, 0}, {9, 9}}}, {"width", 1}}, across}}};
  const Result<Model> model = scene_of(json, 1, options);
  ASSERT_FALSE(model);
  EXPECT_EQ(model.error().code, Code::limit);
  EXPECT_EQ(model.error().issues.front().pointer, "/paths/1");
  EXPECT_THAT(model.error().issues.front().message, HasSubstr("triangles"));
}

TEST(Scene, ListsItsModelsWithTheRequestedTextures) {
  const auto list = [](const Json& textures) {
    const Json tree = {{"preset", "proctree_0"}, {"parameters", {{"mLevels", 2}, {"mSegments", 4}}}};
    const Json layer = {{"model", tree}, {"variants", 1}, {"place", {{"method", "scatter"}, {"count", 3}}}};
    const Json body = {{"generator", "scene"},
                       {"parameters", {{"layers", {layer}}}},
                       {"output", {{"format", "placements"}, {"textures", textures}}}};
    const Result<Request> request = read_request(body.dump(), Limits{});
    EXPECT_TRUE(request) << request.error().issues.front().message;
    Job::Options options;
    const Result<Product> product = produce(*request, options);
    EXPECT_TRUE(product);
    // Each byte is spent once: exactly this limit is enough, and one byte fewer is not.
    options.limits.output_bytes = product->payload.size();
    EXPECT_TRUE(produce(*request, options));
    options.limits.output_bytes -= 1;
    EXPECT_FALSE(produce(*request, options));
    return product->payload.text();
  };
  const std::string none = list("none"), small = list(64), large = list(256);
  EXPECT_EQ(none.find("image/png"), std::string::npos);
  EXPECT_NE(small.find("image/png"), std::string::npos);
  EXPECT_LT(none.size(), small.size());
  EXPECT_LT(small.size(), large.size());
}

}  // namespace
}  // namespace seedmesh
