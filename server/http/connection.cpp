#include "server/http/connection.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace seedmesh::http {
namespace {

constexpr std::size_t small_piece = 16 * 1'024;
constexpr std::size_t read_size = 16 * 1'024;
constexpr std::size_t encrypted_at_once = 64 * 1'024;

int milliseconds_until(Connection::Clock::time_point until) {
  using namespace std::chrono;
  const auto left = ceil<milliseconds>(until - Connection::Clock::now()).count();
  return static_cast<int>(std::clamp<decltype(left)>(left, 0, 3'600'000));
}

}  // namespace

Connection::Connection(int socket, int drain, const TlsIdentity* identity) : socket_(socket), drain_(drain) {
  if (identity) tls_.emplace(*identity);
}

Connection::~Connection() {
  say_goodbye();
  // The watch may still hold the socket in its poll for a moment; a close alone would leave the client
  // waiting until then.
  ::shutdown(socket_, SHUT_WR);
  ::close(socket_);
}

std::string Connection::remote() const {
  sockaddr_storage address{};
  socklen_t size = sizeof(address);
  if (::getpeername(socket_, reinterpret_cast<sockaddr*>(&address), &size) != 0) return {};
  char text[INET6_ADDRSTRLEN] = {};
  if (address.ss_family == AF_INET) {
    ::inet_ntop(AF_INET, &reinterpret_cast<sockaddr_in*>(&address)->sin_addr, text, sizeof(text));
  } else if (address.ss_family == AF_INET6) {
    ::inet_ntop(AF_INET6, &reinterpret_cast<sockaddr_in6*>(&address)->sin6_addr, text, sizeof(text));
  }
  const std::string_view shown = text;
  const std::string_view mapped = "::ffff:";  // an IPv4 client on a socket that serves both families
  return std::string(shown.substr(shown.substr(0, mapped.size()) == mapped ? mapped.size() : 0));
}

bool Connection::wait_for_request(Clock::time_point until) {
  if (!buffered().empty()) return true;
  pollfd fds[2] = {{socket_, POLLIN, 0}, {drain_, POLLIN, 0}};
  while (true) {
    const int ready = ::poll(fds, 2, milliseconds_until(until));
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return false;
    if (fds[0].revents != 0) return fill(until);
    return false;
  }
}

bool Connection::shake_hands(Clock::time_point until) {
  while (tls_ && !tls_->is_open()) {
    if (!receive(until)) return false;
  }
  return true;
}

bool Connection::fill(Clock::time_point until) {
  if (consumed_ == buffer_.size()) {
    buffer_.clear();
    consumed_ = 0;
  }
  const std::size_t before = buffer_.size();
  while (buffer_.size() == before) {
    if (!receive(until)) return buffer_.size() > before;
  }
  return true;
}

/// Reads what is there, or waits for it; with TLS that need not be a byte for us.
bool Connection::receive(Clock::time_point until) {
  while (true) {
    char bytes[read_size];
    const ssize_t got = ::recv(socket_, bytes, sizeof(bytes), MSG_DONTWAIT);
    if (got > 0) {
      const std::string_view wire(bytes, static_cast<std::size_t>(got));
      if (!tls_) {
        buffer_.append(wire);
        return true;
      }
      const bool goes_on = tls_->take(wire, buffer_);
      const bool told = send_wire(tls_->pending(), {});
      tls_->sent();
      return goes_on && told;
    }
    if (got == 0) return false;
    if (errno == EINTR) continue;
    if (errno != EAGAIN && errno != EWOULDBLOCK) return false;
    pollfd fd{socket_, POLLIN, 0};
    const int ready = ::poll(&fd, 1, milliseconds_until(until));
    if (ready == 0 || (ready < 0 && errno != EINTR)) return false;
  }
}

void Connection::consume(std::size_t bytes) {
  consumed_ += bytes;
  if (consumed_ > 4 * read_size) {  // so that a long body does not stay behind what follows it
    buffer_.erase(0, consumed_);
    consumed_ = 0;
    if (buffer_.capacity() > 8 * read_size) buffer_.shrink_to_fit();
  }
}

bool Connection::write(std::string_view piece) {
  if (broken_) return false;
  if (queued_.size() + piece.size() <= small_piece) {
    queued_.append(piece);
    return true;
  }
  const bool sent = send_all(queued_, piece);
  queued_.clear();
  return sent;
}

bool Connection::flush() {
  if (queued_.empty()) return !broken_;
  const bool sent = send_all(queued_, {});
  queued_.clear();
  return sent;
}

bool Connection::send_all(std::string_view first, std::string_view second) {
  if (tls_) return send_encrypted(first) && send_encrypted(second);
  return send_wire(first, second);
}

/// Piece by piece, so that a large answer is not there twice.
bool Connection::send_encrypted(std::string_view plain) {
  while (!broken_ && !plain.empty()) {
    const std::string_view piece = plain.substr(0, encrypted_at_once);
    if (!tls_->put(piece)) {
      broken_ = true;
      break;
    }
    if (send_wire(tls_->pending(), {})) sent_ += piece.size();
    tls_->sent();
    plain.remove_prefix(piece.size());
  }
  return !broken_;
}

bool Connection::send_wire(std::string_view first, std::string_view second) {
  while (!broken_ && !(first.empty() && second.empty())) {
    iovec pieces[2] = {{const_cast<char*>(first.data()), first.size()},
                       {const_cast<char*>(second.data()), second.size()}};
    msghdr message{};
    message.msg_iov = pieces;
    message.msg_iovlen = 2;
    const ssize_t sent = ::sendmsg(socket_, &message, MSG_NOSIGNAL);
    if (sent < 0) {
      if (errno == EINTR) continue;
      broken_ = true;  // gone, or it did not read for as long as SO_SNDTIMEO allows
      break;
    }
    if (!tls_) sent_ += static_cast<std::uint64_t>(sent);
    const std::size_t of_first = std::min(first.size(), static_cast<std::size_t>(sent));
    first.remove_prefix(of_first);
    second.remove_prefix(static_cast<std::size_t>(sent) - of_first);
  }
  return !broken_;
}

/// Ends the session without waiting.
void Connection::say_goodbye() {
  if (!tls_ || broken_) return;
  tls_->end();
  const std::string_view last = tls_->pending();
  if (::send(socket_, last.data(), last.size(), MSG_NOSIGNAL | MSG_DONTWAIT) < 0) broken_ = true;
  tls_->sent();
}

void Connection::linger(std::size_t most) {
  say_goodbye();
  if (broken_ || ::shutdown(socket_, SHUT_WR) != 0) return;
  const auto until = Clock::now() + std::chrono::seconds(2);
  buffer_.clear();
  consumed_ = 0;
  for (std::size_t read = 0; read < most && fill(until); read += read_size) {
    buffer_.clear();
    consumed_ = 0;
  }
}

}  // namespace seedmesh::http
