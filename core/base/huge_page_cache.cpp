#include "core/base/huge_page_cache.h"

#include <algorithm>
#include <cstdint>

#include "core/base/pages.h"

namespace seedmesh {

HugePageCache::HugePageCache(std::size_t most) : most_(most) {
  // keep() runs in destructors, so it must not allocate.
  pieces_.reserve(most_pieces);
}

/// Cuts `bytes` bytes out of the smallest sufficient piece; null where there is none.
std::byte* HugePageCache::cut(std::size_t bytes, std::size_t aligned) {
  const auto skipped = [&](const Piece& piece) {
    return (aligned - reinterpret_cast<std::uintptr_t>(piece.memory) % aligned) % aligned;
  };
  auto best = pieces_.end();
  for (auto piece = pieces_.begin(); piece != pieces_.end(); ++piece) {
    const bool is_smaller = best == pieces_.end() || piece->bytes < best->bytes;
    if (is_smaller && piece->bytes >= bytes + skipped(*piece)) best = piece;
  }
  if (best == pieces_.end()) return nullptr;
  const Piece whole = *best;
  const std::size_t before = skipped(whole), behind = whole.bytes - before - bytes;
  if (before > 0 && behind > 0 && pieces_.size() == most_pieces) return nullptr;
  *best = pieces_.back();
  pieces_.pop_back();
  if (before > 0) pieces_.push_back({whole.memory, before});
  if (behind > 0) pieces_.push_back({whole.memory + before + bytes, behind});
  kept_ -= bytes;
  return whole.memory + before;
}

/// Adds a piece and joins it with adjacent ones, so that cut huge pages become whole again.
void HugePageCache::join(Piece whole) {
  kept_ += whole.bytes;
  for (std::size_t i = pieces_.size(); i-- > 0;) {
    const Piece& piece = pieces_[i];
    const bool is_before = piece.memory + piece.bytes == whole.memory;
    if (!is_before && whole.memory + whole.bytes != piece.memory) continue;
    whole = {is_before ? piece.memory : whole.memory, piece.bytes + whole.bytes};
    pieces_[i] = pieces_.back();
    pieces_.pop_back();
  }
  pieces_.push_back(whole);
}

std::byte* HugePageCache::take(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  return cut(bytes, pages::huge_page);
}

std::byte* HugePageCache::share(std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  if (std::byte* memory = cut(bytes, pages::largest_page)) return memory;
  const std::size_t whole = pages::rounded(bytes, pages::huge_page);
  std::byte* memory = pages::map(whole);
  if (whole > bytes && pieces_.size() < most_pieces) {
    join({memory + bytes, whole - bytes});
  } else if (whole > bytes) {
    pages::unmap(memory + bytes, whole - bytes);
  }
  return memory;
}

bool HugePageCache::keep(std::byte* memory, std::size_t bytes, std::uint64_t used, std::uint64_t peak) {
  const std::lock_guard lock(mutex_);
  if (kept_ + bytes > most_ || kept_ + used > std::max<std::uint64_t>(most_ / 2, peak)) return false;
  if (pieces_.size() == most_pieces) return false;
  join({memory, bytes});
  return true;
}

void HugePageCache::clear() {
  const std::lock_guard lock(mutex_);
  for (const Piece& piece : pieces_) pages::unmap(piece.memory, piece.bytes);
  pieces_.clear();
  kept_ = 0;
}

std::size_t HugePageCache::kept() const {
  const std::lock_guard lock(mutex_);
  return kept_;
}

}  // namespace seedmesh
