#pragma once
/// The parts that all routes share, and the steps that several of them take.
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <variant>

#include "core/base/reserve.h"
#include "core/pipeline.h"
#include "server/access.h"
#include "server/admission.h"
#include "server/cache.h"
#include "server/config.h"
#include "server/http/message.h"
#include "server/log.h"
#include "server/metrics.h"
#include "server/negotiate.h"
#include "server/pages.h"
#include "server/problem.h"
#include "server/shared_cache.h"
#include "server/texture_cache.h"

namespace seedmesh {

/// A request that has been read, with the tag of its answer.
struct Known {
  Request request;
  std::string tag;
  std::string token = {};  ///< of its permalink; "" where it has not been written yet, or is too long
};

Known known(Request request);

/// The token of the permalink; "" where it is too long for any URL.
std::string token_of(const Request& request);

/// Requests that URLs stand for, by raw target: reading a permalink or a preset gives the same each time, and
/// a 304 need not open a token to find that out. Bounded; cleared as a whole when it is full.
class KnownTargets {
 public:
  std::optional<Known> find(const std::string& target) const;
  void keep(const std::string& target, const Known& known);

 private:
  static constexpr std::size_t most_bytes = 16U << 20U;
  mutable std::mutex mutex_;
  std::unordered_map<std::string, Known> by_target_;
  std::size_t bytes_ = 0;
};

/// A text that never changes while the program runs, with everything that answering with it takes.
struct FixedText {
  std::string text, tag;
  std::string packed;  ///< in the coding that was asked for; "" where that gains nothing
};

/// Fixed texts by path, made when they are first asked for: compressing the OpenAPI document for each client
/// would cost more than many a model.
class FixedTexts {
 public:
  std::shared_ptr<const FixedText> get(const std::string& path, Coding coding,
                                       const std::function<std::string()>& make);

 private:
  std::mutex mutex_;
  std::unordered_map<std::string, std::shared_ptr<const FixedText>> by_path_;  ///< "br /docs"
};

struct Service {
  Service(const Config& given, const Log& given_log)
      : config(given),
        log(given_log),
        admission(given.threads, static_cast<std::size_t>(given.queue)),
        cache(given.cache_bytes),
        textures(given.texture_bytes),
        access(given),
        shared(given, given_log) {}

  const Config config;
  const Log& log;
  Admission admission;
  Cache cache;
  TextureCache textures;
  const std::shared_ptr<Reserve> reserve = std::make_shared<Reserve>();
  Access access;
  SharedCache shared;
  Metrics metrics;
  KnownTargets targets;
  FixedTexts texts;
  const Pages pages;
  std::atomic<std::int64_t> in_flight{0};
  std::atomic<std::uint64_t> answered{0};
  std::atomic<bool> draining{false};
};

/// One request on its way through a route.
struct Call {
  Service& service;
  const http::Request& request;
  std::string name;  ///< what stands in the place of the pattern's {…}
  Grant grant;       ///< what it was let in with

  /// Target and query without the signature that the grant is of.
  std::string_view target() const { return std::string_view(request.target).substr(0, grant.target_size); }
  std::string_view query() const;
};

using Clock = std::chrono::steady_clock;
Clock::time_point deadline_of(const Call& call);

/// Waits for a worker and calls `work` with everything but seed and progress. A Problem where admission
/// refuses; what the work itself refuses is its own business.
std::optional<Problem> with_worker(const Call& call, const std::stop_token& stop,
                                   const std::function<void(Job::Options)>& work);

/// The model of a request, from the cache or made now.
Cache::Answer model_of(const Call& call, const Known& known, const Job::Progress& progress);

/// "glb" -> "glb", "png16" -> "png": the extension that a format has in URLs.
std::string extension_of(std::string_view format);

/// An answer with a validator of its own: 304 where the client has it, gzip where it likes it.
http::Response json_answer(const Call& call, std::string text, std::string_view type = "application/json",
                           std::string_view cache_control = "no-cache");

/// The same for a text that is fixed at `path`; `make` is called at most once.
http::Response fixed_answer(const Call& call, const std::string& path, std::string_view type,
                            const std::function<std::string()>& make);

/// 406: the client takes none of the codings there are.
Problem not_acceptable();

http::Response refuse(const Call& call, const Problem& problem);

/// The same, counted by its reason.
http::Response deny(const Call& call, const Denial& denial);

/// The refusal of a request that is not allowed here (Access::forbid); nothing where it is.
std::optional<http::Response> forbidden(const Call& call, const Request& request);

}  // namespace seedmesh
