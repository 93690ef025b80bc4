#include "server/give_back.h"

#include <malloc.h>
#include <unistd.h>

#include <chrono>
#include <cstdint>
#include <fstream>

namespace seedmesh {
namespace {

constexpr std::chrono::seconds pause{1};
constexpr std::int64_t worth = 8 << 20;  ///< bytes of growth

std::int64_t resident() {
  std::int64_t whole = 0, pages = 0;
  std::ifstream("/proc/self/statm") >> whole >> pages;
  return pages * ::sysconf(_SC_PAGESIZE);
}

void trim() {
#ifdef __GLIBC__
  ::malloc_trim(0);  // of all arenas, also in their middle
#endif
}

}  // namespace

GiveBack::GiveBack() : thread_([this] { look(); }) {}

GiveBack::~GiveBack() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  ending_changed_.notify_all();
  thread_.join();
}

void GiveBack::look() {
  std::unique_lock lock(mutex_);
  std::int64_t least = resident();
  while (!ending_changed_.wait_for(lock, pause, [this] { return ending_; })) {
    const std::int64_t now = resident();
    if (now < least + worth) {
      if (now < least) least = now;
      continue;
    }
    lock.unlock();
    trim();
    least = resident();
    lock.lock();
  }
}

}  // namespace seedmesh
