#include "server/signature.h"

#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>
#include <openssl/rand.h>

#include <charconv>
#include <memory>
#include <new>
#include <stdexcept>

#include "core/base/base64url.h"
#include "server/http/text.h"

namespace seedmesh {
namespace {

constexpr std::size_t digest_size = 32;

/// Removes the last query parameter from `text` if it is called `name`, and returns its value.
std::optional<std::string_view> take_last(std::string_view& text, std::string_view name) {
  const auto separator = text.find_last_of("?&");
  if (separator == std::string_view::npos) return std::nullopt;
  const std::string_view last = text.substr(separator + 1);
  if (last.size() <= name.size() || last.substr(0, name.size()) != name || last[name.size()] != '=')
    return std::nullopt;
  text = text.substr(0, separator);
  return last.substr(name.size() + 1);
}

std::optional<std::int64_t> parse_seconds(std::string_view text) {
  const auto value = http::parse_number<std::int64_t>(text);
  return value && *value >= 0 ? value : std::nullopt;
}

}  // namespace

SignatureCheck check_signature(std::string_view target, const std::vector<SigningKey>& keys,
                               std::int64_t now) {
  SignatureCheck check;
  check.target_size = target.size();
  std::string_view rest = target;
  const auto signature = take_last(rest, "signature");
  if (!signature) return check;
  check.state = SignatureState::wrong;
  const std::string_view covered = rest;
  const auto id = take_last(rest, "key");
  const auto given = from_base64url(*signature);
  if (!id || !given || given->size() != digest_size) return check;
  const auto expires = take_last(rest, "expires");
  if (expires && !(check.expires = parse_seconds(*expires))) return check;
  check.target_size = rest.size();
  bool genuine = false;
  for (const SigningKey& key : keys) {
    if (key.id == *id) genuine |= same_in_constant_time(*given, hmac_sha256(key.secret, covered));
  }
  if (!genuine) return check;
  check.state = check.expires && *check.expires <= now ? SignatureState::expired : SignatureState::good;
  return check;
}

std::string sign_target(std::string_view target, const SigningKey& key, std::optional<std::int64_t> expires) {
  std::string text(target);
  const auto add = [&](const std::string& name, const std::string& value) {
    text += (text.find('?') == std::string::npos ? "?" : "&") + name + "=" + value;
  };
  if (expires) add("expires", std::to_string(*expires));
  add("key", key.id);
  add("signature", base64url(hmac_sha256(key.secret, text)));
  return text;
}

std::string sha256(std::string_view bytes) {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned size = 0;
  if (EVP_Digest(bytes.data(), bytes.size(), digest, &size, EVP_sha256(), nullptr) != 1)
    throw std::bad_alloc();
  return {reinterpret_cast<const char*>(digest), size};
}

std::string sha256(const Payload& payload) {
  const std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context(EVP_MD_CTX_new(), &EVP_MD_CTX_free);
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned size = 0;
  bool is_good = context && EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) == 1;
  for (const auto piece : payload.pieces())
    is_good = is_good && EVP_DigestUpdate(context.get(), piece.data(), piece.size()) == 1;
  if (!is_good || EVP_DigestFinal_ex(context.get(), digest, &size) != 1) throw std::bad_alloc();
  return {reinterpret_cast<const char*>(digest), size};
}

std::string hmac_sha256(std::string_view secret, std::string_view bytes) {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned size = 0;
  if (!HMAC(EVP_sha256(), secret.data(), static_cast<int>(secret.size()),
            reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(), digest, &size)) {
    throw std::bad_alloc();
  }
  return {reinterpret_cast<const char*>(digest), size};
}

bool same_in_constant_time(std::string_view a, std::string_view b) {
  return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

std::string secret_bytes(std::size_t count) {
  std::string bytes(count, '\0');
  if (RAND_bytes(reinterpret_cast<unsigned char*>(bytes.data()), static_cast<int>(count)) != 1)
    throw std::runtime_error("the system provides no random bytes");
  return bytes;
}

std::optional<std::string> from_hex(std::string_view text) {
  if (text.size() % 2 != 0) return std::nullopt;
  std::string bytes;
  bytes.reserve(text.size() / 2);
  for (std::size_t i = 0; i < text.size(); i += 2) {
    unsigned value = 0;
    const auto [end, error] = std::from_chars(text.data() + i, text.data() + i + 2, value, 16);
    if (error != std::errc() || end != text.data() + i + 2) return std::nullopt;
    bytes.push_back(static_cast<char>(value));
  }
  return bytes;
}

}  // namespace seedmesh
