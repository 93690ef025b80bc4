#include "server/http/connection.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace seedmesh::http {
namespace {

constexpr std::size_t largest_queue = 16 * 1'024;
constexpr std::size_t read_size = 16 * 1'024;

int milliseconds_until(Connection::Clock::time_point deadline) {
  using namespace std::chrono;
  const auto left = ceil<milliseconds>(deadline - Connection::Clock::now()).count();
  return static_cast<int>(std::clamp<decltype(left)>(left, 0, 3'600'000));
}

/// The outcome of recv() or sendmsg() on a non-blocking socket.
Transfer outcome(ssize_t result, short event) {
  if (result > 0) return {static_cast<std::size_t>(result), 0};
  const bool again = result < 0 && (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR);
  return {0, again ? event : short{0}};
}

}  // namespace

Connection::Connection(int socket, const TlsIdentity* identity, const ReadingPace& pace)
    : socket_(socket), pace_(pace) {
  if (identity) tls_.emplace(*identity, socket);
}

Connection::~Connection() {
  close_session();
  if (slow_) {  // the kernel would otherwise keep what the client does not read, for minutes
    const struct linger now { 1, 0 };
    ::setsockopt(socket_, SOL_SOCKET, SO_LINGER, &now, sizeof(now));
  }
  ::close(socket_);
}

bool Connection::wait(short event, Clock::time_point deadline) const {
  pollfd fd{socket_, event, 0};
  while (true) {
    const int ready = ::poll(&fd, 1, milliseconds_until(deadline));
    if (ready > 0) return true;
    if (ready == 0 || errno != EINTR) return false;
  }
}

bool Connection::handshake(Clock::time_point deadline) {
  while (tls_) {
    const Transfer attempt = tls_->handshake();
    if (attempt.bytes > 0) break;
    if (attempt.wait_for == 0 || !wait(attempt.wait_for, deadline)) return false;
  }
  return true;
}

bool Connection::wait_for_request(Clock::time_point deadline, const std::atomic<bool>& draining) {
  if (!buffered().empty()) return true;
  idle_ = true;  // before `draining` is read: drain() sets that first and then searches idle connections
  bool arrived = false;
  if (!draining && tls_) {
    arrived = wait(POLLIN, deadline) && read_more(deadline);
  } else if (!draining) {  // one blocking call: most requests arrive while the connection is idle
    char bytes[read_size];
    ssize_t size = 0;
    do size = ::recv(socket_, bytes, sizeof(bytes), 0);
    while (size < 0 && errno == EINTR);
    arrived = size > 0;
    if (arrived) append(bytes, static_cast<std::size_t>(size));
  }
  idle_ = false;
  return arrived;
}

void Connection::end_if_idle() {
  if (idle_) ::shutdown(socket_, SHUT_RD);
}

void Connection::append(const char* bytes, std::size_t size) {
  if (consumed_ == buffer_.size()) {
    buffer_.clear();
    consumed_ = 0;
  }
  buffer_.append(bytes, size);
}

Transfer Connection::try_read(char* to, std::size_t size) {
  if (tls_) return tls_->read({to, size});
  return outcome(::recv(socket_, to, size, MSG_DONTWAIT), POLLIN);
}

bool Connection::read_more(Clock::time_point deadline) {
  while (true) {
    char bytes[read_size];
    const Transfer attempt = try_read(bytes, sizeof(bytes));
    append(bytes, attempt.bytes);
    if (attempt.bytes > 0) return true;
    if (attempt.wait_for == 0 || !wait(attempt.wait_for, deadline)) return false;
  }
}

void Connection::consume(std::size_t bytes) {
  consumed_ += bytes;
  if (consumed_ > 4 * read_size) {  // a long body does not stay in the buffer
    buffer_.erase(0, consumed_);
    consumed_ = 0;
    if (buffer_.capacity() > 8 * read_size) buffer_.shrink_to_fit();
  }
}

bool Connection::write(std::string_view piece) {
  if (broken_) return false;
  if (queue_.size() + piece.size() <= largest_queue) {
    queue_.append(piece);
    return true;
  }
  send_all(queue_, piece);
  queue_.clear();
  return !broken_;
}

bool Connection::flush() {
  send_all(queue_, {});
  queue_.clear();
  return !broken_;
}

Transfer Connection::try_send(std::string_view first, std::string_view second) {
  if (tls_) return tls_->write(first.empty() ? second : first);
  iovec pieces[2] = {{const_cast<char*>(first.data()), first.size()},
                     {const_cast<char*>(second.data()), second.size()}};
  msghdr message{};
  message.msg_iov = pieces;
  message.msg_iovlen = 2;
  return outcome(::sendmsg(socket_, &message, MSG_NOSIGNAL | MSG_DONTWAIT), POLLOUT);
}

void Connection::begin_response() {
  waited_ = waited_for_step_ = {};
  sent_before_step_ = sent_;
}

/// Waits until the client can be written to again. False when it is too slow.
bool Connection::wait_for_reader(short event) {
  if (waited_ == Clock::duration::zero()) sent_before_waiting_ = sent_;  // what the kernel took at once
  if (sent_ >= sent_before_step_ + pace_.step) {
    sent_before_step_ = sent_;
    waited_for_step_ = {};
  }
  auto left = pace_.timeout - waited_for_step_;
  if (pace_.rate > 0) {
    const std::chrono::duration<double> earned(static_cast<double>(sent_ - sent_before_waiting_) /
                                               pace_.rate);
    left = std::min(left, pace_.grace + std::chrono::duration_cast<Clock::duration>(earned) - waited_);
  }
  const auto begun = Clock::now();
  slow_ = left <= Clock::duration::zero() || !wait(event, begun + left);
  const auto spent = std::max(Clock::now() - begun, Clock::duration(1));
  waited_ += spent;
  waited_for_step_ += spent;
  return !slow_;
}

bool Connection::send_all(std::string_view first, std::string_view second) {
  while (!broken_ && !(first.empty() && second.empty())) {
    const Transfer attempt = try_send(first, second);
    if (attempt.bytes == 0) {
      broken_ = attempt.wait_for == 0 || !wait_for_reader(attempt.wait_for);
      continue;
    }
    sent_ += attempt.bytes;
    const std::size_t of_first = std::min(first.size(), attempt.bytes);
    first.remove_prefix(of_first);
    second.remove_prefix(attempt.bytes - of_first);
  }
  return !broken_;
}

void Connection::close_session() {
  if (tls_ && !broken_) tls_->close();
}

void Connection::linger(std::size_t most) {
  close_session();
  if (broken_ || ::shutdown(socket_, SHUT_WR) != 0) return;
  const auto deadline = Clock::now() + std::chrono::seconds(2);
  char discarded[read_size];
  for (std::size_t read = 0; read < most;) {
    const Transfer attempt = outcome(::recv(socket_, discarded, sizeof(discarded), MSG_DONTWAIT), POLLIN);
    if (attempt.bytes == 0 && (attempt.wait_for == 0 || !wait(POLLIN, deadline))) return;
    read += attempt.bytes;
  }
}

}  // namespace seedmesh::http
