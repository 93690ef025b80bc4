#include "server/texture_cache.h"

namespace seedmesh {

std::shared_ptr<const void> TextureCache::find(const std::string& key) {
  const std::lock_guard lock(mutex_);
  const auto found = by_key_.find(key);
  if (found == by_key_.end()) return nullptr;
  by_use_.splice(by_use_.begin(), by_use_, found->second);
  return found->second->value;
}

void TextureCache::keep(const std::string& key, std::shared_ptr<const void> value, std::uint64_t bytes) {
  const std::lock_guard lock(mutex_);
  if (bytes > most_bytes_ || by_key_.count(key) > 0) return;
  by_use_.push_front({key, std::move(value), bytes});
  by_key_.emplace(by_use_.front().key, by_use_.begin());
  bytes_ += bytes;
  while (bytes_ > most_bytes_) {
    const Kept& oldest = by_use_.back();
    bytes_ -= oldest.bytes;
    by_key_.erase(oldest.key);
    by_use_.pop_back();
  }
}

std::uint64_t TextureCache::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

}  // namespace seedmesh
