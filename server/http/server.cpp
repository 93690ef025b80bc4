#include "server/http/server.h"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <thread>

#include "server/http/response_writer.h"
#include "server/http/text.h"

namespace seedmesh::http {
namespace {

using Clock = Connection::Clock;

constexpr int accept_queue = 1'024;
/// Threads beyond this number end when they have nothing to do.
constexpr std::size_t most_accepting = 32;
/// Bytes that are read after a refusal, so that the client receives the reason: a body is read to its end, a
/// head without end is not.
constexpr std::size_t most_body_discarded = 24U << 20U, most_head_discarded = 1U << 20U;

bool is_valid_id(std::string_view id) {
  const auto valid = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' ||
           c == '_' || c == '.';
  };
  return !id.empty() && id.size() <= 128 && std::all_of(id.begin(), id.end(), valid);
}

/// Host (NI_NUMERICHOST) or port (NI_NUMERICSERV) of an address as text.
std::string text_of(const sockaddr_storage& address, socklen_t size, int which) {
  char text[NI_MAXHOST] = {};
  const bool host = which == NI_NUMERICHOST;
  constexpr socklen_t capacity = sizeof(text);
  ::getnameinfo(reinterpret_cast<const sockaddr*>(&address), size, host ? text : nullptr, host ? capacity : 0,
                host ? nullptr : text, host ? 0 : capacity, which);
  const std::string_view shown = text, mapped = "::ffff:";  // an IPv4 client of a socket for both families
  return std::string(shown.substr(shown.starts_with(mapped) ? mapped.size() : 0));
}

/// A listening socket, or -1. Accepted sockets inherit its options.
int listen_at(const addrinfo& address, std::chrono::seconds receive_timeout) {
  const int socket = ::socket(address.ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (socket < 0) return -1;
  const int on = 1, off = 0;
  // Not SO_REUSEPORT: a second program could then take half of the connections without notice.
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
  ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  const timeval timeout{receive_timeout.count(), 0};
  ::setsockopt(socket, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof(timeout));
  if (address.ai_family == AF_INET6) ::setsockopt(socket, IPPROTO_IPV6, IPV6_V6ONLY, &off, sizeof(off));
  if (::bind(socket, address.ai_addr, address.ai_addrlen) == 0 && ::listen(socket, accept_queue) == 0)
    return socket;
  const int reason = errno;
  ::close(socket);
  errno = reason;
  return -1;
}

/// Subtracts at the end of its life what was added to a sum before.
struct Release {
  std::atomic<std::uint64_t>& total;
  const std::uint64_t part;
  ~Release() { total -= part; }
};

/// Ends the watch of a socket, if one was started.
struct EndWatch {
  DisconnectWatch& watch;
  const int socket;
  bool started = false;
  ~EndWatch() {
    if (started) watch.remove(socket);
  }
};

}  // namespace

Server::Server(ServerOptions options, Callbacks callbacks)
    : options_(std::move(options)), callbacks_(std::move(callbacks)) {}

Server::~Server() {
  if (listening_ >= 0) ::close(listening_);
}

int Server::bind() {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = AI_PASSIVE;
  addrinfo* found = nullptr;
  if (::getaddrinfo(options_.host.c_str(), std::to_string(options_.port).c_str(), &hints, &found) != 0) {
    errno = EADDRNOTAVAIL;
    return 0;
  }
  for (const addrinfo* address = found; address && listening_ < 0; address = address->ai_next)
    listening_ = listen_at(*address, options_.idle_time);
  const int reason = errno;
  ::freeaddrinfo(found);
  errno = reason;
  sockaddr_storage bound{};
  socklen_t size = sizeof(bound);
  if (listening_ < 0 || ::getsockname(listening_, reinterpret_cast<sockaddr*>(&bound), &size) != 0) return 0;
  return parse_number<int>(text_of(bound, size, NI_NUMERICSERV)).value_or(0);
}

void Server::run() {
  std::unique_lock lock(mutex_);
  if (!draining_ && !add_thread()) throw std::bad_alloc();
  ended_.wait(lock, [this] { return threads_ == 0; });
}

void Server::drain() {
  draining_ = true;
  ::shutdown(listening_, SHUT_RDWR);  // ends accept4()
  const std::lock_guard lock(mutex_);
  for (Connection* connection : connections_) connection->end_if_idle();
}

/// Needs the lock. False where no further thread is possible.
bool Server::add_thread() {
  try {
    std::thread([this] { work(); }).detach();
  } catch (const std::exception&) {
    return false;
  }
  ++threads_;
  ++accepting_;
  return true;
}

/// The body of every thread: accepts connections and serves them. At least one thread waits for a connection at
/// any time, so a further one gets 503 without a delay.
void Server::work() {
  std::unique_lock lock(mutex_);
  while (!draining_ && accepting_ <= most_accepting) {
    lock.unlock();
    std::string remote;
    const int socket = accept_next(remote);
    lock.lock();
    if (socket < 0) continue;
    --accepting_;
    const bool served = open_ < options_.connections && (accepting_ > 0 || add_thread());
    open_ += served ? 1 : 0;
    lock.unlock();
    try {
      served ? serve(socket, remote) : refuse_connection(socket, remote);
    } catch (const std::exception&) {
      // No memory for this connection: it ends.
    }
    lock.lock();
    open_ -= served ? 1 : 0;
    ++accepting_;
  }
  --accepting_;
  if (--threads_ == 0) std::notify_all_at_thread_exit(ended_, std::move(lock));
}

/// The socket of the next connection and the address of its client; -1 where the caller has to try again.
int Server::accept_next(std::string& remote) const {
  sockaddr_storage address{};
  socklen_t size = sizeof(address);
  const int flags = SOCK_CLOEXEC | (options_.tls ? SOCK_NONBLOCK : 0);
  const int socket = ::accept4(listening_, reinterpret_cast<sockaddr*>(&address), &size, flags);
  if (socket >= 0) {
    remote = text_of(address, size, NI_NUMERICHOST);
  } else if (errno == EMFILE || errno == ENFILE || errno == ENOBUFS || errno == ENOMEM) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));  // until another connection ends
  }
  return socket;
}

void Server::serve(int socket, const std::string& remote) {
  Connection connection(socket, options_.tls.get(), options_.pace);
  std::unique_lock lock(mutex_);
  const auto listed = connections_.insert(connections_.end(), &connection);
  lock.unlock();
  const struct Delist {  // before the connection is destroyed
    Server& server;
    const std::list<Connection*>::iterator listed;
    ~Delist() {
      const std::lock_guard held(server.mutex_);
      server.connections_.erase(listed);
    }
  } delist{*this, listed};
  if (!connection.handshake(Clock::now() + options_.head_time)) return;
  while (connection.wait_for_request(Clock::now() + options_.idle_time, draining_)) {
    if (!serve_one(connection, remote)) return;
  }
}

/// Serves one request. False when the connection has to end.
bool Server::serve_one(Connection& connection, const std::string& remote) {
  Request refused;
  std::variant<RequestHead, Refusal> head = read_head(connection, refused);
  Request& request = head.index() == 0 ? std::get<RequestHead>(head).request : refused;
  request.arrived = Clock::now();
  request.remote = remote;
  request.id = request.header("X-Request-Id");
  if (!is_valid_id(request.id)) request.id = random_id();
  if (const auto* refusal = std::get_if<Refusal>(&head)) return refuse(connection, request, *refusal);

  const RequestHead& given = std::get<RequestHead>(head);
  const std::uint64_t all_bodies = body_bytes_ += given.length;
  const Release release{body_bytes_, given.length};
  if (all_bodies > options_.body_memory)
    return refuse(connection, request, {503, "Too many large requests are being received.", "bodies"});
  if (!read_body(connection, given, request.body)) return false;

  EndWatch watched{watch_, connection.socket()};
  request.disconnect_token = [&] {
    watched.started = true;
    return watch_.add(connection.socket());
  };
  Response response = answer(request);
  if (!given.keep_alive || draining_) response.close = true;
  send(connection, request, response);
  return !response.close && !connection.broken();
}

/// Refuses a request with a response, except with status 0: the client left or was too slow.
bool Server::refuse(Connection& connection, const Request& request, const Refusal& refusal) {
  if (refusal.status == 0) return false;
  Response response = callbacks_.refuse(request, refusal);
  response.close = true;
  send(connection, request, response);
  const bool body = refusal.status == 411 || refusal.status == 413 || refusal.status == 415;
  connection.linger(body ? most_body_discarded : most_head_discarded);
  return false;
}

/// Sets `refused` to what is legible of a head that it refuses.
std::variant<RequestHead, Refusal> Server::read_head(Connection& connection, Request& refused) const {
  const auto deadline = Clock::now() + options_.head_time;
  std::size_t searched = 0;
  bool is_first_line = true;
  while (true) {
    std::string_view text = connection.buffered();
    if (is_first_line && text.size() >= 2) {
      is_first_line = false;
      // Some clients send an empty line after a body (RFC 9112 section 2.2).
      if (text.starts_with("\r\n")) connection.consume(2);
      text = connection.buffered();
    }
    const auto end = text.find("\r\n\r\n", searched);
    if (end != std::string_view::npos && end + 4 <= options_.limits.head) {
      auto head = parse_head(text.substr(0, end + 4), options_.limits);
      if (head.index() == 1) refused = legible_part(text.substr(0, end + 4), options_.limits);
      connection.consume(end + 4);
      return head;
    }
    if (const auto refusal = check_partial_head(text, options_.limits)) {
      while (connection.buffered().size() < options_.limits.head && connection.read_more(Clock::now())) {
      }  // the fields after a long target may have arrived
      refused = legible_part(connection.buffered(), options_.limits);
      return *refusal;
    }
    searched = text.size() < 3 ? 0 : text.size() - 3;
    if (!connection.read_more(deadline)) return Refusal{0, {}};
  }
}

/// False where the client left or was too slow.
bool Server::read_body(Connection& connection, const RequestHead& head, std::string& body) const {
  const auto deadline = Clock::now() + options_.body_time;
  if (head.expects_continue && head.length > 0 && connection.buffered().empty()) {
    connection.write("HTTP/1.1 100 Continue\r\n\r\n");
    if (!connection.flush()) return false;
  }
  while (true) {
    const std::string_view part = connection.buffered().substr(0, head.length - body.size());
    body.append(part);
    connection.consume(part.size());
    if (body.size() == head.length) return true;
    if (!connection.read_more(deadline)) return false;
  }
}

Response Server::answer(const Request& request) const {
  try {
    return callbacks_.handle(request);
  } catch (const std::exception& error) {
    return callbacks_.fail(request, error.what());
  } catch (...) {
    return callbacks_.fail(request, "an exception of unknown type");
  }
}

void Server::send(Connection& connection, const Request& request, const Response& response) const {
  const std::uint64_t before = connection.sent();
  const bool complete = write_response(connection, request, response);
  const std::chrono::duration<double> taken = Clock::now() - request.arrived;
  callbacks_.done(
      {request, response, connection.sent() - before, taken.count(), complete, connection.slow()});
}

/// Answers 503 to a connection beyond the limit. Runs on the accepting thread, so it does not wait; with TLS
/// there is no response, because a handshake would have to wait.
void Server::refuse_connection(int socket, std::string remote) {
  Connection connection(socket, nullptr, {.timeout = Clock::duration::zero()});
  if (options_.tls) return;
  connection.read_more(Clock::now());  // closing with unread bytes would reset the connection
  Request request = legible_part(connection.buffered(), options_.limits);
  request.id = random_id();
  request.remote = std::move(remote);
  request.arrived = Clock::now();
  Response response = callbacks_.refuse(request, {503, "There are too many connections.", "connections"});
  response.close = true;
  send(connection, request, response);
}

}  // namespace seedmesh::http
