#pragma once
/// Textures kept in memory between requests: bounded in bytes, least recently used go first.
#include <list>
#include <mutex>
#include <string_view>
#include <unordered_map>

#include "core/base/texture_store.h"

namespace seedmesh {

class TextureCache final : public TextureStore {
 public:
  explicit TextureCache(std::uint64_t most_bytes) : most_bytes_(most_bytes) {}

  std::shared_ptr<const void> find(const std::string& key) override;
  void keep(const std::string& key, std::shared_ptr<const void> value, std::uint64_t bytes) override;

  std::uint64_t bytes() const;

 private:
  struct Kept {
    std::string key;
    std::shared_ptr<const void> value;
    std::uint64_t bytes = 0;
  };

  const std::uint64_t most_bytes_;
  mutable std::mutex mutex_;
  std::list<Kept> by_use_;                                                  ///< most recently used first
  std::unordered_map<std::string_view, std::list<Kept>::iterator> by_key_;  ///< views into by_use_
  std::uint64_t bytes_ = 0;
};

}  // namespace seedmesh
