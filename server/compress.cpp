#include "server/compress.h"

#include <brotli/encode.h>
#include <isa-l/igzip_lib.h>
#include <libdeflate.h>
#include <zlib.h>
#include <zstd.h>

#include <algorithm>
#include <new>
#include <stdexcept>

namespace seedmesh {
namespace {

constexpr int gzip_window = 15 + 16;
/// Quality 0 costs 1.4 ms per MB of vertex data. Quality 1 takes 2.5 ms and is no smaller, quality 3 takes 4.3 ms, and
/// quality 5 takes 20 ms. A window of this size is as small as larger ones.
constexpr std::uint32_t fast_brotli_quality = 0, fast_brotli_window = 18;
constexpr int fast_zstd_level = 1;

/// Bytes that an encoder may write in one step.
constexpr std::size_t step = 64 * 1'024;

/// gzip by ISA-L level 1: 1.2 ms per MB, where zlib's fastest level takes 7.8 ms for the same size. libdeflate
/// takes 3 ms and cannot encode a stream in parts.
class QuickGzip final : public Encoder {
 public:
  QuickGzip() {
    ::isal_deflate_init(stream_.get());
    stream_->level = 1;
    stream_->level_buf = buffer_.get();
    stream_->level_buf_size = ISAL_DEF_LVL1_DEFAULT;
    stream_->gzip_flag = IGZIP_GZIP;
  }
  void add(std::span<const std::byte> part, std::string& out) override {
    while (!part.empty()) {
      const auto now = part.first(std::min<std::size_t>(part.size(), 1U << 30U));
      run(now, out);
      part = part.subspan(now.size());
    }
  }
  void end(std::string& out) override {
    stream_->end_of_stream = 1;
    run({}, out);
  }

 private:
  void run(std::span<const std::byte> part, std::string& out) {
    stream_->next_in = reinterpret_cast<std::uint8_t*>(const_cast<std::byte*>(part.data()));
    stream_->avail_in = static_cast<std::uint32_t>(part.size());
    do {
      std::uint8_t bytes[step];
      stream_->next_out = bytes;
      stream_->avail_out = step;
      if (::isal_deflate(stream_.get()) != COMP_OK) throw std::logic_error("isal_deflate refused its state");
      out.append(reinterpret_cast<const char*>(bytes), step - stream_->avail_out);
    } while (stream_->avail_out == 0 || stream_->avail_in > 0);
  }

  const std::unique_ptr<isal_zstream> stream_{new isal_zstream};
  const std::unique_ptr<std::uint8_t[]> buffer_{new std::uint8_t[ISAL_DEF_LVL1_DEFAULT]};
};

/// gzip by libdeflate for answers that are encoded in one piece. Beside ISA-L level 1, a map of a world is 9 % smaller
/// and a tile 21 %. It costs 5 to 8 ms per MB, so at most half a millisecond for an answer of this size.
class WholeGzip final : public Encoder {
 public:
  static constexpr std::uint64_t most = 64 * 1'024;  ///< bytes of an answer

  explicit WholeGzip(std::uint64_t size) {
    if (!compressor_) throw std::bad_alloc();
    input_.reserve(static_cast<std::size_t>(size));
  }
  void add(std::span<const std::byte> part, std::string&) override {
    input_.append(reinterpret_cast<const char*>(part.data()), part.size());
  }
  void end(std::string& out) override {
    const std::size_t before = out.size();
    out.resize(before + libdeflate_gzip_compress_bound(compressor_.get(), input_.size()));
    const std::size_t size = libdeflate_gzip_compress(compressor_.get(), input_.data(), input_.size(),
                                                      out.data() + before, out.size() - before);
    out.resize(before + size);
  }

 private:
  static constexpr int level = 2;
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor_{
      libdeflate_alloc_compressor(level), libdeflate_free_compressor};
  std::string input_;
};

/// Deflate by zlib, with any of its frames.
class SmallDeflate final : public Encoder {
 public:
  SmallDeflate(int level, int window) {
    if (deflateInit2(&stream_, level, Z_DEFLATED, window, 8, Z_DEFAULT_STRATEGY) != Z_OK)
      throw std::bad_alloc();
  }
  SmallDeflate(const SmallDeflate&) = delete;
  SmallDeflate& operator=(const SmallDeflate&) = delete;
  ~SmallDeflate() override { deflateEnd(&stream_); }
  void add(std::span<const std::byte> part, std::string& out) override {
    while (!part.empty()) {
      const auto now = part.first(std::min<std::size_t>(part.size(), 1U << 30U));
      run(now, Z_NO_FLUSH, out);
      part = part.subspan(now.size());
    }
  }
  void end(std::string& out) override { run({}, Z_FINISH, out); }

 private:
  void run(std::span<const std::byte> part, int flush, std::string& out) {
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(part.data()));
    stream_.avail_in = static_cast<uInt>(part.size());
    do {
      Bytef bytes[step];
      stream_.next_out = bytes;
      stream_.avail_out = step;
      deflate(&stream_, flush);
      out.append(reinterpret_cast<const char*>(bytes), step - stream_.avail_out);
    } while (stream_.avail_out == 0);
  }

  z_stream stream_{};
};

class Brotli final : public Encoder {
 public:
  Brotli(Effort effort, std::uint64_t size) {
    if (!state_) throw std::bad_alloc();
    const auto set = [&](BrotliEncoderParameter parameter, std::uint32_t value) {
      BrotliEncoderSetParameter(state_.get(), parameter, value);
    };
    const bool fast = effort == Effort::fast;
    set(BROTLI_PARAM_QUALITY, fast ? fast_brotli_quality : BROTLI_MAX_QUALITY);
    if (fast) set(BROTLI_PARAM_LGWIN, fast_brotli_window);
    set(BROTLI_PARAM_SIZE_HINT, static_cast<std::uint32_t>(std::min<std::uint64_t>(size, 1U << 30U)));
  }
  void add(std::span<const std::byte> part, std::string& out) override {
    run(BROTLI_OPERATION_PROCESS, part, out);
  }
  void end(std::string& out) override { run(BROTLI_OPERATION_FINISH, {}, out); }

 private:
  void run(BrotliEncoderOperation operation, std::span<const std::byte> part, std::string& out) {
    std::size_t left = part.size(), unused = 0;
    const auto* next = reinterpret_cast<const std::uint8_t*>(part.data());
    do {
      if (!BrotliEncoderCompressStream(state_.get(), operation, &left, &next, &unused, nullptr, nullptr))
        throw std::bad_alloc();
      std::size_t size = 0;
      const std::uint8_t* bytes = BrotliEncoderTakeOutput(state_.get(), &size);
      out.append(reinterpret_cast<const char*>(bytes), size);
    } while (left > 0 || BrotliEncoderHasMoreOutput(state_.get()));
  }

  const std::unique_ptr<BrotliEncoderState, void (*)(BrotliEncoderState*)> state_{
      BrotliEncoderCreateInstance(nullptr, nullptr, nullptr), BrotliEncoderDestroyInstance};
};

class Zstandard final : public Encoder {
 public:
  Zstandard(Effort effort, std::uint64_t size) {
    if (!context_) throw std::bad_alloc();
    const int level = effort == Effort::fast ? fast_zstd_level : 19;
    checked(ZSTD_CCtx_setParameter(context_.get(), ZSTD_c_compressionLevel, level));
    checked(ZSTD_CCtx_setPledgedSrcSize(context_.get(), size));
  }
  void add(std::span<const std::byte> part, std::string& out) override { run(ZSTD_e_continue, part, out); }
  void end(std::string& out) override { run(ZSTD_e_end, {}, out); }

 private:
  static std::size_t checked(std::size_t status) {
    if (ZSTD_isError(status)) throw std::bad_alloc();  // the only error that compression can have
    return status;
  }
  void run(ZSTD_EndDirective directive, std::span<const std::byte> part, std::string& out) {
    ZSTD_inBuffer input{part.data(), part.size(), 0};
    std::size_t left = 0;
    do {
      char bytes[step];
      ZSTD_outBuffer output{bytes, step, 0};
      left = checked(ZSTD_compressStream2(context_.get(), &output, &input, directive));
      out.append(bytes, output.pos);
    } while (directive == ZSTD_e_end ? left > 0 : input.pos < input.size);
  }

  const std::unique_ptr<ZSTD_CCtx, std::size_t (*)(ZSTD_CCtx*)> context_{ZSTD_createCCtx(), ZSTD_freeCCtx};
};

bool is_image(std::span<const std::byte> piece) {
  const std::string_view start(reinterpret_cast<const char*>(piece.data()),
                               std::min<std::size_t>(piece.size(), 16));
  return start.starts_with("\x89PNG\r\n") || start.starts_with("\xABKTX 20") ||
         start.starts_with("\xFF\xD8\xFF") ||
         (start.starts_with("RIFF") &&
          start.substr(std::min<std::size_t>(8, start.size())).starts_with("WEBP"));
}

}  // namespace

std::unique_ptr<Encoder> encoder_of(Coding coding, Effort effort, std::uint64_t size) {
  switch (coding) {
    case Coding::gzip:
      if (effort == Effort::fast && size <= WholeGzip::most) return std::make_unique<WholeGzip>(size);
      if (effort == Effort::fast) return std::make_unique<QuickGzip>();
      return std::make_unique<SmallDeflate>(9, gzip_window);
    case Coding::br:
      return std::make_unique<Brotli>(effort, size);
    case Coding::zstd:
      return std::make_unique<Zstandard>(effort, size);
    case Coding::identity:
      break;
  }
  throw std::invalid_argument("identity is not a coding to encode with");
}

std::string encode(Coding coding, const std::vector<std::span<const std::byte>>& pieces, Effort effort) {
  std::uint64_t size = 0;
  for (const auto piece : pieces) size += piece.size();
  const std::unique_ptr<Encoder> encoder = encoder_of(coding, effort, size);
  std::string out;
  for (const auto piece : pieces) encoder->add(piece, out);
  encoder->end(out);
  out.shrink_to_fit();
  return out;
}

std::string encode(Coding coding, std::string_view text, Effort effort) {
  return encode(coding, {std::as_bytes(std::span(text))}, effort);
}

double likely_saving(const std::vector<std::span<const std::byte>>& pieces) {
  constexpr std::uint64_t window = 16 * 1'024, fewest = 4, one_of = 32;
  std::uint64_t all = 0, compressible = 0;
  for (const auto piece : pieces) {
    all += piece.size();
    if (!is_image(piece)) compressible += piece.size();
  }
  if (compressible == 0) return 0;
  const std::uint64_t windows = std::max(fewest, compressible / window / one_of);
  const std::uint64_t stride = std::max(window, compressible / windows);
  std::string samples;
  std::uint64_t next = 0, before = 0;  // of the compressible bytes
  std::uint64_t wanted = 0;            // of the present window, which may reach over several pieces
  for (const auto piece : pieces) {
    if (is_image(piece)) continue;
    for (std::uint64_t at = 0; at < piece.size();) {
      if (wanted == 0) {
        if (next >= before + piece.size()) break;
        at = next - before;
        next += stride;
        wanted = window;
      }
      const auto size = std::min<std::uint64_t>(wanted, piece.size() - at);
      samples.append(reinterpret_cast<const char*>(piece.data()) + at, size);
      at += size;
      wanted -= size;
    }
    before += piece.size();
  }
  const double left = static_cast<double>(encode(Coding::zstd, samples, Effort::fast).size());
  const double saved = std::max(0.0, 1 - left / static_cast<double>(samples.size()));
  return saved * static_cast<double>(compressible) / static_cast<double>(all);
}

}  // namespace seedmesh
