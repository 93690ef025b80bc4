#pragma once
/// The one buffer of a document: where each array lies in it, and its bytes in that order.
#include <cstdint>
#include <functional>
#include <vector>

#include "core/base/job.h"
#include "core/gltf/columns.h"
#include "core/gltf/payload.h"

namespace seedmesh::gltf {

/// Arrays of one use and stride lie together, so that small ones share a bufferView (several vertex
/// attributes in one view must agree on the stride). The buffer holds the pools in this order.
enum class Pool {
  vertex4,
  vertex8,
  vertex12,
  vertex16,
  octahedral8,  ///< only where it will be compressed, as the three below
  exponential8,
  sequence2,  ///< indices that are no triangles
  sequence4,
  index2,
  index4,
  keys,
  binds,
  image
};

/// Bytes of an element of a pool of vertices or indices, else 0.
std::uint32_t stride_of(Pool pool);

/// What the pool is for, as OpenGL numbers it; 0 for neither vertices nor indices.
int target_of(Pool pool);

/// The pool of a vertex attribute, or of indices, by the stride (and the filter).
Pool vertex_pool(const Column& column);
Pool index_pool(const Column& column);

/// Whether arrays that share a view start at multiples of 4, or follow each other without a gap.
enum class Packing { aligned, tight };

class Bin {
 public:
  /// A place in the buffer, for the accessor or the image that reads it.
  struct Place {
    int view = -1;
    std::uint64_t offset = 0;  ///< within the view; below 1 MiB
  };
  struct View {
    Pool pool = Pool::keys;
    std::uint64_t offset = 0, length = 0;
    std::uint32_t stride = 0;  ///< 0 unless vertex attributes share the view
  };

  /// Does an array of so many bytes get a view of its own, whatever is beside it?
  static bool has_own_view(std::uint64_t bytes);

  /// Adds an array and returns its number. Not after arrange().
  int add(Pool pool, Slice slice);

  /// Gives each array its place: views start at multiples of 4, and are of at most 1 MiB unless one array
  /// alone is larger.
  void arrange(Packing packing = Packing::aligned);

  Place place(int number) const { return places_[static_cast<std::size_t>(number)]; }
  const std::vector<View>& views() const { return views_; }
  std::uint64_t size() const { return size_; }  ///< a multiple of 4

  /// The arrays of each view, in order. Only between arrange() and drain().
  std::vector<std::vector<Slice>> slices() const;

  /// Lets go of all arrays; the places stay.
  void forget() { items_.clear(); }

  /// Hands the bytes out in order, padding included, and lets go of each array when it has been handed out.
  /// Arrays are shared, not copied; neighbours below 4 KiB come gathered in one block (charged to `job`),
  /// because a socket wants few writes.
  void drain(Job& job, const std::function<void(Slice)>& sink);

 private:
  struct Item {
    Pool pool = Pool::keys;
    Slice slice;
  };
  std::vector<Item> items_;
  std::vector<Place> places_;
  std::vector<std::size_t> order_;  ///< items as they lie in the buffer
  std::vector<View> views_;
  std::uint64_t size_ = 0;
};

/// The buffer as it is.
Payload raw(Bin bin, Job& job);

/// The buffer in base64 (RFC 4648, padded), in blocks of 4 MiB charged to `job`.
Payload base64(Bin bin, Job& job);

constexpr std::uint64_t base64_size(std::uint64_t bytes) { return (bytes + 2) / 3 * 4; }

}  // namespace seedmesh::gltf
