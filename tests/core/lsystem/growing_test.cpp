/// Continuous growth: every preset that can grow, and random grammars, just before and after each iteration
/// and in between. Measured by the length, bounds and surface of the drawing.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/base/rng.h"
#include "core/generators/lsystem/fractional_iterations.h"
#include "core/generators/lsystem/shape.h"
#include "core/schema/presets.h"
#include "tests/core/lsystem/support.h"

namespace seedmesh::lsystem {
namespace {

constexpr double step = 1e-6;

struct Measures {
  double length = 0, area = 0;
  glm::dvec3 low{0}, high{0};
  double size() const { return std::sqrt(glm::dot(high - low, high - low)); }
};

/// Area of bark, of the boxes of organs, and of polygons. The mesh is not used, because coincident limbs and
/// the cones of tips change at once.
double area_of(const Skeleton& skeleton) {
  const Limbs& limbs = skeleton.limbs;
  double area = 0;
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (limbs.parent[i] == Limbs::none) continue;
    const glm::dvec3 along = limbs.position[i] - limbs.position[limbs.parent[i]];
    area += math::pi * std::sqrt(glm::dot(along, along)) * double{limbs.base_radius[i] + limbs.radius[i]};
  }
  for (const Organ& organ : skeleton.organs.organ) area += double{organ.scale.x * organ.scale.y};
  for (const Outline& outline : skeleton.outlines.outline) {
    glm::dvec3 twice{0};
    const glm::vec3* vertex = skeleton.outlines.vertex.data() + outline.first;
    for (std::uint32_t k = 2; k < outline.count; ++k)
      twice += glm::cross(glm::dvec3(vertex[k - 1] - vertex[0]), glm::dvec3(vertex[k] - vertex[0]));
    area += 0.5 * std::sqrt(glm::dot(twice, twice));
  }
  return area;
}

/// Returns the bounds of everything with a length. A shoot of length 0 can lie apart from the plant.
void bound(const Limbs& limbs, Measures& measures) {
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (limbs.parent[i] == Limbs::none) continue;
    const glm::dvec3 from = limbs.position[limbs.parent[i]], to = limbs.position[i];
    if (glm::dot(to - from, to - from) < 1e-8) continue;
    measures.low = glm::min(measures.low, glm::min(from, to));
    measures.high = glm::max(measures.high, glm::max(from, to));
  }
}

/// Small limits; plants that exceed them are not measured.
Limits small() {
  Limits limits;
  limits.modules = 20'000;
  return limits;
}

void draw_at(const Grammar& grammar, double age, Drawing& drawing, Job& job) {
  const auto steps = static_cast<std::uint32_t>(std::ceil(age));
  const double share = 1 - (std::ceil(age) - age);
  const Word word = derive_word(grammar, share == 1 ? steps : steps - 1, true, job);
  if (share != 1) return FractionalStep(grammar, drawing, steps - 1, share).word(word, job);
  const double nothing = 0;
  for (std::size_t i = 0; i < word.size(); ++i) {
    drawing.module(word.kind[i], word.parameter.empty() ? &nothing : word.parameter.data() + word.at[i],
                   word.key[i], word.born[i]);
  }
}

/// Returns nullopt where the plant exceeds the limits.
std::optional<Measures> measured(LsystemParams params, double age, std::uint64_t seed) {
  params.age = age;
  params.style = LsystemParams::Style::tubes;
  Job job = job_of(seed, small());
  std::vector<Issue> issues;
  const Grammar grammar = compile(params, seed, Limits{}, issues);
  EXPECT_TRUE(issues.empty()) << issues[0].message;
  Skeleton skeleton(job);
  Drawing drawing(grammar, params, &skeleton, {job});
  try {
    draw_at(grammar, age, drawing, job);
  } catch (const Stop& stop) {
    EXPECT_EQ(stop.code(), Code::limit) << stop.what();
    return std::nullopt;
  }
  shape(skeleton, params, job);
  Measures measures{drawing.turtle().report().total_length, area_of(skeleton), {}, {}};
  bound(skeleton.limbs, measures);
  return measures;
}

/// Returns the measure that differs by more than a thousandth (the area: `area_part`), or "".
std::string jump(const Measures& a, const Measures& b, double area_part) {
  constexpr double small_part = 1e-3;
  const double size = std::max({a.size(), b.size(), 0.1});
  const auto text = [](double from, double to) { return std::to_string(from) + " -> " + std::to_string(to); };
  if (std::abs(a.length - b.length) > small_part * std::max({a.length, b.length, 0.1}))
    return "length " + text(a.length, b.length);
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(a.low[axis] - b.low[axis]) > small_part * size)
      return "low " + text(a.low[axis], b.low[axis]);
    if (std::abs(a.high[axis] - b.high[axis]) > small_part * size)
      return "high " + text(a.high[axis], b.high[axis]);
  }
  if (std::abs(a.area - b.area) > area_part * std::max({a.area, b.area, 1e-3}))
    return "area " + text(a.area, b.area);
  return {};
}

/// Compares the plant around every whole age and in between.
void expect_no_jump(const LsystemParams& params, std::uint64_t seed, const std::string& name,
                    double area_part) {
  for (int k = 0; k < std::min<int>(static_cast<int>(params.iterations), 12); ++k) {
    std::vector<double> ages{k + 0.0, k + step, k + 0.37, k + 0.37 + step, k + 1 - step, k + 1.0};
    std::vector<Measures> found;
    for (const double age : ages) {
      const auto measures = measured(params, age, seed);
      if (!measures) return;
      found.push_back(*measures);
    }
    for (const std::size_t i : {0U, 2U, 4U}) {
      EXPECT_EQ(jump(found[i], found[i + 1], area_part), "") << name << " at the age of " << ages[i];
    }
  }
}

TEST(Growing, HasNoJumpInAnyPreset) {
  int grown = 0;
  for (const auto& [name, preset] : preset_requests()) {
    if (preset.request.at("generator") != "lsystem") continue;
    IssueList errors;
    LsystemParams params = read_lsystem(preset.request.at("parameters"), "", errors);
    ASSERT_TRUE(errors.empty()) << name;
    params.age = 0.5;
    if (params.timed || params.environment || !check(params, Limits{}).empty()) continue;
    ++grown;
    expect_no_jump(params, preset.request.value("seed", std::uint64_t{1}), name, 0.02);
  }
  EXPECT_GT(grown, 50);
}

/// Writes random grammars of all turtle symbols except `$`, which is undefined for a vertical heading.
class RandomGrammar {
 public:
  explicit RandomGrammar(std::uint64_t seed) : rng_(Rng::of_seed(seed)) {}

  LsystemParams make() {
    LsystemParams params = grammar_of("A" + word(1), {"A -> " + word(2), "F -> " + word(1)}, 3);
    if (rng_.unit() < 0.5) params.productions.push_back("B -> " + word(2));
    if (rng_.unit() < 0.3) params.productions.push_back("+ -> " + word(0) + "+");
    if (rng_.unit() < 0.3) params.productions.push_back("@D(x) -> @a(0.8)@D(x*0.9)");
    if (rng_.unit() < 0.3) params.productions.push_back("@- -> F");
    if (rng_.unit() < 0.7) params.interpretation.push_back("A -> " + plain() + plain() + "F");
    if (rng_.unit() < 0.3) params.interpretation.push_back("B -> G" + plain() + plain());
    params.angle = {25, 31, 47, rng_.unit() < 0.5 ? 0.0 : 6.0};
    params.step = {1, rng_.unit() < 0.5 ? 0.0 : 0.4};
    params.tropism.emplace_back();
    params.tropism[0].direction = {0, -1, 0.1};
    params.tropism[0].elasticity = 0.1;
    params.tropism[0].step = 0.07;
    params.width.value = 0.1;
    return params;
  }

 private:
  std::string plain() {
    static constexpr const char* symbols[] = {
        "F",     "f",     "G",         "+",         "-",        "&",        "^",       "\\",
        "/",     "|",     "!(0.2)",    "@D(1.5)",   "@Di(0.8)", "@Dd(1.3)", "@w(0.9)", "@a(0.7)",
        "@-",    "@V",    "@M(1,2,3)", "@R(1,1,0)", "@Ts(0.3)", "@T",       "@Td",     "F(0.7)",
        "+(20)", "/(50)", "{.+F.+F.}", ";(2)",      "-(130)",   "F"};
    return symbols[rng_.below(static_cast<std::uint32_t>(std::size(symbols)))];
  }
  std::string word(int brackets) {
    std::string text;
    const std::uint32_t count = 1 + rng_.below(4);
    for (std::uint32_t i = 0; i < count; ++i) {
      const double draw = rng_.unit();
      if (draw < 0.25 && brackets > 0) {
        text += "[" + word(brackets - 1) + "]";
      } else {
        text += draw < 0.5 ? "A" : draw < 0.6 ? "B" : plain();
      }
    }
    return text;
  }
  Rng rng_;
};

TEST(Growing, HasNoJumpInAnyGrammar) {
  int grown = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const LsystemParams params = RandomGrammar(seed).make();
    if (!check(params, Limits{}).empty()) continue;
    ++grown;
    std::string text = std::to_string(seed) + ": " + params.axiom;
    for (const std::string& each : params.productions) text += "; " + each;
    for (const std::string& each : params.interpretation) text += "; as " + each;
    expect_no_jump(params, seed, text, std::numeric_limits<double>::max());
  }
  EXPECT_GT(grown, 300);
}

TEST(Growing, RestoresTheStateOfModulesThatDisappeared) {
  LsystemParams params = grammar_of("A", {"A -> F[+FA][-FA]"}, 3);
  params.interpretation = {"A -> @D(3)F"};
  const auto near = measured(params, 2 - step, 1), whole = measured(params, 2, 1);
  ASSERT_TRUE(near && whole);
  EXPECT_NEAR(near->length, 21, 1e-3);
  EXPECT_DOUBLE_EQ(whole->length, 21);
}

TEST(Growing, ContinuesWhatThePredecessorDrew) {
  LsystemParams params = grammar_of("F", {"F -> FF"}, 3);
  params.step = {1, 0.5};
  EXPECT_NEAR(measured(params, 2, 0)->length, measured(params, 2 + step, 0)->length, 1e-4);
}

TEST(Growing, LetsLeavesGrowFromNothing) {
  LsystemParams params = grammar_of("F", {"F -> F[+~leaf]"}, 2);
  params.surfaces["leaf"].size = 1;
  EXPECT_NEAR(measured(params, 1, 0)->area, measured(params, 1 + step, 0)->area, 1e-3);
  EXPECT_LT(measured(params, 0.3, 0)->area, measured(params, 0.6, 0)->area);
}

}  // namespace
}  // namespace seedmesh::lsystem
