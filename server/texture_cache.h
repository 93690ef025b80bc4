#pragma once
#include <mutex>

#include "core/texture/texture_store.h"
#include "server/lru.h"

namespace seedmesh {

/// Textures kept in memory between requests, bounded in bytes.
class TextureCache final : public TextureStore {
 public:
  explicit TextureCache(std::uint64_t capacity) : textures_(capacity) {}

  std::shared_ptr<const void> find(const std::string& key) override {
    const std::lock_guard lock(mutex_);
    return textures_.find(key);
  }
  void keep(const std::string& key, std::shared_ptr<const void> value, std::uint64_t bytes) override {
    const std::lock_guard lock(mutex_);
    textures_.insert(key, std::move(value), bytes);
  }
  std::uint64_t bytes() const {
    const std::lock_guard lock(mutex_);
    return textures_.bytes();
  }

 private:
  mutable std::mutex mutex_;
  LruMap<std::shared_ptr<const void>> textures_;
};

}  // namespace seedmesh
