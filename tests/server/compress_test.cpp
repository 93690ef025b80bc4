#include "server/compress.h"

#include <brotli/decode.h>
#include <gtest/gtest.h>
#include <zlib.h>
#include <zstd.h>

namespace seedmesh {
namespace {

std::string gunzip(const std::string& packed, std::size_t size) {
  std::string out(size, '\0');
  z_stream stream{};
  EXPECT_EQ(inflateInit2(&stream, 15 + 16), Z_OK);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(out.data());
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(inflate(&stream, Z_FINISH), Z_STREAM_END);
  EXPECT_EQ(stream.avail_in, 0U);
  inflateEnd(&stream);
  return out;
}

std::string unbrotli(const std::string& packed, std::size_t size) {
  std::string out(size, '\0');
  EXPECT_EQ(BrotliDecoderDecompress(packed.size(), reinterpret_cast<const std::uint8_t*>(packed.data()),
                                    &size, reinterpret_cast<std::uint8_t*>(out.data())),
            BROTLI_DECODER_RESULT_SUCCESS);
  out.resize(size);
  return out;
}

std::string unzstd(const std::string& packed, std::size_t size) {
  std::string out(size, '\0');
  EXPECT_EQ(ZSTD_decompress(out.data(), out.size(), packed.data(), packed.size()), size);
  return out;
}

std::string decoded(Coding coding, const std::string& packed, std::size_t size) {
  switch (coding) {
    case Coding::gzip:
      return gunzip(packed, size);
    case Coding::br:
      return unbrotli(packed, size);
    case Coding::zstd:
      return unzstd(packed, size);
    case Coding::identity:
      break;
  }
  return packed;
}

/// Neither constant nor random.
std::string text_of(std::size_t size) {
  std::string text(size, '\0');
  for (std::size_t i = 0; i < size; ++i) text[i] = static_cast<char>((i * i / 7) % 251);
  return text;
}

class Encoding : public testing::TestWithParam<Coding> {};

TEST_P(Encoding, ComesBackForEveryEffort) {
  for (const std::size_t size : {0U, 1U, 1'000U, 300'000U}) {
    const std::string text = text_of(size);
    for (const Effort effort : {Effort::fast, Effort::once})
      EXPECT_EQ(decoded(GetParam(), encode(GetParam(), text, effort), size), text) << size;
  }
}

TEST_P(Encoding, JoinsPieces) {
  const std::string text = text_of(3'000'000);
  const auto all = std::as_bytes(std::span(text));
  const std::vector<std::span<const std::byte>> pieces = {all.first(10), all.subspan(10, 2'000'000),
                                                          all.subspan(2'000'010)};
  EXPECT_EQ(decoded(GetParam(), encode(GetParam(), pieces, Effort::fast), text.size()), text);
}

TEST_P(Encoding, MakesTextSmaller) {
  const std::string text(100'000, 'x');
  EXPECT_LT(encode(GetParam(), text, Effort::fast).size(), 2'000U);
}

INSTANTIATE_TEST_SUITE_P(All, Encoding, testing::Values(Coding::gzip, Coding::br, Coding::zstd));

TEST(Encode, HasNothingToDoForIdentity) {
  EXPECT_THROW(encode(Coding::identity, "x", Effort::fast), std::invalid_argument);
}

TEST_P(Encoding, AddsWhatIsReadyBeforeTheEnd) {
  const std::string text = text_of(4'000'000);
  const auto all = std::as_bytes(std::span(text));
  const std::unique_ptr<Encoder> encoder = encoder_of(GetParam(), Effort::fast, text.size());
  std::string out;
  for (std::size_t from = 0; from < text.size(); from += 250'000)
    encoder->add(all.subspan(from, 250'000), out);
  EXPECT_GT(out.size(), 0U);
  encoder->end(out);
  EXPECT_EQ(decoded(GetParam(), out, text.size()), text);
}

/// Bytes that no coding makes smaller: a xorshift sequence (Marsaglia 2003).
std::string noise(std::size_t size) {
  std::uint64_t state = 88'172'645'463'325'252U;
  std::string bytes(size, '\0');
  for (char& byte : bytes) {
    state ^= state << 13U, state ^= state >> 7U, state ^= state << 17U;
    byte = static_cast<char>(state);
  }
  return bytes;
}

std::span<const std::byte> piece(const std::string& text) { return std::as_bytes(std::span(text)); }

TEST(LikelySaving, IsNearTheRealSaving) {
  const std::string text = text_of(3'000'000), random = noise(3'000'000);
  const auto real = [](const std::string& bytes) {
    const auto size = static_cast<double>(encode(Coding::zstd, bytes, Effort::fast).size());
    return 1 - size / static_cast<double>(bytes.size());
  };
  EXPECT_NEAR(likely_saving({piece(text)}), real(text), 0.1);
  EXPECT_LT(likely_saving({piece(random)}), 0.01);
  EXPECT_NEAR(likely_saving({piece(text), piece(random)}), real(text) / 2, 0.1);
  std::vector<std::span<const std::byte>> small;  // pieces that are shorter than a sample
  for (std::size_t from = 0; from < text.size(); from += 1'000)
    small.push_back(piece(text).subspan(from, 1'000));
  EXPECT_NEAR(likely_saving(small), real(text), 0.15);
}

TEST(LikelySaving, CountsImagesAsNotCompressible) {
  const std::string text(100'000, 'a');
  for (const std::string& start :
       {std::string("\x89PNG\r\n\x1a\n"), std::string("\xABKTX 20"), std::string("RIFF\0\0\0\0WEBPVP8L", 16),
        std::string("\xFF\xD8\xFF\xE0")}) {
    const std::string image = start + text;
    EXPECT_EQ(likely_saving({piece(image)}), 0) << start;
    EXPECT_NEAR(likely_saving({piece(image), piece(text)}), 0.5, 0.01) << start;
  }
  EXPECT_GT(likely_saving({piece(text)}), 0.99);
  EXPECT_EQ(likely_saving({}), 0);
}

}  // namespace
}  // namespace seedmesh
