#pragma once
/// Who may ask for what: API keys with limits of their own, signed URLs, generators and presets.
///
/// A service without keys is open. As soon as there are API keys or signing keys it is closed: whoever wants
/// a model shows an API key (`Authorization: Bearer ...` or `X-Api-Key: ...`), or a URL that a signing key
/// has signed (GET and HEAD).
#include <memory>
#include <mutex>
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

namespace seedmesh {

/// Requests of one key a second, as a bucket that holds one second's worth and at least one.
class Bucket {
 public:
  using Clock = std::chrono::steady_clock;
  explicit Bucket(double rate) : rate_(rate), left_(most()) {}

  /// 0 where a request may pass, else the seconds until the next one may.
  double take(Clock::time_point now);

 private:
  double most() const { return rate_ > 1 ? rate_ : 1; }
  const double rate_;
  double left_;
  std::optional<Clock::time_point> last_;
};

/// What a request has been let in with.
struct Grant {
  enum class By { nothing, key, signature };
  By by = By::nothing;
  std::string key;                      ///< name of the API key
  std::optional<std::int64_t> expires;  ///< of the signature
  std::size_t target_size = 0;          ///< characters of the raw target without the signature
  std::shared_ptr<const void> place;    ///< one of the key's requests at once, given back with the last copy
};

/// Why a request was not let in, and the word for the metrics, of a bounded set.
struct Denial {
  Problem problem;
  std::string_view reason;
};

class Access {
 public:
  explicit Access(const Config& config);
  ~Access();

  /// Whether models are for those alone who show a key or a signature.
  bool closed() const { return !api_keys_.empty() || !signing_keys_.empty(); }

  /// 401 where nothing was shown, 403 where it does not hold, 429 over a limit of the key.
  std::variant<Grant, Denial> admit(const http::Request& request);

  /// 403 where the request, or one inside it, is of a generator that is not allowed, or of no preset where
  /// there shall be nothing else. Seed and output are free.
  std::optional<Denial> forbid(const Request& request) const;

  bool allows_generator(std::string_view name) const;
  bool only_presets() const { return only_presets_; }

  /// The permalink as the holder of `grant` may have it: signed where the service has signing keys. Empty for
  /// those who came by a signature, since a new one would outlive theirs.
  std::string signed_for(const Grant& grant, const std::string& permalink) const;

  /// The same link for the same time: for the redirection of a signed permalink.
  std::string signed_until(const Grant& grant, const std::string& permalink) const;

 private:
  struct Use;

  std::variant<Grant, Denial> admit_key(const std::string& shown, Grant grant);

  const std::vector<ApiKey> api_keys_;
  const std::vector<SigningKey> signing_keys_;
  const std::vector<std::string> generators_;
  const bool only_presets_;
  const double link_lifetime_;
  std::vector<std::shared_ptr<Use>> uses_;  ///< beside api_keys_
  std::set<std::string> presets_;  ///< their requests without seed and output, where only they may pass
};

}  // namespace seedmesh
