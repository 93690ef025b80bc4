#pragma once
/// Signed URLs: who holds a key of the service can hand out single models, for a time, to those who hold
/// none. The seam of OpenSSL's libcrypto.
///
/// A signature covers the whole raw target, query included, and stands at its end:
///   /v1/models/<token>.glb?expires=1798761600&key=2026a&signature=<base64url of HMAC-SHA256>
/// signs the text before "&signature=". `expires` (seconds since 1970) may be absent. Several keys hold at
/// once: the first signs, all verify, so that a key can be exchanged while links of the old one are still
/// around.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace seedmesh {

struct SigningKey {
  std::string id;
  std::string secret;  ///< bytes
};

enum class SignatureState { absent, good, wrong, expired };

struct SignatureCheck {
  SignatureState state = SignatureState::absent;
  std::size_t target_size = 0;          ///< characters of the target before what the signature added to it
  std::optional<std::int64_t> expires;  ///< of a good or expired one
};

/// Verifies in constant time. An expired signature counts as one only where it is genuine.
SignatureCheck check_signature(std::string_view target, const std::vector<SigningKey>& keys,
                               std::int64_t now);

/// The target with its signature.
std::string sign_target(std::string_view target, const SigningKey& key, std::optional<std::int64_t> expires);

/// 32 bytes.
std::string sha256(std::string_view bytes);
std::string hmac_sha256(std::string_view secret, std::string_view bytes);

/// Takes as long wherever the two differ. Only lengths may be told apart by time.
bool same_in_constant_time(std::string_view a, std::string_view b);

/// Bytes that nobody can guess; for new keys.
std::string secret_bytes(std::size_t count);

std::string hex(std::string_view bytes);
std::optional<std::string> from_hex(std::string_view text);

}  // namespace seedmesh
