#pragma once
/// Sees clients leave while their request is being worked on. One thread for all connections.
#include <map>
#include <mutex>
#include <stop_token>
#include <thread>

namespace seedmesh::http {

class Watch {
 public:
  Watch();
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  /// A token that is set when the peer of `socket` closes its side or the connection fails.
  std::stop_token add(int socket);

  /// To be called before the socket is closed or read again.
  void remove(int socket);

 private:
  void look();
  void wake();

  std::mutex mutex_;
  std::map<int, std::stop_source> watched_;
  bool ending_ = false;
  int wake_;  ///< an eventfd
  std::thread thread_;
};

}  // namespace seedmesh::http
