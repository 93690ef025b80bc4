#pragma once
/// Finished models in memory, bounded in bytes. Equal requests at the same time cost one generation.
/// The key is the canonical request and not its hash. Otherwise a client that finds two requests with the
/// same hash could replace the model of another client.
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <unordered_map>
#include <variant>

#include "core/pipeline.h"
#include "server/lru.h"
#include "server/problem.h"

namespace seedmesh {

/// A finished model, shared and never changed.
struct CachedModel {
  Product product;
  std::shared_ptr<const Payload> payload;  ///< the bytes, moved out of `product`
  std::string token;                       ///< token of the permalink; "" where it is too long for a URL
  bool shared = false;                     ///< it came from the shared cache
};

class Cache {
 public:
  using Entry = std::shared_ptr<const CachedModel>;
  using Outcome = std::variant<Entry, Problem>;
  using Make = std::function<Outcome(const std::stop_token& stop)>;
  using GetDisconnectToken = std::function<std::stop_token()>;

  explicit Cache(std::uint64_t capacity) : models_(capacity) {}

  struct Lookup {
    Outcome outcome;
    bool hit = false;  ///< the model was in memory, or another request was generating it
  };

  /// The entry at `key`, or the result of `make`. The first request calls `make`; equal requests wait for it.
  /// `disconnect_token` is called only where there is something to wait for. The work stops when the clients of all these
  /// requests have left. A Problem goes to all of them and is not kept.
  Lookup get(const std::string& key, const GetDisconnectToken& disconnect_token, const Make& make);

  struct Counters {
    std::uint64_t bytes = 0, entries = 0, hits = 0, misses = 0, joins = 0, evictions = 0;
  };
  Counters counters() const;

  /// Returns the entry at `key`, or null. Not counted as a hit or a miss.
  Entry find(const std::string& key);

  /// Keeps an entry that was made elsewhere, such as an encoded form. Its payload may be null.
  void put(const std::string& key, const Entry& entry);

 private:
  /// One generation in progress.
  struct Flight {
    std::condition_variable_any ended;
    std::optional<Outcome> outcome;
    int waiting = 1;
    std::stop_source stop;
  };

  void keep(const std::string& key, const Entry& entry);
  Outcome run(const std::string& key, const std::shared_ptr<Flight>& flight,
              const GetDisconnectToken& disconnect_token, const Make& make);
  std::optional<Outcome> join(std::unique_lock<std::mutex>& lock, const std::shared_ptr<Flight>& flight,
                              const GetDisconnectToken& disconnect_token);

  mutable std::mutex mutex_;
  LruMap<Entry> models_;
  std::unordered_map<std::string, std::shared_ptr<Flight>> flights_;
  Counters counters_;
};

}  // namespace seedmesh
