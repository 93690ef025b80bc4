/// Pointers of warnings, in the requests of the golden table, of the corpus of L-systems and of all presets.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "core/pipeline.h"

namespace seedmesh {
namespace {

using Json = nlohmann::json;

int warnings_seen = 0;

void expect_in_request(const std::string& name, const Request& request, const Json& answer) {
  const Json canonical = Json::parse(request.canonical());
  const Json warnings = answer.value("warnings", Json::array());
  for (const Json& warning : warnings) {
    const auto pointer = warning.at("pointer").get<std::string>();
    ++warnings_seen;
    EXPECT_TRUE(canonical.contains(Json::json_pointer(pointer)))
        << name << ": the request has no " << pointer << ": " << warning.at("message");
  }
}

void expect_pointers(const std::string& name, const Result<Request>& request, bool is_derived) {
  if (!request) return;
  if (const Result<std::string> answer = validate(*request, {}))
    expect_in_request(name, *request, Json::parse(*answer));
  if (!is_derived) return;
  if (const Result<std::string> answer = derive(*request, {}))
    expect_in_request(name, *request, Json::parse(*answer));
}

TEST(Warnings, PointIntoTheRequest) {
  warnings_seen = 0;
  for (const PresetInfo& preset : presets()) {
    const auto request = read_preset(preset.name, {}, Limits{});
    if (request) expect_pointers(preset.name, *request, false);
  }
  for (const auto& file : std::filesystem::directory_iterator(SEEDMESH_SOURCE_DIR "/tests/golden/requests")) {
    const Json requests = Json::parse(std::ifstream(file.path()));
    for (const auto& [name, request] : requests.items()) {
      if (request.contains("generator") || request.contains("preset"))
        expect_pointers(name, read_request(request.dump(), Limits{}), false);
    }
  }
  const Json corpus = Json::parse(std::ifstream(SEEDMESH_SOURCE_DIR "/tests/corpus/lsystem.json"));
  const auto visit = [](const auto& self, const Json& value) -> void {
    if (value.is_object() && value.contains("axiom")) {
      const Json body = {{"generator", "lsystem"}, {"parameters", value}};
      expect_pointers(value.at("axiom").dump(), read_request(body.dump(), Limits{}), true);
    } else if (value.is_structured()) {
      for (const Json& each : value) self(self, each);
    }
  };
  visit(visit, corpus);
  EXPECT_GT(warnings_seen, 20);
}

/// Every generator, and a request inside another one.
TEST(Warnings, AreAboutWhatTheRequestContains) {
  const std::string rules =
      R"({"generator":"lsystem","parameters":{"axiom":"F","productions":["F->FF","F->G"]}})";
  const std::string inside = R"({"generator":"scene","parameters":{"layers":[{"model":)" + rules +
                             R"(,"place":{"method":"positions","positions":[{"at":[0,0]}]}}]}})";
  const auto pointers = [](const std::string& text) {
    std::vector<std::string> found;
    const Result<Request> request = read_request(text, Limits{});
    if (!request) return std::vector<std::string>{request.error().issues.front().message};
    const Result<std::string> answer = validate(*request, {});
    if (!answer) return std::vector<std::string>{answer.error().issues.front().message};
    const Json read = Json::parse(*answer);
    for (const Json& warning : read.at("warnings")) found.push_back(warning.at("pointer"));
    return found;
  };
  EXPECT_EQ(pointers(rules).front(), "/parameters/productions/1");
  EXPECT_EQ(pointers(inside).front(), "/parameters/layers/0/model/parameters/productions/1");
}

}  // namespace
}  // namespace seedmesh
