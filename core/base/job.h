#pragma once
/// The context that every generator gets besides its parameters: seed, limits, deadline, cancellation, memory
/// budget and progress, in one argument.
#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <stop_token>
#include <string_view>
#include <utility>

#include "core/base/result.h"
#include "core/base/rng.h"

namespace seedmesh {

/// The greatest amounts that one request may use: numbers of items, or bytes where the name states it. Flags
/// and environment variables of the server change them.
struct Limits {
  std::uint64_t modules = 64'000'000;
  std::uint64_t shapes = 4'000'000;
  std::uint64_t triangles = 40'000'000;
  std::uint64_t output_bytes = std::uint64_t{1} << 30U;
  std::uint64_t memory_bytes = std::uint64_t{2} << 30U;
  std::uint32_t iterations = 1'000;
  std::uint32_t bracket_depth = 10'000;
  std::uint32_t expression_depth = 200;
};

/// Returns the issue of a request that has `found` iterations, where limits.iterations allows fewer. Its
/// pointer is "/iterations".
Issue iterations_issue(std::uint64_t found, const Limits& limits);

/// The exception that ends a request: a limit is exceeded, the deadline has passed, the request is cancelled,
/// or a value turns out to be unusable while the work runs. Only Job and MemoryBudget throw it. core/pipeline
/// catches it for all requests. The import of cpfg catches it around the statements that it runs. The writer
/// of WebP catches it to end its encoder. The pointer of its issue is relative to the parameters of the
/// outermost request.
class Stop : public std::exception {
 public:
  Stop(Code code, Issue issue) : code_(code), issue_(std::move(issue)) {}
  const char* what() const noexcept override { return issue_.message.c_str(); }
  Code code() const { return code_; }
  const Issue& issue() const { return issue_; }

 private:
  Code code_;
  Issue issue_;
};

class HugePageCache;

/// Counts the bytes of all arrays of one request. The arrays share it, because those of the finished model
/// outlive the Job.
class MemoryBudget {
 public:
  explicit MemoryBudget(std::uint64_t limit, std::shared_ptr<HugePageCache> reserve = nullptr)
      : limit_(limit), reserve_(std::move(reserve)) {}
  /// Returns the store that keeps the memory of big arrays for later requests; may be null.
  HugePageCache* reserve() const { return reserve_.get(); }
  void take(std::uint64_t bytes);  ///< throws Stop before the limit is exceeded
  void release(std::uint64_t bytes) { used_.fetch_sub(bytes, std::memory_order_relaxed); }
  std::uint64_t used() const { return used_.load(std::memory_order_relaxed); }
  std::uint64_t peak() const { return peak_.load(std::memory_order_relaxed); }  ///< the most that was used

  /// Bytes that blocks leave empty at the ends of their last pages. Not counted as used.
  std::uint64_t slack() const { return slack_.load(std::memory_order_relaxed); }
  void take_slack(std::uint64_t bytes) { slack_.fetch_add(bytes, std::memory_order_relaxed); }
  void release_slack(std::uint64_t bytes) { slack_.fetch_sub(bytes, std::memory_order_relaxed); }

  /// From now on, large arrays take only the pages that they need. Once the request uses 8 MiB (saves_memory()), a
  /// freed array also returns its memory to the system, so that later arrays cause page faults again. Meant for
  /// responses that are much smaller than the data that they are made of.
  void prefer_low_memory() { prefers_low_memory_.store(true, std::memory_order_relaxed); }
  bool prefers_low_memory() const { return prefers_low_memory_.load(std::memory_order_relaxed); }
  bool saves_memory() const { return saves_memory_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::uint64_t> used_{0}, peak_{0};
  std::atomic<bool> saves_memory_{false}, prefers_low_memory_{false};
  std::uint64_t limit_;
  std::shared_ptr<HugePageCache> reserve_;
  std::atomic<std::uint64_t> slack_{0};
};

/// The context of one request. Safe to use from the worker threads of that request.
class Job {
 public:
  using Clock = std::chrono::steady_clock;
  using Progress = std::function<void(std::string_view stage, double share)>;

  struct Options {
    Limits limits = {};
    int threads = 1;            ///< how many threads the work may use; never changes the result
    std::stop_token stop = {};  ///< set when the caller has gone or the service drains
    Clock::time_point deadline = Clock::time_point::max();
    std::shared_ptr<HugePageCache> reserve = {};  ///< memory of earlier requests, for this and later ones
    Progress progress = {};  ///< called for each stage with a share 0..1, from one thread at a time
  };

  Job(std::uint64_t seed, Options options);

  /// Returns the Job of a request inside this one. It has another seed and the same budget, limits, stop
  /// token and deadline. `pointer` leads from the parameters of this request to those of the inner one; the
  /// pointer of every Stop of the child starts with it. The child reports no progress: its stages are part of
  /// a stage of this request.
  Job for_child(std::uint64_t seed, std::string_view pointer = {}) const;

  /// Returns a Job for an estimate inside this request, with the same seed, limits, stop token, deadline and
  /// memory budget. It counts modules, shapes, triangles and bytes from 0, so that an estimate does not use
  /// up the limits of the request. It works on one thread and reports no progress.
  Job for_estimate() const;

  /// Returns a Job like for_estimate(), with smaller limits. Where one is exceeded, the work ends by
  /// abandon_attempt() (core/base/attempt.h) instead of a Stop.
  Job for_small_estimate(const Limits& limits) const;

  /// While the scope exists, issues of IssueKind::limit that have no pointer get `pointer`. This applies to
  /// this job and to its children. Do not create or destroy a scope while other threads use this job.
  class PointerScope {
   public:
    PointerScope(Job& job, std::string_view pointer)
        : job_(job), before_(std::exchange(job.fallback_, job.prefix_ + std::string(pointer))) {}
    ~PointerScope() { job_.fallback_ = std::move(before_); }
    PointerScope(const PointerScope&) = delete;
    PointerScope& operator=(const PointerScope&) = delete;

   private:
    Job& job_;
    std::string before_;
  };

  Rng rng() const { return Rng::of_seed(seed_); }
  std::uint64_t seed() const { return seed_; }
  const Limits& limits() const { return state_->options.limits; }
  int threads() const { return state_->options.threads; }
  const std::shared_ptr<MemoryBudget>& budget() const { return state_->budget; }

  /// Throws Stop when the request is cancelled or the deadline has passed. Reads the clock (about 25 ns):
  /// call it every 4,096 steps, or through Meter.
  void check() const;

  /// Counts `amount` of a resource before it is made. Throws Stop when the limit would be exceeded. Calls
  /// check() too, so spend many units at once; Meter does.
  void spend(Resource resource, std::uint64_t amount);
  std::uint64_t spent(Resource resource) const;

  /// Reports the running stage and the share of it that is done, 0..1. Called from one thread at a time.
  void progress(std::string_view stage, double share) const;

  /// The stages named so far and when each began.
  struct Stage {
    std::string name;
    Clock::time_point begun;
  };
  const std::vector<Stage>& stages() const { return state_->stages; }

  /// Throws Stop for an issue that is found only while the request runs: with Code::limit where its kind is
  /// limit, else with Code::invalid. The issue's pointer is relative to the parameters of this job's request.
  /// In a job of for_small_estimate(), an issue of this kind abandons the attempt instead.
  [[noreturn]] void refuse(Issue issue) const;

 private:
  struct State {
    State(Options given)
        : options(std::move(given)),
          budget(std::make_shared<MemoryBudget>(options.limits.memory_bytes, options.reserve)) {}
    State(Options given, std::shared_ptr<MemoryBudget> shared)
        : options(std::move(given)), budget(std::move(shared)) {}
    Options options;
    std::shared_ptr<MemoryBudget> budget;
    std::atomic<std::uint64_t> spent[4] = {};
    std::vector<Stage> stages;
    bool is_attempt = false;  ///< exceeded limits abandon the work
  };
  Job(std::uint64_t seed, std::shared_ptr<State> state)
      : seed_(seed), is_child_(true), state_(std::move(state)) {}

  std::uint64_t seed_;
  bool is_child_ = false;
  std::string prefix_;    ///< path from the parameters of the outermost request to those of this one
  std::string fallback_;  ///< pointer for issues about limits that have no pointer
  std::shared_ptr<State> state_;
};

/// Counts single units in an inner loop. It takes them from the Job in portions of 4,096 and calls
/// Job::check() with each portion. Each thread needs its own Meter. The rest of the last portion is not
/// returned, so a count may be too high by up to 4,095 for each Meter. Several Meters may therefore report
/// the limit too early, but never too late. A single Meter reports it exactly.
class Meter {
 public:
  Meter(Job& job, Resource resource) : job_(&job), resource_(resource) {}
  void spend(std::uint64_t amount = 1) {
    if (amount <= left_) {
      left_ -= amount;
    } else {
      refill(amount);
    }
  }

 private:
  void refill(std::uint64_t amount);

  Job* job_;
  Resource resource_;
  std::uint64_t left_ = 0;
};

}  // namespace seedmesh
