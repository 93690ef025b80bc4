#pragma once
/// A zip archive of payloads.
#include <string>
#include <vector>

#include "core/base/job.h"
#include "core/gltf/payload.h"

namespace seedmesh::gltf {

struct ZipEntry {
  std::string name;  ///< ASCII, with / between directories, unique in the archive
  Payload payload;
};

/// Stores the entries without compression, in their order, with the time stamp 1980-01-01 00:00. The same
/// entries therefore give the same bytes. The pieces of the entries become pieces of the archive and are not
/// copied. Each byte is read once for its CRC (about 1 GB/s). Throws Stop through `job` where the archive
/// would reach 4 GiB or have more than 65,535 entries.
Payload zip(std::vector<ZipEntry> entries, const Job& job);

}  // namespace seedmesh::gltf
