#pragma once
/// One client's socket: reading with absolute deadlines, writing that joins small pieces, and an end that
/// lets the client read the last answer. Owns the socket. One thread.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "server/http/tls.h"

namespace seedmesh::http {

class Connection {
 public:
  using Clock = std::chrono::steady_clock;

  /// `drain` is a file descriptor that becomes readable when idle connections shall end. With an `identity`
  /// the client has to speak TLS.
  Connection(int socket, int drain, const TlsIdentity* identity = nullptr);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  int socket() const { return socket_; }
  std::string remote() const;

  /// Agrees with the client on keys; false when it does not in time. Nothing to do without TLS.
  bool shake_hands(Clock::time_point until);

  /// Waits for the first byte of a request; false when the client leaves, the time is over or the service
  /// drains.
  bool wait_for_request(Clock::time_point until);

  /// Reads more into the buffer; false when the client has closed or the time is over.
  bool fill(Clock::time_point until);
  std::string_view buffered() const { return std::string_view(buffer_).substr(consumed_); }
  void consume(std::size_t bytes);

  /// Queues a small piece, sends a big one at once together with what is queued. False once the client cannot
  /// be written to.
  bool write(std::string_view piece);
  bool flush();
  bool broken() const { return broken_; }
  std::uint64_t sent() const { return sent_; }

  /// Ends our side and reads what the client still sends, for two seconds and `most` bytes: closing a socket
  /// with unread bytes resets it, and the client would lose the answer that tells what was wrong.
  void linger(std::size_t most);

 private:
  bool receive(Clock::time_point until);
  bool send_all(std::string_view first, std::string_view second);
  bool send_encrypted(std::string_view plain);
  bool send_wire(std::string_view first, std::string_view second);
  void say_goodbye();

  int socket_;
  int drain_;
  std::optional<TlsSession> tls_;
  std::string buffer_;
  std::size_t consumed_ = 0;
  std::string queued_;
  std::uint64_t sent_ = 0;
  bool broken_ = false;
};

}  // namespace seedmesh::http
