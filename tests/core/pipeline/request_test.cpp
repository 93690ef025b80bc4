/// From the text of a body to a Request: what is refused, where, and what is canonical.
#include <gmock/gmock.h>

#include <string>

#include "core/pipeline.h"
#include "core/pipeline/body.h"
#include "generated/params/lsystem.h"

namespace seedmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

constexpr const char* plant =
    R"({"generator":"lsystem","seed":3,"parameters":{"axiom":"X","productions":["X -> F[+X]F[-X]+X","F -> FF"],"iterations":5,"angle":20}})";

std::string canonical(std::string_view json) {
  const Result<Request> request = read_request(json, Limits{});
  if (request) return request->canonical();
  ADD_FAILURE() << request.error().issues.front().pointer << ": " << request.error().issues.front().message;
  return "";
}

Error error_of(std::string_view json) {
  const Result<Request> request = read_request(json, Limits{});
  if (!request) return request.error();
  ADD_FAILURE() << json << " was taken";
  return {};
}

std::vector<std::string> pointers(std::string_view json) {
  std::vector<std::string> all;
  const Error error = error_of(json);
  EXPECT_EQ(error.code, Code::invalid);
  for (const Issue& issue : error.issues) all.push_back(issue.pointer);
  return all;
}

TEST(ReadRequest, TakesAWholeRequest) {
  const Result<Request> request = read_request(plant, Limits{});
  ASSERT_TRUE(request);
  EXPECT_EQ(request->generator(), "lsystem");
  EXPECT_EQ(request->seed(), 3U);
  EXPECT_EQ(request->format(), "glb");
  const auto& params = *static_cast<const LsystemParams*>(request->body().params.get());
  EXPECT_EQ(params.angle.yaw, 20);
  EXPECT_EQ(params.productions.size(), 2U);
}

/// The default algorithm has no `resolution`, but the request does not ask for the default.
TEST(ReadRequest, ReportsNoConflictWithTheDefaultOfARefusedMember) {
  const auto terrain = [](const std::string& members) {
    return R"({"generator":"terrain","parameters":{"resolution":65,)" + members + "}}";
  };
  EXPECT_THAT(pointers(terrain(R"("algorithm":"fmb")")), ElementsAre("/parameters/algorithm"));
  EXPECT_THAT(pointers(terrain(R"("algorithm":null)")), ElementsAre("/parameters/algorithm"));
  EXPECT_THAT(pointers(terrain(R"("algoritm":"fbm")")), ElementsAre("/parameters/algoritm"));
  EXPECT_THAT(pointers(terrain(R"("algorithm":"diamond_square")")), ElementsAre("/parameters/resolution"));
  EXPECT_THAT(pointers(terrain(R"("algorithm":"fbm","hydraulic":{"metod":"stream_power","iterations":9})")),
              ElementsAre("/parameters/hydraulic/metod"));
  EXPECT_THAT(pointers(terrain(R"("algorithm":"fbm","hydraulic":{"iterations":9},"note":1)")),
              UnorderedElementsAre("/parameters/note", "/parameters/hydraulic/iterations"));
  EXPECT_THAT(pointers(terrain(R"("note":1,"size":"1 km")")),
              UnorderedElementsAre("/parameters/note", "/parameters/size", "/parameters/resolution"));
}

/// The default method needs a distance, but the request does not ask for the default.
TEST(ReadRequest, ReportsNothingMissingForTheDefaultOfARefusedMember) {
  const auto scene = [](const std::string& place) {
    return R"({"generator":"scene","parameters":{"layers":[{"model":{"preset":"oak"},"place":)" + place +
           "}]}}";
  };
  EXPECT_THAT(pointers(scene(R"({"method":"grid"})")), ElementsAre("/parameters/layers/0/place/method"));
  EXPECT_THAT(pointers(scene("{}")), ElementsAre("/parameters/layers/0/place"));
  EXPECT_THAT(pointers(scene(R"({"count":-1})")),
              UnorderedElementsAre("/parameters/layers/0/place/count", "/parameters/layers/0/place"));
}

TEST(ReadRequest, SaysWhichSeedsItTakes) {
  const auto message = [](const std::string& seed) {
    const Error error = error_of(R"({"generator":"lsystem","parameters":{"axiom":"F"},"seed":)" + seed + "}");
    return error.issues.front().message;
  };
  const std::string expected =
      ", expected an integer from 0 to 18446744073709551615, or its decimal digits as a text";
  EXPECT_EQ(message("18446744073709551616"), "found 18446744073709551616" + expected);
  EXPECT_EQ(message("\"18446744073709551616\""), "found 18446744073709551616" + expected);
  EXPECT_EQ(message("2e19"), "found 20000000000000000000" + expected);
  EXPECT_EQ(message("-18446744073709551617"), "found -18446744073709551617" + expected);
  EXPECT_EQ(message("-1"), "found -1" + expected);
  EXPECT_EQ(message("1.5"), "found 1.5" + expected);
  EXPECT_EQ(message("\"0x1\""), "found the text \"0x1\"" + expected);
}

TEST(ReadRequest, ReportsNumbersThatAreTooLargeWithAllOtherErrors) {
  EXPECT_THAT(pointers(R"({"a":1e999})"), UnorderedElementsAre("/a", "/a", ""));
  EXPECT_THAT(
      pointers(
          R"({"generator":"lsystem","seed":-1e400,"parameters":{"axiom":"F)\"","ignore":null,"angle":2e308,)"
          R"("step":-1e999,"sides":1}})"),
      UnorderedElementsAre("/seed", "/parameters/angle", "/parameters/step", "/parameters/sides",
                           "/parameters/ignore", "/parameters/axiom"));
  EXPECT_EQ(error_of(R"({"seed":1e999,)").code, Code::malformed);
  EXPECT_TRUE(read_request(R"({"generator":"lsystem","parameters":{"axiom":"F","angle":1e-999}})", Limits{}));
}

TEST(ReadRequest, ReportsABrokenImageWithAllOtherErrors) {
  EXPECT_THAT(pointers(R"({"generator":"lsystem","seed":-1,"parameters":{"axiom":"F","materials":[{"images":)"
                       R"({"color":"data:image/png;base64,iVBORw0KGgo="}}]}})"),
              UnorderedElementsAre("/seed", "/parameters/materials/0/images/color"));
}

TEST(ReadRequest, ReportsOnceThatAPresetIsOfAnotherGenerator) {
  const Error error = error_of(R"({"preset":"oak","generator":"lsystem","seed":-1})");
  ASSERT_EQ(error.issues.size(), 2U);
  EXPECT_EQ(error.issues[1].pointer, "/generator");
  EXPECT_EQ(error.issues[1].message,
            "found \"lsystem\", but the preset is a request for tree, which has other parameters than "
            "lsystem");
  EXPECT_TRUE(read_request(R"({"preset":"oak","generator":"tree"})", Limits{}));
  EXPECT_TRUE(read_request(R"({"preset":"oak","generator":"fractal","parameters":null})", Limits{}));
}

TEST(ReadRequest, ListsTheGenerators) {
  EXPECT_EQ(error_of(R"({"generator":"tre"})").issues.front().message,
            "there is no generator \"tre\"; did you mean \"tree\"?");
  EXPECT_THAT(error_of(R"({"generator":"galaxies"})").issues.front().message,
              HasSubstr("there are tree, lsystem, building, terrain, scene, city, fractal"));
}

TEST(ReadRequest, IsCanonicalWhateverTheOrder) {
  EXPECT_EQ(
      canonical(plant),
      R"({"generator":"lsystem","parameters":{"angle":20,"axiom":"X","iterations":5,"productions":["X -> F[+X]F[-X]+X","F -> FF"]},"seed":3})");
  EXPECT_EQ(
      canonical(
          R"({"output":{"format":"glb"},"parameters":{"angle":{"yaw":20.0,"pitch":20,"roll":20},"sides":8,"iterations":5,
                          "productions":["X -> F[+X]F[-X]+X","F -> FF"],"axiom":"X"},"seed":"3","generator":"lsystem"})"),
      canonical(plant));
}

TEST(ReadRequest, LeavesDefaultsOutOfTheCanonicalForm) {
  EXPECT_EQ(canonical(R"({"generator":"lsystem","seed":0,"output":{},"parameters":{"axiom":"F"}})"),
            R"({"generator":"lsystem","parameters":{"axiom":"F"}})");
  EXPECT_EQ(
      canonical(
          R"({"generator":"lsystem","seed":"9007199254740993","output":{"format":"zip"},"parameters":{"axiom":"F"}})"),
      R"({"generator":"lsystem","output":{"format":"zip"},"parameters":{"axiom":"F"},"seed":"9007199254740993"})");
}

TEST(ReadRequest, ReadsItsOwnCanonicalForm) { EXPECT_EQ(canonical(canonical(plant)), canonical(plant)); }

TEST(ReadRequest, DistinguishesMalformedFromInvalid) {
  EXPECT_EQ(error_of("{").code, Code::malformed);
  EXPECT_EQ(error_of("").code, Code::malformed);
  EXPECT_EQ(error_of(R"({"generator":"lsystem","generator":"tree"})").code, Code::malformed);
  EXPECT_EQ(error_of(std::string(100'000, '[')).code, Code::malformed);
  EXPECT_EQ(error_of("[]").code, Code::invalid);
}

TEST(ReadRequest, MissesTheGenerator) {
  EXPECT_THAT(pointers("{}"), ElementsAre(""));
  EXPECT_THAT(error_of("{}").issues.front().message, HasSubstr("generator"));
  EXPECT_THAT(pointers(R"({"generator":"nope"})"), ElementsAre("/generator"));
  EXPECT_THAT(error_of(R"({"generator":"l-system"})").issues.front().message,
              HasSubstr("did you mean \"lsystem\"?"));
  EXPECT_THAT(pointers(R"({"generator":7})"), ElementsAre("/generator"));
  EXPECT_THAT(pointers("[]"), ElementsAre(""));
}

TEST(ReadRequest, MissesTheParametersAtTheBody) {
  EXPECT_THAT(pointers(R"({"generator":"lsystem"})"), ElementsAre(""));
  EXPECT_THAT(error_of(R"({"generator":"lsystem"})").issues.front().message, HasSubstr("axiom"));
  EXPECT_THAT(pointers(R"({"generator":"lsystem","parameters":{}})"), ElementsAre("/parameters"));
  EXPECT_THAT(pointers(R"({"generator":"lsystem","parameters":[]})"), ElementsAre("/parameters"));
}

TEST(ReadRequest, PointsAtEachUnknownMember) {
  EXPECT_THAT(
      pointers(
          R"({"generator":"lsystem","sed":1,"parameters":{"axiom":"F","angel":3},"output":{"fromat":"glb"}})"),
      UnorderedElementsAre("/sed", "/parameters/angel", "/output/fromat"));
}

TEST(ReadRequest, NamesTheParentOfAMisplacedMember) {
  const Result<Request> request =
      read_request(R"({"generator":"tree","Levels":2,"lods":3,"colour":1})", Limits{});
  ASSERT_FALSE(request);
  std::map<std::string, std::string> messages;
  for (const Issue& issue : request.error().issues) messages[issue.pointer] = issue.message;
  EXPECT_EQ(messages["/Levels"], "\"Levels\" is not known here; it belongs in \"parameters\"");
  EXPECT_EQ(messages["/lods"], "\"lods\" is not known here; it belongs in \"output\"");
  EXPECT_THAT(messages["/colour"], testing::StartsWith("\"colour\" is not known here"));
}

TEST(ReadRequest, ReportsSchemaAndGrammarErrorsTogether) {
  EXPECT_THAT(
      pointers(
          R"({"generator":"lsystem","seed":-1,"parameters":{"axiom":"F","productions":["F F"],"iterations":-3}})"),
      UnorderedElementsAre("/seed", "/parameters/productions/0", "/parameters/iterations"));
}

TEST(ReadRequest, ReportsTheLineOfAGrammarError) {
  const Error error = error_of(
      R"json({"generator":"lsystem","parameters":{"axiom":"A(1)","productions":["A(x) -> A(x+*2)"]}})json");
  EXPECT_EQ(error.issues.front().pointer, "/parameters/productions/0");
  EXPECT_EQ(error.issues.front().line, 1);
  EXPECT_EQ(error.issues.front().column, 13);
}

TEST(ReadRequest, DoesNotEchoWhatTheSchemaSaid) {
  EXPECT_THAT(pointers(R"({"generator":"lsystem","parameters":{"axiom":"F","productions":["F -> FF",7]}})"),
              ElementsAre("/parameters/productions/1"));
  EXPECT_THAT(pointers(R"({"generator":"lsystem","parameters":{"axiom":7}})"),
              ElementsAre("/parameters/axiom"));
}

TEST(ReadRequest, EnforcesTheLimitsOfTheService) {
  Limits limits;
  limits.iterations = 10;
  const Result<Request> request =
      read_request(R"({"generator":"lsystem","parameters":{"axiom":"F","iterations":11}})", limits);
  ASSERT_FALSE(request);
  EXPECT_EQ(request.error().issues.front().pointer, "/parameters/iterations");
}

TEST(Preset, IsTheBaseThatTheBodyIsMergedOver) {
  const std::string plain = canonical(R"({"preset":"koch_island"})");
  EXPECT_EQ(plain, canonical(*preset_json("koch_island")));
  EXPECT_THAT(plain, testing::Not(HasSubstr("preset")));
  EXPECT_THAT(
      canonical(
          R"({"preset":"koch_island","seed":5,"parameters":{"iterations":2},"output":{"format":"gltf"}})"),
      testing::AllOf(HasSubstr(R"("iterations":2)"), HasSubstr(R"("seed":5)"),
                     HasSubstr(R"("format":"gltf")")));
}

TEST(Preset, LosesAMemberToNull) {
  EXPECT_THAT(canonical(R"({"preset":"koch_island","parameters":{"iterations":null}})"),
              testing::Not(HasSubstr("iterations")));
}

TEST(Preset, IsRefusedWhereItIsUnknown) {
  EXPECT_THAT(pointers(R"({"preset":"koch_ireland"})"), ElementsAre("/preset"));
  EXPECT_THAT(error_of(R"({"preset":"koch_ireland"})").issues.front().message,
              HasSubstr("did you mean \"koch_island\"?"));
  EXPECT_THAT(pointers(R"({"preset":"none","seed":-1})"), UnorderedElementsAre("/preset", "/seed"));
  EXPECT_THAT(pointers(R"({"preset":5})"), ElementsAre("/preset"));
  EXPECT_THAT(pointers(R"({"preset":"Koch Island"})"), ElementsAre("/preset"));
  EXPECT_THAT(error_of(R"({"preset":"Koch Island"})").issues.front().message,
              HasSubstr("did you mean \"koch_island\"?"));
}

TEST(WithFormat, ChangesTheFormAlone) {
  const Result<Request> request = read_request(plant, Limits{});
  const Result<Request> zip = with_format(*request, "zip");
  ASSERT_TRUE(zip);
  EXPECT_EQ(zip->format(), "zip");
  EXPECT_EQ(request->format(), "glb");
  EXPECT_EQ(with_format(*zip, "glb")->canonical(), request->canonical());
  const Result<Request> odd = with_format(*request, "png16");
  ASSERT_FALSE(odd);
  EXPECT_EQ(odd.error().issues.front().pointer, "/output/format");
}

}  // namespace
}  // namespace seedmesh
