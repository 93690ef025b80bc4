#pragma once
/// Signed URLs: the holder of a signing key can allow clients without an API key to request single models for
/// a limited time. Uses OpenSSL's libcrypto.
///
/// A signature covers the whole undecoded target with its query, and is the end of the target:
///   /v1/models/<token>.glb?expires=1798761600&key=2026a&signature=<base64url of HMAC-SHA256>
/// The signed text is everything before "&signature=". `expires` (seconds since 1970) is optional. Several keys
/// are valid at the same time: the first signs and all verify, so that a key can be replaced while its links
/// are still in use.
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/gltf/payload.h"

namespace seedmesh {

struct SigningKey {
  std::string id;
  std::string secret;  ///< bytes
};

enum class SignatureState { absent, good, wrong, expired };

struct SignatureCheck {
  SignatureState state = SignatureState::absent;
  std::size_t target_size = 0;          ///< characters of the target without expires, key and signature
  std::optional<std::int64_t> expires;  ///< Unix time at which a good or expired signature ends; none: never
};

/// Verifies a signature in constant time. `now` is Unix time in seconds. `expired` is reported only for a
/// genuine signature.
SignatureCheck check_signature(std::string_view target, const std::vector<SigningKey>& keys,
                               std::int64_t now);

/// Appends a signature to the target. `expires` is Unix time in seconds; without it, the signature does not
/// expire.
std::string sign_target(std::string_view target, const SigningKey& key, std::optional<std::int64_t> expires);

/// Returns the SHA-256 digest, 32 bytes.
std::string sha256(std::string_view bytes);
std::string sha256(const Payload& payload);
std::string hmac_sha256(std::string_view secret, std::string_view bytes);

/// Compares in a time that depends on the lengths alone.
bool same_in_constant_time(std::string_view a, std::string_view b);

/// Random bytes from the system, for new keys.
std::string secret_bytes(std::size_t count);

/// Decodes hexadecimal digits. Returns nothing if the text is not valid.
std::optional<std::string> from_hex(std::string_view text);

}  // namespace seedmesh
