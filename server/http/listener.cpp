#include "server/http/listener.h"

#include <httplib.h>
#include <sys/eventfd.h>

#include <atomic>
#include <cerrno>
#include <ctime>
#include <random>
#include <type_traits>

#include "core/base/rng.h"
#include "server/http/connection.h"
#include "server/http/threads.h"
#include "server/http/watch.h"

namespace seedmesh::http {
namespace {

/// The request that the library sees instead of the client's: only what decides how it frames the answer.
constexpr std::string_view plain_head = "GET / HTTP/1.1\r\nHost: here\r\n\r\n";
constexpr std::string_view bodiless_head = "HEAD / HTTP/1.1\r\nHost: here\r\n\r\n";

/// Reads the head above, writes to the client.
class Wire : public httplib::Stream {
 public:
  Wire(Connection& connection, std::string_view head) : connection_(connection), head_(head) {}

  using httplib::Stream::write;
  bool is_readable() const override { return !head_.empty(); }
  bool is_writable() const override { return !connection_.broken(); }
  ssize_t read(char* to, size_t size) override {
    const std::size_t count = head_.copy(to, size);
    head_.remove_prefix(count);
    return static_cast<ssize_t>(count);
  }
  ssize_t write(const char* from, size_t size) override {
    return connection_.write({from, size}) ? static_cast<ssize_t>(size) : -1;
  }
  void get_remote_ip_and_port(std::string& ip, int& port) const override { ip.clear(), port = 0; }
  void get_local_ip_and_port(std::string& ip, int& port) const override { ip.clear(), port = 0; }
  socket_t socket() const override {
    return 0;
  }  // the library refuses numbers that select() cannot take; it need not

 private:
  Connection& connection_;
  std::string_view head_;
};

/// Travels in a Request of the library, in a field that only its client uses: the one place where it carries
/// something of ours to the handler.
struct Answer {
  Response* response = nullptr;
  Connection* connection = nullptr;
  bool operator()(std::uint64_t, std::uint64_t) const { return true; }
};

/// "Sun, 06 Nov 1994 08:49:37 GMT"
std::string http_date() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  ::gmtime_r(&now, &utc);
  char text[40];
  return {text, std::strftime(text, sizeof(text), "%a, %d %b %Y %H:%M:%S GMT", &utc)};
}

bool is_sane_id(std::string_view id) {
  const auto sane = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '-' ||
           c == '_' || c == '.';
  };
  return !id.empty() && id.size() <= 128 && std::all_of(id.begin(), id.end(), sane);
}

void write_slice(const Slice& slice, httplib::DataSink& sink) {
  std::uint64_t skip = slice.offset;
  std::uint64_t left = slice.length;
  for (const auto piece : slice.payload->pieces()) {
    if (skip >= piece.size()) {
      skip -= piece.size();
      continue;
    }
    const std::uint64_t count = std::min<std::uint64_t>(piece.size() - skip, left);
    if (count == 0) break;
    if (!sink.write(reinterpret_cast<const char*>(piece.data()) + skip, count)) return;
    left -= count;
    skip = 0;
  }
}

/// Moves an answer into the library's form. Bodies are written in one call of the provider: between calls the
/// library asks whether it is shutting down, and would cut an answer short.
void translate(Answer answer, httplib::Response& to) {
  Response& from = *answer.response;
  to.status = from.status;
  for (auto& [name, value] : from.headers) to.headers.emplace(std::move(name), std::move(value));
  to.headers.emplace("Date", http_date());
  if (auto* slice = std::get_if<Slice>(&from.body); slice && slice->length > 0) {
    to.set_content_provider(slice->length, from.type, [slice](size_t, size_t, httplib::DataSink& sink) {
      write_slice(*slice, sink);
      return true;
    });
  } else if (auto* stream = std::get_if<Stream>(&from.body)) {
    to.set_chunked_content_provider(from.type, [stream, answer](size_t, httplib::DataSink& sink) {
      (*stream)([&](std::string_view piece) {
        return sink.write(piece.data(), piece.size()) && answer.connection->flush();
      });
      sink.done();
      return true;
    });
  } else {
    if (auto* text = std::get_if<std::string>(&from.body)) to.body = std::move(*text);
    if (!from.type.empty()) to.headers.emplace("Content-Type", from.type);
  }
}

}  // namespace

class Listener::Server : public httplib::Server {
 public:
  Server(ListenerOptions options, Callbacks callbacks)
      : options_(std::move(options)),
        callbacks_(std::move(callbacks)),
        threads_(options_.connections),
        drain_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    std::random_device entropy;
    next_id_ = (std::uint64_t{entropy()} << 32U) | entropy();
    set_tcp_nodelay(true);
    // The library's own choice, SO_REUSEPORT, would let a second program take half of our connections without
    // a word.
    set_socket_options([](socket_t socket) {
      const int on = 1;
      ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof(on));
    });
    set_write_timeout(options_.write_time.count());
    set_keep_alive_timeout(options_.idle_time.count());
    set_pre_routing_handler([](const httplib::Request& from, httplib::Response& to) {
      translate(*from.progress.target<Answer>(), to);
      return HandlerResponse::Handled;
    });
    set_post_routing_handler([](const httplib::Request&, httplib::Response& to) {
      to.headers.erase("Keep-Alive");
      if (to.status == 304 || to.status == 204) to.headers.erase("Content-Length");
    });
    new_task_queue = [this] { return new Queue(threads_); };
  }
  ~Server() override { ::close(drain_); }

  int bind() {
    const int port = options_.port != 0 ? (bind_to_port(options_.host, options_.port) ? options_.port : -1)
                                        : bind_to_any_port(options_.host);
    if (port <= 0) return 0;
    // The library asks for a queue of 5, which makes clients of a burst wait for their second try.
    if (::listen(svr_sock_, 1'024) != 0) return 0;
    return port;
  }

  void run() {
    if (!draining_) listen_after_bind();
    threads_.join();
  }

  void drain() {
    draining_ = true;
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(drain_, &one, sizeof(one));
    // Not stop(): the library then cuts the answers that are being written.
    ::shutdown(svr_sock_, SHUT_RDWR);
  }

 private:
  /// Hands connections to the threads, and to the accepting thread itself when all are taken: it answers 503
  /// and goes on.
  class Queue : public httplib::TaskQueue {
   public:
    explicit Queue(Threads& threads) : threads_(threads) {}
    // Nothing with 0.11, whether it was taken with 0.18.
    using Taken = decltype(std::declval<httplib::TaskQueue&>().enqueue(std::function<void()>()));
    Taken enqueue(std::function<void()> task) override {
      if (!threads_.start(task)) {
        full_here() = true;
        task();
        full_here() = false;
      }
      return static_cast<Taken>(true);
    }
    void shutdown() override { threads_.join(); }

   private:
    Threads& threads_;
  };

  /// Whether this thread serves a connection only to turn it away.
  static bool& full_here() {
    thread_local bool full = false;
    return full;
  }

  /// A request's part of a sum, for as long as it is being served.
  struct Share {
    Share(std::atomic<std::uint64_t>& given, std::uint64_t amount)
        : total(given), part(amount), sum(total.fetch_add(amount) + amount) {}
    Share(const Share&) = delete;
    Share& operator=(const Share&) = delete;
    ~Share() { total.fetch_sub(part); }
    std::atomic<std::uint64_t>& total;
    const std::uint64_t part;
    const std::uint64_t sum;
  };

  // The two forms that the protected function has in 0.11 and in 0.18.
  using Setup = std::function<void(httplib::Request&)>;
  template <class Base>
  bool speak(bool (Base::*process)(httplib::Stream&, bool, bool&, const Setup&), Wire& wire, bool close,
             const Setup& setup) {
    bool closed = false;
    return (this->*process)(wire, close, closed, setup);
  }
  template <class Base>
  bool speak(bool (Base::*process)(httplib::Stream&, const std::string&, int, const std::string&, int, bool,
                                   bool&, const Setup&),
             Wire& wire, bool close, const Setup& setup) {
    bool closed = false;
    return (this->*process)(wire, "", 0, "", 0, close, closed, setup);
  }

  bool process_and_close_socket(socket_t socket) override {
    Connection connection(socket, drain_, options_.tls.get());
    if (full_here()) {
      if (!options_.tls) turn_away(connection);  // hands are not shaken on the accepting thread
      return true;
    }
    if (!connection.shake_hands(Connection::Clock::now() + options_.head_time)) return true;
    while (connection.wait_for_request(Connection::Clock::now() + options_.idle_time)) {
      if (!serve_one(connection)) break;
    }
    return true;
  }

  /// One request and its answer; false when the connection shall end.
  bool serve_one(Connection& connection) {
    std::variant<Head, Refusal> read = await_head(connection);
    Head* head = std::get_if<Head>(&read);
    const auto* refusal = std::get_if<Refusal>(&read);
    Request unread;
    Request& request = head ? head->request : unread;
    request.arrived = Connection::Clock::now();
    request.remote = connection.remote();
    const std::string id = request.header("X-Request-Id");
    request.id = is_sane_id(id) ? id : make_id();
    if (refusal && refusal->status == 0) return false;
    if (refusal) return turn_down(connection, request, *refusal);
    const Share body_share(body_bytes_, head->length);
    if (body_share.sum > options_.body_memory) {
      return turn_down(connection, request, {503, "Too many large requests at once.", "bodies"});
    }
    if (!receive_body(connection, *head)) return false;

    bool watched = false;
    request.gone = [&] {
      watched = true;
      return watch_.add(connection.socket());
    };
    Response response = answer(request);
    if (!head->keep_alive || draining_) response.close = true;
    send(connection, request, response);
    if (watched) watch_.remove(connection.socket());
    return !response.close && !connection.broken();
  }

  bool turn_down(Connection& connection, const Request& request, const Refusal& refusal) {
    Response response = callbacks_.refuse(request, refusal);
    response.close = true;
    send(connection, request, response);
    // A body is worth reading to its end, so that the client sees why it was refused; an endless head is not.
    const bool body = refusal.status == 411 || refusal.status == 413 || refusal.status == 415;
    connection.linger(body ? 24U << 20U : 1U << 20U);
    return false;
  }

  /// Status 0: the client left or was too slow, and gets no answer.
  std::variant<Head, Refusal> await_head(Connection& connection) {
    const auto until = Connection::Clock::now() + options_.head_time;
    std::size_t searched = 0;
    while (true) {
      const std::string_view text = connection.buffered();
      const auto end = text.find("\r\n\r\n", searched);
      if (end != std::string_view::npos && end + 4 <= options_.limits.head) {
        auto head = read_head(text.substr(0, end + 4), options_.limits);
        connection.consume(end + 4);
        return head;
      }
      if (Refusal refusal = too_long(text, options_.limits); refusal.status) return refusal;
      searched = text.size() < 3 ? 0 : text.size() - 3;
      if (!connection.fill(until)) return Refusal{0, {}};
    }
  }

  bool receive_body(Connection& connection, Head& head) {
    if (head.length == 0) return true;
    const auto until = Connection::Clock::now() + options_.body_time;
    if (head.expects_continue && connection.buffered().empty()) {
      connection.write("HTTP/1.1 100 Continue\r\n\r\n");
      if (!connection.flush()) return false;
    }
    std::string& body = head.request.body;
    while (true) {
      const std::string_view some = connection.buffered().substr(0, head.length - body.size());
      body.append(some);
      connection.consume(some.size());
      if (body.size() == head.length) return true;
      if (!connection.fill(until)) return false;
    }
  }

  Response answer(const Request& request) {
    try {
      return callbacks_.handle(request);
    } catch (const std::exception& error) {
      return callbacks_.fail(request, error.what());
    } catch (...) {
      return callbacks_.fail(request, "an exception of no known type");
    }
  }

  void send(Connection& connection, const Request& request, Response& response) {
    const std::uint64_t before = connection.sent();
    response.headers.emplace_back("X-Request-Id", request.id);
    Wire wire(connection, request.method == "HEAD" ? bodiless_head : plain_head);
    const auto attach = [&](httplib::Request& seen) { seen.progress = Answer{&response, &connection}; };
    const bool written = speak(&Server::process_request, wire, response.close, attach);
    const bool complete = connection.flush() && written;
    const std::chrono::duration<double> taken = Connection::Clock::now() - request.arrived;
    callbacks_.done({request, response, connection.sent() - before, taken.count(), complete});
  }

  /// Runs on the accepting thread, so it waits for nothing.
  void turn_away(Connection& connection) {
    connection.fill(Connection::Clock::now());
    Request request;
    request.id = make_id();
    request.arrived = Connection::Clock::now();
    Response response = callbacks_.refuse(request, {503, "Too many connections.", "connections"});
    response.close = true;
    send(connection, request, response);
  }

  std::string make_id() {
    static constexpr char digits[] = "0123456789abcdef";
    std::uint64_t bits = mix(next_id_.fetch_add(1, std::memory_order_relaxed));
    std::string id(16, '0');
    for (char& c : id) {
      c = digits[bits & 15U];
      bits >>= 4U;
    }
    return id;
  }

  ListenerOptions options_;
  Callbacks callbacks_;
  Threads threads_;
  Watch watch_;
  int drain_;
  std::atomic<bool> draining_{false};
  std::atomic<std::uint64_t> body_bytes_{0};
  std::atomic<std::uint64_t> next_id_{0};
};

Listener::Listener(ListenerOptions options, Callbacks callbacks)
    : server_(std::make_unique<Server>(std::move(options), std::move(callbacks))) {}
Listener::~Listener() = default;
int Listener::bind() { return server_->bind(); }
void Listener::run() { server_->run(); }
void Listener::drain() { server_->drain(); }

}  // namespace seedmesh::http
