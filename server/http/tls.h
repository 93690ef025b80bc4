#pragma once
/// TLS for a service without a proxy in front of it: a certificate with its key, and the server side of one
/// session over a non-blocking socket. Uses OpenSSL; supports TLS 1.2 and 1.3.
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>

struct ssl_ctx_st;
struct ssl_st;

namespace seedmesh::http {

/// Outcome of one attempt to read or write without blocking. With neither bytes nor an event the connection
/// has ended.
struct Transfer {
  std::size_t bytes = 0;
  short wait_for = 0;  ///< the poll() event after which the attempt is to be repeated
};

/// A certificate and its private key. May be used from many threads.
class TlsIdentity {
 public:
  /// Reads PEM files: the certificate followed by the rest of its chain, and the key. Returns an error message
  /// where a file is not valid.
  static std::variant<std::shared_ptr<const TlsIdentity>, std::string> read(const std::string& certificate,
                                                                            const std::string& key);
  ~TlsIdentity();
  TlsIdentity(const TlsIdentity&) = delete;
  TlsIdentity& operator=(const TlsIdentity&) = delete;

 private:
  friend class TlsSession;
  explicit TlsIdentity(ssl_ctx_st* context) : context_(context) {}
  ssl_ctx_st* const context_;
};

/// One session. Not for use from several threads.
class TlsSession {
 public:
  /// `socket` is a connected non-blocking socket, which the session does not own.
  TlsSession(const TlsIdentity& identity, int socket);
  ~TlsSession();
  TlsSession(const TlsSession&) = delete;
  TlsSession& operator=(const TlsSession&) = delete;

  Transfer handshake();  ///< `bytes` is 1 once the handshake is complete
  Transfer read(std::span<char> to);
  Transfer write(std::string_view from);
  void close();  ///< sends the close notice to the client; does not wait

 private:
  Transfer outcome(int result);

  ssl_st* session_;
  bool failed_ = false;
};

}  // namespace seedmesh::http
