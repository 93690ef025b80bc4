#pragma once
/// Huge pages that arrays of requests have left, for those of the next requests: the kernel clears each page
/// that it gives, which is a tenth of the time of a tree of 100,000 triangles. Safe for use from many
/// threads.
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace seedmesh {

class Reserve {
 public:
  static constexpr std::size_t usual = std::size_t{128} << 20U;

  /// Keeps so many bytes at most.
  explicit Reserve(std::size_t most = usual);
  ~Reserve() { clear(); }
  Reserve(const Reserve&) = delete;
  Reserve& operator=(const Reserve&) = delete;

  /// So many bytes, whole huge pages whose content is anything; null where there are no such.
  std::byte* take(std::size_t room);
  /// So many bytes, pages of the largest size (pages.h), out of huge pages that others have the rest of; new
  /// ones where there are none. Throws std::bad_alloc.
  std::byte* share(std::size_t room);
  /// Any pages. False: the caller unmaps them. It is kept as long as all that is kept and what its request
  /// uses, this included, are together no more than half the most or than the request has used at its peak,
  /// so that a great request is not greater by what it has let go.
  bool keep(std::byte* memory, std::size_t room, std::uint64_t used, std::uint64_t peak);
  /// Gives all back to the system.
  void clear();
  std::size_t kept() const;

 private:
  struct Piece {
    std::byte* memory;
    std::size_t room;
  };
  std::byte* cut(std::size_t room, std::size_t aligned);
  void join(Piece whole);

  static constexpr std::size_t most_pieces = 4096;

  mutable std::mutex mutex_;
  std::vector<Piece> pieces_;
  std::size_t kept_ = 0;
  const std::size_t most_;
};

}  // namespace seedmesh
