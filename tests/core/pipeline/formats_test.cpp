/// Forms of answers that only some generators have.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/pipeline.h"
#include "core/registry/registry.h"

namespace seedmesh {
namespace {

using ::testing::HasSubstr;

std::vector<std::string> formats_of(std::string_view schema) {
  return Json::parse(*schema_json(schema)).value("x-formats", std::vector<std::string>());
}

TEST(OwnFormats, AreThoseThatTheSchemasName) {
  std::set<std::string> all;
  for (const std::string& form : formats_of("output")) all.insert(form);
  for (const Generator& generator : generators()) {
    std::vector<std::string> forms;
    for (const OwnFormat& form : generator.formats) forms.emplace_back(form.format);
    EXPECT_EQ(forms, formats_of(generator.name)) << generator.name;
    all.insert(forms.begin(), forms.end());
  }
  const Json output = Json::parse(*schema_json("output"));
  EXPECT_EQ(all, output["properties"]["format"]["enum"].get<std::set<std::string>>());
}

TEST(Formats, HaveARowForEachValueOfTheSchema) {
  std::vector<std::string> names;
  for (const FormatInfo& format : output_formats) names.emplace_back(format.name);
  const Json output = Json::parse(*schema_json("output"));
  EXPECT_EQ(names, output["properties"]["format"]["enum"].get<std::vector<std::string>>());
  std::vector<std::string> models;
  for (const FormatInfo& format : output_formats) {
    if (format.is_model) models.emplace_back(format.name);
  }
  EXPECT_EQ(models, formats_of("output"));
}

TEST(Formats, HaveTheExtensionsAndMediaTypesOfOpenApi) {
  const Json api = Json::parse(openapi_json());
  const Json& parameters = api["components"]["parameters"];
  std::vector<std::string> extensions;
  for (const std::string_view extension : output_extensions()) extensions.emplace_back(extension);
  EXPECT_EQ(extensions, parameters["Extension"]["schema"]["enum"].get<std::vector<std::string>>());
  for (const char* path :
       {"/v1/presets/{name}.{extension}", "/v1/presets/{name}.json", "/v1/models/{token}.{extension}"})
    EXPECT_TRUE(api["paths"].contains(path)) << path;
  const Json& answers = api["components"]["responses"]["Model"]["content"];
  for (const FormatInfo& format : output_formats)
    EXPECT_TRUE(answers.contains(format.media_type)) << format.name;
}

TEST(Formats, AreFoundByTheirExtension) {
  EXPECT_EQ(format_with_extension("png")->name, "png16");
  EXPECT_EQ(format_with_extension("zip")->name, "zip");
  EXPECT_EQ(format_with_extension("obj"), nullptr);
  EXPECT_EQ(output_extension_list({"json"}), ".glb, .gltf, .zip, .png, .r16, .ply, .geojson or .json");
}

TEST(Motions, AreThoseThatTheSchemasName) {
  for (const Generator& generator : generators()) {
    std::vector<std::string> motions;
    if (generator.grows) motions.emplace_back("animation");
    if (generator.sways) motions.emplace_back("wind");
    EXPECT_EQ(motions,
              Json::parse(*schema_json(generator.name)).value("x-motions", std::vector<std::string>()))
        << generator.name;
  }
}

TEST(OwnFormats, NeedValuesThatTheSchemasName) {
  for (const Generator& generator : generators()) {
    const Json schema = Json::parse(*schema_json(generator.name));
    const Json needs = schema.value("x-formats-where", Json::object());
    for (const auto& [format, values] : needs.items()) {
      EXPECT_THAT(formats_of(generator.name), testing::Contains(format));
      for (const auto& [name, value] : values.items())
        EXPECT_THAT(schema["properties"][name]["enum"].get<std::vector<Json>>(), testing::Contains(value));
    }
  }
}

TEST(OwnFormats, AreRefusedWhereTheGeneratorHasThemNot) {
  const Result<Request> request = read_request(
      R"({"generator":"lsystem","parameters":{"axiom":"F"},"output":{"format":"r16"}})", Limits{});
  ASSERT_FALSE(request);
  EXPECT_EQ(request.error().issues.front().pointer, "/output/format");
  EXPECT_THAT(request.error().issues.front().message, HasSubstr("the formats of lsystem are glb, gltf, zip"));
}

TEST(OwnFormats, MakeOneFileOfTheirMediaType) {
  const Result<Request> request = read_request(
      R"({"generator":"terrain","parameters":{"iterations":3},"output":{"format":"r16"}})", Limits{});
  ASSERT_TRUE(request);
  const Result<Product> product = produce(*request, {});
  ASSERT_TRUE(product);
  EXPECT_EQ(product->payload.size(), 9U * 9 * 2);
  EXPECT_EQ(product->extension, "r16");
  EXPECT_EQ(product->media_type, "application/octet-stream");
  const Result<Request> picture = with_format(*request, "png16");
  ASSERT_TRUE(picture);
  const Result<Product> png = produce(*picture, {});
  ASSERT_TRUE(png);
  EXPECT_EQ(png->media_type, "image/png");
  EXPECT_EQ(png->extension, "png");
  EXPECT_EQ(png->payload.text().substr(1, 3), "PNG");
}

std::vector<std::string> pointers_of(const char* json) {
  const Result<Request> request = read_request(json, Limits{});
  std::vector<std::string> pointers;
  if (!request) {
    for (const Issue& issue : request.error().issues) pointers.push_back(issue.pointer);
  }
  return pointers;
}

TEST(OwnFormats, FollowTheConventionsOfAnEngineWhereTheyHaveAny) {
  EXPECT_THAT(pointers_of(R"({"generator":"terrain","parameters":{"iterations":5},
                              "output":{"format":"r16","profile":"unity"}})"),
              ::testing::IsEmpty());
  EXPECT_THAT(pointers_of(R"({"generator":"terrain","parameters":{"iterations":5},
                              "output":{"format":"r16","profile":"unreal"}})"),
              ::testing::ElementsAre("/output/profile"));
  EXPECT_THAT(pointers_of(R"({"generator":"terrain","parameters":{"resample":100},
                              "output":{"format":"r16","profile":"unity","lods":1}})"),
              ::testing::ElementsAre("/parameters/resample"));
  EXPECT_THAT(pointers_of(R"({"generator":"terrain","output":{"format":"png8","profile":"unity"}})"),
              ::testing::Contains("/output/profile"));
  EXPECT_THAT(pointers_of(R"({"generator":"fractal","parameters":{},
                              "output":{"format":"ply","profile":"unity"}})"),
              ::testing::Contains("/output/profile"));
}

TEST(OwnFormats, ThatAreNoModelsRefuseEachOptionOfModelsOnce) {
  constexpr const char* options[] = {R"("lods":3)",           R"("impostor":true)",
                                     R"("instancing":"gpu")", R"("animation":"growth")",
                                     R"("wind":"weights")",   R"("collision":"plain")"};
  for (const std::string option : options) {
    const Result<Request> request =
        read_request(R"({"generator":"terrain","output":{"format":"png16",)" + option + "}}", Limits{});
    ASSERT_FALSE(request) << option;
    ASSERT_EQ(request.error().issues.size(), 1U) << option;
    EXPECT_EQ(request.error().issues[0].pointer, "/output/" + option.substr(1, option.find('"', 1) - 1));
    EXPECT_THAT(request.error().issues[0].message, HasSubstr("the format png16, which is not a model"))
        << option;
  }
}

TEST(OwnFormats, ThatDoNotSuitTheParametersAreRefusedBeforeAnythingIsMade) {
  EXPECT_THAT(pointers_of(R"({"generator":"terrain","parameters":{"algorithm":"fbm","shape":"sphere"},
                              "output":{"format":"png16"}})"),
              ::testing::ElementsAre("/parameters/shape"));
  const Result<Request> model =
      read_request(R"({"generator":"terrain","parameters":{"algorithm":"fbm","shape":"sphere"}})", Limits{});
  ASSERT_TRUE(model);
  EXPECT_FALSE(with_format(*model, "r16"));
}

std::uint64_t triangles_of(const char* json) {
  const Result<Request> request = read_request(json, Limits{});
  EXPECT_TRUE(request);
  const Result<Product> product = produce(*request, {});
  EXPECT_TRUE(product);
  return product ? product->statistics.triangles : 0;
}

TEST(Levels, OfTerrainMeetABudgetTogether) {
  // A budget alone joins triangles; with levels, the finest that fits comes first and others follow it.
  const std::uint64_t joined = triangles_of(
      R"({"generator":"terrain","parameters":{"iterations":7},"output":{"max_triangles":20000}})");
  EXPECT_GT(joined, 15'000U);
  EXPECT_LE(joined, 20'000U);
  EXPECT_EQ(triangles_of(R"({"generator":"terrain","parameters":{"iterations":7},
                             "output":{"max_triangles":20000,"lods":3,"profile":"unity"}})"),
            8192U);
}

TEST(Levels, AreRefusedWhereATerrainHasNone) {
  const Result<Request> request = read_request(
      R"({"generator":"terrain","parameters":{"algorithm":"fbm","resolution":17,
          "onto":{"mapping":"normal_map","model":{"generator":"fractal","parameters":{"iterations":0}}}},
          "output":{"lods":2,"profile":"unity"}})",
      Limits{});
  ASSERT_TRUE(request);
  const Result<Product> product = produce(*request, {});
  ASSERT_FALSE(product);
  EXPECT_EQ(product.error().issues.front().pointer, "/output/lods");
}

}  // namespace
}  // namespace seedmesh
