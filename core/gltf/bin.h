#pragma once
/// The buffer of a glTF document: the location of each array, and the bytes.
#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/job.h"
#include "core/gltf/columns.h"
#include "core/gltf/payload.h"

namespace seedmesh::gltf {

/// Arrays with equal use and stride are stored together, so that small ones share a bufferView: all vertex
/// attributes of a view have one stride. The buffer contains the pools in this order.
enum class Pool {
  vertex4,
  vertex8,
  vertex12,
  vertex16,
  octahedral8,  ///< only in compressed files, like the three below
  exponential8,
  sequence2,  ///< indices of lines and points
  sequence4,
  index2,
  index4,
  keys,
  binds,
  image
};

/// Returns the bytes of one element; 0 for pools of other data than vertices and indices.
std::uint32_t stride_of(Pool pool);

/// Returns the target of a bufferView (an OpenGL constant), or 0 for other data than vertices and indices.
int target_of(Pool pool);

/// Returns the pool of a vertex attribute, or of indices. The stride and the filter of the column determine
/// it.
Pool vertex_pool(const Column& column);
Pool index_pool(const Column& column);

/// Whether arrays that share a view start at multiples of 4 (aligned) or follow each other without gaps (tight).
enum class Packing { aligned, tight };

class Bin {
 public:
  /// The location of an array, for its accessor or image.
  struct Location {
    int view = -1;
    std::uint64_t offset = 0;  ///< within the view; below 1 MiB
  };
  struct View {
    Pool pool = Pool::keys;
    std::uint64_t offset = 0, length = 0;
    std::uint32_t stride = 0;  ///< 0 unless vertex attributes share the view
  };

  /// Whether an array of this size always gets a view of its own.
  static bool has_own_view(std::uint64_t bytes);

  /// Adds an array and returns its number. Call it before arrange().
  int add(Pool pool, Slice slice);

  /// Computes the location of each array. Views start at multiples of 4 and have at most 1 MiB, unless one
  /// array is larger.
  void arrange(Packing packing = Packing::aligned);

  Location location(int number) const { return locations_[static_cast<std::size_t>(number)]; }
  const std::vector<View>& views() const { return views_; }
  std::uint64_t size() const { return size_; }  ///< a multiple of 4

  /// Returns the arrays of each view, in order. Call it between arrange() and drain().
  std::vector<std::vector<Slice>> slices() const;

  /// Releases all arrays; the locations stay.
  void release() { items_.clear(); }

  /// Passes the bytes to `sink` in order, with padding, and releases each array afterwards. Arrays are shared
  /// and not copied. Neighbours below 4 KiB are copied into one block (charged to `job`), so that a socket
  /// gets few writes.
  void drain(Job& job, const std::function<void(Slice)>& sink);

 private:
  struct Item {
    Pool pool = Pool::keys;
    Slice slice;
  };
  std::vector<Item> items_;
  std::vector<Location> locations_;
  std::vector<std::size_t> order_;  ///< numbers of the items in buffer order
  std::vector<View> views_;
  std::uint64_t size_ = 0;
};

/// Throws Stop where a file would have 4 GiB or more: sizes are 32-bit words in GLB, and in zip without
/// zip64.
void refuse_beyond_4_gib(std::uint64_t bytes, const Job& job);

/// Returns the bytes of the buffer.
Payload raw(Bin bin, Job& job);

/// Returns the buffer in base64 (RFC 4648, padded), in blocks of 4 MiB charged to `job`.
Payload base64(Bin bin, Job& job);

constexpr std::uint64_t base64_size(std::uint64_t bytes) { return (bytes + 2) / 3 * 4; }

}  // namespace seedmesh::gltf
