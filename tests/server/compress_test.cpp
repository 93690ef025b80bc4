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
    for (const Effort effort : {Effort::model, Effort::text, Effort::once})
      EXPECT_EQ(decoded(GetParam(), encode(GetParam(), text, effort), size), text) << size;
  }
}

TEST_P(Encoding, JoinsPieces) {
  const std::string text = text_of(3'000'000);
  const auto all = std::as_bytes(std::span(text));
  const std::vector<std::span<const std::byte>> pieces = {all.first(10), all.subspan(10, 2'000'000),
                                                          all.subspan(2'000'010)};
  EXPECT_EQ(decoded(GetParam(), encode(GetParam(), pieces, Effort::model), text.size()), text);
}

TEST_P(Encoding, MakesTextSmaller) {
  const std::string text(100'000, 'x');
  EXPECT_LT(encode(GetParam(), text, Effort::model).size(), 2'000U);
}

INSTANTIATE_TEST_SUITE_P(All, Encoding, testing::Values(Coding::gzip, Coding::br, Coding::zstd));

TEST(Encode, HasNothingToDoForIdentity) {
  EXPECT_THROW(encode(Coding::identity, "x", Effort::text), std::invalid_argument);
}

}  // namespace
}  // namespace seedmesh
