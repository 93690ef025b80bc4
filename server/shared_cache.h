#pragma once
/// Models that replicas share through a Redis, so that what one has made no other makes again. The seam of
/// hiredis.
///
/// It is never a reason to fail or to wait: a thread of its own opens connections, looks after them and
/// writes; a request takes a connection that is ready, for one bounded exchange, or goes on without. What is
/// found is checked (form, lengths, a hash of all bytes); what does not hold counts as not found.
///
/// Keys are "seedmesh:" + engine version + ":" + SHA-256 of the canonical request: whoever can write into the
/// database can put models there, but no client of ours can make two requests that share a key.
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
  /// Without an address in `config` it does nothing.
  SharedCache(const Config& config, const Log& log);
  ~SharedCache();
  SharedCache(const SharedCache&) = delete;
  SharedCache& operator=(const SharedCache&) = delete;

  /// The model of a canonical request, or null. `token` becomes that of the entry.
  Cache::Entry get(const std::string& canonical, const std::string& token);

  /// Hands the model to the thread that writes; drops it where too much waits already.
  void put(const std::string& canonical, const Cache::Entry& entry);

  struct Figures {
    std::uint64_t hits = 0, misses = 0, writes = 0, errors = 0, skips = 0, connections = 0;
  };
  Figures figures() const;

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
  void give_back(Connection connection);
  void count_error(const std::string& what);
  void look_after();
  Connection connect() const;
  bool write(redisContext& connection, const Write& write) const;

  const std::optional<RedisAddress> address_;
  const double timeout_;
  const std::int64_t lifetime_;
  const std::uint64_t largest_;
  const std::size_t wanted_;  ///< connections
  const Log& log_;

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Connection> ready_;
  std::size_t open_ = 0;  ///< ready and in use
  std::deque<Write> writes_;
  std::uint64_t waiting_bytes_ = 0;
  Figures figures_;
  bool failing_ = false;  ///< since the last exchange, so that the log tells once
  bool ending_ = false;
  std::thread thread_;
};

/// A model as the bytes that are kept, and back; null where they are not what pack() made.
std::string pack(const Made& made);
Cache::Entry unpack(std::shared_ptr<const void> owner, std::string_view bytes, const std::string& token);

}  // namespace seedmesh
