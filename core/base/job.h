#pragma once
/// What every generator gets besides its parameters: seed, limits, stop, progress. One argument, from the
/// first line to the last, so that cancellation and limits never have to be threaded in later.
#include <atomic>
#include <chrono>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <stop_token>
#include <string_view>

#include "core/base/result.h"
#include "core/base/rng.h"

namespace seedmesh {

/// The greatest amounts one request may use. Flags and environment of the server change them.
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

/// What is counted while a request runs.
enum class Resource { modules, shapes, triangles, output_bytes };

/// "Stop now": over a limit, over time, or the caller has gone. Thrown by Job (and its Purse) alone, caught
/// in the pipeline alone; no code between the two may swallow it (core/generators/child throws it on with the
/// place that it belongs to).
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

class Reserve;

/// Bytes in use by the arrays of one request. Shared with the arrays, which outlive the Job in the product.
class Purse {
 public:
  explicit Purse(std::uint64_t limit, std::shared_ptr<Reserve> reserve = nullptr)
      : limit_(limit), reserve_(std::move(reserve)) {}
  /// Where big arrays leave their memory for those of later requests; may be null.
  Reserve* reserve() const { return reserve_.get(); }
  void take(std::uint64_t bytes);  ///< throws Stop before the limit is passed
  void give_back(std::uint64_t bytes) { used_.fetch_sub(bytes, std::memory_order_relaxed); }
  std::uint64_t used() const { return used_.load(std::memory_order_relaxed); }
  std::uint64_t peak() const { return peak_.load(std::memory_order_relaxed); }  ///< the most that was used

  /// Bytes that blocks leave empty at the ends of their last pages. Not counted as used.
  std::uint64_t slack() const { return slack_.load(std::memory_order_relaxed); }
  void take_slack(std::uint64_t bytes) { slack_.fetch_add(bytes, std::memory_order_relaxed); }
  void give_back_slack(std::uint64_t bytes) { slack_.fetch_sub(bytes, std::memory_order_relaxed); }

  /// Big arrays take no page more than they need, and once the request has used 8 MiB, memory goes back to
  /// the system with each array, at the cost of touching it anew. For an answer that is much smaller than
  /// what it is made of.
  void be_thrifty() { wants_thrift_.store(true, std::memory_order_relaxed); }
  bool wants_thrift() const { return wants_thrift_.load(std::memory_order_relaxed); }
  bool is_thrifty() const { return is_thrifty_.load(std::memory_order_relaxed); }

 private:
  std::atomic<std::uint64_t> used_{0}, peak_{0};
  std::atomic<bool> is_thrifty_{false}, wants_thrift_{false};
  std::uint64_t limit_;
  std::shared_ptr<Reserve> reserve_;
  std::atomic<std::uint64_t> slack_{0};
};

/// Whose names collision shapes have; none: there are none.
enum class CollisionNames { none, plain, unreal, godot };

/// How what stands many times is to be written; any: as the profile likes it.
enum class CopyForm { any, nodes, gpu, merge };

/// What of the wanted output bears on how a model is made. Whoever is asked for what it cannot make is not
/// called: the pipeline refuses the request.
struct Demand {
  int lods = 1;               ///< levels of detail, 1 to 5
  bool share_organs = false;  ///< organs as nodes that share a mesh, instead of one mesh of all
  bool growth = false;        ///< the animation "growth"
  bool wind = false;          ///< wind weights in TEXCOORD_2 and TEXCOORD_3
  CollisionNames collision = CollisionNames::none;
  int textures = 512;                ///< texels of a side; 0: none
  bool tangents = true;              ///< for forms that hold models themselves
  bool impostor = false;             ///< a picture as the coarsest level of each plant of a scene
  CopyForm copies = CopyForm::any;   ///< of what is repeated in a scene or a building
  std::uint64_t most_triangles = 0;  ///< of whoever keeps a budget by itself; 0: as many as there are
  std::uint32_t most_bones = 240;    ///< of the animation "growth"
  bool packs = false;  ///< no mesh that is done is looked at again: it may be packed (core/gltf/pack.h)
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
    std::shared_ptr<Reserve> reserve = {};  ///< memory of earlier requests, for this and later ones
    Progress progress = {};  ///< told of each stage and share 0..1; called from one thread at a time
  };

  Job(std::uint64_t seed, Options options);

  /// The same purse, limits, stop and deadline with another seed, for a request inside this one. Its stages
  /// are part of a stage of this one: it tells no progress.
  Job for_child(std::uint64_t seed) const;

  Rng rng() const { return Rng::of_seed(seed_); }
  std::uint64_t seed() const { return seed_; }
  const Limits& limits() const { return state_->options.limits; }
  int threads() const { return state_->options.threads; }
  const std::shared_ptr<Purse>& purse() const { return state_->purse; }

  /// Throws Stop when the caller has gone or the deadline has passed. Costs a clock reading (about 25 ns):
  /// call it every 4,096 steps, or through Meter.
  void check() const;

  /// Set by the pipeline before a generator runs. Of this job alone: a request inside another is made
  /// plainly.
  void set_demand(const Demand& demand) { demand_ = demand; }
  const Demand& demand() const { return demand_; }

  /// Counts `amount` of a resource before it is made; throws Stop when the limit would be passed. Looks at
  /// stop and deadline too, so call it in batches (Meter does).
  void spend(Resource resource, std::uint64_t amount);
  std::uint64_t spent(Resource resource) const;

  /// Names the stage that runs and how much of it is done, for the caller's progress bar. From one thread at
  /// a time.
  void progress(std::string_view stage, double share) const;

  /// The stages named so far and when each began.
  struct Stage {
    std::string name;
    Clock::time_point begun;
  };
  const std::vector<Stage>& stages() const { return state_->stages; }

  /// Refuses with a limit of the caller's own wording; for limits that are no Resource (depth, iterations).
  [[noreturn]] static void refuse(std::string message, std::string pointer = "");

  /// Refuses the request itself (Code::invalid) for a fault that shows only while it runs, as a division by
  /// zero.
  [[noreturn]] static void reject(Issue issue);

 private:
  struct State {
    State(Options given)
        : options(std::move(given)),
          purse(std::make_shared<Purse>(options.limits.memory_bytes, options.reserve)) {}
    Options options;
    std::shared_ptr<Purse> purse;
    std::atomic<std::uint64_t> spent[4] = {};
    std::vector<Stage> stages;
  };
  Job(std::uint64_t seed, std::shared_ptr<State> state)
      : seed_(seed), is_child_(true), state_(std::move(state)) {}

  std::uint64_t seed_;
  bool is_child_ = false;
  Demand demand_;
  std::shared_ptr<State> state_;
};

/// Spends one unit at a time for an inner loop: takes leases of 4,096 from the Job and looks at stop and
/// deadline with each lease. One per thread. What is left of the last lease is not given back, so a count may
/// be high by 4,095 a thread; a refusal therefore never comes late, and early by less than that.
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
