#include "core/base/job.h"

#include <algorithm>

#include "core/base/attempt.h"

namespace seedmesh {
namespace {

constexpr std::uint64_t lease = 4096;

/// Use of memory from which on a request that prefers low memory saves it.
constexpr std::uint64_t least_saving_memory = std::uint64_t{8} << 20U;

std::uint64_t bound_of(const Limits& limits, Resource resource) {
  switch (resource) {
    case Resource::modules:
      return limits.modules;
    case Resource::shapes:
      return limits.shapes;
    case Resource::triangles:
      return limits.triangles;
    case Resource::output_bytes:
      return limits.output_bytes;
    default:
      assert(false);  // the others are not counted
      return 0;
  }
}

Issue issue_of(const Limit& limit) {
  std::string name(limit.resource == Resource::memory_bytes ? "bytes of memory" : word_of(limit.resource));
  std::ranges::replace(name, '_', ' ');
  return limit_issue(limit, "needs at least " + std::to_string(limit.needed) + " " + name +
                                "; the limit is " + std::to_string(limit.bound));
}

}  // namespace

Issue iterations_issue(std::uint64_t found, const Limits& limits) {
  return limit_issue(
      {Resource::iterations, limits.iterations, found},
      "found " + std::to_string(found) + " iterations; the limit is " + std::to_string(limits.iterations),
      "/iterations");
}

void MemoryBudget::take(std::uint64_t bytes) {
  std::uint64_t used = used_.load(std::memory_order_relaxed);
  do {
    if (bytes > limit_ || used > limit_ - bytes) {
      throw Stop(Code::limit, issue_of({Resource::memory_bytes, limit_, used + std::min(bytes, ~used)}));
    }
  } while (!used_.compare_exchange_weak(used, used + bytes, std::memory_order_relaxed));
  std::uint64_t peak = peak_.load(std::memory_order_relaxed);
  while (used + bytes > peak && !peak_.compare_exchange_weak(peak, used + bytes, std::memory_order_relaxed)) {
  }
  if (used + bytes >= least_saving_memory && prefers_low_memory())
    saves_memory_.store(true, std::memory_order_relaxed);
}

Job::Job(std::uint64_t seed, Options options)
    : seed_(seed), state_(std::make_shared<State>(std::move(options))) {}

Job Job::for_child(std::uint64_t seed, std::string_view pointer) const {
  Job child(seed, state_);
  child.prefix_ = prefix_ + std::string(pointer);
  child.fallback_ = fallback_;
  return child;
}

Job Job::for_estimate() const {
  Options options = state_->options;
  options.threads = 1;
  options.progress = {};
  Job estimate(seed_, std::make_shared<State>(std::move(options), state_->budget));
  estimate.prefix_ = prefix_;
  estimate.fallback_ = fallback_;
  return estimate;
}

Job Job::for_small_estimate(const Limits& limits) const {
  Job estimate = for_estimate();
  estimate.state_->options.limits = limits;
  estimate.state_->is_attempt = true;
  return estimate;
}

void Job::check() const {
  const Options& options = state_->options;
  if (options.stop.stop_requested()) {
    throw Stop(Code::cancelled, {IssueKind::cancelled, "", "the request was cancelled"});
  }
  if (options.deadline != Clock::time_point::max() && Clock::now() >= options.deadline) {
    throw Stop(Code::deadline, {IssueKind::deadline, "", "the time limit has passed"});
  }
}

void Job::spend(Resource resource, std::uint64_t amount) {
  check();
  const std::uint64_t bound = bound_of(limits(), resource);
  auto& counter = state_->spent[static_cast<int>(resource)];
  std::uint64_t before = counter.load(std::memory_order_relaxed);
  do {
    if (amount > bound || before > bound - amount) {
      refuse(issue_of({resource, bound, before + std::min(amount, ~before)}));
    }
  } while (!counter.compare_exchange_weak(before, before + amount, std::memory_order_relaxed));
}

std::uint64_t Job::spent(Resource resource) const {
  return state_->spent[static_cast<int>(resource)].load(std::memory_order_relaxed);
}

void Job::progress(std::string_view stage, double share) const {
  if (is_child_) return;
  if (state_->stages.empty() || state_->stages.back().name != stage) {
    state_->stages.push_back({std::string(stage), Clock::now()});
  }
  if (state_->options.progress) state_->options.progress(stage, share);
}

void Job::refuse(Issue issue) const {
  const bool is_limit = issue.kind == IssueKind::limit;
  if (is_limit && state_->is_attempt) abandon_attempt();
  if (!issue.pointer.empty()) {
    issue.pointer.insert(0, prefix_);
  } else {
    issue.pointer = is_limit ? fallback_ : prefix_;
  }
  throw Stop(is_limit ? Code::limit : Code::invalid, std::move(issue));
}

void Meter::refill(std::uint64_t amount) {
  // The last units before the limit are reserved one by one, so that a limit of N allows exactly N.
  const std::uint64_t limit = bound_of(job_->limits(), resource_);
  const std::uint64_t spent = job_->spent(resource_);
  const std::uint64_t open = spent < limit ? limit - spent : 0;
  const std::uint64_t want = amount - left_;
  const std::uint64_t take = std::max(want, std::min(lease, open));
  job_->spend(resource_, take);
  left_ = take - want;
}

}  // namespace seedmesh
