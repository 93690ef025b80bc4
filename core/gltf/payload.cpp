#include "core/gltf/payload.h"

#include <iterator>
#include <utility>

namespace seedmesh {

void Payload::add(std::string text) {
  if (text.empty()) return;
  auto kept = std::make_shared<const std::string>(std::move(text));
  const auto bytes = std::as_bytes(std::span(*kept));
  add(std::move(kept), bytes);
}

void Payload::add(std::shared_ptr<const void> owner, std::span<const std::byte> bytes) {
  if (bytes.empty()) return;
  if (owner && (owners_.empty() || owners_.back() != owner)) owners_.push_back(std::move(owner));
  pieces_.push_back(bytes);
  size_ += bytes.size();
}

void Payload::append(Payload other) {
  owners_.insert(owners_.end(), std::make_move_iterator(other.owners_.begin()),
                 std::make_move_iterator(other.owners_.end()));
  pieces_.insert(pieces_.end(), other.pieces_.begin(), other.pieces_.end());
  size_ += other.size_;
}

std::string Payload::text() const {
  std::string all;
  all.reserve(size_);
  for (const auto piece : pieces_) all.append(reinterpret_cast<const char*>(piece.data()), piece.size());
  return all;
}

}  // namespace seedmesh
