#include "core/model/trim.h"

#include <gmock/gmock.h>

#include "core/base/rng.h"

namespace seedmesh {
namespace {

/// The value of a linear track at a time.
float value_at(const std::vector<float>& times, const std::vector<float>& values, float time) {
  if (time <= times.front()) return values.front();
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (time <= times[i])
      return values[i - 1] + (values[i] - values[i - 1]) * (time - times[i - 1]) / (times[i] - times[i - 1]);
  }
  return values.back();
}

TEST(Trim, ShiftsEveryTrackInTime) {
  for (std::uint64_t seed = 0; seed < 2'000; ++seed) {
    const Rng rng = Rng::of_seed(seed);
    Animation animation;
    animation.times.resize(1);
    Channel channel;
    channel.node = 0;
    channel.times = 0;
    float time = static_cast<float>(2 * rng.at(9).unit());
    const auto keys = 1 + static_cast<std::uint64_t>(rng.at(8).unit() * 6);
    for (std::uint64_t key = 0; key < keys; ++key) {
      animation.times[0].push_back(time);
      for (int lane = 0; lane < 3; ++lane)
        channel.values.push_back(static_cast<float>(rng.at(key).at(static_cast<std::uint64_t>(lane)).unit()));
      time += 0.1F + static_cast<float>(rng.at(7).at(key).unit());
    }
    animation.channels.push_back(channel);
    const Animation before = animation;
    const auto cut = static_cast<float>(3 * rng.at(6).unit());
    trim(animation, cut);
    const std::vector<float>&times = animation.times[0], &values = animation.channels[0].values;
    ASSERT_FALSE(times.empty());
    ASSERT_EQ(values.size(), 3 * times.size());
    for (std::size_t i = 1; i < times.size(); ++i) ASSERT_LT(times[i - 1], times[i]);
    for (std::size_t lane = 0; lane < 3; ++lane) {
      std::vector<float> own, other;
      for (std::size_t i = lane; i < values.size(); i += 3) own.push_back(values[i]);
      for (std::size_t i = lane; i < before.channels[0].values.size(); i += 3)
        other.push_back(before.channels[0].values[i]);
      for (float at = 0; at < 5; at += 0.37F)
        ASSERT_NEAR(value_at(times, own, at), value_at(before.times[0], other, at + cut), 1e-5) << seed;
    }
  }
}

}  // namespace
}  // namespace seedmesh
