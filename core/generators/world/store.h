#pragma once
/// Values that tiles share and that follow from the request alone: regions, sites, roads. The store is bounded in
/// bytes and removes the least recently used value first. A value is made once, while other threads wait for it.
#include <compare>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>

#include "core/base/job.h"

namespace seedmesh::world {

class Store {
 public:
  enum class Layer : std::uint8_t { region, bounds, site, road, plan, file };
  struct Key {
    std::uint64_t world = 0;  ///< World::id
    Layer layer = Layer::region;
    std::int64_t x = 0, y = 0;
    std::int64_t detail = 0;
    auto operator<=>(const Key&) const = default;
  };
  struct Made {
    std::shared_ptr<const void> value;
    std::uint64_t bytes = 0;
  };

  explicit Store(std::uint64_t capacity = std::uint64_t{64} << 20U) : capacity_(capacity) {}

  /// Returns the value of `key`. If the store has none, `make` makes it. `make` may get values of lower
  /// layers. If it throws, one of the waiting threads makes the value. Waiting ends with the job's deadline.
  template <class Value, class Make>
  std::shared_ptr<const Value> get(const Key& key, const Job& job, const Make& make) {
    const auto made = find_or_make(key, job, [&] {
      std::shared_ptr<const Value> value = make();
      const std::uint64_t bytes = value->bytes();
      return Made{std::move(value), bytes};
    });
    return std::static_pointer_cast<const Value>(made);
  }

  std::uint64_t next_world() {
    const std::lock_guard lock(mutex_);
    return ++worlds_;
  }
  std::uint64_t bytes() const {
    const std::lock_guard lock(mutex_);
    return bytes_;
  }

 private:
  struct Entry {
    Key key;
    Made made;
    bool ready = false;
  };
  std::shared_ptr<const void> find_or_make(const Key& key, const Job& job, const std::function<Made()>& make);
  void keep(std::list<Entry>::iterator entry, const Made& made);

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::uint64_t capacity_, bytes_ = 0, worlds_ = 0;
  std::list<Entry> by_use_;  ///< most recently used first
  std::map<Key, std::list<Entry>::iterator> by_key_;
};

}  // namespace seedmesh::world
