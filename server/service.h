#pragma once
/// State that all routes share, and steps that several routes take.
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <semaphore>
#include <string>
#include <unordered_map>

#include "core/base/huge_page_cache.h"
#include "core/pipeline.h"
#include "server/access.h"
#include "server/admission.h"
#include "server/cache.h"
#include "server/config.h"
#include "server/http/message.h"
#include "server/in_flight.h"
#include "server/log.h"
#include "server/metrics.h"
#include "server/negotiate.h"
#include "server/pages.h"
#include "server/problem.h"
#include "server/shared_cache.h"
#include "server/texture_cache.h"
#include "server/worlds.h"

namespace seedmesh {

/// A request with the tag that identifies its result.
struct TaggedRequest {
  Request request;
  std::string tag;
  std::string token = {};  ///< token of its permalink; "" if not computed yet, or too long for a URL
};

/// Computes the tag of a request.
TaggedRequest tagged(Request request);

/// Returns the token of the permalink; "" where it is too long for a URL.
std::string token_of(const Request& request);

/// The requests of permalinks and presets by undecoded target, so that a 304 need not decompress a token.
/// Bounded in bytes; emptied when it is full.
class TargetCache {
 public:
  std::optional<TaggedRequest> find(const std::string& target) const;
  void insert(const std::string& target, const TaggedRequest& wanted);

 private:
  static constexpr std::size_t capacity = 16U << 20U;
  mutable std::mutex mutex_;
  std::unordered_map<std::string, TaggedRequest> by_target_;
  std::size_t bytes_ = 0;
};

/// A text that does not change while the program runs.
struct StaticText {
  std::string text, tag;
  std::string encoded;  ///< body in the requested coding; "" for identity and small texts
};

/// Static texts by path and coding, made at the first request: compressing the OpenAPI document for each
/// client would cost more than to generate many models.
class StaticTexts {
 public:
  std::shared_ptr<const StaticText> get(const std::string& path, Coding coding,
                                        const std::function<std::string()>& make);

 private:
  std::mutex mutex_;
  std::unordered_map<std::string, std::shared_ptr<const StaticText>> by_path_;  ///< keys such as "br /docs"
};

struct Service {
  Service(const Config& given, const Log& given_log)
      : config(given),
        log(given_log),
        admission(given.threads, static_cast<std::size_t>(given.queue)),
        in_flight_memory(given.memory_in_flight),
        compressors(given.threads),
        cache(given.cache_bytes),
        textures(given.texture_bytes),
        worlds(given.world_bytes),
        access(given),
        shared(given, given_log) {}

  const Config config;
  const Log& log;
  Admission admission;
  InFlight in_flight_memory;
  std::counting_semaphore<> compressors;
  Cache cache;
  TextureCache textures;
  Worlds worlds;
  const std::shared_ptr<HugePageCache> huge_pages = std::make_shared<HugePageCache>();
  Access access;
  SharedCache shared;
  Metrics metrics;
  TargetCache targets;
  StaticTexts texts;
  const Pages pages;
  std::atomic<std::int64_t> in_flight{0};
  /// Number of responses that were sent; MemoryTrimmer compares it with its last value.
  std::atomic<std::uint64_t> answered{0};
  std::atomic<bool> draining{false};
};

/// One request, and the data that its route needs.
struct RequestContext {
  Service& service;
  const http::Request& request;
  std::string name;  ///< the segment that matches {...} in the pattern
  Grant grant;       ///< the credential with which it was admitted

  /// Target and query without the signature.
  std::string_view target() const { return std::string_view(request.target).substr(0, grant.target_size); }
  std::string_view query() const;
};

using Clock = std::chrono::steady_clock;
Clock::time_point deadline_of(const RequestContext& call);

/// "https://host:port" as the client wrote it.
std::string origin_of(const RequestContext& call);

/// Returns the options of work without a worker: limits, stop and deadline of the request.
Job::Options options_without_worker(const RequestContext& call);

/// Waits for a worker, then calls `work` with all options except the progress callback. Returns a Problem where no
/// worker became free; errors of the work itself are handled by `work`.
std::optional<Problem> with_worker(const RequestContext& call, const std::stop_token& stop,
                                   const std::function<void(Job::Options)>& work);

/// The same for a file of a world. It waits as tiles do, by level (admission.h), and `work` gets one thread.
std::optional<Problem> with_tile_worker(const RequestContext& call, int level, const std::stop_token& stop,
                                        const std::function<void(Job::Options)>& work);

/// Returns the model of a request, from a cache or generated now.
Cache::Lookup model_of(const RequestContext& call, const TaggedRequest& wanted,
                       const Job::Progress& progress);

/// Returns a picture of the model of a request, from the cache or drawn now.
Cache::Lookup picture_of(const RequestContext& call, const Request& request, const PictureOptions& picture);

/// Waits until the memory of responses in flight is below its limit. False after two seconds or the deadline.
bool wait_for_memory(const RequestContext& call);

/// 503: too many responses are being sent to clients that read slowly.
Problem too_much_in_flight(Service& service);

/// Returns a response with an ETag: 304 where the client has the text already, else the text in the best coding.
http::Response json_response(const RequestContext& call, std::string text,
                             std::string_view type = "application/json",
                             std::string_view cache_control = "no-cache");

/// The same for the static text at `path`. Calls `make` at most once for each coding.
http::Response static_response(const RequestContext& call, const std::string& path, std::string_view type,
                               const std::function<std::string()>& make);

/// 406: the client accepts none of the codings.
Problem not_acceptable();

/// Returns the response for an error. Counts it in the metrics.
http::Response refuse(const RequestContext& call, const Problem& problem);

/// Returns the response for a request that was not admitted. Counts it by its reason.
http::Response deny(const RequestContext& call, const Denial& denial);

/// Returns the response for a request that Access::forbid denies; nothing for an allowed request.
std::optional<http::Response> check_allowed(const RequestContext& call, const Request& request);

}  // namespace seedmesh
