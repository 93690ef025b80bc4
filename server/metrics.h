#pragma once
/// Metrics for /metrics in the text format of Prometheus.
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "server/cache.h"
#include "server/shared_cache.h"

namespace seedmesh {

class Metrics {
 public:
  Metrics();
  ~Metrics();

  /// Counts a response. `route` is a pattern, so that the number of series is bounded.
  void answered(std::string_view route, int status, double seconds, std::uint64_t bytes);
  /// Counts a request that was refused by admission ("queue_full", "deadline", "draining", "connections",
  /// "bodies", "memory_in_flight") or by a limit of its key ("key_rate", "key_concurrency").
  void rejected(std::string_view reason);
  /// Counts a request that was not admitted: "key_missing", "key_wrong", "signature_wrong", "signature_expired",
  /// "generator", "only_presets".
  void denied(std::string_view reason);
  /// Counts a request that would have exceeded a limit: the name of a Resource (limit_of in problem.h), or "body".
  void limited(std::string_view limit);
  /// Counts a request that was stopped before its end: "client_gone", "deadline", "slow_client".
  void cancelled(std::string_view reason);
  /// Counts a request that was admitted with an API key. The names come from the configuration.
  void used(std::string_view key);
  /// Records the time of a part of a generation: "queue", "derive", "mesh", "encode", "render", "compress".
  void spent(std::string_view span, double seconds);
  /// Counts a generated model.
  void made(const Statistics& statistics);
  /// Counts a picture that was drawn.
  void drawn();

  /// Values at the time of a request for /metrics.
  struct Levels {
    std::int64_t in_flight = 0;
    std::uint64_t memory_in_flight = 0;
    std::uint64_t waiting = 0;
    int workers = 0, busy = 0;
    Cache::Counters cache;
    SharedCache::Counters shared;
  };
  /// Returns the response body for /metrics.
  std::string text(const Levels& levels);

 private:
  struct Series;
  std::unique_ptr<Series> series_;
};

}  // namespace seedmesh
