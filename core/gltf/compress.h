#pragma once
/// EXT_meshopt_compression (Kapoulkine, Khronos registry 2021) for a buffer that has been arranged: views of
/// vertices and indices become streams of meshoptimizer's codecs, all else stays as it is.
#include <cstdint>
#include <string>

#include "core/gltf/bin.h"

namespace seedmesh::gltf {

/// The stream of an array that is to have a view of its own, ahead of compress(), which takes it as it is.
Slice encoded_ahead(const Slice& plain, Pool pool, Job& job);

struct Compressed {
  Bin bin;                     ///< arranged; its views are those of the plain buffer, in their order
  std::string views;           ///< the JSON array bufferViews, for readers of the extension
  std::uint64_t fallback = 0;  ///< bytes of the second buffer, which nobody stores; 0: nothing is compressed
};

/// `plain` is packed tight, so that indices of several meshes make one stream. It lets go of its arrays; each
/// goes when its stream is made. Charges the streams to `job`. About 45 ms for a million triangles.
Compressed compress(Bin& plain, Job& job);

}  // namespace seedmesh::gltf
