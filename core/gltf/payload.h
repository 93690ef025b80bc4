#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace seedmesh {

/// The bytes of a file or a response as a list of pieces. Vertex and index data therefore go from the arrays
/// of a mesh to the socket without a copy. The pieces are valid as long as the payload exists. No piece is
/// empty.
class Payload {
 public:
  Payload() = default;
  void add(std::string text);  ///< owns the text
  /// Refers to `bytes`, which `owner` owns. A null owner means that the bytes exist as long as the program.
  void add(std::shared_ptr<const void> owner, std::span<const std::byte> bytes);
  void append(Payload other);  ///< adds all pieces of `other` at the end
  std::uint64_t size() const { return size_; }
  const std::vector<std::span<const std::byte>>& pieces() const { return pieces_; }
  std::string text() const;  ///< a copy of all bytes in one string

 private:
  std::vector<std::shared_ptr<const void>> owners_;
  std::vector<std::span<const std::byte>> pieces_;
  std::uint64_t size_ = 0;
};

}  // namespace seedmesh
