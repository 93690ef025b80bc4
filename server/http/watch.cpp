#include "server/http/watch.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cstdint>
#include <vector>

namespace seedmesh::http {

Watch::Watch() : wake_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)), thread_([this] { look(); }) {}

Watch::~Watch() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wake();
  thread_.join();
  ::close(wake_);
}

std::stop_token Watch::add(int socket) {
  std::stop_token token;
  {
    const std::lock_guard lock(mutex_);
    token = watched_.try_emplace(socket).first->second.get_token();
  }
  wake();
  return token;
}

void Watch::remove(int socket) {
  {
    const std::lock_guard lock(mutex_);
    watched_.erase(socket);
  }
  wake();  // lets go of the socket, which a poll keeps open
}

void Watch::wake() {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(wake_, &one, sizeof(one));
}

void Watch::look() {
  std::vector<pollfd> fds;
  std::vector<std::stop_source>
      peers;  // of fds[1...]: the number of a socket may be given to another one meanwhile
  while (true) {
    fds.assign(1, {wake_, POLLIN, 0});
    peers.clear();
    {
      const std::lock_guard lock(mutex_);
      if (ending_) return;
      // A client that has left stays in the table until its request ends, but need not be asked again.
      for (const auto& [socket, gone] : watched_) {
        if (gone.stop_requested()) continue;
        fds.push_back({socket, POLLRDHUP, 0});
        peers.push_back(gone);
      }
    }
    if (::poll(fds.data(), fds.size(), -1) < 0) continue;
    if (fds.front().revents != 0) {
      std::uint64_t count = 0;
      [[maybe_unused]] const auto got = ::read(wake_, &count, sizeof(count));
    }
    for (std::size_t i = 1; i < fds.size(); ++i) {
      if (fds[i].revents != 0) peers[i - 1].request_stop();  // runs callbacks: not under the lock
    }
  }
}

}  // namespace seedmesh::http
