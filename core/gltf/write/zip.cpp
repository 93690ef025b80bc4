/// PKWARE, "APPNOTE.TXT - .ZIP File Format Specification", version 6.3.10: stored entries, no zip64.
#include "core/gltf/write/zip.h"

#include <zlib.h>

#include <initializer_list>
#include <limits>
#include <utility>

#include "core/gltf/bin.h"

namespace seedmesh::gltf {
namespace {

constexpr std::uint32_t local_header = 0x04034B50, directory_header = 0x02014B50, directory_end = 0x06054B50;
constexpr std::uint64_t local_header_bytes = 30, directory_header_bytes = 46, directory_end_bytes = 22;

constexpr std::uint16_t version_needed = 10;            // 1.0
constexpr std::uint16_t version_made_by = 3 << 8 | 63;  // Unix, 6.3
constexpr std::uint16_t no_flags = 0, stored = 0;
constexpr std::uint16_t midnight = 0, first_of_january_1980 = 1U << 5U | 1U;  // the earliest MS-DOS time
constexpr std::uint32_t unix_file_mode = 0100666U << 16U;

void append_16(std::string& out, std::initializer_list<std::size_t> numbers) {
  for (const std::size_t number : numbers) {
    for (int shift = 0; shift < 16; shift += 8) out += static_cast<char>(number >> shift & 0xFFU);
  }
}

void append_32(std::string& out, std::initializer_list<std::uint64_t> numbers) {
  for (const std::uint64_t number : numbers) {
    for (int shift = 0; shift < 32; shift += 8) out += static_cast<char>(number >> shift & 0xFFU);
  }
}

std::uint64_t checksum(const Payload& payload) {
  uLong crc = 0;
  for (const std::span<const std::byte> piece : payload.pieces())
    crc = crc32_z(crc, reinterpret_cast<const Bytef*>(piece.data()), piece.size());
  return crc;
}

/// The fields that the local header of an entry and its header in the directory share.
std::string shared_fields(const ZipEntry& entry) {
  const std::uint64_t size = entry.payload.size();
  std::string fields;
  append_16(fields, {version_needed, no_flags, stored, midnight, first_of_january_1980});
  append_32(fields, {checksum(entry.payload), size, size});
  append_16(fields, {entry.name.size(), 0});  // no extra field
  return fields;
}

void refuse_too_large(const std::vector<ZipEntry>& entries, const Job& job) {
  std::uint64_t size = directory_end_bytes;
  for (const ZipEntry& entry : entries)
    size += local_header_bytes + directory_header_bytes + 2 * entry.name.size() + entry.payload.size();
  refuse_beyond_4_gib(size, job);
  constexpr std::uint64_t most = std::numeric_limits<std::uint16_t>::max();
  if (entries.size() <= most) return;
  job.refuse(limit_issue({Resource::file_bytes, most, entries.size()},
                         "the archive would have " + std::to_string(entries.size()) +
                             " files; its format holds at most " + std::to_string(most)));
}

}  // namespace

Payload zip(std::vector<ZipEntry> entries, const Job& job) {
  refuse_too_large(entries, job);
  Payload archive;
  std::string directory;
  for (ZipEntry& entry : entries) {
    job.check();
    const std::string shared = shared_fields(entry);
    append_32(directory, {directory_header});
    append_16(directory, {version_made_by});
    directory += shared;
    append_16(directory, {0, 0, 0});  // no comment, disk 0, binary data
    append_32(directory, {unix_file_mode, archive.size()});
    directory += entry.name;
    std::string header;
    append_32(header, {local_header});
    archive.add(header + shared + entry.name);
    archive.append(std::move(entry.payload));
  }
  const std::uint64_t begin = archive.size(), length = directory.size();
  append_32(directory, {directory_end});
  append_16(directory, {0, 0, entries.size(), entries.size()});
  append_32(directory, {length, begin});
  append_16(directory, {0});  // no comment
  archive.add(std::move(directory));
  return archive;
}

}  // namespace seedmesh::gltf
