#pragma once
#include <cstdint>
#include <list>
#include <string>
#include <string_view>
#include <unordered_map>

namespace seedmesh {

/// Values by key, bounded in bytes. The least recently used value is removed first. Not thread-safe.
/// `Value` is a shared pointer, so that a removed value exists as long as it is in use.
template <class Value>
class LruMap {
 public:
  explicit LruMap(std::uint64_t capacity) : capacity_(capacity) {}

  /// Returns the value of `key`, which counts as a use; null if there is none.
  Value find(const std::string& key) {
    const auto found = by_key_.find(key);
    if (found == by_key_.end()) return nullptr;
    by_use_.splice(by_use_.begin(), by_use_, found->second);
    return found->second->value;
  }

  /// Adds a value that counts as `bytes` bytes. Does nothing if the key is present or `bytes` exceeds the capacity.
  void insert(const std::string& key, Value value, std::uint64_t bytes) {
    if (bytes > capacity_ || by_key_.count(key) > 0) return;
    by_use_.push_front({key, std::move(value), bytes});
    by_key_.emplace(by_use_.front().key, by_use_.begin());
    bytes_ += bytes;
    for (; bytes_ > capacity_; ++evictions_) {
      bytes_ -= by_use_.back().bytes;
      by_key_.erase(by_use_.back().key);
      by_use_.pop_back();
    }
  }

  std::uint64_t bytes() const { return bytes_; }
  std::uint64_t size() const { return by_use_.size(); }
  std::uint64_t evictions() const { return evictions_; }

 private:
  struct Node {
    std::string key;
    Value value;
    std::uint64_t bytes = 0;
  };

  const std::uint64_t capacity_;
  std::list<Node> by_use_;  ///< most recently used first
  std::unordered_map<std::string_view, typename std::list<Node>::iterator> by_key_;  ///< views into by_use_
  std::uint64_t bytes_ = 0, evictions_ = 0;
};

}  // namespace seedmesh
