#pragma once
/// Reports clients that close their side while their request is in work. One thread watches all
/// watched sockets every 50 milliseconds, and sleeps while there are none.
#include <condition_variable>
#include <map>
#include <mutex>
#include <stop_token>
#include <thread>

namespace seedmesh::http {

class DisconnectWatch {
 public:
  /// Returns a token that is set when the peer of `socket` closes its side or the connection fails.
  std::stop_token add(int socket);

  /// Has to be called before the socket is closed.
  void remove(int socket);

 private:
  void run(const std::stop_token& end);

  std::mutex mutex_;
  std::condition_variable_any added_;
  std::map<int, std::stop_source> watched_;
  std::jthread thread_{[this](const std::stop_token& end) { run(end); }};  ///< last: it uses the others
};

}  // namespace seedmesh::http
