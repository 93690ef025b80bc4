#pragma once
/// What the operator can ask at /metrics, in Prometheus' text form.
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

  /// A request has been answered. `route` is a pattern, so that the number of series stays bounded.
  void answered(std::string_view route, int status, double seconds, std::uint64_t bytes);
  /// A request has been turned away by admission: "queue_full", "deadline", "draining", "connections",
  /// "bodies"; or by a limit of its key: "key_rate", "key_concurrency".
  void rejected(std::string_view reason);
  /// A request was not let in: "key_missing", "key_wrong", "signature_wrong", "signature_expired",
  /// "generator", "only_presets".
  void denied(std::string_view reason);
  /// A request would have passed a limit: "modules", "triangles", "memory", ... (limit_of in problem.h).
  void limited(std::string_view limit);
  /// Work was stopped before its end: "client_gone", "deadline".
  void cancelled(std::string_view reason);
  /// A request has been let in with an API key; names come from the configuration.
  void used(std::string_view key);
  /// A part of a generation: "queue", "derive", "mesh", "encode".
  void spent(std::string_view span, double seconds);
  void made(const Statistics& statistics);

  /// Values that are read when somebody asks.
  struct Levels {
    std::int64_t in_flight = 0;
    std::uint64_t waiting = 0;
    int workers = 0, busy = 0;
    Cache::Figures cache;
    SharedCache::Figures shared;
  };
  std::string text(const Levels& levels);

 private:
  struct Series;
  std::unique_ptr<Series> series_;
};

}  // namespace seedmesh
