#include "server/http/disconnect_watch.h"

#include <poll.h>

#include <chrono>
#include <vector>

namespace seedmesh::http {

std::stop_token DisconnectWatch::add(int socket) {
  const std::lock_guard lock(mutex_);
  added_.notify_one();
  return watched_.try_emplace(socket).first->second.get_token();
}

void DisconnectWatch::remove(int socket) {
  const std::lock_guard lock(mutex_);
  watched_.erase(socket);
}

void DisconnectWatch::run(const std::stop_token& end) {
  std::unique_lock lock(mutex_);
  while (added_.wait(lock, end, [this] { return !watched_.empty(); })) {
    std::vector<std::stop_source> gone;
    for (const auto& [socket, source] : watched_) {
      pollfd fd{socket, POLLRDHUP, 0};
      if (!source.stop_requested() && ::poll(&fd, 1, 0) > 0) gone.push_back(source);
    }
    lock.unlock();
    for (std::stop_source& source : gone) source.request_stop();  // runs callbacks, so not under the lock
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    lock.lock();
  }
}

}  // namespace seedmesh::http
