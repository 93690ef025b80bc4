#include "core/gltf/zip.h"

#include <zip.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>

namespace seedmesh::gltf {
namespace {

constexpr zip_uint16_t midnight = 0, first_of_january_1980 = 1U << 5U | 1U;  // the zero of MS-DOS time

/// What libzip writes, with stored data kept as spans of their entries. libzip knows buffers only: it reads
/// from an entry into one and writes that out. So the entry tells the tape which bytes it gave, and a write
/// that brings just these again is recorded as the spans themselves. Any other write is copied, which makes
/// this right (if not lean) whatever libzip does between reading and writing.
class Tape {
 public:
  void given(std::span<const std::byte> bytes) { given_.push_back(bytes); }

  void write(std::span<const std::byte> bytes) {
    if (position_ < size_) {
      overwrite(bytes);
    } else if (are_given(bytes)) {
      for (const auto span : given_) add_span(span);
    } else {
      add_copy(bytes);
    }
    position_ += bytes.size();
    size_ = std::max(size_, position_);
    given_.clear();
  }

  void seek(std::uint64_t position) { position_ = position; }
  std::uint64_t position() const { return position_; }
  std::uint64_t size() const { return size_; }

  /// The archive; `entries` own what the spans point at.
  Payload take(std::vector<ZipEntry> entries) {
    auto owner = std::make_shared<const std::vector<ZipEntry>>(std::move(entries));
    Payload payload;
    for (Chunk& chunk : chunks_) {
      if (chunk.span.empty()) {
        payload.add(std::move(chunk.copy));
      } else {
        payload.add(owner, chunk.span);
      }
    }
    return payload;
  }

 private:
  struct Chunk {
    std::uint64_t offset = 0;
    std::string copy;
    std::span<const std::byte> span;  ///< empty: `copy` holds the bytes
  };

  bool are_given(std::span<const std::byte> bytes) const {
    for (const auto span : given_) {
      if (span.size() > bytes.size() || std::memcmp(span.data(), bytes.data(), span.size()) != 0)
        return false;
      bytes = bytes.subspan(span.size());
    }
    return bytes.empty() && !given_.empty();
  }

  void add_span(std::span<const std::byte> span) {
    if (!chunks_.empty() && !chunks_.back().span.empty()) {
      auto& last = chunks_.back().span;
      if (last.data() + last.size() == span.data()) {
        last = {last.data(), last.size() + span.size()};
        size_ += span.size();
        return;
      }
    }
    chunks_.push_back({size_, {}, span});
    size_ += span.size();
  }

  void add_copy(std::span<const std::byte> bytes) {
    if (chunks_.empty() || !chunks_.back().span.empty()) chunks_.push_back({size_, {}, {}});
    chunks_.back().copy.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    size_ += bytes.size();
  }

  /// libzip goes back to a header once it knows the CRC of what follows; headers are copies, in one chunk
  /// each.
  void overwrite(std::span<const std::byte> bytes) {
    const auto next =
        std::upper_bound(chunks_.begin(), chunks_.end(), position_,
                         [](std::uint64_t at, const Chunk& chunk) { return at < chunk.offset; });
    Chunk& chunk = *std::prev(next);
    const std::uint64_t start = position_ - chunk.offset;
    if (!chunk.span.empty() || start + bytes.size() > chunk.copy.size()) {
      throw std::logic_error("zip: libzip wrote over stored data");
    }
    std::memcpy(chunk.copy.data() + start, bytes.data(), bytes.size());
  }

  std::vector<Chunk> chunks_;
  std::vector<std::span<const std::byte>> given_;
  std::uint64_t position_ = 0;
  std::uint64_t size_ = 0;
};

/// An entry as libzip reads it.
class EntrySource {
 public:
  EntrySource(const ZipEntry& entry, Tape& tape) : payload_(entry.payload), tape_(tape) {}

  static zip_int64_t call(void* self, void* data, zip_uint64_t length, zip_source_cmd_t command) {
    return static_cast<EntrySource*>(self)->answer(data, length, command);
  }

 private:
  zip_int64_t answer(void* data, zip_uint64_t length, zip_source_cmd_t command) {
    switch (command) {
      case ZIP_SOURCE_OPEN:
        piece_ = 0;
        offset_ = 0;
        return 0;
      case ZIP_SOURCE_READ:
        return read(data, length);
      case ZIP_SOURCE_STAT:
        return stat(static_cast<zip_stat_t*>(data));
      case ZIP_SOURCE_CLOSE:
      case ZIP_SOURCE_FREE:
        return 0;
      case ZIP_SOURCE_SUPPORTS:
        return ZIP_SOURCE_SUPPORTS_READABLE;
      default:
        return -1;
    }
  }

  /// At most the rest of one piece; libzip asks again until its buffer is full.
  zip_int64_t read(void* data, zip_uint64_t length) {
    if (piece_ == payload_.pieces().size()) return 0;
    const auto rest = payload_.pieces()[piece_].subspan(offset_);
    const auto given = rest.first(std::min<std::size_t>(rest.size(), length));
    std::memcpy(data, given.data(), given.size());
    tape_.given(given);
    offset_ += given.size();
    if (given.size() == rest.size()) {
      ++piece_;
      offset_ = 0;
    }
    return static_cast<zip_int64_t>(given.size());
  }

  zip_int64_t stat(zip_stat_t* about) const {
    zip_stat_init(about);
    about->valid = ZIP_STAT_SIZE;
    about->size = payload_.size();
    return sizeof(*about);
  }

  const Payload& payload_;
  Tape& tape_;
  std::size_t piece_ = 0;
  std::size_t offset_ = 0;
};

/// The archive as libzip writes it. Exceptions must not fly through C: the last message is kept and thrown by
/// zip().
class ArchiveSink {
 public:
  Tape tape;
  std::string fault;

  static zip_int64_t call(void* self, void* data, zip_uint64_t length, zip_source_cmd_t command) {
    auto& sink = *static_cast<ArchiveSink*>(self);
    try {
      return sink.answer(data, length, command);
    } catch (const std::exception& caught) {
      sink.fault = caught.what();
      zip_error_set(&sink.error_, ZIP_ER_WRITE, EIO);
      return -1;
    }
  }

 private:
  zip_int64_t answer(void* data, zip_uint64_t length, zip_source_cmd_t command) {
    switch (command) {
      case ZIP_SOURCE_WRITE:
        tape.write({static_cast<const std::byte*>(data), length});
        return static_cast<zip_int64_t>(length);
      case ZIP_SOURCE_SEEK_WRITE:
        return seek(data, length);
      case ZIP_SOURCE_TELL_WRITE:
        return static_cast<zip_int64_t>(tape.position());
      case ZIP_SOURCE_STAT:
        zip_error_set(&error_, ZIP_ER_READ, ENOENT);
        return -1;  // nothing there yet
      case ZIP_SOURCE_ERROR:
        return zip_error_to_data(&error_, data, length);
      case ZIP_SOURCE_SUPPORTS:
        return ZIP_SOURCE_SUPPORTS_WRITABLE;
      case ZIP_SOURCE_BEGIN_WRITE:
      case ZIP_SOURCE_COMMIT_WRITE:
      case ZIP_SOURCE_ROLLBACK_WRITE:
      case ZIP_SOURCE_FREE:
        return 0;
      default:
        zip_error_set(&error_, ZIP_ER_OPNOTSUPP, 0);
        return -1;
    }
  }

  zip_int64_t seek(void* data, zip_uint64_t length) {
    const zip_int64_t target =
        zip_source_seek_compute_offset(tape.position(), tape.size(), data, length, &error_);
    if (target < 0) return -1;
    tape.seek(static_cast<std::uint64_t>(target));
    return 0;
  }

  zip_error_t error_{};
};

void require(bool done, const char* what) {
  if (!done) throw std::runtime_error(std::string("zip: ") + what);
}

}  // namespace

Payload zip(std::vector<ZipEntry> entries) {
  ArchiveSink sink;
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* target = zip_source_function_create(ArchiveSink::call, &sink, &error);
  require(target, "no memory");
  zip_t* opened = zip_open_from_source(target, ZIP_CREATE | ZIP_TRUNCATE, &error);
  if (!opened) zip_source_free(target);
  require(opened, "cannot open");
  std::unique_ptr<zip_t, void (*)(zip_t*)> archive(opened, zip_discard);

  std::vector<EntrySource> sources;
  sources.reserve(entries.size());
  for (const ZipEntry& entry : entries) {
    zip_source_t* source =
        zip_source_function(archive.get(), EntrySource::call, &sources.emplace_back(entry, sink.tape));
    require(source, "no memory");
    const zip_int64_t index = zip_file_add(archive.get(), entry.name.c_str(), source, 0);
    if (index < 0) zip_source_free(source);
    require(index >= 0, "cannot add");
    const auto number = static_cast<zip_uint64_t>(index);
    require(zip_set_file_compression(archive.get(), number, ZIP_CM_STORE, 0) == 0, "cannot store");
    require(zip_file_set_dostime(archive.get(), number, midnight, first_of_january_1980, 0) == 0,
            "cannot date");
  }
  const bool closed = zip_close(archive.get()) == 0;
  require(closed, sink.fault.empty() ? zip_strerror(archive.get()) : sink.fault.c_str());
  static_cast<void>(archive.release());  // zip_close has freed it
  return sink.tape.take(std::move(entries));
}

}  // namespace seedmesh::gltf
