#pragma once
/// Answers kept in memory: bounded in bytes, least recently used go first; and single flight, so that many
/// equal requests at once cost one. Keyed by the canonical request itself and not by its hash: whoever found
/// two requests with one hash could otherwise put a model of theirs in the place of another.
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <stop_token>
#include <string>
#include <unordered_map>
#include <variant>

#include "core/pipeline.h"
#include "server/problem.h"

namespace seedmesh {

/// A finished model, shared and never changed.
struct Made {
  Product product;
  std::shared_ptr<const Payload> payload;  ///< the product's bytes, taken out of it
  std::string token;                       ///< of the permalink; "" where it is too long for any URL
  bool shared = false;                     ///< another replica made it: it came from the shared cache
};

class Cache {
 public:
  using Entry = std::shared_ptr<const Made>;
  using Outcome = std::variant<Entry, Problem>;
  using Make = std::function<Outcome(const std::stop_token& stop)>;
  using Gone = std::function<std::stop_token()>;

  explicit Cache(std::uint64_t most_bytes) : most_bytes_(most_bytes) {}

  struct Answer {
    Outcome outcome;
    bool hit = false;  ///< it was there, or another request was about to make it
  };

  /// The entry at `key`, or what `make` yields. The first to ask makes; others wait for it. `gone` is asked
  /// for only where there is something to wait for. The work is stopped when all who wait for it have gone. A
  /// Problem is given to all of them and not kept.
  Answer get(const std::string& key, const Gone& gone, const Make& make);

  /// The entry at `key` if it is there.
  Entry find(const std::string& key);

  struct Figures {
    std::uint64_t bytes = 0, entries = 0, hits = 0, misses = 0, joins = 0, evictions = 0;
  };
  Figures figures() const;

 private:
  struct Flight {
    std::condition_variable_any landed;
    std::optional<Outcome> outcome;
    int waiting = 1;
    std::stop_source stop;
  };
  struct Kept {
    std::string key;
    Entry entry;
    std::uint64_t bytes = 0;
  };

  Outcome fly(const std::string& key, const std::shared_ptr<Flight>& flight, const Gone& gone,
              const Make& make);
  std::optional<Outcome> join(std::unique_lock<std::mutex>& lock, const std::shared_ptr<Flight>& flight,
                              const Gone& gone);
  Entry touch(const std::string& key);
  void keep(const std::string& key, const Entry& entry);

  const std::uint64_t most_bytes_;
  mutable std::mutex mutex_;
  std::list<Kept> by_use_;                                                  ///< most recently used first
  std::unordered_map<std::string_view, std::list<Kept>::iterator> by_key_;  ///< views into by_use_
  std::unordered_map<std::string, std::shared_ptr<Flight>> flights_;
  Figures figures_;
};

}  // namespace seedmesh
