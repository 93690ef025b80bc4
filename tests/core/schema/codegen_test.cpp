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
  } catch (const SchemaError& error) {
    return error.what();
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

TEST(Codegen, NamesThePositionOfAnError) {
  EXPECT_THAT(refusal_of(described(R"("type":"array","items":{"type":"number","odd":1})")),
              testing::StartsWith("odd.schema.json#/properties/a/items: "));
}

TEST(Codegen, RefusesWhatItCouldNotKeep) {
  EXPECT_THAT(refusal_of(R"({"type":"number"})"), testing::HasSubstr("needs a title"));
  EXPECT_THAT(refusal_of(described(R"("type":"integer")")), testing::HasSubstr("needs a minimum"));
  EXPECT_THAT(refusal_of(described(R"("type":"string","pattern":"^.*$")")), testing::HasSubstr("is none of"));
  EXPECT_THAT(refusal_of(described(R"("type":"number","maximum":1,"default":2)")),
              testing::HasSubstr("above the maximum"));
  EXPECT_THAT(refusal_of(described(R"("type":"string","enum":["x"],"default":"y")")),
              testing::HasSubstr("not in the enum"));
  EXPECT_THAT(refusal_of(described(R"("type":"string","default":2)")),
              testing::HasSubstr("the default is not of the type string"));
  EXPECT_THAT(
      refusal_of(described(R"("oneOf":[{"type":"number"},{"type":"integer","minimum":0,"maximum":1}])")),
      testing::HasSubstr("same JSON type"));
  EXPECT_THAT(refusal_of(described(R"("type":"object")")), testing::HasSubstr("additionalProperties"));
  EXPECT_THAT(refusal_of(described(R"("$ref":"#/$defs/none")")), testing::HasSubstr("names nothing"));
  EXPECT_THAT(refusal_of(R"({"$ref":"#/properties/a"})"), testing::HasSubstr("cycle"));
  EXPECT_THAT(refusal_of(R"({"$ref":"#/$defs/n","minimum":3})", R"(,"$defs":{"n":{"type":"number"}})"),
              testing::HasSubstr("beside $ref"));
  EXPECT_THAT(refusal_of(described(R"("type":"number")"), R"(,"required":["b"])"),
              testing::HasSubstr("the required property b"));
}

/// What the tool says to x-applies-when of a parameter `a` beside a number, a choice and a text that may be
/// left out.
std::string refusal_of_condition(const std::string& condition) {
  return refusal_of(described(R"("type":"number","default":1,"x-applies-when":)" + condition) + R"(,"n":)" +
                    described(R"("type":"number","default":1)") + R"(,"c":)" +
                    described(R"("type":"string","enum":["x","y"],"default":"x")") + R"(,"o":)" +
                    described(R"("type":"string")"));
}

TEST(Codegen, TakesConditionsOnOtherParameters) {
  for (const char* condition :
       {R"({"n":2})", R"({"n":{"above":2}})", R"({"/n":{"not":0}})", R"({"c":["x","y"]})",
        R"({"o":{"not":null}})", R"({"anyOf":[{"n":2},{"c":"y"}]})", R"({"allOf":[{"n":2},{"c":"y"}]})"})
    EXPECT_EQ(refusal_of_condition(condition), "") << condition;
}

TEST(Codegen, RefusesConditionsThatCannotBeChecked) {
  EXPECT_THAT(refusal_of_condition(R"({"m":2})"), testing::HasSubstr("there is no parameter m"));
  EXPECT_THAT(refusal_of_condition(R"({"n/m":2})"), testing::HasSubstr("nothing can be found in n"));
  EXPECT_THAT(refusal_of_condition(R"({"n":"x"})"), testing::HasSubstr("`n` is never \"x\""));
  EXPECT_THAT(refusal_of_condition(R"({"c":"z"})"), testing::HasSubstr("`c` is never \"z\""));
  EXPECT_THAT(refusal_of_condition(R"({"c":{"above":2}})"), testing::HasSubstr("above goes with numbers"));
  EXPECT_THAT(refusal_of_condition(R"({"n":{"below":2}})"), testing::HasSubstr("a test is"));
  EXPECT_THAT(refusal_of_condition(R"({"anyOf":[{"n":2}]})"), testing::HasSubstr("two conditions or more"));
  EXPECT_THAT(refusal_of_condition("{}"), testing::HasSubstr("an object with members"));
  EXPECT_THAT(refusal_of_condition("[]"), testing::HasSubstr("an object with members"));
}

}  // namespace
}  // namespace codegen
