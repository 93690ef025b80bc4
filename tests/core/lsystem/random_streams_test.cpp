/// An edit of one production does not change other branches.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <tuple>

#include "core/generators/lsystem/lsystem.h"
#include "core/schema/issue_list.h"
#include "generated/params/lsystem.h"
#include "tests/support/context.h"

namespace seedmesh::lsystem {
namespace {

/// A trunk with a branch of kind L on its left and one of kind R on its right; both use random values.
std::string tree(const std::string& left_production) {
  return R"json({"axiom":"F(1)[+(50)L(1)][-(50)R(1)]F(1)","iterations":7,"style":"lines","productions":[)json"
         R"json("R(l) -> F(l)[+(25)R(l*0.7)]R(l*0.8) : 0.6","R(l) -> F(l)[-(25)R(l*ran(0.5,0.9))] : 0.4",)json" +
         left_production + "]}";
}

using Point = std::tuple<float, float, float>;

/// Returns the ends of lines to the right of the trunk.
std::set<Point> right_half(const std::string& text) {
  IssueList errors;
  const LsystemParams params = read_lsystem(Json::parse(text), "", errors);
  EXPECT_TRUE(errors.empty());
  Job job(11, Job::Options{});
  const Result<Model> model = generate(params, context_of(job));
  EXPECT_TRUE(model);
  std::set<Point> points;
  for (const MeshGroup& group : model->meshes) {
    for (const Primitive& primitive : group.primitives) {
      for (const glm::vec3& p : primitive.mesh.position) {
        if (p.x > 0.01F) points.emplace(p.x, p.y, p.z);
      }
    }
  }
  return points;
}

TEST(RandomStreams, OfOtherSubtreesStayWhenOneProductionIsEdited) {
  const std::set<Point> before =
      right_half(tree(R"json("L(l) -> F(l)[+(20)L(l*0.6)]L(l*ran(0.6,0.8))")json"));
  ASSERT_GT(before.size(), 20U);
  EXPECT_EQ(before,
            right_half(tree(R"json("L(l) -> F(l*0.5)F(l*0.5)[-(20)L(l*ran(0.4,0.5))][+(20)L(l*0.6)]")json")));
  EXPECT_EQ(before,
            right_half(tree(R"json("L(l) -> F(l) : 0.5","L(l) -> [+(9)L(l*ran(0.5,0.6))] : 0.5")json")));
  EXPECT_EQ(before, right_half(tree(R"json("L(l) -> *")json")));
}

TEST(RandomStreams, MoveWithTheSeed) {
  const std::string text = tree(R"json("L(l) -> F(l)")json");
  const std::set<Point> before = right_half(text);
  IssueList errors;
  Job job(12, Job::Options{});
  const Result<Model> other = generate(read_lsystem(Json::parse(text), "", errors), context_of(job));
  std::set<Point> points;
  for (const Primitive& primitive : other->meshes.front().primitives) {
    for (const glm::vec3& p : primitive.mesh.position) {
      if (p.x > 0.01F) points.emplace(p.x, p.y, p.z);
    }
  }
  EXPECT_NE(before, points);
}

}  // namespace
}  // namespace seedmesh::lsystem
