/// Forms of answers that only some generators have.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "core/generators/registry.h"
#include "core/pipeline.h"

namespace seedmesh {
namespace {

using ::testing::HasSubstr;

std::vector<std::string> formats_of(std::string_view schema) {
  return Json::parse(*schema_json(schema)).value("x-formats", std::vector<std::string>());
}

TEST(Forms, AreThoseThatTheSchemasName) {
  std::set<std::string> all;
  for (const std::string& form : formats_of("output")) all.insert(form);
  for (const Generator& generator : generators()) {
    std::vector<std::string> forms;
    for (const OwnForm& form : generator.forms) forms.emplace_back(form.format);
    EXPECT_EQ(forms, formats_of(generator.name)) << generator.name;
    all.insert(forms.begin(), forms.end());
  }
  const Json output = Json::parse(*schema_json("output"));
  EXPECT_EQ(all, output["properties"]["format"]["enum"].get<std::set<std::string>>());
}

TEST(Forms, AreRefusedWhereTheGeneratorHasThemNot) {
  const Result<Request> request = read_request(
      R"({"generator":"lsystem","parameters":{"axiom":"F"},"output":{"format":"r16"}})", Limits{});
  ASSERT_FALSE(request);
  EXPECT_EQ(request.error().issues.front().pointer, "/output/format");
  EXPECT_THAT(request.error().issues.front().message, HasSubstr("the forms of lsystem are glb, gltf, zip"));
}

TEST(Forms, MakeOneFileOfTheirMediaType) {
  const Result<Request> request = read_request(
      R"({"generator":"terrain","parameters":{"iterations":3},"output":{"format":"r16"}})", Limits{});
  ASSERT_TRUE(request);
  Job job(0, Job::Options{});
  const Result<Product> product = produce(*request, job);
  ASSERT_TRUE(product);
  EXPECT_EQ(product->payload.size(), 9U * 9 * 2);
  EXPECT_EQ(product->extension, "r16");
  EXPECT_EQ(product->media_type, "application/octet-stream");
  const Result<Request> picture = with_format(*request, "png16");
  ASSERT_TRUE(picture);
  const Result<Product> png = produce(*picture, job);
  ASSERT_TRUE(png);
  EXPECT_EQ(png->media_type, "image/png");
  EXPECT_EQ(png->extension, "png");
  EXPECT_EQ(png->payload.text().substr(1, 3), "PNG");
}

}  // namespace
}  // namespace seedmesh
