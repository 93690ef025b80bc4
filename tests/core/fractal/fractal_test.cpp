/// The whole generator: results of derive, refused requests, elements and methods.
#include <cmath>
#include <cstring>
#include <set>

#include "core/generators/fractal/chaos.h"
#include "core/generators/fractal/encode.h"
#include "core/generators/fractal/pieces.h"
#include "tests/core/fractal/support.h"
#include "tests/support/context.h"

namespace seedmesh::fractal {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::StartsWith;

TEST(Fractal, DerivesTheSpongeInClosedFormAtAnyDepth) {
  const Json three = derived("{}");
  EXPECT_EQ(three["pieces"], 8000);
  EXPECT_EQ(three["exposed_quads"], 18048);
  EXPECT_EQ(three["genus"], 1409);
  EXPECT_NEAR(three["dimension"].get<double>(), 2.7268330278608, 1e-9);
  EXPECT_NEAR(three["surface_area"].get<double>(), 24.757201646090536, 1e-9);
  EXPECT_NEAR(three["volume"].get<double>(), 0.4064421074023269, 1e-12);
  const Json thirty = derived(R"({"iterations": 30})");
  EXPECT_NEAR(thirty["volume"].get<double>(), std::pow(20.0 / 27, 30), 1e-15);
  EXPECT_TRUE(thirty["genus"].is_null());
}

TEST(Fractal, AddsUpTheMeasuresOfCopiesThatTouchAlongEdges) {
  const Json pyramid =
      derived(R"({"instructions": "sierpinski_pyramid", "element": "pyramid", "iterations": 4})");
  EXPECT_NEAR(pyramid["volume"].get<double>(), 0.050862630208333336, 1e-12);
  const Json tetrahedra =
      derived(R"({"instructions": "sierpinski_tetrahedron", "element": "tetrahedron", "iterations": 5})");
  EXPECT_NEAR(tetrahedra["surface_area"].get<double>(), 2 * std::sqrt(3.0), 1e-12);
  EXPECT_TRUE(derived(R"({"instructions": "sierpinski_pyramid", "element": "sphere"})")["volume"].is_null());
}

/// Koch 1904: the perimeter grows by 4/3 each round, and the area tends to 8/5 of the triangle.
TEST(Fractal, MeasuresTheKochCurveAndTheSnowflake) {
  const Json curve = derived(R"({"instructions": "koch_curve", "element": "segment", "stages": [0, 1, 5]})");
  ASSERT_EQ(curve["stages"].size(), 3U);
  for (const Json& stage : curve["stages"]) {
    const int rounds = stage["iterations"];
    EXPECT_EQ(stage["pieces"], std::pow(4, rounds));
    EXPECT_NEAR(stage["length"].get<double>(), std::pow(4.0 / 3, rounds), 1e-12);
    // Round k adds 4^(k-1) triangles with sides of 3^-k.
    double area = 0;
    for (int k = 1; k <= rounds; ++k) area += std::sqrt(3.0) / 4 * std::pow(4.0, k - 1) / std::pow(9.0, k);
    EXPECT_NEAR(stage["area"].get<double>(), area, 1e-12);
  }
  constexpr double side = 0.75;
  const double triangle = std::sqrt(3.0) / 4 * side * side;
  const auto plate = [](int rounds) {
    return derived(R"({"instructions": "koch_snowflake", "element": "plate", "iterations": )" +
                   std::to_string(rounds) + "}");
  };
  EXPECT_NEAR(plate(0)["area"].get<double>(), triangle, 1e-12);
  EXPECT_NEAR(plate(1)["area"].get<double>(), triangle * 4 / 3, 1e-12);
  EXPECT_NEAR(plate(200)["area"].get<double>(), triangle * 8 / 5, 1e-12);
  EXPECT_NEAR(plate(3)["length"].get<double>(), 3 * side * std::pow(4.0 / 3, 3), 1e-12);
  const Json outline =
      derived(R"({"instructions": "koch_snowflake", "element": "segment", "iterations": 3})");
  EXPECT_EQ(outline["area"], plate(3)["area"]);
  // The mesh of the plate has the same area: half of its faces that look along Z show one side.
  const Result<Model> model =
      fractal_of(R"({"instructions": "koch_snowflake", "element": "plate", "iterations": 3})");
  ASSERT_TRUE(model);
  const Mesh& mesh = model->meshes[0].primitives[0].mesh;
  double twice = 0;
  for (std::size_t i = 0; i < mesh.index.size(); i += 3) {
    const glm::vec3 a = mesh.position[mesh.index.at(i)], b = mesh.position[mesh.index.at(i + 1)],
                    c = mesh.position[mesh.index.at(i + 2)];
    const glm::vec3 normal = glm::cross(b - a, c - a);
    if (normal.z > 0) twice += static_cast<double>(normal.z);
  }
  EXPECT_NEAR(twice / 2, plate(3)["area"].get<double>(), 1e-6);
}

TEST(Fractal, DerivesEveryStageOfTheChaosGame) {
  const Json answer = derived(R"({"method": "frcm", "stages": [100, 500]})");
  ASSERT_EQ(answer["stages"].size(), 2U);
  EXPECT_EQ(answer["stages"][1]["points"], 500);
  EXPECT_EQ(answer["stages"][1]["pieces"], 500);
}

TEST(Fractal, SolvesMoransEquationWhereScalesDiffer) {
  const double dimension = derived(R"({"instructions": "jerusalem_cube"})")["dimension"];
  const double r = std::sqrt(2.0) - 1;
  EXPECT_NEAR(8 * std::pow(r, dimension) + 12 * std::pow(r * r, dimension), 1, 1e-9);
}

TEST(Fractal, RefusesMapsThatGrowOrLeaveNothing) {
  EXPECT_THAT(refusal(R"({"instructions": [{"scale": 1.5}]})"),
              testing::AllOf(StartsWith("/instructions/0/scale"), HasSubstr("1.5")));
  EXPECT_THAT(refusal(R"({"instructions": [{"scale": 0.5}, {"scale": [0.5, 0, 0.5]}]})"),
              StartsWith("/instructions/1/scale"));
  EXPECT_THAT(refusal(R"({"instructions": [{"matrix": [0,0,0,0, 0,0,0,0, 0,0,0,0]}]})"), HasSubstr("zeros"));
  EXPECT_THAT(refusal(R"({"instructions": [{"scale": 0.5, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0]}]})"),
              StartsWith("/instructions/0:"));
  EXPECT_THAT(refusal(R"({"instructions": [{}]})"), HasSubstr("identity"));
  EXPECT_THAT(refusal(R"({"method": "frcm", "instructions": [{"scale": 1, "rotate": [0, 30, 0]}]})"),
              HasSubstr("does not contract"));
  EXPECT_THAT(refusal(R"({"instructions": "word_test", "text": "A?"})"), StartsWith("/text"));
}

TEST(Fractal, RefusesAModelAboveALimitBeforeItIsMade) {
  for (const char* name : {"menger_sponge", "corner_cube_outside", "sierpinski_triangle", "word_test",
                           "dragon", "tree", "jerusalem_cube", "koch_snowflake", "pascal_parity"}) {
    Job::Options options;
    options.limits.memory_bytes = 64'000'000;
    const std::string said =
        refusal(std::string(R"({"iterations": 30, "instructions": ")") + name + R"("})", options);
    EXPECT_NE(said, "") << name;
  }
  EXPECT_THAT(refusal(R"({"iterations": 6})"),
              testing::AllOf(StartsWith("/iterations"), HasSubstr("5 rounds keep")));
}

TEST(Fractal, ReportsCountsThatAreTooLargeForANumber) {
  for (const char* json :
       {R"({"iterations": 240})", R"({"iterations": 1000})",
        R"({"iterations": 1000, "instructions": "corner_cube_outside"})",
        R"({"iterations": 1000, "instructions": "sierpinski_pyramid", "element": "pyramid"})"}) {
    EXPECT_TRUE(Json::accept(canonical_text(derived(json)))) << json;
  }
  EXPECT_TRUE(derived(R"({"iterations": 1000})")["pieces"].is_null());
  EXPECT_THAT(refusal(R"({"iterations": 20})"), HasSubstr("needs about 4.2e+26 triangles"));
  EXPECT_THAT(refusal(R"({"iterations": 1000})"),
              testing::AllOf(HasSubstr("more than 1e+300 triangles"), HasSubstr("5 rounds keep")));
  EXPECT_THAT(refusal(R"({"iterations": 1000, "element": "sphere"})"),
              testing::AllOf(HasSubstr("more than 46116"), HasSubstr("4 rounds keep")));
}

TEST(Fractal, SupportsEveryElementWithEveryInstructionOfTheThesis) {
  for (const char* element : {"cube", "pyramid", "rainbow_cube"}) {
    for (const char* name : {"corner_cube", "koch_cube", "menger_sponge", "sierpinski_pyramid",
                             "sierpinski_triangle", "word_test"}) {
      const Result<Model> model = fractal_of(std::string(R"({"iterations": 2, "element": ")") + element +
                                             R"(", "instructions": ")" + name + R"("})");
      ASSERT_TRUE(model) << element << name;
      EXPECT_GT(count(*model).triangles, 0U);
    }
  }
}

TEST(Fractal, DrawsTheSameCopiesAsNodesAndAsOneMesh) {
  const FractalParams params = fractal_params(R"({"instructions": "dragon", "iterations": 10})");
  const Result<Model> model = fractal_of(R"({"instructions": "dragon", "iterations": 10})");
  ASSERT_TRUE(model);
  EXPECT_EQ(count(*model).triangles, 12U * 1024U);
  EXPECT_LT(count(*model).bytes, 12U * 1024U * 30U) << "copies of a part";
  Limits roomy;
  Job job(0, {.limits = roomy});
  Instructions whole = instructions_of(params);
  whole.arrangement = {Affine{}};  // an arrangement is always made into one mesh
  Model baked;
  const Result<Element> element = element_of(params, context_of(job));
  ASSERT_TRUE(element);
  baked.nodes.emplace_back();
  add_pieces(baked, 0, whole, *element, {10, 1}, job);
  EXPECT_EQ(count(baked).triangles, 12U * 1024U);
  const Box a = bounds_of(*model), b = bounds_of(baked);
  EXPECT_LT(glm::length(a.min - b.min) + glm::length(a.max - b.max), 2e-5F)
      << "a node's box is a little larger";
}

TEST(Fractal, KeepsSolidsClosedUnderMapsThatMirror) {
  const Result<Model> model = fractal_of(
      R"({"element": "pyramid", "iterations": 2, "instructions": [{"scale": [-0.5, 0.4, 0.3], "translate": [0.3, 0, 0]},
          {"scale": 0.4, "rotate": [10, 20, 30], "translate": [-0.3, 0, 0]}]})");
  ASSERT_TRUE(model);
  EXPECT_THAT(faults(*model), IsEmpty());
  EXPECT_GT(seedmesh::measure({&only_mesh(*model)}).volume, 0);
}

TEST(Fractal, CopiesAModelThatIsARequest) {
  const std::string child =
      R"({"element": {"model": {"generator": "fractal", "parameters": {"iterations": 1}}}, "iterations": 1})";
  const Result<Model> model = fractal_of(child);
  ASSERT_TRUE(model) << model.error().issues.front().message;
  EXPECT_EQ(count(*model).triangles, 20U * 144U);
}

TEST(Fractal, PointsIntoTheNestedRequest) {
  EXPECT_THAT(refusal(R"({"element": {"model": {"generator": "fractl"}}})"),
              testing::AllOf(StartsWith("/element/model/generator"), HasSubstr("did you mean \"fractal\"")));
  EXPECT_THAT(
      refusal(R"({"element": {"model": {"generator": "fractal", "parameters": {"iterations": -1}}}})"),
      StartsWith("/element/model/parameters/iterations"));
  EXPECT_THAT(refusal(R"({"element": {"model": {"generator": "fractal", "parameters": {"iterations": 8}}}})"),
              StartsWith("/element/model/parameters/iterations"));
  EXPECT_THAT(refusal(R"({"element": {}})"), HasSubstr("neither"));
}

TEST(Fractal, LimitsTheDepthOfNestedRequests) {
  std::string json = R"({"iterations": 0})";
  for (int depth = 0; depth < 5; ++depth)
    json = R"({"iterations": 0, "element": {"model": {"generator": "fractal", "parameters": )" + json + "}}}";
  EXPECT_THAT(refusal(json), HasSubstr("expected at most 4"));
}

TEST(Fractal, WritesNestedRequestsInCanonicalForm) {
  const auto canonical = [](const char* json) {
    IssueList faults;
    const Generator* generator = find_generator("fractal");
    return canonical_text(generator->write(read_parameters(*generator, Json::parse(json), "/parameters",
                                                           {Job(0, Job::Options{}), generators()}, faults)));
  };
  EXPECT_EQ(
      canonical(
          R"({"element": {"model": {"generator": "fractal", "parameters": {"iterations": 3, "size": 2.0}}}})"),
      canonical(R"({"element": {"model": {"parameters": {"size": 2}, "generator": "fractal"}}})"));
}

TEST(ChaosGame, DrawsTheFernInItsBox) {
  Job job(3, Job::Options{});
  const Cloud cloud = play(instructions_of(fractal_params(R"({"method": "frcm", "instructions": "fern"})")),
                           StartPoints(), 500'000, 100, job);
  const Box box = bounds_of(cloud.position.span());
  // Ten units of the published fern are one here, its middle at (0.24, 5).
  EXPECT_NEAR(box.min.x * 10 + 0.24, -2.182, 0.01);
  EXPECT_NEAR(box.max.x * 10 + 0.24, 2.6558, 0.01);
  EXPECT_NEAR(box.min.y * 10 + 5, 0, 0.05);
  EXPECT_NEAR(box.max.y * 10 + 5, 9.9983, 0.01);
}

TEST(ChaosGame, ComesNearerToTheAttractorWithEachStep) {
  const Instructions gasket =
      instructions_of(fractal_params(R"({"method": "frcm", "instructions": "pascal_parity"})"));
  Job job(1, Job::Options{});
  const Cloud cloud = play(gasket, StartPoints(), 2000, 60, job);
  for (const glm::vec3& p : cloud.position) {
    // In the binary digits of a point of the gasket, x and y (from the lower left) never have both a one.
    const auto x = static_cast<std::uint32_t>((static_cast<double>(p.x) + 0.5) * 65536),
               y = static_cast<std::uint32_t>((static_cast<double>(p.y) + 0.5) * 65536);
    EXPECT_EQ(x & y & 0xFF00U, 0U);
    EXPECT_LT(std::abs(p.z), 1e-17F);
  }
}

TEST(ChaosGame, ChoosesMapsByTheirProbabilities) {
  const Instructions fern = instructions_of(fractal_params(R"({"method": "frcm", "instructions": "fern"})"));
  Job job(1, Job::Options{});
  const Cloud cloud = play(fern, StartPoints(), 1'000'000, 0, job);
  std::array<double, 4> taken{};
  for (const std::uint8_t map : cloud.map) taken[map] += 1e-6;
  EXPECT_NEAR(taken[0], 0.01, 0.001);
  EXPECT_NEAR(taken[1], 0.85, 0.003);
  EXPECT_NEAR(taken[3], 0.07, 0.002);
}

TEST(ChaosGame, IsTheSameOnAnyNumberOfThreadsAndForAnyLength) {
  const Instructions sponge = instructions_of(fractal_params(R"({"method": "frcm"})"));
  Job one(7, {.threads = 1}), eight(7, {.threads = 8});
  const Cloud a = play(sponge, StartPoints(), 300'001, 10, one),
              b = play(sponge, StartPoints(), 300'001, 10, eight);
  EXPECT_EQ(std::memcmp(a.position.data(), b.position.data(), a.position.bytes()), 0);
  const Cloud few = play(sponge, StartPoints(), 100, 0, one),
              more = play(sponge, StartPoints(), 1000, 0, one);
  EXPECT_EQ(std::memcmp(few.position.data(), more.position.data(), few.position.bytes()), 0);
}

TEST(ChaosGame, GivesPointsElementsAndVoxels) {
  const Result<Model> points = fractal_of(R"({"method": "frcm", "points": 5000})");
  ASSERT_TRUE(points);
  EXPECT_EQ(count(*points).points, 5000U);
  const Result<Model> elements = fractal_of(R"({"method": "frcm", "points": 50, "cloud": "elements"})");
  ASSERT_TRUE(elements);
  EXPECT_EQ(count(*elements).triangles, 600U);
  const Result<Model> voxels =
      fractal_of(R"({"method": "frcm", "points": 100000, "cloud": "voxels", "voxels": 27})");
  ASSERT_TRUE(voxels);
  EXPECT_EQ(seedmesh::measure({&only_mesh(*voxels)}).open_edges, 0U);
}

TEST(Escape, MakesAClosedPlateThatIsAsHighAsTheSet) {
  const Result<Model> model = fractal_of(
      R"({"method": "escape", "size": 2, "escape": {"resolution": 65, "relief": 0.25, "plate": 0.1, "limit": 60}})");
  ASSERT_TRUE(model);
  EXPECT_THAT(faults(*model), IsEmpty());
  const MeshMeasures measures = seedmesh::measure({&only_mesh(*model)});
  EXPECT_EQ(measures.open_edges, 0U);
  EXPECT_GT(measures.volume, 0);
  EXPECT_FLOAT_EQ(bounds_of(*model).max.y, 0.5F);
  EXPECT_FLOAT_EQ(bounds_of(*model).min.y, -0.2F);
}

TEST(Forms, HoldThePointsOrTheEscapeTimes) {
  Job job(0, Job::Options{});
  const auto file = [&](const char* json, const char* format) {
    return encode(fractal_params(json), {format}, context_of(job));
  };
  const auto ply = file(R"({"method": "frcm", "points": 10})", "ply");
  ASSERT_TRUE(ply);
  const std::string text(ply->begin(), ply->end());
  EXPECT_THAT(text, StartsWith("ply\nformat binary_little_endian 1.0\n"));
  EXPECT_THAT(text, HasSubstr("element vertex 10\n"));
  EXPECT_EQ(text.size() - text.find("end_header\n") - 11, 150U);
  for (const char* format : {"png8", "png16"}) {
    const auto png = file(R"({"method": "escape", "escape": {"resolution": 9}})", format);
    ASSERT_TRUE(png);
    EXPECT_EQ((*png)[1], 'P');
  }
}

TEST(Forms, AreRefusedFirstWhereTheMethodDoesNotHaveThem) {
  const auto refused = [](const char* json, const char* format) {
    const std::vector<Issue> issues = check_format(fractal_params(json), {format});
    return issues.empty() ? std::string() : issues.front().pointer;
  };
  EXPECT_EQ(refused("{}", "ply"), "/method");
  EXPECT_EQ(refused("{}", "png8"), "/method");
  EXPECT_EQ(refused(R"({"method": "frcm"})", "png16"), "/method");
  EXPECT_EQ(refused(R"({"method": "frcm", "stages": [10]})", "ply"), "/stages");
  EXPECT_EQ(refused(R"({"method": "frcm"})", "ply"), "");
  EXPECT_EQ(refused(R"({"method": "escape"})", "png16"), "");
}

/// The pointers of the parameters that do nothing.
std::vector<std::string> unused(std::string_view json) {
  std::vector<std::string> pointers;
  for (const Warning& warning : warnings_of(fractal_params(json))) pointers.push_back(warning.pointer);
  return pointers;
}

TEST(Probabilities, ThatDoNotSumToOneAreReportedOrRefused) {
  const auto request = [](const char* second, const char* weights) {
    return std::string(R"({"method": "frcm", "weights": ")") + weights +
           R"(", "instructions": [{"scale": 0.5, "probability": 0.5}, {"scale": 0.4, "probability": )" +
           second + "}]}";
  };
  EXPECT_THAT(unused(request("0.5", "normalize")), IsEmpty());
  EXPECT_THAT(unused(request("0.4", "normalize")), testing::ElementsAre("/instructions"));
  EXPECT_THAT(check(fractal_params(request("0.5", "strict")), Limits{}), IsEmpty());
  const std::vector<Issue> issues = check(fractal_params(request("0.4", "strict")), Limits{});
  ASSERT_EQ(issues.size(), 1U);
  EXPECT_EQ(issues[0].message,
            "the probabilities of the maps sum to 0.9, expected 1 because `weights` is strict");
}

TEST(UnusedParameters, AreThoseOfOtherMethods) {
  EXPECT_THAT(unused("{}"), IsEmpty());
  EXPECT_THAT(unused(R"({"points": 5, "voxels": 8, "palette": ["#000000"], "escape": {"span": 2}})"),
              testing::UnorderedElementsAre("/points", "/voxels", "/palette", "/escape"));
  EXPECT_THAT(unused(R"({"method": "frcm", "iterations": 5, "surface": "pieces", "points": 9})"),
              testing::UnorderedElementsAre("/iterations", "/surface"));
  EXPECT_THAT(
      unused(R"({"method": "escape", "instructions": "vicsek", "element": "sphere", "color": "#000000"})"),
      testing::UnorderedElementsAre("/instructions", "/element", "/color"));
  EXPECT_EQ(warnings_of(fractal_params(R"({"palette": ["#000000"]})")).front().message,
            "`palette` has no effect unless `method` is frcm or escape.");
}

TEST(UnusedParameters, MayDependOnOtherParameters) {
  EXPECT_THAT(unused(R"({"columns": 2})"), testing::ElementsAre("/columns"));
  EXPECT_THAT(unused(R"({"columns": 2, "stages": [1, 2]})"), IsEmpty());
  EXPECT_THAT(unused(R"({"text": "NO"})"), testing::ElementsAre("/text"));
  EXPECT_THAT(unused(R"({"text": "NO", "instructions": "word_test"})"), IsEmpty());
  EXPECT_THAT(unused(R"({"element": "rainbow_cube", "color": "#000000"})"), testing::ElementsAre("/color"));
  EXPECT_THAT(unused(R"({"element": "pyramid", "color": "#000000"})"), IsEmpty());
  EXPECT_THAT(unused(R"({"surface": "merged", "element": "sphere"})"), testing::ElementsAre("/surface"));
  EXPECT_THAT(unused(R"({"surface": "merged"})"), IsEmpty());
  EXPECT_THAT(unused(R"({"instructions": [{"scale": 0.5}, {"scale": 0.5, "probability": 2}]})"),
              testing::ElementsAre("/instructions/1/probability"));
  EXPECT_THAT(unused(R"({"method": "frcm", "voxels": 9, "color": "#000000", "element": "sphere"})"),
              testing::UnorderedElementsAre("/voxels", "/color"));
  EXPECT_THAT(unused(R"({"method": "frcm", "start": "cube", "element": "sphere"})"),
              testing::ElementsAre("/element"));
  EXPECT_THAT(unused(R"({"method": "frcm", "voxels": 9, "color": "#000000", "cloud": "elements"})"),
              IsEmpty());
  EXPECT_THAT(unused(R"({"method": "escape", "escape": {"constant": [0, 1]}})"),
              testing::ElementsAre("/escape/constant"));
  EXPECT_THAT(unused(R"({"method": "escape", "escape": {"set": "julia", "constant": [0, 1]}})"), IsEmpty());
}

TEST(UnusedParameters, AreReportedByEveryRoute) {
  const char* const json = R"({"points": 5})";
  EXPECT_EQ(fractal_of(json)->warnings.front().pointer, "/points");
  EXPECT_EQ(derived(json)["warnings"][0]["pointer"], "/points");
  Job job(0, Job::Options{});
  for (const char* each : {json, R"({"method": "escape", "points": 5})"})
    EXPECT_EQ(appraise(fractal_params(each), context_of(job))->warnings.front().pointer, "/points") << each;
}

TEST(Plate, FillsTheSnowflake) {
  for (const int rounds : {0, 1, 4}) {
    const Result<Model> model =
        fractal_of(R"({"instructions": "koch_snowflake", "element": "plate", "iterations": )" +
                   std::to_string(rounds) + "}");
    ASSERT_TRUE(model);
    EXPECT_THAT(faults(*model), IsEmpty()) << rounds;
    const MeshMeasures measures = seedmesh::measure({&only_mesh(*model)});
    EXPECT_EQ(measures.open_edges, 0U) << rounds;
    const double triangle = std::sqrt(3.0) / 4 * 0.75 * 0.75;
    EXPECT_NEAR(measures.volume, 0.1 * triangle * (8.0 / 5 - 3.0 / 5 * std::pow(4.0 / 9, rounds)), 1e-5)
        << rounds;
  }
}

}  // namespace
}  // namespace seedmesh::fractal
