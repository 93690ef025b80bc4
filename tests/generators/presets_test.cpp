/// Every shipped preset, of every generator: it is well described, makes a sound model, and means what its
/// tags say.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "core/geom/mesh/finish.h"
#include "core/pipeline/body.h"
#include "core/pipeline/make_model.h"
#include "tests/generators/edge_exceptions.h"
#include "tests/support/context.h"
#include "tests/support/mesh_faults.h"

namespace seedmesh {

/// What a failure calls the preset by.
void PrintTo(const PresetInfo& preset, std::ostream* out) { *out << preset.name; }

namespace {

/// Of a preset as it is shipped: it must load at once on a phone, unless its tags say that it is large.
// A large model holds the 26,000 buildings of a whole city.
constexpr std::uint64_t most_triangles = 300'000, most_of_large = 1'500'000;

class Presets : public testing::TestWithParam<PresetInfo> {
 protected:
  bool is(std::string_view tag) const {
    const std::vector<std::string>& tags = GetParam().tags;
    return std::find(tags.begin(), tags.end(), tag) != tags.end();
  }

  static std::optional<Request> request(const Overrides& overrides = {}) {
    const auto read = read_preset(GetParam().name, overrides, Limits{});
    if (!read || !*read) {
      ADD_FAILURE() << (read ? read->error().issues.front().pointer + ": " +
                                   read->error().issues.front().message
                             : "there is no such preset");
      return std::nullopt;
    }
    return **read;
  }

  static std::optional<Model> model_of(const Request& request) {
    Job job(request.seed(), Job::Options{});
    Demand demand;
    demand.growth = demand_of(request.body().output, *request.body().generator).growth;
    Result<Model> model = request.body().generator->generate(request.body().params, context_of(job, demand));
    if (!model) {
      ADD_FAILURE() << model.error().issues.front().message;
      return std::nullopt;
    }
    expect_zeros_as_flagged(*model);
    finish(*model, job);
    return std::move(*model);
  }

  template <class T>
  static bool has_minus_zero(const Array<T>& values) {
    const std::span<const float> numbers(reinterpret_cast<const float*>(values.data()),
                                         values.bytes() / sizeof(float));
    return std::any_of(numbers.begin(), numbers.end(),
                       [](float number) { return number == 0 && std::signbit(number); });
  }

  /// finish() does not search meshes whose generator says that they have none.
  static void expect_zeros_as_flagged(const Model& model) {
    for (const MeshGroup& group : model.meshes) {
      for (const Primitive& primitive : group.primitives) {
        const Mesh& mesh = primitive.mesh;
        if (!mesh.no_minus_zero) continue;
        EXPECT_FALSE(has_minus_zero(mesh.position) || has_minus_zero(mesh.normal) ||
                     has_minus_zero(mesh.uv[0]) || has_minus_zero(mesh.tangent))
            << group.name;
      }
    }
  }

  static Box bounds(const Model& model) {
    std::optional<Box> all;
    for (const MeshGroup& group : model.meshes) {
      for (const Primitive& primitive : group.primitives) {
        const Box& box = primitive.mesh.bounds;
        all = all ? Box{glm::min(all->min, box.min), glm::max(all->max, box.max)} : box;
      }
    }
    return all.value_or(Box{});
  }
};

TEST_P(Presets, SayWhatTheyAre) {
  const PresetInfo& preset = GetParam();
  EXPECT_TRUE(std::all_of(preset.name.begin(), preset.name.end(), [](char c) {
    return std::islower(static_cast<unsigned char>(c)) != 0 ||
           std::isdigit(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
  }));
  EXPECT_FALSE(preset.title.empty());
  EXPECT_FALSE(preset.tags.empty());
  ASSERT_FALSE(preset.description.empty());
  EXPECT_TRUE(preset.description.back() == '.' || preset.description.back() == ')')
      << "a description is made of sentences";
}

TEST_P(Presets, MakeSoundModels) {
  const std::optional<Request> read = request();
  ASSERT_TRUE(read);
  const std::optional<Model> model = model_of(*read);
  ASSERT_TRUE(model);
  EXPECT_TRUE(model->warnings.empty());
  const std::vector<EdgeException> accepted = edge_exceptions_of(GetParam().name);
  std::set<std::string_view> found;
  for (const std::string& fault : faults(*model)) {
    const auto names_it = [&](const EdgeException& each) {
      return fault.find(each.check) != std::string::npos;
    };
    const auto exception = std::find_if(accepted.begin(), accepted.end(), names_it);
    EXPECT_NE(exception, accepted.end()) << fault;
    if (exception != accepted.end()) found.insert(exception->check);
  }
  for (const EdgeException& each : accepted) {
    EXPECT_TRUE(found.contains(each.check))
        << "delete the exception, which is not needed any more: " << each.check;
  }
  std::uint64_t elements = 0, triangles = 0;
  for (const MeshGroup& group : model->meshes) {
    for (const Primitive& primitive : group.primitives) {
      elements += primitive.mesh.elements();
      if (primitive.mesh.topology == Topology::triangles) triangles += primitive.mesh.elements();
    }
  }
  EXPECT_GT(elements, 0U) << "the model is empty";
  EXPECT_LE(triangles, is("large") ? most_of_large : most_triangles);
}

TEST_P(Presets, StandUprightOnTheGroundWhereTheyArePlants) {
  if (!is("tree") && !is("bush") && !is("plant")) GTEST_SKIP() << "no tag says that it is a plant";
  const std::optional<Request> read = request();
  ASSERT_TRUE(read);
  const std::optional<Model> model = model_of(*read);
  ASSERT_TRUE(model);
  const Box box = bounds(*model);
  const float height = box.max.y - box.min.y;
  EXPECT_GE(box.min.y, -0.05F * height) << "it grows into the ground";
  EXPECT_GT(height, 0.1F) << "lengths are in metres";
  EXPECT_LT(height, 60.0F) << "lengths are in metres";
}

TEST_P(Presets, DifferFromSeedToSeedOnlyWhereTheyAreStochastic) {
  std::vector<std::string> texts;
  for (const char* seed : {"1", "2"}) {
    const std::optional<Request> read = request({{"seed", seed}});
    ASSERT_TRUE(read);
    const Result<std::string> derived = derive(*read, {});
    ASSERT_TRUE(derived);
    texts.push_back(*derived);
  }
  EXPECT_EQ(texts[0] != texts[1], is("stochastic"));
}

INSTANTIATE_TEST_SUITE_P(All, Presets, testing::ValuesIn(presets()), [](const auto& preset) {
  std::string name = preset.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace seedmesh
