#pragma once
/// The outer layers of a GLB in a request: base64, chunks, the nesting of the JSON.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "core/base/array.h"

namespace seedmesh::gltf {

/// An error in an imported file; read.cpp catches it and returns an Issue.
struct Unreadable {
  std::string message;
};

/// Charges the memory that a library uses to the request while it exists.
class Charge {
 public:
  Charge(const Job& job, std::uint64_t bytes) : budget_(job.budget()), bytes_(bytes) { budget_->take(bytes); }
  Charge(const Charge&) = delete;
  Charge& operator=(const Charge&) = delete;
  ~Charge() { budget_->release(bytes_); }

 private:
  std::shared_ptr<MemoryBudget> budget_;
  std::uint64_t bytes_;
};

/// Decodes base64 (RFC 4648 section 4), with or without padding. Line ends are not allowed. Throws
/// Unreadable.
Array<std::byte> bytes_of_base64(std::string_view text, const Job& job);

/// Checks the header, the chunks and the nesting of the JSON, and returns the JSON. Throws Unreadable for
/// anything that should not reach the parser.
std::string_view checked_json(std::span<const std::byte> glb);

}  // namespace seedmesh::gltf
