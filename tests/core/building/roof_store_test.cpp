#include "core/generators/building/roof_store.h"

#include <gtest/gtest.h>

namespace seedmesh::building {
namespace {

Plan rectangle(double width, double depth) { return {{{{0, 0}, {width, 0}, {width, depth}, {0, depth}}}}; }

RoofOptions gable(double angle) {
  RoofOptions options;
  options.kind = RoofKind::gable;
  options.angle = angle;
  return options;
}

TEST(RoofStore, ReturnsTheRoofThatWasMadeBefore) {
  const Job job(1, Job::Options{});
  RoofStore store;
  const auto first = store.roof(rectangle(9, 6), gable(0.6), job);
  EXPECT_EQ(store.roof(rectangle(9, 6), gable(0.6), job), first);
}

TEST(RoofStore, DistinguishesPlansAndOptions) {
  const Job job(1, Job::Options{});
  RoofStore store;
  const auto first = store.roof(rectangle(9, 6), gable(0.6), job);
  for (const auto& [plan, options] : {std::pair(rectangle(9, 7), gable(0.6)),
                                      {rectangle(9, 6), gable(0.7)},
                                      {rectangle(9, 6), RoofOptions{}}}) {
    const auto other = store.roof(plan, options, job);
    EXPECT_NE(other, first);
    EXPECT_EQ(other->point, roof(plan, options, job).point);
  }
}

}  // namespace
}  // namespace seedmesh::building
