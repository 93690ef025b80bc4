#include "core/generators/tree/weber_penn.h"

#include <cmath>
#include <memory>

#include "core/base/parallel.h"
#include "core/generators/tree/weber_penn_grow.h"

namespace seedmesh::tree {
namespace {

// Fewer stems are not grown in parts.
constexpr std::size_t least_stems = 8;
// Trunks that split off are grown before the parts are made, because one may bear half the tree; at most so
// many.
constexpr std::size_t most_trunks = 16;
// Stems bear this share of their greatest number of children, on average.
constexpr double usual_share = 0.7;
// A part may be larger than the average by this factor. Trees of fewer joints have fewer parts.
constexpr double largest_part = 1.5, many_joints = 12'000;

/// A part of the tree with a skeleton of its own, whose joints are numbered as if they followed those of
/// `base`.
struct Part {
  Part(const WeberPennTree& tree, const SkeletonWriter& base, std::size_t most)
      : skeleton(base.job()), writer(skeleton, base, most), growth(tree, writer) {}
  Skeleton skeleton;
  SkeletonWriter writer;
  WeberPennGrowth growth;
};

/// A trunk that is grown, or else the stems from `begin` to `end` that wait in `from`.
struct Step {
  std::unique_ptr<Part> part;
  const WeberPennGrowth* from = nullptr;
  std::size_t begin = 0, end = 0;
};

/// Steps in the order in which their skeletons are joined.
struct Plan {
  std::vector<Step> steps;
  std::size_t trunks = 0, stems = 0;
};

/// About as many joints and leaves as the tree has.
struct Expected {
  double joints = 0, leaves = 0;
};

Expected expected_size(const WeberPennTree& tree) {
  const int levels = tree.params.Levels;
  double stems = tree.params.branches_0, joints = 0;
  for (int n = 0; n < levels; ++n) {
    const double children = n + 1 < levels ? tree.level(n + 1).branches : 0;
    joints += stems * (tree.level(n).curve_res + children);
    if (n + 1 < levels) stems *= children;
  }
  return {usual_share * joints, usual_share * stems * std::abs(tree.params.Leaves)};
}

/// Plans what waits in `from`, the last stem first. Trunks are grown here, and what grows from them follows.
void plan_parts(const WeberPennGrowth& from, std::size_t most, Plan& plan) {
  for (std::size_t end = from.waiting.size(); end > 0; --end) {
    const WeberPennStem& stem = from.waiting[end - 1];
    if (stem.level > 0 || plan.trunks == most_trunks) {
      plan.steps.push_back({nullptr, &from, end - 1, end});
      ++plan.stems;
      continue;
    }
    ++plan.trunks;
    auto part = std::make_unique<Part>(from.tree, from.writer, most);
    grow_stem(part->growth, stem);
    write_leaves(part->growth);
    const WeberPennGrowth& growth = part->growth;
    plan.steps.push_back({std::move(part), nullptr, 0, 0});
    plan_parts(growth, most, plan);
  }
}

/// Joins neighbouring steps of one growth up to `stems` stems.
void join_steps(Plan& plan, std::size_t stems) {
  std::vector<Step> joined;
  for (Step& step : plan.steps) {
    const bool continues = !joined.empty() && step.from && joined.back().from == step.from &&
                           joined.back().begin == step.end && joined.back().end - step.begin <= stems;
    if (continues) {
      joined.back().begin = step.begin;
    } else {
      joined.push_back(std::move(step));
    }
  }
  plan.steps = std::move(joined);
}

void grow_step(Step& step, const Expected& expected, std::size_t most, double share) {
  const WeberPennGrowth& from = *step.from;
  auto part = std::make_unique<Part>(from.tree, from.writer, most);
  part->growth.waiting.assign(from.waiting.begin() + static_cast<std::ptrdiff_t>(step.begin),
                              from.waiting.begin() + static_cast<std::ptrdiff_t>(step.end));
  part->writer.expect(share * expected.joints, share * expected.leaves);
  grow_waiting(part->growth);
  step.part = std::move(part);
}

/// Grows what waits on all threads. The result is that of one thread, because stems that wait do not depend
/// on each other and random numbers have keys. Returns false, with nothing grown, where the tree is small or
/// may reach a limit.
bool grow_in_parts(WeberPennGrowth& growth, const Expected& expected) {
  const Job& job = growth.writer.job();
  if (!has_threads(job) || growth.waiting.size() < least_stems) return false;
  const std::size_t parts_per_thread = expected.joints < many_joints ? 2 : 4;
  const std::size_t wanted = parts_per_thread * static_cast<std::size_t>(job.threads());
  const std::size_t most_of_trunk = growth.writer.most_of_parts(wanted + most_trunks);
  if (most_of_trunk == 0) return false;
  write_leaves(growth);
  Plan plan;
  const bool fits = attempt([&] {
    plan_parts(growth, most_of_trunk, plan);
    join_steps(plan, std::max<std::size_t>(1, plan.stems / wanted));
    const std::size_t count = plan.steps.size(), most = growth.writer.most_of_parts(count);
    const double share = largest_part / static_cast<double>(count);
    parallel_for(job, count, 1, [&](std::size_t, std::size_t, std::size_t i) {
      if (!plan.steps[i].part) grow_step(plan.steps[i], expected, most, share);
    });
  });
  if (!fits) return false;  // the tree is so large that it may reach a limit
  std::vector<SkeletonWriter*> written;
  for (Step& step : plan.steps) written.push_back(&step.part->writer);
  growth.writer.take(written);
  return true;
}

}  // namespace

void grow_weber_penn(const TreeParams& params, const RandomStreams& random, SkeletonWriter& writer) {
  WeberPennTree tree(params, random);
  const Expected expected = expected_size(tree);
  if (!has_threads(writer.job())) writer.expect(expected.joints, expected.leaves);
  WeberPennGrowth growth(tree, writer);
  for (int number = 0; number < params.branches_0; ++number) {
    WeberPennStem trunk = make_trunk(tree, number);
    SkeletonWriter::Joint root;
    root.position = trunk.position;
    root.radius = root.base_radius = radius_at(tree, trunk, 0);
    root.key = trunk.rng.key();
    trunk.joint = writer.add(root);
    grow_stem(growth, trunk);
  }
  if (!grow_in_parts(growth, expected)) grow_waiting(growth);
}

}  // namespace seedmesh::tree
