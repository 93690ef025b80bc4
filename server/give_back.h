#pragma once
/// Memory that requests have left free in the C library's arenas, given back to the system.
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <thread>

namespace seedmesh {

/// Makes the C library give large blocks back at once, the ends of its arenas from 4 MB on, and keep few
/// arenas: by default it learns to keep up to 64 MB in each of eight arenas a core. To be called before
/// threads are made; MALLOC_ variables that the operator has set hold.
void keep_little_memory(int workers);

/// While this lives, a thread looks every second how much memory the process has, and gives the free part
/// back: where it has grown, and where requests have been answered and none is in flight. What stays is what
/// is used.
class GiveBack {
 public:
  struct Activity {
    std::uint64_t answered = 0;  ///< requests, ever
    std::int64_t in_flight = 0;
  };

  /// `also` gives back what is kept elsewhere.
  GiveBack(std::function<Activity()> activity, std::function<void()> also);
  ~GiveBack();
  GiveBack(const GiveBack&) = delete;
  GiveBack& operator=(const GiveBack&) = delete;

 private:
  void look();

  const std::function<Activity()> activity_;
  const std::function<void()> also_;
  std::mutex mutex_;
  std::condition_variable ending_changed_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace seedmesh
