#include "core/texture/data_uri.h"

#include <gmock/gmock.h>

namespace seedmesh::texture {
namespace {

// One red texel.
constexpr std::string_view red =
    "data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC";

std::string fault_of(std::string_view text) {
  const Job job(1, Job::Options{});
  const auto image = image_of_data_uri(text, "x", job);
  return image ? "" : image.error().issues.front().message;
}

TEST(DataUri, ReturnsTheFileByteForByte) {
  const Job job(1, Job::Options{});
  const auto image = image_of_data_uri(red, "red", job);
  ASSERT_TRUE(image) << image.error().issues.front().message;
  EXPECT_EQ((*image)->mime, "image/png");
  EXPECT_EQ((*image)->bytes.size(), 69U);
  EXPECT_EQ((*image)->bytes[1], 'P');
}

TEST(DataUri, ReadsBase64WithOrWithoutPaddingAndAsDataUri) {
  const Job job(1, Job::Options{});
  for (const char* text : {"TWE=", "TWE", "data:image/png;base64,TWE="}) {
    const Result<Array<std::uint8_t>> bytes = bytes_of_base64(text, job);
    ASSERT_TRUE(bytes) << text;
    EXPECT_EQ(std::string(bytes->begin(), bytes->end()), "Ma");
  }
  for (const char* text : {"data:image/png,TWE", "TWE!", "TWEaT"})
    EXPECT_FALSE(bytes_of_base64(text, job)) << text;
}

TEST(DataUri, GivesTheMeanOfTheChannelsAsBrightness) {
  const Job job(1, Job::Options{});
  const Result<Brightness> image = brightness_of_png(red, job);
  ASSERT_TRUE(image) << image.error().issues.front().message;
  EXPECT_EQ(image->width, 1U);
  EXPECT_EQ(image->height, 1U);
  ASSERT_EQ(image->values.size(), 1U);
  EXPECT_FLOAT_EQ(image->values[0], 1.0F / 3);
}

TEST(DataUri, RejectsOtherFiles) {
  EXPECT_NE(fault_of("https://example.org/a.png").find("expected \"data:image/png;base64,"),
            std::string::npos);
  EXPECT_EQ(fault_of("data:image/png;base64,!!!!"), "found characters that are not base64");
  EXPECT_EQ(fault_of("data:image/jpeg;base64,AAAA"), "found no complete JPEG file");
  EXPECT_FALSE(fault_of("data:image/png;base64,AAAA").empty());
  EXPECT_FALSE(fault_of("data:image/png;base64,").empty());
}

TEST(DataUri, ReportsWhatWasFoundInsteadOfAnImage) {
  using testing::StartsWith;
  EXPECT_THAT(error_of_image_uri("https://example.org/bark.png"),
              StartsWith("found \"https://example.org/bark.png\", which is not such an image; expected"));
  EXPECT_THAT(error_of_image_uri("data:image/webp;base64,UklGRg=="),
              StartsWith("found \"data:image/webp…\""));
  EXPECT_THAT(error_of_image_uri("\xC3\xA9"), StartsWith("found no image; expected"));
}

TEST(DataUri, RejectsATruncatedImage) {
  for (std::size_t length = 30; length + 4 < red.size(); length += 4)
    EXPECT_FALSE(fault_of(red.substr(0, length)).empty());
}

TEST(DataUri, DetectsATruncatedImageWithoutDecodingIt) {
  EXPECT_EQ(error_of_image_uri(red), "");
  for (std::size_t length = 24; length + 4 < red.size(); length += 4)
    EXPECT_FALSE(error_of_image_uri(red.substr(0, length)).empty()) << length;
  EXPECT_EQ(error_of_image_uri("data:image/png;base64,iVBORw0KGgo="),
            "the PNG is truncated: it ends after 8 bytes, before the end of its data");
}

// Files of 3 x 2 texels by libvips: baseline, and progressive.
constexpr std::string_view jpegs[] = {
    "/9j/2wBDAP//////////////////////////////////////////////////////////////////////////////////////2wBDAf//"
    "//"
    "//////////////////////////////////////////////////////////////////////////////////"
    "wAARCAACAAMDASIAAhEBAxEB/"
    "8QAFQABAQAAAAAAAAAAAAAAAAAAAAL/xAAUEAEAAAAAAAAAAAAAAAAAAAAA/8QAFQEBAQAAAAAAAAAAAAAAAAAAAQP/"
    "xAAUEQEAAAAAAAAAAAAAAAAAAAAA/9oADAMBAAIRAxEAPwCQAo//2Q==",
    "/9j/2wBDAP//////////////////////////////////////////////////////////////////////////////////////2wBDAf//"
    "//"
    "//////////////////////////////////////////////////////////////////////////////////"
    "wgARCAACAAMDASIAAhEBAxEB/"
    "8QAFQABAQAAAAAAAAAAAAAAAAAAAAH/xAAVAQEBAAAAAAAAAAAAAAAAAAABAv/aAAwDAQACEAMQAAABgK//"
    "xAAUEAEAAAAAAAAAAAAAAAAAAAAA/"
    "9oACAEBAAEFAn//xAAUEQEAAAAAAAAAAAAAAAAAAAAA/9oACAEDAQE/AX//xAAUEQEAAAAAAAAAAAAAAAAAAAAA/9oACAECAQE/AX//"
    "xAAUEAEAAAAAAAAAAAAAAAAAAAAA/9oACAEBAAY/An//xAAUEAEAAAAAAAAAAAAAAAAAAAAA/9oACAEBAAE/IX//"
    "2gAMAwEAAgADAAAAEAv/"
    "xAAUEQEAAAAAAAAAAAAAAAAAAAAA/9oACAEDAQE/EH//xAAUEQEAAAAAAAAAAAAAAAAAAAAA/9oACAECAQE/EH//"
    "xAAUEAEAAAAAAAAAAAAAAAAAAAAA/9oACAEBAAE/EH//2Q=="};

TEST(DataUri, ReadsTheSizeOfAJpeg) {
  const std::string head = "data:image/jpeg;base64,";
  for (const std::string_view file : jpegs) {
    EXPECT_EQ(fault_of(head + std::string(file)), "");
    // "CAACAAMD" is 08 0002 0003 03: the precision, height, width and components of the frame header.
    const auto with_size = [&](std::string_view size) {
      std::string changed(file);
      return head + changed.replace(changed.find("CAACAAMD"), 8, size);
    };
    EXPECT_EQ(fault_of(with_size("CCAAIAAD")), "") << "8192 x 8192";
    EXPECT_EQ(fault_of(with_size("CCABAAMD")), "the JPEG has 3 x 8193 pixels; a side may have 8192");
    EXPECT_EQ(fault_of(with_size("CAAC//8D")), "the JPEG has 65535 x 2 pixels; a side may have 8192");
    EXPECT_EQ(fault_of(with_size("CAAAAAMD")), "the JPEG does not state its size");
  }
  EXPECT_EQ(fault_of(head + "/9j/2Q=="), "found no complete JPEG file") << "no frame at all";
  EXPECT_EQ(fault_of(head + "/9j/4AAA/8AAEQgAAQAB/9k="), "found no complete JPEG file")
      << "a segment of no length";
}

TEST(DataUri, DetectsAnAlphaChannel) {
  Job job(0, Job::Options{});
  const std::string head = "data:image/png;base64,";
  const std::pair<std::string, bool> pictures[] = {
      {"iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGMwOmEDAAJmATdXu5wqAAAAAElFTkSuQmCC", false},
      {"iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR4nGMwOmHDAAADnQE3dmMj8wAAAABJRU5ErkJggg==",
       true},
      // RGB with one transparent colour
      {"iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAABnRSTlMAMgDIADwFlFcIAAAADElEQVR4nGMwOmEDAAJmATdXu5wqA"
       "AAAAElFTkSuQmCC",
       true}};
  for (const auto& [file, expected] : pictures) {
    const auto image = image_of_data_uri(head + file, "leaf", job);
    ASSERT_TRUE(image);
    EXPECT_EQ(has_alpha(**image), expected) << file;
  }
}

}  // namespace
}  // namespace seedmesh::texture
