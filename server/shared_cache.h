#pragma once
/// Models that replicas share through Redis, so that most models are generated only once. Uses hiredis.
///
/// The shared cache never makes a request fail. It delays a request by at most the time limit of one command.
/// A thread in the background opens connections and writes models. A request continues without the cache if
/// no connection is ready. A model that is found is verified (form, length, hash of all bytes); an invalid
/// one counts as not found.
///
/// Keys are "seedmesh:" + engine version + ":" + SHA-256 of the canonical request. Anyone who can write into the
/// database can replace models, but no client of the service can make two requests with the same key.
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "server/cache.h"
#include "server/config.h"
#include "server/log.h"

struct redisContext;

namespace seedmesh {

class SharedCache {
 public:
  /// Does nothing where `config` has no address.
  SharedCache(const Config& config, const Log& log);
  ~SharedCache();
  SharedCache(const SharedCache&) = delete;
  SharedCache& operator=(const SharedCache&) = delete;

  /// Returns the model of a canonical request, or null. The entry receives `token`.
  Cache::Entry get(const std::string& canonical, const std::string& token);

  /// Queues a model to be written. Drops it if it is too large, the queue is full, or Redis does not respond.
  void put(const std::string& canonical, const Cache::Entry& entry);

  /// Counts since the start. `skips`: reads without a ready connection, and writes dropped by a full queue or a
  /// failing Redis.
  struct Counters {
    std::uint64_t hits = 0, misses = 0, writes = 0, errors = 0, skips = 0, connections = 0;
  };
  Counters counters() const;

 private:
  struct Close {
    void operator()(redisContext* context) const;
  };
  using Connection = std::unique_ptr<redisContext, Close>;
  struct Write {
    std::string key;
    Cache::Entry entry;
  };

  std::string key_of(const std::string& canonical) const;
  Connection take();
  void put_back(Connection connection);
  void count_error(const std::string& what);
  void maintain();
  Connection connect() const;
  bool write(redisContext& connection, const Write& write) const;

  const std::optional<RedisAddress> address_;
  const double timeout_;
  const std::int64_t lifetime_;
  const std::uint64_t largest_;
  const std::size_t pool_size_;  ///< connections for reading
  const Log& log_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Connection> ready_;
  std::size_t open_ = 0;  ///< ready and in use
  std::deque<Write> writes_;
  std::uint64_t queued_bytes_ = 0;
  Counters counters_;
  bool failing_ = false;  ///< the last command or connection failed; limits the log to one report
  bool ending_ = false;
  std::thread thread_;
};

/// The stored form of a model, and its inverse. unpack() returns null for bytes that are not from pack(); `owner`
/// keeps the bytes alive.
std::string pack(const CachedModel& made);
Cache::Entry unpack(std::shared_ptr<const void> owner, std::string_view bytes, const std::string& token);

}  // namespace seedmesh
