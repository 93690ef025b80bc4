/// The host tool itself: what it makes of one small schema, and what it refuses.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "api_schema/codegen/emit.h"

namespace codegen {
namespace {

namespace fs = std::filesystem;

const fs::path golden_folder = SEEDMESH_SOURCE_DIR "/tests/golden/codegen";

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Compares with the golden file, or writes it where SEEDMESH_UPDATE_GOLDEN is set.
void expect_golden(const std::string& name, const std::string& text) {
  const bool update =
      std::getenv("SEEDMESH_UPDATE_GOLDEN") != nullptr;  // NOLINT(concurrency-mt-unsafe): one thread
  if (update) std::ofstream(golden_folder / name, std::ios::binary) << text;
  EXPECT_EQ(text, text_of(golden_folder / name)) << name;
}

TEST(Codegen, MakesTheGoldenFiles) {
  const Unit unit = load_unit(golden_folder / "tiny.schema.json");
  expect_golden("tiny.h.txt", emit_header(unit));
  expect_golden("tiny.cpp.txt", emit_source(unit));
  expect_golden("tiny.md.txt", emit_reference(unit));
}

/// What the tool says to an object schema whose one property is `property`.
std::string refusal_of(const std::string& property, const std::string& more = "") {
  const fs::path folder = fs::path(testing::TempDir()) / "seedmesh_codegen_test";
  fs::create_directories(folder);
  const fs::path file = folder / "odd.schema.json";
  std::ofstream(file)
      << R"({"title":"Odd","description":"Odd.","type":"object","additionalProperties":false,"properties":{"a":)"
      << property << "}" << more << "}";
  try {
    emit_header(load_unit(file));
  } catch (const SchemaError& fault) {
    return fault.what();
  }
  return "";
}

std::string described(const std::string& keywords) {
  return R"({"title":"A","description":"A.",)" + keywords + "}";
}

TEST(Codegen, TakesAPlainSchema) { EXPECT_EQ(refusal_of(described(R"("type":"number","default":1)")), ""); }

TEST(Codegen, RefusesEveryKeywordItDoesNotKnow) {
  for (const char* keywords :
       {R"("type":"number","multipleOf":2)", R"("type":"string","format":"uri")",
        R"("type":"number","maxLength":2)", R"("type":"array","items":{"type":"number"},"uniqueItems":true)",
        R"("type":"number","x-colour":"red")", R"("type":"number","exclusiveMaximum":1)",
        R"("oneOf":[{"type":"number"}],"minimum":1)"}) {
    EXPECT_THAT(refusal_of(described(keywords)), testing::HasSubstr("unknown keyword")) << keywords;
  }
}

TEST(Codegen, SaysWhereTheFaultIs) {
  EXPECT_THAT(refusal_of(described(R"("type":"array","items":{"type":"number","odd":1})")),
              testing::StartsWith("odd.schema.json#/properties/a/items: "));
}

TEST(Codegen, RefusesWhatItCouldNotKeep) {
  EXPECT_THAT(refusal_of(R"({"type":"number"})"), testing::HasSubstr("has a title"));
  EXPECT_THAT(refusal_of(described(R"("type":"integer")")), testing::HasSubstr("has a minimum"));
  EXPECT_THAT(refusal_of(described(R"("type":"string","pattern":"^.*$")")), testing::HasSubstr("no form"));
  EXPECT_THAT(refusal_of(described(R"("type":"number","maximum":1,"default":2)")),
              testing::HasSubstr("above the maximum"));
  EXPECT_THAT(refusal_of(described(R"("type":"string","enum":["x"],"default":"y")")),
              testing::HasSubstr("not in the enum"));
  EXPECT_THAT(refusal_of(described(R"("type":"string","default":2)")),
              testing::HasSubstr("the default is no string"));
  EXPECT_THAT(
      refusal_of(described(R"("oneOf":[{"type":"number"},{"type":"integer","minimum":0,"maximum":1}])")),
      testing::HasSubstr("told apart"));
  EXPECT_THAT(refusal_of(described(R"("type":"object")")), testing::HasSubstr("additionalProperties"));
  EXPECT_THAT(refusal_of(described(R"("$ref":"#/$defs/none")")), testing::HasSubstr("leads nowhere"));
  EXPECT_THAT(refusal_of(R"({"$ref":"#/properties/a"})"), testing::HasSubstr("circle"));
  EXPECT_THAT(refusal_of(R"({"$ref":"#/$defs/n","minimum":3})", R"(,"$defs":{"n":{"type":"number"}})"),
              testing::HasSubstr("beside $ref"));
  EXPECT_THAT(refusal_of(described(R"("type":"number")"), R"(,"required":["b"])"),
              testing::HasSubstr("requires b"));
}

}  // namespace
}  // namespace codegen
