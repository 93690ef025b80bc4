#pragma once
/// Counts the shapes of one derivation. Thousands of small buildings of a city share one limit, so the portions
/// that are taken from the job begin small.
#include <algorithm>
#include <cstdint>

#include "core/base/job.h"

namespace seedmesh::building {

/// Like Meter, in portions from 64 that double up to 4,096. The rest of the last portion is not returned, so a count
/// may be too high by less than the count itself and 64.
class ShapeMeter {
 public:
  explicit ShapeMeter(Job& job) : job_(&job) {}

  void spend(std::uint64_t amount = 1) {
    if (amount > left_) refill(amount - left_);
    left_ -= amount;
  }

 private:
  void refill(std::uint64_t wanted) {
    // The last units before the limit are reserved one by one, so that a limit of N allows exactly N.
    const std::uint64_t limit = job_->limits().shapes, spent = job_->spent(Resource::shapes);
    const std::uint64_t open = spent < limit ? limit - spent : 0;
    const std::uint64_t taken = std::max(wanted, std::min(portion_, open));
    job_->spend(Resource::shapes, taken);
    left_ += taken;
    portion_ = std::min<std::uint64_t>(2 * portion_, 4096);
  }

  Job* job_;
  std::uint64_t left_ = 0, portion_ = 64;
};

}  // namespace seedmesh::building
