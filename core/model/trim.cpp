#include "core/model/trim.h"

#include <algorithm>

namespace seedmesh {
namespace {

/// The keys that remain of one list of times: the last one at or before the cut, and all after it.
struct Cut {
  std::size_t first = 0;  ///< key that becomes the one at time 0, or that stays the first
  float share = 0;        ///< share of the way from `first` to the next key at the cut
};

Cut cut_of(const std::vector<float>& times, float seconds) {
  const auto after = std::upper_bound(times.begin(), times.end(), seconds);
  if (after == times.begin()) return {};
  const auto first = static_cast<std::size_t>(after - times.begin()) - 1;
  if (after == times.end()) return {first, 0};
  return {first, (seconds - times[first]) / (times[first + 1] - times[first])};
}

}  // namespace

void trim(Animation& animation, float seconds) {
  std::vector<Cut> cuts;
  for (std::vector<float>& times : animation.times) {
    const Cut cut = cut_of(times, seconds);
    cuts.push_back(cut);
    times.erase(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(cut.first));
    for (float& time : times) time = std::max(0.0F, time - seconds);
  }
  for (Channel& channel : animation.channels) {
    const auto list = static_cast<std::size_t>(channel.times);
    const Cut& cut = cuts[list];
    const std::size_t lanes = channel.values.size() / (animation.times[list].size() + cut.first);
    channel.values.erase(channel.values.begin(),
                         channel.values.begin() + static_cast<std::ptrdiff_t>(cut.first * lanes));
    if (cut.share == 0 || channel.interpolation == Interpolation::step) continue;
    for (std::size_t i = 0; i < lanes; ++i)
      channel.values[i] += cut.share * (channel.values[lanes + i] - channel.values[i]);
  }
}

}  // namespace seedmesh
