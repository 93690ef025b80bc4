#pragma once
/// The connection to one client. It reads with absolute deadlines, joins small writes and disconnects slow clients.
/// When it closes, the client can still read the last response. Owns the socket. Used by one thread, except for
/// end_if_idle().
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "server/http/tls.h"

namespace seedmesh::http {

/// How fast a client has to read a response. Only time during which the socket accepts no bytes is counted. A client is
/// therefore never too slow for a response that fits into the buffers of the kernel.
struct ReadingPace {
  std::chrono::steady_clock::duration timeout = std::chrono::seconds(30);  ///< time for reading each `step`
  std::uint64_t step = 64 * 1'024;  ///< bytes; fewer bytes do not extend the timeout
  /// Time spent waiting for the client before `rate` is enforced.
  std::chrono::steady_clock::duration grace = std::chrono::seconds(10);
  double rate = 0;  ///< least bytes per second from the first wait on; 0: no limit
};

class Connection {
 public:
  using Clock = std::chrono::steady_clock;

  /// Without TLS, `socket` is blocking and has a receive timeout (SO_RCVTIMEO), the longest time without a
  /// request. With an `identity` the client has to use TLS, and `socket` is non-blocking.
  Connection(int socket, const TlsIdentity* identity, const ReadingPace& pace);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  int socket() const { return socket_; }

  /// Completes the TLS handshake. False on failure or after the deadline; true at once without TLS.
  bool handshake(Clock::time_point deadline);

  /// Waits for the first byte of a request. Returns false if the client leaves, end_if_idle() is called,
  /// `draining` is set, or the receive timeout passes (with TLS: the deadline).
  bool wait_for_request(Clock::time_point deadline, const std::atomic<bool>& draining);

  /// Ends the wait for a request, if this connection is waiting. May be called from any thread.
  void end_if_idle();

  /// Reads more bytes into the buffer. False after the deadline or when the client has closed.
  bool read_more(Clock::time_point deadline);
  std::string_view buffered() const { return std::string_view(buffer_).substr(consumed_); }
  void consume(std::size_t bytes);  ///< removes bytes from the front of the buffer

  /// Queues a small piece; sends a large one at once, after what is queued. False when the client cannot be
  /// written to any more.
  bool write(std::string_view piece);
  /// Sends what is queued. False when the client cannot be written to any more.
  bool flush();
  /// Starts to measure the pace of a response. Has to be called before its first write.
  void begin_response();
  bool broken() const { return broken_; }
  bool slow() const { return slow_; }           ///< the client did not keep the pace; broken() is true, too
  std::uint64_t sent() const { return sent_; }  ///< bytes before encryption

  /// Closes our side, then reads and discards up to `most` bytes for at most two seconds. Closing a socket
  /// with unread bytes resets the connection, and the client would lose the response.
  void linger(std::size_t most);

 private:
  bool wait(short event, Clock::time_point deadline) const;
  bool wait_for_reader(short event);
  Transfer try_read(char* to, std::size_t size);
  void append(const char* bytes, std::size_t size);
  Transfer try_send(std::string_view first, std::string_view second);
  bool send_all(std::string_view first, std::string_view second);
  void close_session();

  const int socket_;
  const ReadingPace pace_;
  std::optional<TlsSession> tls_;
  std::atomic<bool> idle_{false};
  std::string buffer_;  ///< bytes that have been read
  std::size_t consumed_ = 0;
  std::string queue_;  ///< bytes to be sent
  std::uint64_t sent_ = 0;
  bool broken_ = false, slow_ = false;

  // Of the present response: time spent waiting for the client, and bytes sent before.
  Clock::duration waited_{0}, waited_for_step_{0};
  std::uint64_t sent_before_waiting_ = 0, sent_before_step_ = 0;
};

}  // namespace seedmesh::http
