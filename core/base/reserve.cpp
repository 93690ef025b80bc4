#include "core/base/reserve.h"

#include <algorithm>

#include "core/base/pages.h"

namespace seedmesh {

Reserve::Reserve(std::size_t most) : most_(most) {
  // Keeping is part of destructors: it must not need memory. Pieces are whole huge pages.
  pieces_.reserve(most / pages::huge_page);
}

std::byte* Reserve::take(std::size_t room) {
  const std::lock_guard lock(mutex_);
  auto best = pieces_.end();
  for (auto piece = pieces_.begin(); piece != pieces_.end(); ++piece) {
    if (piece->room >= room && (best == pieces_.end() || piece->room < best->room)) best = piece;
  }
  if (best == pieces_.end()) return nullptr;
  std::byte* const memory = best->memory;
  best->memory += room;
  best->room -= room;
  if (best->room == 0) {
    *best = pieces_.back();
    pieces_.pop_back();
  }
  kept_ -= room;
  return memory;
}

bool Reserve::keep(std::byte* memory, std::size_t room, std::uint64_t used, std::uint64_t peak) {
  const std::lock_guard lock(mutex_);
  if (kept_ + room > most_ || kept_ + used > std::max<std::uint64_t>(most_ / 2, peak)) return false;
  // Neighbours are joined, so that what was cut can be whole again.
  Piece whole{memory, room};
  for (std::size_t i = pieces_.size(); i-- > 0;) {
    const Piece& piece = pieces_[i];
    const bool is_before = piece.memory + piece.room == whole.memory;
    if (!is_before && whole.memory + whole.room != piece.memory) continue;
    whole = {is_before ? piece.memory : whole.memory, piece.room + whole.room};
    pieces_[i] = pieces_.back();
    pieces_.pop_back();
  }
  pieces_.push_back(whole);
  kept_ += room;
  return true;
}

void Reserve::clear() {
  const std::lock_guard lock(mutex_);
  for (const Piece& piece : pieces_) pages::unmap(piece.memory, piece.room);
  pieces_.clear();
  kept_ = 0;
}

std::size_t Reserve::kept() const {
  const std::lock_guard lock(mutex_);
  return kept_;
}

}  // namespace seedmesh
