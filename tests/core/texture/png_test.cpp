#include "core/texture/png.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <bit>
#include <string>
#include <vector>

namespace seedmesh::texture {
namespace {

using ::testing::HasSubstr;

Job job_with_memory(std::uint64_t bytes) {
  Job::Options options;
  options.limits.memory_bytes = bytes;
  return Job(0, options);
}
Job any_job() { return job_with_memory(std::uint64_t{1} << 30U); }

/// Bytes without a pattern, so that every filter and both bytes of a sample matter.
std::vector<std::uint8_t> noise(std::size_t count) {
  Rng rng(7);
  std::vector<std::uint8_t> bytes(count);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(rng.next());
  return bytes;
}

std::string text_of(const Array<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

void append_word(std::string& text, std::uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(word >> shift & 0xFFU);
}

std::uint32_t crc(std::string_view text) {
  std::uint32_t value = 0xFFFFFFFFU;
  for (const char c : text) {
    value ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1U) ^ (value & 1U ? 0xEDB88320U : 0U);
  }
  return ~value;
}

std::string chunk(const std::string& kind, const std::string& data) {
  std::string text;
  append_word(text, static_cast<std::uint32_t>(data.size()));
  text += kind + data;
  append_word(text, crc(kind + data));
  return text;
}

/// The start of a file that claims to have this size: 8 bits, grey.
std::string head(std::uint32_t width, std::uint32_t height) {
  std::string size;
  append_word(size, width);
  append_word(size, height);
  return std::string("\x89PNG\r\n\x1A\n", 8) + chunk("IHDR", size + std::string("\x08\0\0\0\0", 5));
}

std::string a_file() {
  const Job job = any_job();
  const auto bytes = noise(64);
  return text_of(encode_png({8, 8, 1, 8, std::as_bytes(std::span(bytes))}, PngEffort::small, job));
}

std::string refusal(const std::string& file) {
  const Job job = any_job();
  const Result<Picture> picture = decode_png(bytes_of(file), {}, job);
  EXPECT_FALSE(picture);
  return picture ? "" : picture.error().issues.front().message;
}

TEST(Png, PreservesEveryPixelOfEveryKind) {
  const Job job = any_job();
  for (const int channels : {1, 2, 3, 4}) {
    for (const int bits : {8, 16}) {
      for (const PngEffort effort : {PngEffort::streamed, PngEffort::quick, PngEffort::small}) {
        const auto bytes = noise(std::size_t{19} * 70 * static_cast<std::size_t>(channels * bits / 8));
        const PictureView picture{19, 70, channels, bits, std::as_bytes(std::span(bytes))};
        const Array<std::uint8_t> file = encode_png(picture, effort, job);
        const Result<Picture> again = decode_png(std::as_bytes(file.span()), {}, job);
        ASSERT_TRUE(again) << again.error().issues.front().message;
        EXPECT_EQ(again->width, 19U);
        EXPECT_EQ(again->height, 70U);
        EXPECT_EQ(again->channels, channels);
        EXPECT_EQ(again->bits, bits);
        EXPECT_TRUE(std::ranges::equal(again->bytes, bytes)) << channels << " of " << bits;
      }
    }
  }
}

TEST(Png, ReadsAPaletteAsItsColours) {
  const Job job = any_job();
  const std::vector<std::uint8_t> numbers = {0, 1, 2, 2, 1, 0};
  const std::vector<glm::u8vec3> colors = {{1, 2, 3}, {40, 50, 60}, {255, 0, 128}};
  const Array<std::uint8_t> file =
      encode_png({3, 2, 1, 8, std::as_bytes(std::span(numbers)), colors}, PngEffort::quick, job);
  const Result<Picture> picture = decode_png(std::as_bytes(file.span()), {}, job);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->channels, 3);
  EXPECT_THAT(picture->bytes.span(), testing::ElementsAre(1, 2, 3, 40, 50, 60, 255, 0, 128,  //
                                                          255, 0, 128, 40, 50, 60, 1, 2, 3));
}

TEST(Png, Stores16BitsWithTheHighByteFirst) {
  const Job job = any_job();
  const std::vector<std::uint16_t> pixel = {0x1234};
  const Array<std::uint8_t> file =
      encode_png({1, 1, 1, 16, std::as_bytes(std::span(pixel))}, PngEffort::streamed, job);
  const Result<Picture> picture = decode_png(std::as_bytes(file.span()), {}, job);
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->channel(0), 0x1234U);
  // IHDR says so, and no chunk carries a time.
  EXPECT_EQ(file[24], 16);
  EXPECT_EQ(text_of(file).find("tIME"), std::string::npos);
}

TEST(Png, ReportsTruncationWhereverAFileEnds) {
  const std::string file = a_file();
  for (std::size_t size = 8; size < file.size(); ++size) {
    EXPECT_THAT(refusal(file.substr(0, size)), HasSubstr("truncated")) << size;
  }
  EXPECT_THAT(refusal(file.substr(0, 5)), HasSubstr("5 bytes without the signature of a PNG"));
  EXPECT_THAT(refusal(""), HasSubstr("0 bytes"));
}

TEST(Png, RejectsAnyFlippedBit) {
  const std::string file = a_file();
  constexpr std::size_t last_sum =
      4;  // of IEND, which holds nothing; newer versions of libpng do not look at it
  for (std::size_t at = 8; at < file.size() - last_sum; ++at) {
    std::string damaged = file;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    EXPECT_NE(refusal(damaged), "") << at;
  }
}

TEST(Png, RejectsABombByItsSizeBeforeItAllocates) {
  const Job job = job_with_memory(1000);
  const std::string file = head(60'000, 60'000) + chunk("IDAT", std::string(100, '\0')) + chunk("IEND", "");
  const Result<Picture> picture = decode_png(bytes_of(file), {}, job);
  ASSERT_FALSE(picture);
  EXPECT_EQ(picture.error().issues.front().message,
            "the PNG has 60000 x 60000 pixels; a side may have 16385");
}

TEST(Png, RejectsASizeThatItsBytesCannotHold) {
  const Job job = job_with_memory(1000);
  const std::string file = head(16'000, 16'000) + chunk("IDAT", std::string(100, '\0')) + chunk("IEND", "");
  const Result<Picture> picture = decode_png(bytes_of(file), {}, job);
  ASSERT_FALSE(picture);
  EXPECT_THAT(picture.error().issues.front().message, HasSubstr("cannot hold 16000 x 16000 pixels"));
}

TEST(Png, ChargesItsPixelsToTheRequest) {
  const Job job = job_with_memory(63);
  const std::string file = a_file();
  EXPECT_THROW((void)decode_png(bytes_of(file), {}, job), Stop);
  EXPECT_EQ(job.budget()->used(), 0U);
  const auto bytes = noise(64);
  EXPECT_THROW(encode_png({8, 8, 1, 8, std::as_bytes(std::span(bytes))}, PngEffort::streamed, job), Stop);
  EXPECT_EQ(job.budget()->used(), 0U);
}

TEST(Png, ExpandsPalettesToColoursAndFewBitsToEight) {
  const std::string zlib_of_one_row("\x78\x01\x01\x02\x00\xFD\xFF\x00\x1B\x00\x1D\x00\x1C", 13);
  std::string size;
  append_word(size, 4);
  append_word(size, 1);
  const std::string start = std::string("\x89PNG\r\n\x1A\n", 8);
  const std::string palette =
      chunk("PLTE", std::string("\x01\x02\x03\x04\x05\x06\x07\x08\x09\x0A\x0B\x0C", 12));
  const std::string colours = start + chunk("IHDR", size + std::string("\x02\x03\0\0\0", 5)) + palette +
                              chunk("IDAT", zlib_of_one_row) + chunk("IEND", "");
  const Job job = any_job();
  const Result<Picture> coloured = decode_png(bytes_of(colours), {}, job);
  ASSERT_TRUE(coloured) << coloured.error().issues.front().message;
  EXPECT_EQ(coloured->channels, 3);
  EXPECT_EQ(std::vector<int>(coloured->bytes.begin(), coloured->bytes.end()),
            (std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}));

  const std::string greys = start + chunk("IHDR", size + std::string("\x02\x00\0\0\0", 5)) +
                            chunk("IDAT", zlib_of_one_row) + chunk("IEND", "");
  const Result<Picture> grey = decode_png(bytes_of(greys), {}, job);
  ASSERT_TRUE(grey) << grey.error().issues.front().message;
  EXPECT_EQ(std::vector<int>(grey->bytes.begin(), grey->bytes.end()), (std::vector<int>{0, 85, 170, 255}));
}

TEST(Png, RejectsPixelsWithoutAHeaderAndAHeaderWithoutPixels) {
  const std::string signature("\x89PNG\r\n\x1A\n", 8);
  EXPECT_THAT(refusal(signature + chunk("IDAT", "x") + chunk("IEND", "")), HasSubstr("damaged"));
  EXPECT_THAT(refusal(head(2, 2) + chunk("IEND", "")), HasSubstr("damaged"));
  EXPECT_THAT(refusal(head(0, 2) + chunk("IEND", "")), HasSubstr("damaged"));
  EXPECT_THAT(refusal(head(0x80000000U, 2) + chunk("IEND", "")), HasSubstr("damaged"));
}

}  // namespace
}  // namespace seedmesh::texture
