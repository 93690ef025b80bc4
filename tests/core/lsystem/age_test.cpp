/// Age: the plant between two iterations. For every grammar, a small change of age moves limbs by a small
/// distance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/core/lsystem/support.h"
#include "tests/support/context.h"

namespace seedmesh::lsystem {
namespace {

struct System {
  const char* name;
  LsystemParams params;
};

LsystemParams with(LsystemParams params, double angle, std::vector<std::string> interpretation = {}) {
  params.angle = {angle, angle, angle, 0};
  params.interpretation = std::move(interpretation);
  return params;
}

/// Systems that rewrite drawn symbols, turns and interpreted symbols, and systems with contexts or a cut.
std::vector<System> systems() {
  return {
      {"ABOP 1.24a", with(grammar_of("F", {"F -> F[+F]F[-F]F"}, 4), 25.7)},
      {"ABOP 1.24d", with(grammar_of("X", {"X -> F[+X]F[-X]+X", "F -> FF"}, 5), 20)},
      {"Koch", with(grammar_of("F", {"F -> F+F--F+F"}, 4), 60)},
      {"dragon", with(grammar_of("X", {"X -> X+YF+", "Y -> -FX-Y"}, 6), 90, {})},
      {"parametric",
       with(grammar_of("A(1)",
                       {"A(l) -> F(l)[&(40)A(l*0.8)]/(137.5)[&(30)A(l*0.7)]A(l*0.9)", "F(l) -> F(l*1.2)"}, 5),
            45)},
      {"interpreted", with(grammar_of("F", {"F -> H[+G][-G]", "G -> H[&G]"}, 5), 25, {"G -> F", "H -> F"})},
      {"random choice",
       with(grammar_of("A", {"A -> F[+(ran(10,50))A]A : 0.6", "A -> F-A : 0.4", "F -> FF"}, 5), 30)},
      {"context", with(grammar_of("BAAAA", {"B < A -> B", "B -> A", "A -> F[+A]A"}, 4), 30, {"B -> F"})},
      {"erased", with(grammar_of("LFFF", {"L -> ", "F -> F[+L]F"}, 3), 40, {"L -> [F(2)]"})},
      {"cut", with(grammar_of("F[+FFF%FFF]F", {"F -> FF"}, 3), 50)},
  };
}

std::vector<glm::vec3> points_at(LsystemParams params, double age) {
  params.age = age;
  params.style = LsystemParams::Style::lines;
  Job job = job_of(5);
  const Result<Model> model = generate(params, context_of(job));
  EXPECT_TRUE(model);
  std::vector<glm::vec3> points;
  for (const MeshGroup& group : model->meshes) {
    for (const Primitive& each : group.primitives)
      points.insert(points.end(), each.mesh.position.begin(), each.mesh.position.end());
  }
  return points;
}

/// Returns the largest distance of a point of one plant from the other plant.
double moved(const std::vector<glm::vec3>& from, const std::vector<glm::vec3>& to) {
  double farthest = 0;
  for (const glm::vec3& point : from) {
    float nearest = 1e30F;
    for (const glm::vec3& other : to) nearest = std::min(nearest, glm::dot(point - other, point - other));
    farthest = std::max(farthest, std::sqrt(double{nearest}));
  }
  return farthest;
}

double size_of(const std::vector<glm::vec3>& points) {
  glm::vec3 low = points[0], high = points[0];
  for (const glm::vec3& point : points) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
  return std::sqrt(double{glm::dot(high - low, high - low)});
}

TEST(Age, MovesNoLimbFarInASmallStep) {
  constexpr double step = 0.001;
  for (const System& system : systems()) {
    const double whole = static_cast<double>(system.params.iterations);
    const double size = size_of(points_at(system.params, whole));
    for (double age = 0.5; age <= whole - step; age += 0.2501) {
      for (const double at : {age, std::round(age) - step, std::round(age)}) {
        if (at + step > whole) continue;
        const auto before = points_at(system.params, at), after = points_at(system.params, at + step);
        EXPECT_LT(std::max(moved(before, after), moved(after, before)), 20 * step * size)
            << system.name << " at the age of " << at;
      }
    }
  }
}

TEST(Age, OfAllIterationsIsTheWholePlant) {
  for (const System& system : systems()) {
    LsystemParams whole = system.params;
    whole.style = LsystemParams::Style::lines;
    Job job = job_of(5);
    const auto grown = points_at(system.params, static_cast<double>(whole.iterations));
    const Result<Model> model = generate(whole, context_of(job));
    ASSERT_TRUE(model);
    std::size_t count = 0;
    for (const MeshGroup& group : model->meshes) {
      for (const Primitive& each : group.primitives) count += each.mesh.position.size();
    }
    EXPECT_EQ(grown.size(), count) << system.name;
  }
}

TEST(Age, BeyondTheIterationsIsRefused) {
  LsystemParams params = grammar_of("F", {"F -> FF"}, 3);
  params.age = 3.5;
  EXPECT_EQ(errors_of(params).at(0).substr(0, 5), "/age ");
}

TEST(Age, IsANameWhereModulesAreTimed) {
  LsystemParams params = grammar_of("A(0)", {"A(t) : age > t + 1 -> I(t)[+(40)A(t+1)]A(t+1)"}, 5);
  params.interpretation = {"I(t) -> F(2*min(1,(age-t)/3))", "A(t) -> F(max(0,age-t)*2/3)"};
  params.timed = true;
  params.age = 2.5;
  EXPECT_EQ(derived(params), "I(0)[+(40)I(1)[+(40)A(2)]A(2)]I(1)[+(40)A(2)]A(2)");
  double last = 0;
  for (double age = 0.25; age <= 5; age += 0.25) {
    const double size = size_of(points_at(
        [&] {
          LsystemParams at = params;
          return at;
        }(),
        age));
    EXPECT_GT(size, last) << age;
    last = size;
  }
  params.constants["age"] = 3.0;
  EXPECT_EQ(errors_of(params).at(0).substr(0, 14), "/constants/age");
}

TEST(Age, LeavesTheTextOfTheWordWhole) {
  LsystemParams params = grammar_of("A", {"A -> F[+A]A"}, 3);
  params.age = 1.5;
  EXPECT_EQ(derived(params), "F[+F[+A]A]F[+A]A");
}

}  // namespace
}  // namespace seedmesh::lsystem
