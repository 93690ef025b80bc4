#include "server/access.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>

#include "server/http/text.h"

namespace seedmesh {
namespace {

using Json = nlohmann::json;

/// The API key that a request carries.
std::optional<std::string> given_key(const http::Request& request) {
  const std::string authorization = request.header("Authorization");
  const std::string_view scheme = "Bearer ";
  if (http::equals_ignoring_case(std::string_view(authorization).substr(0, scheme.size()), scheme))
    return std::string(http::trimmed(std::string_view(authorization).substr(scheme.size())));
  if (request.has_header("X-Api-Key")) return request.header("X-Api-Key");
  return std::nullopt;
}

/// A canonical request without seed and output, which may vary in a preset.
std::string preset_part(const std::string& canonical) {
  Json object = Json::parse(canonical);
  object.erase("seed");
  object.erase("output");
  return object.dump();
}

/// The first generator in a request, or in requests nested in it, for which `allowed` is false.
template <class Allowed>
std::optional<std::string> find_forbidden(const Json& value, const Allowed& allowed) {
  if (value.is_object()) {
    const auto generator = value.find("generator");
    if (generator != value.end() && generator->is_string() &&
        !allowed(generator->get_ref<const std::string&>()))
      return generator->get<std::string>();
  }
  if (!value.is_structured()) return std::nullopt;
  for (const Json& inner : value) {
    if (auto forbidden = find_forbidden(inner, allowed)) return forbidden;
  }
  return std::nullopt;
}

std::string world_prefix(std::string_view world) { return "/v1/worlds/" + std::string(world); }

Denial denied(int status, std::string detail, std::string_view reason) {
  return {problem(status, std::move(detail)), reason};
}

Denial over_limit(std::string detail, double seconds, std::string_view reason) {
  Denial denial = denied(429, std::move(detail), reason);
  denial.problem.word = "rate-limited";
  denial.problem.retry_after = std::max(1, static_cast<int>(std::ceil(seconds)));
  return denial;
}

}  // namespace

double TokenBucket::take(Clock::time_point now) {
  if (rate_ <= 0) return 0;
  if (last_)
    left_ = std::min(capacity(), left_ + rate_ * std::chrono::duration<double>(now - *last_).count());
  last_ = now;
  if (left_ < 1) return (1 - left_) / rate_;
  left_ -= 1;
  return 0;
}

/// The present use of one key.
struct Access::Usage {
  Usage(double rate, int limit) : bucket(rate), concurrency(limit) {}
  std::mutex mutex;
  TokenBucket bucket;
  const int concurrency;  ///< most concurrent requests; 0: no limit
  int running = 0;
};

Access::Access(const Config& config)
    : api_keys_(config.api_keys),
      signing_keys_(config.signing_keys),
      generators_(config.generators),
      only_presets_(config.only_presets),
      link_lifetime_(config.link_lifetime) {
  for (const ApiKey& key : api_keys_) {
    usages_.push_back(
        std::make_shared<Usage>(key.rate < 0 ? config.key_rate : key.rate,
                                key.concurrency < 0 ? config.key_concurrency : key.concurrency));
  }
  if (!only_presets_) return;
  for (const PresetInfo& preset : presets()) {
    const auto request = read_preset(preset.name, {}, config.limits);
    if (request && *request) presets_.insert(preset_part((*request)->canonical()));
  }
}

Access::~Access() = default;

std::variant<Grant, Denial> Access::admit(const http::Request& request) {
  Grant grant;
  grant.target_size = request.target.size();
  if (!closed()) return grant;
  SignatureCheck signature;
  signature.target_size = request.target.size();
  const bool reads = request.method == "GET" || request.method == "HEAD";
  if (!signing_keys_.empty() && reads)
    signature = check_signature(request.target, signing_keys_, std::time(nullptr));
  grant.target_size = signature.target_size;
  if (const auto key = given_key(request)) return admit_key(*key, std::move(grant));
  return admit_signature(signature, std::move(grant), !signing_keys_.empty() && reads);
}

std::variant<Grant, Denial> Access::admit_signature(SignatureCheck signature, Grant grant, bool may_sign) {
  switch (signature.state) {
    case SignatureState::good:
      grant.by = Grant::By::signature;
      grant.expires = signature.expires;
      return grant;
    case SignatureState::wrong:
      return denied(403, "The signature of this URL is not valid.", "signature_wrong");
    case SignatureState::expired:
      return denied(403, "The signature of this URL has expired.", "signature_expired");
    case SignatureState::absent:
      break;
  }
  return denied(401, may_sign ? "An API key or a signed URL is required." : "An API key is required.",
                "key_missing");
}

std::variant<Grant, Denial> Access::admit_world(const http::Request& request, std::string_view world,
                                                std::string_view segment) {
  if (!closed() || segment.empty()) return admit(request);
  Grant grant;
  grant.target_size = request.target.size();
  if (const auto key = given_key(request)) return admit_key(*key, std::move(grant));
  const std::string signed_prefix = world_prefix(world) + "?" + std::string(segment);
  return admit_signature(check_signature(signed_prefix, signing_keys_, std::time(nullptr)), std::move(grant),
                         true);
}

std::string Access::world_segment(const Grant& grant, std::string_view world) const {
  if (signing_keys_.empty()) return {};
  const std::string prefix = world_prefix(world);
  std::string target;
  if (grant.by == Grant::By::signature) {
    target = sign_target(prefix, signing_keys_.front(), grant.expires);
  } else {
    target = signed_for(grant, prefix);
  }
  return target.substr(prefix.size() + 1) + "/";
}

std::variant<Grant, Denial> Access::admit_key(const std::string& key, Grant grant) {
  const std::string digest = sha256(key);
  std::size_t found = api_keys_.size();
  for (std::size_t i = 0; i < api_keys_.size(); ++i) {  // all of them, so that the time reveals nothing
    if (same_in_constant_time(api_keys_[i].digest, digest)) found = i;
  }
  if (found == api_keys_.size()) return denied(403, "The API key is not known.", "key_wrong");
  const std::shared_ptr<Usage>& usage = usages_[found];
  const std::lock_guard lock(usage->mutex);
  if (usage->concurrency > 0 && usage->running >= usage->concurrency) {
    return over_limit(
        "This key has reached its limit of " + std::to_string(usage->running) + " concurrent requests.", 1,
        "key_concurrency");
  }
  if (const double wait = usage->bucket.take(TokenBucket::Clock::now()); wait > 0)
    return over_limit("This key has reached its limit of requests per second.", wait, "key_rate");
  ++usage->running;
  grant.by = Grant::By::key;
  grant.key = api_keys_[found].name;
  grant.slot = std::shared_ptr<const void>(nullptr, [usage](const void*) {
    const std::lock_guard release(usage->mutex);
    --usage->running;
  });
  return grant;
}

bool Access::allows_generator(std::string_view name) const {
  return generators_.empty() || std::find(generators_.begin(), generators_.end(), name) != generators_.end();
}

std::optional<Denial> Access::forbid(const Request& request) const {
  if (!generators_.empty()) {
    const auto allowed = [&](const std::string& name) { return allows_generator(name); };
    if (const auto forbidden = find_forbidden(Json::parse(request.canonical()), allowed))
      return denied(403, "The generator " + *forbidden + " is not allowed on this service.", "generator");
  }
  if (only_presets_ && presets_.count(preset_part(request.canonical())) == 0)
    return denied(403, "This service makes only presets, with any seed and output.", "only_presets");
  return std::nullopt;
}

std::string Access::signed_for(const Grant& grant, const std::string& permalink) const {
  if (signing_keys_.empty()) return permalink;
  if (grant.by == Grant::By::signature) return {};
  std::optional<std::int64_t> expires;
  if (link_lifetime_ > 0)
    expires = std::time(nullptr) + static_cast<std::int64_t>(std::llround(link_lifetime_));
  return sign_target(permalink, signing_keys_.front(), expires);
}

std::string Access::signed_until(const Grant& grant, const std::string& permalink) const {
  if (grant.by != Grant::By::signature || signing_keys_.empty()) return permalink;
  return sign_target(permalink, signing_keys_.front(), grant.expires);
}

}  // namespace seedmesh
