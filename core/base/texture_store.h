#pragma once
/// What made textures are kept in from one request to the next, so that only the first pays for them. Whoever
/// calls the pipeline owns one and decides what it holds; core knows this interface alone. Any number of
/// threads may use one at once.
#include <cstdint>
#include <memory>
#include <string>

namespace seedmesh {

class TextureStore {
 public:
  virtual ~TextureStore() = default;
  /// What was kept under this key, or null.
  virtual std::shared_ptr<const void> find(const std::string& key) = 0;
  /// Keeps `value`, which is never changed again and takes `bytes` of memory; may forget it at any time. The
  /// type behind the pointer follows from the key.
  virtual void keep(const std::string& key, std::shared_ptr<const void> value, std::uint64_t bytes) = 0;
};

}  // namespace seedmesh
