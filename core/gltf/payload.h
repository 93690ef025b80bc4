#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace seedmesh {

/// Bytes of an answer as a list of pieces, so that vertex and index data go from the mesh arrays to the
/// socket without a copy. The pieces stay valid as long as this lives. No piece is empty.
class Payload {
 public:
  Payload() = default;
  void add(std::string text);  ///< owns the text
  /// Points at `bytes`, which `owner` keeps alive; a null owner stands for bytes that live as long as the
  /// program.
  void add(std::shared_ptr<const void> owner, std::span<const std::byte> bytes);
  void append(Payload other);  ///< all pieces of `other`, after ours
  std::uint64_t size() const { return size_; }
  const std::vector<std::span<const std::byte>>& pieces() const { return pieces_; }
  std::string text() const;  ///< all of it in one string; copies

 private:
  std::vector<std::shared_ptr<const void>> owners_;
  std::vector<std::span<const std::byte>> pieces_;
  std::uint64_t size_ = 0;
};

}  // namespace seedmesh
