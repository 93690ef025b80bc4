#pragma once
/// The outer layers of a GLB that comes as text: base64, chunks, the shape of the JSON.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/base/array.h"

namespace seedmesh::gltf {

/// A fault of a file that somebody gave; caught in read.cpp, where it becomes an Issue.
struct Unreadable {
  std::string message;
};

/// Memory of a library, charged to the purse for as long as this lives.
class Charge {
 public:
  Charge(const Job& job, std::uint64_t bytes) : purse_(job.purse()), bytes_(bytes) { purse_->take(bytes); }
  Charge(const Charge&) = delete;
  Charge& operator=(const Charge&) = delete;
  ~Charge() { purse_->give_back(bytes_); }

 private:
  std::shared_ptr<Purse> purse_;
  std::uint64_t bytes_;
};

/// RFC 4648 with or without padding, no line ends. Throws Unreadable.
Array<std::byte> bytes_of_base64(std::string_view text, const Job& job);

/// Looks at the frame of a GLB and at how deep its JSON goes, and gives the JSON. Throws Unreadable for what
/// no library should be asked to parse.
std::string_view checked_json(std::span<const std::byte> glb);

}  // namespace seedmesh::gltf
