#include "server/http/tls.h"

#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/ssl.h>

#include <algorithm>
#include <new>

namespace seedmesh::http {
namespace {

/// The first error that the library remembers; forgets all.
std::string last_error() {
  const unsigned long code = ::ERR_get_error();
  ::ERR_clear_error();
  const char* reason = code ? ::ERR_reason_error_string(code) : nullptr;
  return reason ? reason : "an error that has no name";
}

/// Of the protocols that the client names, the one that we speak.
int choose_protocol(SSL*, const unsigned char** out, unsigned char* out_size, const unsigned char* in,
                    unsigned int in_size, void*) {
  static constexpr unsigned char ours[] = {8, 'h', 't', 't', 'p', '/', '1', '.', '1'};
  unsigned char* chosen = nullptr;
  const int found = ::SSL_select_next_proto(&chosen, out_size, ours, sizeof(ours), in, in_size);
  *out = chosen;
  return found == OPENSSL_NPN_NEGOTIATED ? SSL_TLSEXT_ERR_OK : SSL_TLSEXT_ERR_NOACK;
}

}  // namespace

std::variant<std::shared_ptr<const TlsIdentity>, std::string> TlsIdentity::read(
    const std::string& certificate, const std::string& key) {
  ::ERR_clear_error();
  ssl_ctx_st* context = ::SSL_CTX_new(::TLS_server_method());
  if (!context) return "TLS cannot be used: " + last_error();
  const std::shared_ptr<const TlsIdentity> identity(new TlsIdentity(context));
  ::SSL_CTX_set_min_proto_version(context, TLS1_2_VERSION);
  // No renegotiation, which lets a client make us work, and no compression, which tells secrets by their
  // length.
  ::SSL_CTX_set_options(context,
                        SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_COMPRESSION | SSL_OP_CIPHER_SERVER_PREFERENCE);
  ::SSL_CTX_set_mode(context, SSL_MODE_RELEASE_BUFFERS);
  ::SSL_CTX_set_alpn_select_cb(context, choose_protocol, nullptr);
  if (::SSL_CTX_use_certificate_chain_file(context, certificate.c_str()) != 1) {
    return certificate + " holds no certificate in PEM: " + last_error();
  }
  if (::SSL_CTX_use_PrivateKey_file(context, key.c_str(), SSL_FILETYPE_PEM) != 1) {
    return key + " holds no key in PEM that fits the certificate: " + last_error();
  }
  return identity;
}

TlsIdentity::~TlsIdentity() { ::SSL_CTX_free(context_); }

TlsSession::TlsSession(const TlsIdentity& identity)
    : session_(::SSL_new(identity.context_)), in_(::BIO_new(::BIO_s_mem())), out_(::BIO_new(::BIO_s_mem())) {
  if (!session_ || !in_ || !out_) {
    ::SSL_free(session_);
    ::BIO_free(in_);
    ::BIO_free(out_);
    throw std::bad_alloc();
  }
  ::SSL_set_bio(session_, in_, out_);
  ::SSL_set_accept_state(session_);
}

TlsSession::~TlsSession() { ::SSL_free(session_); }

bool TlsSession::take(std::string_view wire, std::string& plain) {
  ::ERR_clear_error();
  if (::BIO_write(in_, wire.data(), static_cast<int>(wire.size())) != static_cast<int>(wire.size()))
    return false;
  while (true) {
    char bytes[16 * 1'024];
    const int got = ::SSL_read(session_, bytes, sizeof(bytes));
    if (got <= 0) return ::SSL_get_error(session_, got) == SSL_ERROR_WANT_READ;
    plain.append(bytes, static_cast<std::size_t>(got));
  }
}

bool TlsSession::put(std::string_view plain) {
  ::ERR_clear_error();
  return ::SSL_write(session_, plain.data(), static_cast<int>(plain.size())) ==
         static_cast<int>(plain.size());
}

void TlsSession::end() {
  ::ERR_clear_error();
  if (is_open()) ::SSL_shutdown(session_);
}

bool TlsSession::is_open() const { return ::SSL_is_init_finished(session_) != 0; }

std::string_view TlsSession::pending() const {
  char* bytes = nullptr;
  const long size = ::BIO_get_mem_data(out_, &bytes);
  return size > 0 ? std::string_view(bytes, static_cast<std::size_t>(size)) : std::string_view();
}

void TlsSession::sent() { [[maybe_unused]] const auto done = BIO_reset(out_); }

std::string ask_over_tls(int socket, std::string_view request, std::size_t most) {
  std::string answer;
  SSL_CTX* context = ::SSL_CTX_new(::TLS_client_method());
  SSL* session = context ? ::SSL_new(context) : nullptr;
  if (session && ::SSL_set_fd(session, socket) == 1 && ::SSL_connect(session) == 1 &&
      ::SSL_write(session, request.data(), static_cast<int>(request.size())) > 0) {
    while (answer.size() < most) {
      char bytes[256];
      const int got =
          ::SSL_read(session, bytes, static_cast<int>(std::min(sizeof(bytes), most - answer.size())));
      if (got <= 0) break;
      answer.append(bytes, static_cast<std::size_t>(got));
    }
  }
  ::SSL_free(session);
  ::SSL_CTX_free(context);
  return answer;
}

}  // namespace seedmesh::http
