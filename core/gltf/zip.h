#pragma once
/// A zip archive of payloads.
#include <string>
#include <vector>

#include "core/gltf/payload.h"

namespace seedmesh::gltf {

struct ZipEntry {
  std::string name;  ///< ASCII, with / between folders, unique in the archive
  Payload payload;
};

/// Stores the entries as they are, in their order, with the time stamp 1980-01-01 00:00, by libzip: the same
/// entries give the same bytes. The pieces of the entries become pieces of the archive and are not copied;
/// each byte is read once for its CRC (about 1 GB/s). The archive is below 4 GiB: the caller sees to that.
Payload zip(std::vector<ZipEntry> entries);

}  // namespace seedmesh::gltf
