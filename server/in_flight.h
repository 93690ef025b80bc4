#pragma once
/// The memory of responses that are being sent. A client that reads slowly keeps its response in memory, so
/// many slow clients could use all memory of the process.
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>

#include "core/gltf/payload.h"

namespace seedmesh {

/// Counts payloads that are being sent against one limit of the process. A payload that several clients read at
/// the same time counts once. May be used from many threads; has to outlive what hold() returns.
class InFlight {
 public:
  using Clock = std::chrono::steady_clock;

  /// Smaller payloads are not counted: they fit into the buffers of the kernel.
  static constexpr std::uint64_t smallest = 16 * 1'024;

  explicit InFlight(std::uint64_t capacity) : capacity_(capacity) {}

  /// Waits until less than the limit is in use. False after the deadline. Called before a model is made, so that
  /// a waiting request uses no memory.
  bool wait(Clock::time_point deadline);

  /// Returns the payload, counted with `extra` bytes until the result and its copies are gone. Null if the
  /// limit would be exceeded. A payload larger than the limit is accepted if no other payload is counted.
  /// Several holders of one payload count `extra` each.
  std::shared_ptr<const Payload> hold(std::shared_ptr<const Payload> payload, std::uint64_t extra = 0);

  std::uint64_t bytes() const;

 private:
  void release(const Payload* payload, std::uint64_t extra);

  const std::uint64_t capacity_;
  mutable std::mutex mutex_;
  std::condition_variable released_;
  std::map<const Payload*, std::uint64_t> holders_;
  std::uint64_t bytes_ = 0;
};

}  // namespace seedmesh
