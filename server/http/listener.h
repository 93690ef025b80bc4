#pragma once
/// The HTTP server: accepts connections, reads requests strictly, hands them to one handler, writes the
/// answers. The only pair of files that knows cpp-httplib, as Debian 12 (0.11) and Debian 13 (0.18) ship it.
///
/// The library listens and writes answers. It never reads a client's bytes: its limits are fixed when it is
/// compiled or do not hold for chunked bodies, it joins no two reads under one deadline, and it matches
/// routes with regular expressions.
#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "server/http/head.h"
#include "server/http/message.h"
#include "server/http/tls.h"

namespace seedmesh::http {

struct ListenerOptions {
  std::string host = "127.0.0.1";
  int port = 8080;  ///< 0 = any that is free
  HeadLimits limits;
  std::shared_ptr<const TlsIdentity> tls;  ///< null: plain HTTP
  std::size_t connections = 512;           ///< at once; one more is answered 503 at once
  std::uint64_t body_memory =
      256U << 20U;  ///< for the bodies of all requests together; one more is answered 503
  std::chrono::seconds head_time{10};
  std::chrono::seconds body_time{30};
  std::chrono::seconds idle_time{75};   ///< how long a connection may wait for its next request
  std::chrono::seconds write_time{30};  ///< how long a client may leave an answer unread
};

/// What happened to one request, told after the answer has been written.
struct Exchange {
  const Request& request;
  const Response& response;
  std::uint64_t sent;  ///< bytes, head included
  double seconds;      ///< from the request's arrival to the last byte handed to the system
  bool complete;       ///< false where the client left before the end
};

struct Callbacks {
  Handler handle;                                                  ///< may throw: answered by `fail`
  std::function<Response(const Request&, const Refusal&)> refuse;  ///< an answer to what is no sound request
  std::function<Response(const Request&, const std::string& what)> fail;
  std::function<void(const Exchange&)> done;
};

class Listener {
 public:
  Listener(ListenerOptions options, Callbacks callbacks);
  ~Listener();

  /// Binds and returns the port, or 0 with `errno` set.
  int bind();

  /// Serves until drain() and until every request has been answered.
  void run();

  /// No more connections; idle ones end at once, others after their present request. Any thread; not a signal
  /// handler.
  void drain();

 private:
  class Server;
  std::unique_ptr<Server> server_;
};

}  // namespace seedmesh::http
