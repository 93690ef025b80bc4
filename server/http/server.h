#pragma once
/// An HTTP/1.1 server with one thread for each connection: accepts connections, parses requests, passes them
/// to one handler and writes the responses. A thread that has served a connection accepts the next one, so a
/// new connection costs no new thread and no exchange between threads. Decision 5 explains why no library does this.
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>

#include "server/http/connection.h"
#include "server/http/disconnect_watch.h"
#include "server/http/message.h"
#include "server/http/request_head.h"
#include "server/http/tls.h"

namespace seedmesh::http {

struct ServerOptions {
  std::string host = "127.0.0.1";
  int port = 8080;  ///< 0: any free port
  HeadLimits limits;
  std::shared_ptr<const TlsIdentity> tls;   ///< null: plain HTTP
  std::size_t connections = 512;            ///< open at the same time; a further one receives 503
  std::uint64_t body_memory = 256U << 20U;  ///< bytes of all bodies together; a further body receives 503
  std::chrono::seconds head_time{10};       ///< time for a whole head, or a TLS handshake
  std::chrono::seconds body_time{30};       ///< time for a whole body
  std::chrono::seconds idle_time{75};       ///< time between two requests of one connection
  ReadingPace pace;                         ///< pace of a client that reads a response
};

/// One request with its response, reported after the last byte was written.
struct Exchange {
  const Request& request;
  const Response& response;
  std::uint64_t sent;  ///< bytes, head included
  double seconds;      ///< time from the arrival of the request to the end of the response
  bool complete;       ///< false where the client left before the end, or read too slowly
  bool slow;           ///< the client read too slowly
};

/// Called from many threads.
struct Callbacks {
  Handler handle;                                                  ///< may throw; `fail` responds then
  std::function<Response(const Request&, const Refusal&)> refuse;  ///< responds to an invalid request
  std::function<Response(const Request&, const std::string& what)> fail;
  std::function<void(const Exchange&)> done;
};

class Server {
 public:
  Server(ServerOptions options, Callbacks callbacks);
  ~Server();
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  /// Binds the address and returns the port. Returns 0 and sets `errno` on failure.
  int bind();

  /// Serves until drain() is called and every request has its response.
  void run();

  /// Stops accepting connections. Idle connections close at once, others after their present response. May be
  /// called from any thread, but not from a signal handler.
  void drain();

 private:
  bool add_thread();
  void work();
  int accept_next(std::string& remote) const;
  void serve(int socket, const std::string& remote);
  bool serve_one(Connection& connection, const std::string& remote);
  bool refuse(Connection& connection, const Request& request, const Refusal& refusal);
  void refuse_connection(int socket, std::string remote);
  std::variant<RequestHead, Refusal> read_head(Connection& connection, Request& refused) const;
  bool read_body(Connection& connection, const RequestHead& head, std::string& body) const;
  Response answer(const Request& request) const;
  void send(Connection& connection, const Request& request, const Response& response) const;

  const ServerOptions options_;
  const Callbacks callbacks_;
  DisconnectWatch watch_;
  int listening_ = -1;
  std::atomic<bool> draining_{false};
  std::atomic<std::uint64_t> body_bytes_{0};
  std::mutex mutex_;
  std::condition_variable ended_;  ///< the last thread has ended
  std::size_t threads_ = 0;        ///< all of them
  std::size_t accepting_ = 0;      ///< threads that wait for a connection
  std::size_t open_ = 0;           ///< connections that are served
  std::list<Connection*> connections_;
};

}  // namespace seedmesh::http
