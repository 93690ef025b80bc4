#pragma once
/// What the operator can ask at /metrics, in Prometheus' text form.
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "server/cache.h"

namespace seedmesh {

class Metrics {
 public:
  Metrics();
  ~Metrics();

  /// A request has been answered. `route` is a pattern, so that the number of series stays bounded.
  void answered(std::string_view route, int status, double seconds, std::uint64_t bytes);
  /// A request has been turned away by admission: "queue_full", "deadline", "draining", "connections",
  /// "bodies".
  void rejected(std::string_view reason);
  /// A part of a generation: "queue", "derive", "mesh", "encode".
  void spent(std::string_view span, double seconds);
  void made(const Statistics& statistics);

  /// Values that are read when somebody asks.
  struct Levels {
    std::int64_t in_flight = 0;
    std::uint64_t waiting = 0;
    int workers = 0, busy = 0;
    Cache::Figures cache;
  };
  std::string text(const Levels& levels);

 private:
  struct Series;
  std::unique_ptr<Series> series_;
};

}  // namespace seedmesh
