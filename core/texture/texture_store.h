#pragma once
/// A cache of generated textures between requests. The caller of the pipeline owns it and decides what it keeps;
/// core depends only on this interface. Any number of threads may use it at the same time.
#include <cstdint>
#include <memory>
#include <string>

namespace seedmesh {

class TextureStore {
 public:
  virtual ~TextureStore() = default;
  /// Returns the entry of this key, or null.
  virtual std::shared_ptr<const void> find(const std::string& key) = 0;
  /// Keeps `value`, which takes `bytes` of memory and must not be changed afterwards. The store may remove it at any
  /// time. The type behind the pointer follows from the key.
  virtual void keep(const std::string& key, std::shared_ptr<const void> value, std::uint64_t bytes) = 0;
};

}  // namespace seedmesh
