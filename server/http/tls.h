#pragma once
/// TLS for a service that stands without a proxy: a certificate, and the server's side of one session between
/// the bytes on the wire and those of HTTP. Does no input or output itself, so that deadlines and limits stay
/// those of the connection. With OpenSSL; 1.2 and 1.3 are spoken.
#include <memory>
#include <string>
#include <string_view>
#include <variant>

struct ssl_ctx_st;
struct ssl_st;
struct bio_st;

namespace seedmesh::http {

/// A certificate and its key. May be used from many threads.
class TlsIdentity {
 public:
  /// Reads PEM files: the certificate, followed by the rest of its chain, and the key. Or why not.
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

/// One thread.
class TlsSession {
 public:
  explicit TlsSession(const TlsIdentity& identity);
  ~TlsSession();
  TlsSession(const TlsSession&) = delete;
  TlsSession& operator=(const TlsSession&) = delete;

  /// Reads what came over the wire and appends what it says to `plain`. False when the client has ended the
  /// session or speaks no TLS.
  bool take(std::string_view wire, std::string& plain);

  /// Encrypts; false when the session cannot carry it.
  bool put(std::string_view plain);
  void end();  ///< tells the client that nothing more comes

  bool is_open() const;  ///< hands have been shaken
  /// What is to be sent next, until sent().
  std::string_view pending() const;
  void sent();

 private:
  ssl_st* session_;
  bio_st* in_;   ///< owned by the session
  bio_st* out_;  ///< the same
};

/// Sends `request` over a connected socket as a client that trusts any certificate, and gives back the first
/// `most` bytes of the answer, or fewer. For asking ourselves on this machine.
std::string ask_over_tls(int socket, std::string_view request, std::size_t most);

}  // namespace seedmesh::http
