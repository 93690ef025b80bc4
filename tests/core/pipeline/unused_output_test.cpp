/// No option of the output is accepted and ignored. For every generator and every value of every member of the output,
/// the file or its warnings differ from those of the request without the member, or the request is refused. The exceptions
/// are listed: options that ask for a state that the model has without them.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/pipeline.h"

namespace seedmesh {
namespace {

using Json = nlohmann::ordered_json;

/// A small request of each generator.
const std::map<std::string, std::string>& small_requests() {
  static const std::map<std::string, std::string> all = {
      {"building",
       R"({"generator":"building","parameters":{"rules":"Lot --> extrude(3) Mass","size":[9,0,7]}})"},
      {"city", R"({"generator":"city","parameters":{"area":{"size":[120,120]}}})"},
      {"fractal", R"({"generator":"fractal","parameters":{"iterations":1}})"},
      {"lsystem", R"({"generator":"lsystem","parameters":{"axiom":"F[+F]F","productions":[],"angle":30}})"},
      {"scene",
       R"({"generator":"scene","parameters":{"layers":[{"model":{"generator":"fractal","parameters":{"iterations":1}},)"
       R"("place":{"method":"positions","positions":[{"at":[0,0]},{"at":[5,5]}]}}]}})"},
      {"terrain", R"({"generator":"terrain","parameters":{"algorithm":"fbm","resolution":9}})"},
      {"tree", R"({"generator":"tree","parameters":{"Levels":1}})"},
      {"world", R"({"generator":"world","parameters":{"extent":32768}})"},
  };
  return all;
}

/// The values of a member that differ from its default.
std::vector<Json> values_of(const std::string& name, const Json& schema) {
  std::vector<Json> values;
  const auto add = [&](const Json& value) {
    if (!schema.contains("default") || value != schema["default"]) values.push_back(value);
  };
  const auto each = [&](const auto& self, const Json& form) -> void {
    for (const Json& alternative : form.value("oneOf", Json::array())) self(self, alternative);
    for (const Json& word : form.value("enum", Json::array())) add(word);
    const std::string type = form.value("type", "");
    if (type == "boolean") add(true);
    if (type == "integer") add(std::max(form["minimum"].get<int>(), 2));
    if (type == "array") add(Json::parse("[1,0.5]"));
  };
  each(each, schema);
  if (name == "name") add("other");
  return values;
}

/// What a request yields: an error, or the bytes and the warnings of the file without its own account of the request.
std::string outcome_of(Json request, const Json& output) {
  request["output"] = output;
  request["output"]["provenance"] = output.value("provenance", "none");
  request["output"]["name"] = output.value("name", "model");
  const Result<Request> read = read_request(request.dump(), Limits{});
  if (!read) return "refused: " + read.error().issues.front().pointer;
  const Result<Product> made = produce(*read, {});
  if (!made) return "refused: " + made.error().issues.front().pointer;
  std::string outcome = made->payload.text();
  for (const Warning& warning : made->warnings) outcome += warning.pointer + warning.message;
  return outcome;
}

bool asks_for_what_is(const std::string& name, const Json& value) {
  static const std::map<std::string, std::set<Json>> all = {
      // What the readers of these profiles support is all that a small model has.
      {"profile", {"unity", "unreal", "godot", "blender"}},
      {"provenance", {"none"}},            // outcome_of() leaves it out anyway
      {"textures", {"none"}},              // a model without textures
      {"image_format", {"png"}},           // the format outside of the profile web
      {"instancing", {"nodes", "merge"}},  // a model without copies; copies of a scene are nodes
      {"tangents", {"none"}},              // a model without textures
  };
  const auto found = all.find(name);
  return found != all.end() && found->second.contains(value);
}

TEST(UnusedOutput, IsRefusedOrReported) {
  const Json schema = Json::parse(std::ifstream(SEEDMESH_SOURCE_DIR "/api_schema/output.schema.json"));
  for (const std::string_view name_of_generator : generator_names()) {
    const std::string generator(name_of_generator);
    ASSERT_TRUE(small_requests().contains(generator)) << generator;
    const Json request = Json::parse(small_requests().at(generator));
    const std::string plain = outcome_of(request, Json::object());
    ASSERT_FALSE(plain.starts_with("refused")) << generator << plain;
    for (const auto& [name, member] : schema["properties"].items()) {
      for (const Json& value : values_of(name, member)) {
        if (asks_for_what_is(name, value)) continue;
        EXPECT_NE(outcome_of(request, {{name, value}}), plain)
            << generator << " output." << name << " " << value;
      }
    }
  }
}

/// The forms that need another option.
TEST(UnusedOutput, InAProfileOrFormatIsRefusedOrReported) {
  const std::vector<std::pair<const char*, const char*>> cases = {
      {R"({"format":"zip"})", R"({"format":"zip","lods":2})"},
      {R"({"format":"zip"})", R"({"format":"zip","lods":[1,0.5]})"},
      {R"({"format":"zip"})", R"({"format":"zip","impostor":true})"},
      {R"({"profile":"web"})", R"({"profile":"web","lods":2})"},
      {R"({"profile":"unity"})", R"({"profile":"unity","instancing":"gpu"})"},
  };
  for (const auto& [generator, text] : small_requests()) {
    const Json request = Json::parse(text);
    for (const auto& [base, changed] : cases)
      EXPECT_NE(outcome_of(request, Json::parse(changed)), outcome_of(request, Json::parse(base)))
          << generator << " " << changed;
  }
}

}  // namespace
}  // namespace seedmesh
