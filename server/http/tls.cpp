#include "server/http/tls.h"

#include <openssl/err.h>
#include <openssl/ssl.h>
#include <poll.h>

#include <algorithm>
#include <climits>
#include <new>

namespace seedmesh::http {
namespace {

/// The text of the first error in OpenSSL's queue. Clears the queue.
std::string last_error() {
  const unsigned long code = ::ERR_get_error();
  ::ERR_clear_error();
  const char* reason = code ? ::ERR_reason_error_string(code) : nullptr;
  return reason ? reason : "unknown error";
}

/// Selects HTTP/1.1 from the protocols that the client offers (ALPN).
int choose_protocol(SSL*, const unsigned char** out, unsigned char* out_size, const unsigned char* in,
                    unsigned int in_size, void*) {
  static constexpr unsigned char ours[] = {8, 'h', 't', 't', 'p', '/', '1', '.', '1'};
  unsigned char* chosen = nullptr;
  const int found = ::SSL_select_next_proto(&chosen, out_size, ours, sizeof(ours), in, in_size);
  *out = chosen;
  return found == OPENSSL_NPN_NEGOTIATED ? SSL_TLSEXT_ERR_OK : SSL_TLSEXT_ERR_NOACK;
}

int int_size(std::size_t size) { return static_cast<int>(std::min<std::size_t>(size, INT_MAX)); }

}  // namespace

std::variant<std::shared_ptr<const TlsIdentity>, std::string> TlsIdentity::read(
    const std::string& certificate, const std::string& key) {
  ::ERR_clear_error();
  ssl_ctx_st* context = ::SSL_CTX_new(::TLS_server_method());
  if (!context) return "TLS cannot be used: " + last_error();
  const std::shared_ptr<const TlsIdentity> identity(new TlsIdentity(context));
  ::SSL_CTX_set_min_proto_version(context, TLS1_2_VERSION);
  // Renegotiation lets a client cause work at will, and compression reveals secrets by their length.
  ::SSL_CTX_set_options(context,
                        SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION | SSL_OP_CIPHER_SERVER_PREFERENCE);
  ::SSL_CTX_set_mode(context, SSL_MODE_RELEASE_BUFFERS | SSL_MODE_ENABLE_PARTIAL_WRITE |
                                  SSL_MODE_ACCEPT_MOVING_WRITE_BUFFER);
  ::SSL_CTX_set_alpn_select_cb(context, choose_protocol, nullptr);
  if (::SSL_CTX_use_certificate_chain_file(context, certificate.c_str()) != 1)
    return certificate + " has no certificate in PEM form: " + last_error();
  if (::SSL_CTX_use_PrivateKey_file(context, key.c_str(), SSL_FILETYPE_PEM) != 1)
    return key + " has no private key in PEM form that fits the certificate: " + last_error();
  return identity;
}

TlsIdentity::~TlsIdentity() { ::SSL_CTX_free(context_); }

TlsSession::TlsSession(const TlsIdentity& identity, int socket) : session_(::SSL_new(identity.context_)) {
  if (!session_ || ::SSL_set_fd(session_, socket) != 1) {
    ::SSL_free(session_);
    throw std::bad_alloc();
  }
  ::SSL_set_accept_state(session_);
}

TlsSession::~TlsSession() { ::SSL_free(session_); }

Transfer TlsSession::outcome(int result) {
  if (result > 0) return {static_cast<std::size_t>(result), 0};
  switch (::SSL_get_error(session_, result)) {
    case SSL_ERROR_WANT_READ:
      return {0, POLLIN};
    case SSL_ERROR_WANT_WRITE:
      return {0, POLLOUT};
    default:
      failed_ = true;
      return {};
  }
}

Transfer TlsSession::handshake() {
  ::ERR_clear_error();
  return outcome(::SSL_do_handshake(session_));
}

Transfer TlsSession::read(std::span<char> to) {
  ::ERR_clear_error();
  return outcome(::SSL_read(session_, to.data(), int_size(to.size())));
}

Transfer TlsSession::write(std::string_view from) {
  ::ERR_clear_error();
  return outcome(::SSL_write(session_, from.data(), int_size(from.size())));
}

void TlsSession::close() {
  ::ERR_clear_error();
  if (!failed_ && ::SSL_is_init_finished(session_)) ::SSL_shutdown(session_);
}

}  // namespace seedmesh::http
