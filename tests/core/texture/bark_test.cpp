#include "core/texture/bark.h"

#include <gtest/gtest.h>

#include <cmath>

namespace seedmesh::texture {
namespace {

/// The mean difference between two columns.
double difference(const Field& field, int a, int b) {
  double sum = 0;
  for (int y = 0; y < field.size(); ++y) sum += std::abs(field.at(a, y) - field.at(b, y));
  return sum / field.size();
}

/// The greatest difference between neighbouring columns.
double steepest(const Field& field) {
  double most = 0;
  for (int x = 0; x < field.size(); ++x) most = std::max(most, difference(field, x, x + 1));
  return most;
}

TEST(Bark, TilesInStripsOfPowersOfTwoOfItsWidth) {
  const Job job(1, Job::Options{});
  constexpr int size = 256;
  for (const std::string_view kind : bark_kinds()) {
    const Relief relief = bark_relief(kind, size, 5, job);
    for (const Field* field : {&relief.height, &relief.tone}) {
      const double usual = steepest(*field);
      for (float strip = 0.5F; strip >= least_bark_strip; strip *= 0.5F) {
        const int end = static_cast<int>(strip * size);
        EXPECT_LE(difference(*field, end - 1, 0), 1.05 * usual) << kind << ", a strip of " << strip;
        EXPECT_LT(difference(*field, end, 0), 1e-6) << kind << ", the edge of a strip of " << strip;
      }
    }
  }
}

}  // namespace
}  // namespace seedmesh::texture
