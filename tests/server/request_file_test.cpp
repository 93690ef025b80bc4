#include "server/request_file.h"

#include <gmock/gmock.h>

#include <random>

namespace seedmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

RequestFile read(const std::string& text) {
  auto result = read_request_file("assets/oak.seedmesh", text);
  if (const auto* errors = std::get_if<ErrorLines>(&result)) ADD_FAILURE() << errors->front();
  return std::get<RequestFile>(std::move(result));
}

ErrorLines errors_in(const std::string& text) {
  auto result = read_request_file("assets/oak.seedmesh", text);
  return std::holds_alternative<ErrorLines>(result) ? std::get<ErrorLines>(result) : ErrorLines{};
}

TEST(RequestFile, MakesOneFileWithItsNameInTheFormatOfTheRequest) {
  const RequestFile plain = read(R"({"$schema": "x", "seed": 18446744073709551615})");
  ASSERT_EQ(plain.outputs.size(), 1U);
  EXPECT_EQ(plain.outputs[0].name, "oak.glb");
  EXPECT_EQ(plain.outputs[0].request, R"({"seed":18446744073709551615})") << "the seed is exact";
  EXPECT_EQ(read(R"({"name": "alps", "output": {"format": "png16"}})").outputs[0].name, "alps.png");
  EXPECT_EQ(read(R"({"output": {"format": "placements"}})").outputs[0].name, "oak.zip");
}

TEST(RequestFile, GivesEachOutputItsOwnMembersAndRemovesThoseThatAreNull) {
  const RequestFile file = read(
      R"({"output": {"profile": "web", "lods": 3}, "outputs": {"b.glb": {"lods": null}, "a.zip": {"format": "zip"}}})");
  ASSERT_EQ(file.outputs.size(), 2U);
  EXPECT_EQ(file.outputs[0].name, "b.glb");
  EXPECT_EQ(file.outputs[0].request, R"({"output":{"profile":"web"}})");
  EXPECT_EQ(file.outputs[1].request, R"({"output":{"profile":"web","lods":3,"format":"zip"}})");
}

TEST(RequestFile, RefusesNamesThatLeaveTheFolder) {
  for (const char* name : {"", "..", ".hidden", "a/b", "../a", "a\\\\b", "a:b", "a\\nb"}) {
    EXPECT_THAT(errors_in(R"({"name": ")" + std::string(name) + "\"}"),
                ElementsAre(HasSubstr("1:10: /name: ")))
        << name;
    EXPECT_EQ(errors_in(R"({"outputs": {")" + std::string(name) + "\": {}}}").size(), 1U) << name;
  }
  EXPECT_EQ(errors_in(R"({"outputs": {"a.seedmesh": {}}})").size(), 1U);
}

TEST(RequestFile, RefusesAnExtensionThatIsNotThatOfTheFormat) {
  EXPECT_THAT(
      errors_in(R"({"outputs": {"oak.zip": {}}})"),
      ElementsAre(
          "assets/oak.seedmesh:1:25: /outputs/oak.zip: expected the extension .glb of the format glb"));
  EXPECT_TRUE(errors_in(R"({"outputs": {"oak.zip": {"format": "zip"}}})").empty());
  EXPECT_TRUE(errors_in(R"({"outputs": {"oak.any": {"format": "unknown"}}})").empty())
      << "the service refuses it";
}

TEST(RequestFile, ListsAllErrorsOfAFile) {
  EXPECT_THAT(
      errors_in("{\"output\": 3,\n \"seed\": 1, \"seed\": 2, \"outputs\": {\"a.glb\": 1}}"),
      ElementsAre("assets/oak.seedmesh:2:13: the key \"seed\" is given twice",
                  "assets/oak.seedmesh:1:12: /output: expected an object",
                  "assets/oak.seedmesh:2:45: /outputs/a.glb: expected an object with members of output"));
  EXPECT_EQ(errors_in(R"({"outputs": {}})").size(), 1U);
}

TEST(RequestFile, PlacesErrorsOfARequestInTheFile) {
  const RequestFile file =
      read("{\"output\": {\"lods\": 2},\n \"outputs\": {\n  \"a.glb\": {\"lods\": 99}, \"b.glb\": {}}}");
  Issue in_text(IssueKind::syntax, "/parameters/axiom", "found `[`", 1, 2);
  EXPECT_THAT(
      error_lines(file, "a.glb", {{IssueKind::out_of_range, "/output/lods", "found 99"}, in_text}),
      ElementsAre("assets/oak.seedmesh:3:21: /outputs/a.glb/lods: found 99",
                  "assets/oak.seedmesh:1:1: /parameters/axiom: found `[` (line 1, column 2 of this text)"));
  EXPECT_THAT(error_lines(file, "b.glb", {{IssueKind::out_of_range, "/output/lods", "found 99"}}),
              ElementsAre("assets/oak.seedmesh:1:21: /output/lods: found 99"));
}

TEST(RequestFile, GivesOutputsOrErrorsForAnyText) {
  const std::string whole =
      R"({"$schema": "x", "name": "é\u00e9", "output": {"lods": [1, 0.5]}, "outputs": {"a.glb": {"lods": null}}, "seed": 1e9})";
  std::mt19937 engine(7);
  const auto random = [&] { return static_cast<unsigned>(engine()); };
  int accepted = 0;
  for (int i = 0; i < 50'000; ++i) {
    std::string text = whole;
    for (unsigned changes = 1 + random() % 3; changes > 0; --changes) {
      const std::size_t at = random() % text.size();
      const char byte = whole[random() % whole.size()];
      switch (random() % 4) {
        case 0:
          text[at] = byte;
          break;
        case 1:
          text.insert(at, 1, byte);
          break;
        case 2:
          text.erase(at, 1 + random() % 3);
          break;
        default:
          text[at] = static_cast<char>(random());
      }
    }
    const auto result = read_request_file("a.seedmesh", text);
    if (const auto* file = std::get_if<RequestFile>(&result)) {
      ++accepted;
      ASSERT_FALSE(file->outputs.empty()) << text;
      error_lines(*file, file->outputs[0].name,
                  {{IssueKind::wrong_type, "/outputs/a.glb/lods/1/x", "found 1"}});
    } else {
      const auto& errors = std::get<ErrorLines>(result);
      ASSERT_FALSE(errors.empty()) << text;
      for (const std::string& line : errors) ASSERT_TRUE(line.starts_with("a.seedmesh:")) << line;
    }
  }
  EXPECT_GT(accepted, 1'000);
}

}  // namespace
}  // namespace seedmesh
