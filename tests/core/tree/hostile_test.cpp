/// Parameters drawn at random from the schema, many at their limits: a sound model or a refusal, nothing
/// else.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "core/base/rng.h"
#include "core/generators/tree/tree.h"
#include "core/geom/mesh/finish.h"
#include "core/schema/embedded.h"
#include "generated/params/tree.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh::tree {
namespace {

Json drawn(const Json& schema, Rng rng);

Json drawn_number(const Json& schema, Rng& rng) {
  const double low = schema.contains("minimum") ? schema["minimum"].get<double>()
                                                : schema["exclusiveMinimum"].get<double>() + 1e-3;
  const double high = schema["maximum"].get<double>();
  const double pick = rng.unit();
  // A third low, a third high, the rest between.
  const double value = pick < 0.33 ? low : pick < 0.66 ? high : rng.uniform(low, high);
  if (schema["type"] == "integer") return static_cast<std::int64_t>(value);
  return value;
}

Json drawn_object(const Json& schema, Rng& rng) {
  Json object = Json::object();
  const Json required = schema.value("required", Json::array());
  for (const auto& [name, property] : schema["properties"].items()) {
    if (name.ends_with("images")) continue;  // files, not numbers: tests/core/texture
    Rng own = rng.at(name);
    const bool is_required = std::find(required.begin(), required.end(), name) != required.end();
    if (own.unit() < 0.5 || is_required) object[name] = drawn(property, own.at("value"));
  }
  return object;
}

Json drawn(const Json& schema, Rng rng) {
  if (schema.contains("oneOf")) return rng.next() >> 12U;  // a seed
  const std::string type = schema["type"];
  if (type == "boolean") return rng.unit() < 0.5;
  if (type == "number" || type == "integer") return drawn_number(schema, rng);
  if (type == "object") return drawn_object(schema, rng);
  if (type == "array") {
    Json list = Json::array();
    const auto least = schema.value("minItems", 0U), most = std::min(schema.value("maxItems", 3U), least + 3);
    const std::uint32_t count = least + rng.below(most - least + 1);
    for (std::uint32_t i = 0; i < count; ++i) list.push_back(drawn(schema["items"], rng.at(i)));
    return list;
  }
  if (schema.contains("enum"))
    return schema["enum"][rng.below(static_cast<std::uint32_t>(schema["enum"].size()))];
  return "#123456";
}

/// 0: refused, 1: sound.
int outcome(const Json& json, std::uint64_t seed) {
  IssueList faults;
  TreeParams params = read_tree(json, "/parameters", faults);
  EXPECT_TRUE(faults.empty());
  if (params.mSegments % 2) ++params.mSegments;
  Job::Options options;
  options.limits.triangles = 60'000;
  options.limits.memory_bytes = std::uint64_t{1} << 28U;
  Job job(seed, options);
  try {
    Result<Model> model = generate(params, {job});
    EXPECT_TRUE(model);
    finish(*model, job);
    for (const std::string& fault : seedmesh::faults(*model)) {
      // Where limbs have no length, leaves lie on leaves; the bark has no excuse.
      const bool is_of_leaves =
          fault.starts_with("leaves:") &&
          (fault.find("edges") != std::string::npos || fault.find("duplicate") != std::string::npos);
      const bool is_about_order = fault.find("cache misses") != std::string::npos;
      // Several trunks without any distance start at one point.
      const bool trunks_meet =
          json.value("0Branches", 1) > 1 && fault.find("duplicate vertices") != std::string::npos;
      // A leaf that is rolled up has corners whose faces look in opposite directions.
      const double droop = json.value("leaf", Json::object()).value("droop", 0.0);
      const bool is_rolled_up = std::abs(droop) > 150 && fault.find("turned against") != std::string::npos;
      EXPECT_TRUE(is_of_leaves || is_about_order || trunks_meet || is_rolled_up)
          << fault << " of seed " << seed << ": " << json.dump();
    }
    return 1;
  } catch (const Stop& stop) {
    // A bark whose limbs overlap too densely to be closed is refused as invalid, everything else by a limit.
    EXPECT_TRUE(stop.code() == Code::limit || stop.issue().kind == IssueKind::evaluation)
        << stop.issue().message;
    return 0;
  }
}

TEST(HostileParameters, GiveASoundModelOrARefusal) {
  const char* count = std::getenv("SEEDMESH_HOSTILE_DRAWS");
  const int draws = count ? std::atoi(count) : 300;
  Json schema;
  for (const EmbeddedText& text : embedded_schemas()) {
    if (text.name == "tree") schema = Json::parse(text.text);
  }
  ASSERT_TRUE(schema.is_object());
  int sound = 0;
  for (int i = 0; i < draws && !testing::Test::HasFatalFailure(); ++i) {
    Rng rng = Rng::of_seed(static_cast<std::uint64_t>(i));
    sound += outcome(drawn_object(schema, rng), static_cast<std::uint64_t>(i));
  }
  EXPECT_GT(sound, draws / 4) << "most draws must be made, not refused";
}

}  // namespace
}  // namespace seedmesh::tree
