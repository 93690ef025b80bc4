#include "core/generators/lsystem/shared_parts.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>

#include "core/geom/mesh/finish.h"
#include "tests/core/lsystem/support.h"

namespace seedmesh::lsystem {
namespace {

using Share = LsystemParams::Share;

/// System A of Tajić (section 4.3 of the thesis), with its values.
LsystemParams tajic_a(int depth, LsystemParams::Style style) {
  LsystemParams params = grammar_of("FFFFFA", {"A -> F[&&A][^^A]///A"}, depth);
  params.angle = {25, 25, 25, 0};
  params.step.value = 0.15;
  params.width.value = 0.04;
  params.width_rule = LsystemParams::WidthRule::decrement;
  params.width_decrement = 0.003;
  params.interpretation = {"A -> F"};
  params.sides = 10;
  params.style = style;
  return params;
}

Model model_of(LsystemParams params, Share share, Limits limits = {}) {
  params.share = share;
  Job job = job_of(1, limits);
  Result<Model> model = generate(params, context_of(job));
  EXPECT_TRUE(model) << (model ? "" : model.error().issues.front().message);
  return model ? *std::move(model) : Model{};
}

/// The number of elements that are shown, and their corners in the whole model, sorted.
struct Shown {
  std::uint64_t elements = 0;
  std::vector<std::array<float, 6>> lines;
};

Shown shown(const Model& model, bool with_lines) {
  Shown out;
  for (const Node& node : model.nodes) {
    if (node.mesh < 0) continue;
    const std::vector<Transform> once{Transform{}};
    const std::vector<Transform>& places =
        node.instances.transforms.empty() ? once : node.instances.transforms;
    for (const Primitive& primitive : model.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
      out.elements += places.size() * primitive.mesh.elements();
      if (!with_lines) continue;
      for (const Transform& place : places) {
        const auto at = [&](std::size_t i) {
          return place.rotation * primitive.mesh.position[primitive.mesh.index.at(i)] + place.translation;
        };
        for (std::size_t i = 0; i + 1 < primitive.mesh.index.size(); i += 2) {
          const glm::vec3 a = at(i), b = at(i + 1);
          out.lines.push_back({a.x, a.y, a.z, b.x, b.y, b.z});
        }
      }
    }
  }
  return out;
}

/// Sums that do not depend on the order of the lines.
std::array<double, 9> moments(const std::vector<std::array<float, 6>>& lines) {
  std::array<double, 9> sums{};
  for (const auto& line : lines) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double middle = (static_cast<double>(line[k]) + static_cast<double>(line[k + 3])) / 2,
                   extent = static_cast<double>(line[k + 3]) - static_cast<double>(line[k]);
      sums[k] += middle;
      sums[k + 3] += middle * middle;
      sums[k + 6] += extent * extent;
    }
  }
  return sums;
}

TEST(SharedParts, ShowTheSameLinesAsOneMesh) {
  for (const int depth : {7, 9, 10}) {
    const LsystemParams params = tajic_a(depth, LsystemParams::Style::lines);
    const Model one = model_of(params, Share::never), parts = model_of(params, Share::always);
    const Shown a = shown(one, true), b = shown(parts, true);
    // 5 + (3^n - 1) / 2 + 3^n segments
    const auto power = static_cast<std::uint64_t>(std::pow(3.0, depth) + 0.5);
    EXPECT_EQ(a.elements, 5 + (power - 1) / 2 + power);
    EXPECT_EQ(b.elements, a.elements);
    const auto before = moments(a.lines), after = moments(b.lines);
    for (std::size_t k = 0; k < 9; ++k)
      EXPECT_NEAR(after[k], before[k], 1e-5 * static_cast<double>(a.elements)) << depth;
    std::uint64_t stored = 0;
    for (const MeshGroup& mesh : parts.meshes) stored += mesh.primitives[0].mesh.elements();
    EXPECT_LT(stored, a.elements / 2);
  }
}

TEST(SharedParts, HaveTheWidthsOfTheWholeTree) {
  // The volume of closed tubes grows with the squares of their widths: one step of the decrement would change it by more
  // than a fifth. The cones at the ends of parts add some.
  const auto volume = [](const Model& model) {
    double sum = 0;
    for (const Node& node : model.nodes) {
      if (node.mesh < 0) continue;
      const double copies = static_cast<double>(std::max<std::size_t>(node.instances.transforms.size(), 1));
      for (const Primitive& primitive : model.meshes[static_cast<std::size_t>(node.mesh)].primitives) {
        const Mesh& mesh = primitive.mesh;
        for (std::size_t i = 0; i + 2 < mesh.index.size(); i += 3) {
          const glm::dvec3 a(mesh.position[mesh.index.at(i)]), b(mesh.position[mesh.index.at(i + 1)]),
              c(mesh.position[mesh.index.at(i + 2)]);
          sum += copies * glm::dot(a, glm::cross(b, c)) / 6;
        }
      }
    }
    return sum;
  };
  const LsystemParams params = tajic_a(8, LsystemParams::Style::tubes);
  const double one = volume(model_of(params, Share::never)), parts = volume(model_of(params, Share::always));
  EXPECT_NEAR(parts, one, 0.1 * one);
}

TEST(SharedParts, AnswerTheDeepestTreeOfTheThesisWithinTheLimits) {
  for (const auto style : {LsystemParams::Style::lines, LsystemParams::Style::tubes}) {
    const Model model = model_of(tajic_a(15, style), Share::auto_);
    const Shown all = shown(model, false);
    if (style == LsystemParams::Style::lines) {
      EXPECT_EQ(all.elements, 21'523'365U);
    } else {
      // Segments are 3 mm thinner in each step, so those of the first 13 steps have a width: 5 and (3^13 - 1) / 2.
      EXPECT_GE(all.elements, 20U * 797'166U);
    }
  }
}

TEST(SharedParts, MeasureTheWholeTree) {
  for (const int depth : {8, 10}) {
    LsystemParams params = tajic_a(depth, LsystemParams::Style::tubes);
    Job one = job_of(1), two = job_of(1);
    params.share = Share::never;
    const Result<Json> whole = derive(params, context_of(one));
    params.share = Share::always;
    const Result<Json> shared = derive(params, context_of(two));
    ASSERT_TRUE(whole && shared);
    EXPECT_EQ(shared->at("string"), whole->at("string"));
    EXPECT_EQ(shared->at("counts"), whole->at("counts"));
    const Json &a = whole->at("turtle"), &b = shared->at("turtle");
    EXPECT_EQ(b.at("segments"), a.at("segments"));
    EXPECT_NEAR(b.at("total_length").get<double>(), a.at("total_length").get<double>(), 1e-6);
    for (const char* end : {"min", "max"}) {
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(b.at("bounds").at(end)[k].get<double>(), a.at("bounds").at(end)[k].get<double>(), 1e-9);
    }
  }
}

TEST(SharedParts, ContinueBehindAPartThatMovesTheTurtle) {
  // Every K is followed by the next one along the same curve.
  LsystemParams params = grammar_of("K+K+K", {"K -> K-K++K-K", "K -> K"}, 7);
  params.productions = {"K -> K-K++K-K"};
  params.angle = {60, 60, 60, 0};
  params.interpretation = {"K -> F"};
  params.style = LsystemParams::Style::lines;
  const Shown a = shown(model_of(params, Share::never), true),
              b = shown(model_of(params, Share::always), true);
  EXPECT_EQ(a.elements, 3U * 16'384U);
  EXPECT_EQ(b.elements, a.elements);
  const auto before = moments(a.lines), after = moments(b.lines);
  for (std::size_t k = 0; k < 9; ++k) EXPECT_NEAR(after[k], before[k], 1e-5 * std::abs(before[k]) + 0.01);
}

TEST(SharedParts, AreLeftOutWhereChanceOrPolygonsNeedTheWhole) {
  Job job = job_of(1);
  const auto shares = [&](LsystemParams params) {
    params.share = Share::always;
    std::vector<Issue> issues;
    const Grammar grammar = compile(params, 1, Limits{}, issues);
    return has_shared_parts(grammar, params, static_cast<std::uint32_t>(params.iterations), context_of(job));
  };
  LsystemParams params = tajic_a(10, LsystemParams::Style::tubes);
  EXPECT_TRUE(shares(params));
  params.productions = {"A -> F[&&A][^^A]///A : 0.5", "A -> FA : 0.5"};
  EXPECT_FALSE(shares(params));
  params = tajic_a(10, LsystemParams::Style::tubes);
  params.width_rule = LsystemParams::WidthRule::longest_chain;
  EXPECT_FALSE(shares(params));
  params = tajic_a(10, LsystemParams::Style::tubes);
  params.productions = {"A -> F[&&A][^^A]///A{.f.f.}"};
  EXPECT_FALSE(shares(params));
}

/// Poses of the organs of a request.
std::vector<std::array<double, 4>> organs_of(LsystemParams params) {
  Job job = job_of(0);
  params.surfaces["leaf"].size = 0.5;
  params.surfaces["bud"].size = 0.25;
  std::vector<Issue> issues;
  const Grammar grammar = compile(params, 0, Limits{}, issues);
  EXPECT_TRUE(issues.empty()) << issues.front().message;
  Skeleton skeleton(job);
  Drawing drawing(grammar, params, &skeleton, context_of(job));
  ContextFreeDerivation<Drawing>(grammar, static_cast<std::uint32_t>(params.iterations), false, job, drawing)
      .run();
  std::vector<std::array<double, 4>> out;
  for (const Organ& organ : skeleton.organs.organ) {
    out.push_back({static_cast<double>(organ.surface), static_cast<double>(organ.position.x),
                   static_cast<double>(organ.position.y), static_cast<double>(organ.scale.y)});
  }
  return out;
}

TEST(Objects, AreParametersThatProductionsPassOn) {
  const auto named = organs_of(grammar_of("F[+~leaf(2)]F~bud", {}, 0));
  const auto passed = organs_of(
      grammar_of("A(leaf, 2)A(bud, 1)", {"A(o, s) : o == leaf -> F[+@N(o, s)]", "A(o, s) -> F@N(o)"}, 1));
  EXPECT_EQ(passed, named);
}

TEST(Objects, AreEndNodesInAFrame) {
  LsystemParams params =
      grammar_of("Limb(translate(frame(), 1, 2, 0), leaf)", {"Limb(f, o) -> @Nf(scale(f, 1, 3, 1), o)"}, 1);
  params.modules = {"Limb(frame f, o)"};
  const auto placed = organs_of(params);
  ASSERT_EQ(placed.size(), 1U);
  EXPECT_EQ(placed[0], (std::array<double, 4>{1, 1, 2, 1.5}));  // bud is object 0, leaf 1; 3 times 0.5 m
}

TEST(Objects, ThatDoNotExistAreRefused) {
  LsystemParams params = grammar_of("F@N(7)", {}, 0);
  params.surfaces["leaf"] = {};
  Job job = job_of(0);
  try {
    EXPECT_FALSE(generate(params, context_of(job)));
  } catch (const Stop& stop) {
    EXPECT_THAT(stop.issue().message,
                testing::HasSubstr("found 7 as an object, expected the name of an entry of `surfaces`"));
  }
  EXPECT_THAT(errors_of(grammar_of("F@N(leaf)", {}, 0)), testing::SizeIs(1));
}

}  // namespace
}  // namespace seedmesh::lsystem
