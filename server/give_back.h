#pragma once
/// Memory that requests have left free in the C library's arenas, given back to the system.
#include <condition_variable>
#include <mutex>
#include <thread>

namespace seedmesh {

/// While this lives, a thread looks every second how much memory the process has, and gives the free part
/// back where that has grown since it last did. What stays is what is used.
class GiveBack {
 public:
  GiveBack();
  ~GiveBack();
  GiveBack(const GiveBack&) = delete;
  GiveBack& operator=(const GiveBack&) = delete;

 private:
  void look();

  std::mutex mutex_;
  std::condition_variable ending_changed_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace seedmesh
