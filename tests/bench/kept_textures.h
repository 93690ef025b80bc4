#pragma once
/// An unbounded texture cache that lasts from one request to the next, as in a server.
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "core/texture/texture_store.h"

namespace seedmesh::bench {

class KeptTextures : public TextureStore {
 public:
  std::shared_ptr<const void> find(const std::string& key) override {
    const auto found = all_.find(key);
    return found == all_.end() ? nullptr : found->second;
  }
  void keep(const std::string& key, std::shared_ptr<const void> value, std::uint64_t) override {
    all_.emplace(key, std::move(value));
  }

 private:
  std::map<std::string, std::shared_ptr<const void>> all_;
};

}  // namespace seedmesh::bench
