#include "core/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <new>
#include <thread>
#include <utility>

#include "core/base/chunks.h"

#if !defined(SEEDMESH_STD_THREADS)
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>
#endif

namespace seedmesh {
namespace {

// How long a thread waits for work, and how often it looks at the clock.
constexpr std::chrono::microseconds longest_wait{300};
constexpr int waits_a_look = 64;
// After so many, a tenth of a millisecond, others may have the core.
constexpr int most_waits = 2048;
// So many wait: what takes a millisecond has no use for more.
constexpr int most_waiters = 7;

void wait_a_little() {
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("isb");
#endif
}

/// For what another thread is about to end, which may have no core.
class Wait {
 public:
  void a_little() {
    if (++times_ < most_waits) {
      wait_a_little();
    } else {
      std::this_thread::yield();
    }
  }

 private:
  int times_ = 0;
};

#if defined(SEEDMESH_STD_THREADS)
class Threads {
 public:
  ~Threads() { wait(); }
  template <class Task>
  void start(Task task) {
    ++running_;
    std::thread([this, task = std::move(task)] {
      task();
      --running_;  // the last that it does here
    }).detach();
  }
  void wait() const {
    while (running_ > 0) std::this_thread::yield();
  }
  static int most(int threads) { return threads; }

 private:
  std::atomic<int> running_{0};
};

bool is_for_all(int) { return true; }

void run(int threads, std::size_t chunks, const std::function<void(std::size_t)>& each) {
  Region region(chunks, static_cast<std::size_t>(threads), each);
  Threads others;
  for (int i = 1; i < threads; ++i) others.start([&region, i] { region.work(static_cast<std::size_t>(i)); });
  region.work(0);
  others.wait();
  region.throw_on();
}
#else
class Threads {
 public:
  template <class Task>
  void start(Task task) {
    group_.run(std::move(task));
  }
  void wait() { group_.wait(); }
  static int most(int) { return tbb::this_task_arena::max_concurrency(); }

 private:
  tbb::task_group group_;
};

/// All threads that there are belong to the caller's own arena; to make another takes 4 microseconds.
bool is_for_all(int threads) {
  return static_cast<std::size_t>(threads) >=
         tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
}

void run(int threads, std::size_t chunks, const std::function<void(std::size_t)>& each) {
  const auto share_out = [&] {
    tbb::parallel_for(
        std::size_t{0}, chunks,
        [&](std::size_t i) {
          const InAChunk mark;
          each(i);
        },
        tbb::simple_partitioner());
  };
  if (is_for_all(threads)) return share_out();
  tbb::task_arena arena(threads);
  arena.execute(share_out);
}
#endif

}  // namespace

/// The threads that help one other, who alone calls what is public.
class Crew {
 public:
  explicit Crew(int helpers) : most_(helpers) { muster(1); }
  ~Crew() {
    is_over_ = true;
    threads_.wait();
  }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  void run(std::size_t chunks, const std::function<void(std::size_t)>& each) {
    muster(chunks - 1);
    Region region(chunks, 1 + static_cast<std::size_t>(awake_), each);
    region_.show(&region);
    region.work(0);
    region_.hide([&] { return help_beside(); });
    region.throw_on();
  }

  /// False: it knows of others.
  bool learn_of(Pieces& pieces) {
    if (beside_.is_shown()) return false;
    muster(1);
    beside_.show(&pieces);
    return true;
  }
  void forget_pieces() {
    beside_.hide([] { return false; });
  }

 private:
  /// What threads may work at, and how many do.
  template <class Work>
  class Place {
   public:
    void show(Work* work) { work_ = work; }
    bool is_shown() const { return work_ != nullptr; }

    /// From here on nobody has it. What is done meanwhile is done with `otherwise`, while that returns true.
    template <class Otherwise>
    void hide(const Otherwise& otherwise) {
      work_ = nullptr;
      Wait wait;
      while (inside_ > 0) {
        if (!otherwise()) wait.a_little();
      }
    }

    /// Calls `visit` with what is there; returns what that does.
    template <class Visit>
    bool enter(const Visit& visit) {
      if (!is_shown()) return false;
      ++inside_;  // before the second look: whoever hides it waits for those whom he cannot see
      Work* work = work_;
      const bool done = work && visit(*work);
      --inside_;
      return done;
    }

   private:
    alignas(cache_line) std::atomic<Work*> work_{nullptr};
    alignas(cache_line) std::atomic<int> inside_{0};
  };

  bool help_region(std::size_t number) {
    return region_.enter([number](Region& region) {
      const bool is_left = region.is_left();
      if (is_left) region.work(number);
      return is_left;
    });
  }
  bool help_beside() {
    return beside_.enter([](Pieces& pieces) { return pieces.do_one(); });
  }

  /// Calls those who sleep, where fewer are awake than those who wait, or can be of use.
  void muster(std::size_t useful) noexcept {
    const int wanted =
        std::min(most_, std::max(most_waiters, static_cast<int>(std::min<std::size_t>(useful, 1024))));
    try {
      // Counted once: the first may sleep again before the last is called.
      for (int missing = wanted - awake_; missing > 0; --missing) {
        const int number = ++awake_;
        threads_.start([this, number] { help(static_cast<std::size_t>(number)); });
      }
    } catch (const std::bad_alloc&) {  // then there are fewer
      --awake_;
    }
  }

  void help(std::size_t number) {
    using Clock = std::chrono::steady_clock;
    Clock::time_point end = Clock::now() + longest_wait;
    for (int waits = 1; !is_over_; ++waits) {
      if (help_region(number) || help_beside()) {
        waits = 0;
        end = Clock::time_point::max();
        continue;
      }
      wait_a_little();
      if (waits % waits_a_look != 0) continue;
      const Clock::time_point now = Clock::now();
      if (end == Clock::time_point::max()) end = now + longest_wait;
      if (now > end || awake_ > most_waiters) break;
    }
    --awake_;
  }

  int most_;
  std::atomic<int> awake_{0};
  std::atomic<bool> is_over_{false};
  Place<Region> region_;
  Place<Pieces> beside_;
  Threads threads_;
};

namespace {
/// Of the thread whose helpers are kept awake.
thread_local Crew* own_crew = nullptr;

Crew* crew_for(const Job& job) { return is_for_all(job.threads()) ? own_crew : nullptr; }
}  // namespace

KeepAwake::KeepAwake(const Job& job) {
  if (!has_threads(job) || own_crew || !is_for_all(job.threads())) return;
  crew_ = std::make_unique<Crew>(Threads::most(job.threads()) - 1);
  own_crew = crew_.get();
}

KeepAwake::~KeepAwake() {
  if (crew_) own_crew = nullptr;
}

Beside::Beside(const Job& job, std::function<std::size_t()> prepare, std::function<void(std::size_t)> piece)
    : job_(job), pieces_(std::make_unique<Pieces>(std::move(prepare), std::move(piece))) {
  if (!has_threads(job)) return;
  Crew* crew = crew_for(job);
  if (crew && crew->learn_of(*pieces_)) crew_ = crew;
}

Beside::~Beside() {
  pieces_->stop();
  if (crew_) crew_->forget_pieces();
}

void Beside::finish() {
  Wait wait;
  while (!pieces_->is_prepared()) {
    if (!pieces_->do_one()) wait.a_little();
  }
  parallel_for(job_, std::min<std::size_t>(pieces_->left(), static_cast<std::size_t>(job_.threads())), 1,
               [&](std::size_t, std::size_t, std::size_t) {
                 while (pieces_->do_one()) {
                 }
               });
  if (crew_) crew_->forget_pieces();
  crew_ = nullptr;
  pieces_->throw_on();
}

bool has_threads(const Job& job) { return job.threads() > 1 && !in_a_chunk; }

void parallel_for(const Job& job, std::size_t count, std::size_t chunk,
                  const std::function<void(std::size_t, std::size_t, std::size_t)>& body) {
  const std::size_t chunks = chunk_count(count, chunk);
  const auto each = [&](std::size_t i) { body(i * chunk, std::min(count, (i + 1) * chunk), i); };
  if (!has_threads(job) || chunks <= 1) {
    for (std::size_t i = 0; i < chunks; ++i) each(i);
  } else if (Crew* crew = crew_for(job)) {
    crew->run(chunks, each);
  } else {
    run(job.threads(), chunks, each);
  }
}

}  // namespace seedmesh
