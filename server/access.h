#pragma once
/// Access control: API keys with limits of their own, signed URLs, allowed generators and presets.
///
/// A service without keys is open. With API keys or signing keys it is closed: a request for a model needs an
/// API key (`Authorization: Bearer ...` or `X-Api-Key: ...`) or, for GET and HEAD, a signed URL.
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/pipeline.h"
#include "server/config.h"
#include "server/http/message.h"
#include "server/problem.h"
#include "server/signature.h"

namespace seedmesh {

/// Limits the requests of one key by a token bucket. The bucket has tokens for the requests of one second, at least one.
class TokenBucket {
 public:
  using Clock = std::chrono::steady_clock;
  /// `rate` in requests a second; 0: no limit.
  explicit TokenBucket(double rate) : rate_(rate), left_(capacity()) {}

  /// Returns 0 where the request may pass, else the seconds until the next request may pass.
  double take(Clock::time_point now);

 private:
  double capacity() const { return rate_ > 1 ? rate_ : 1; }
  const double rate_;
  double left_;
  std::optional<Clock::time_point> last_;
};

/// The credential with which a request was admitted.
struct Grant {
  enum class By { nothing, key, signature };
  By by = By::nothing;
  std::string key;                      ///< name of the API key
  std::optional<std::int64_t> expires;  ///< Unix time at which the signature expires; none: never
  std::size_t target_size = 0;          ///< characters of the undecoded target without the signature
  std::shared_ptr<const void> slot;  ///< one concurrent request of the key, until its last copy is destroyed
};

/// Why a request was not admitted.
struct Denial {
  Problem problem;
  std::string_view reason;  ///< label for the metrics, from a bounded set
};

class Access {
 public:
  explicit Access(const Config& config);
  ~Access();

  /// Whether requests for models need a key or a signature.
  bool closed() const { return !api_keys_.empty() || !signing_keys_.empty(); }

  /// Denies with 401 without a credential, 403 with one that is not valid, 429 beyond a limit of the key.
  std::variant<Grant, Denial> admit(const http::Request& request);

  /// Like admit(), for a file of a world. `segment` is the path segment after the name of the world. It is
  /// the text of a signed query (`expires=...&key=...&signature=...`) for "/v1/worlds/<world>", and gives
  /// access to all files of that world. An empty segment has no signature.
  std::variant<Grant, Denial> admit_world(const http::Request& request, std::string_view world,
                                          std::string_view segment);

  /// Returns the segment that admits the holder of `grant` to all files of a world, followed by "/". It is empty
  /// without signing keys. It expires with the signature of the grant, or else after the lifetime of links.
  std::string world_segment(const Grant& grant, std::string_view world) const;

  /// Denies with 403 if the request, or one nested in it, uses a generator that is not allowed. If only
  /// presets are allowed, it also denies a request that differs from all presets in more than seed and
  /// output.
  std::optional<Denial> forbid(const Request& request) const;

  /// Whether requests may use the generator of this name.
  bool allows_generator(std::string_view name) const;
  bool only_presets() const { return only_presets_; }

  /// Returns the permalink for the holder of `grant`, signed if the service has signing keys. Empty for a request
  /// that was itself signed, because the new signature would outlive the given one.
  std::string signed_for(const Grant& grant, const std::string& permalink) const;

  /// Returns the permalink with a signature that expires with that of `grant`, for redirects of signed permalinks.
  /// Returns it unchanged if the grant is not by signature.
  std::string signed_until(const Grant& grant, const std::string& permalink) const;

 private:
  struct Usage;

  static std::variant<Grant, Denial> admit_signature(SignatureCheck signature, Grant grant, bool may_sign);
  std::variant<Grant, Denial> admit_key(const std::string& key, Grant grant);

  const std::vector<ApiKey> api_keys_;
  const std::vector<SigningKey> signing_keys_;
  const std::vector<std::string> generators_;
  const bool only_presets_;
  const double link_lifetime_;
  std::vector<std::shared_ptr<Usage>> usages_;  ///< one for each of api_keys_
  std::set<std::string>
      presets_;  ///< canonical requests without seed and output, where only presets are allowed
};

}  // namespace seedmesh
