#include "core/base/job.h"

#include <algorithm>

namespace seedmesh {
namespace {

constexpr std::uint64_t lease = 4096;

/// Below it thrift is not worth its cost.
constexpr std::uint64_t worth_thrift = std::uint64_t{8} << 20U;

struct ResourceLimit {
  const char* name;
  std::uint64_t value;
};

ResourceLimit limit_of(const Limits& limits, Resource resource) {
  switch (resource) {
    case Resource::modules:
      return {"modules", limits.modules};
    case Resource::shapes:
      return {"shapes", limits.shapes};
    case Resource::triangles:
      return {"triangles", limits.triangles};
    case Resource::output_bytes:
      return {"output bytes", limits.output_bytes};
  }
  return {"units", 0};
}

[[noreturn]] void refuse_limit(std::string_view name, std::uint64_t limit, std::uint64_t wanted) {
  Job::refuse("needs at least " + std::to_string(wanted) + " " + std::string(name) + "; the limit is " +
              std::to_string(limit));
}

}  // namespace

void Purse::take(std::uint64_t bytes) {
  std::uint64_t used = used_.load(std::memory_order_relaxed);
  do {
    if (bytes > limit_ || used > limit_ - bytes) refuse_limit("bytes of memory", limit_, used + bytes);
  } while (!used_.compare_exchange_weak(used, used + bytes, std::memory_order_relaxed));
  std::uint64_t peak = peak_.load(std::memory_order_relaxed);
  while (used + bytes > peak && !peak_.compare_exchange_weak(peak, used + bytes, std::memory_order_relaxed)) {
  }
  if (used + bytes >= worth_thrift && wants_thrift()) is_thrifty_.store(true, std::memory_order_relaxed);
}

Job::Job(std::uint64_t seed, Options options)
    : seed_(seed), state_(std::make_shared<State>(std::move(options))) {}

Job Job::for_child(std::uint64_t seed) const { return Job(seed, state_); }

void Job::check() const {
  const Options& options = state_->options;
  if (options.stop.stop_requested()) throw Stop(Code::cancelled, {"", "the request was cancelled"});
  if (options.deadline != Clock::time_point::max() && Clock::now() >= options.deadline) {
    throw Stop(Code::deadline, {"", "the time limit has passed"});
  }
}

void Job::spend(Resource resource, std::uint64_t amount) {
  check();
  const ResourceLimit limit = limit_of(limits(), resource);
  auto& counter = state_->spent[static_cast<int>(resource)];
  std::uint64_t before = counter.load(std::memory_order_relaxed);
  do {
    if (amount > limit.value || before > limit.value - amount) {
      refuse_limit(limit.name, limit.value, before + std::min(amount, ~before));
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

void Job::refuse(std::string message, std::string pointer) {
  throw Stop(Code::limit, {std::move(pointer), std::move(message)});
}

void Job::reject(Issue issue) { throw Stop(Code::invalid, std::move(issue)); }

void Meter::refill(std::uint64_t amount) {
  // The last units before the limit are handed out one by one, so that a limit of N lets exactly N through.
  const std::uint64_t limit = limit_of(job_->limits(), resource_).value;
  const std::uint64_t spent = job_->spent(resource_);
  const std::uint64_t open = spent < limit ? limit - spent : 0;
  const std::uint64_t want = amount - left_;
  const std::uint64_t take = std::max(want, std::min(lease, open));
  job_->spend(resource_, take);
  left_ = take - want;
}

}  // namespace seedmesh
