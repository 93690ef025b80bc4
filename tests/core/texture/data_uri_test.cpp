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

TEST(DataUri, GivesTheFileByteForByte) {
  const Job job(1, Job::Options{});
  const auto image = image_of_data_uri(red, "red", job);
  ASSERT_TRUE(image) << image.error().issues.front().message;
  EXPECT_EQ((*image)->mime, "image/png");
  EXPECT_EQ((*image)->bytes.size(), 69U);
  EXPECT_EQ((*image)->bytes[1], 'P');
}

TEST(DataUri, RefusesWhatIsNoPicture) {
  EXPECT_NE(fault_of("https://example.org/a.png").find("expected \"data:image/png;base64,"),
            std::string::npos);
  EXPECT_EQ(fault_of("data:image/png;base64,!!!!"), "found characters that are no base64");
  EXPECT_EQ(fault_of("data:image/jpeg;base64,AAAA"), "found no JPEG file, or only a part of one");
  EXPECT_FALSE(fault_of("data:image/png;base64,AAAA").empty());
  EXPECT_FALSE(fault_of("data:image/png;base64,").empty());
}

TEST(DataUri, SaysWhatWasFoundInPlaceOfAPicture) {
  using testing::StartsWith;
  EXPECT_THAT(fault_of_image_uri("https://example.org/bark.png"),
              StartsWith("found \"https://example.org/bark.png\", which is no such picture; expected"));
  EXPECT_THAT(fault_of_image_uri("data:image/webp;base64,UklGRg=="),
              StartsWith("found \"data:image/webp…\""));
  EXPECT_THAT(fault_of_image_uri("\xC3\xA9"), StartsWith("found no image; expected"));
}

TEST(DataUri, RefusesAPictureThatIsCutShort) {
  for (std::size_t length = 30; length + 4 < red.size(); length += 4)
    EXPECT_FALSE(fault_of(red.substr(0, length)).empty());
}

TEST(DataUri, TellsOfAPictureThatIsCutShortWithoutItsPixels) {
  EXPECT_EQ(fault_of_image_uri(red), "");
  for (std::size_t length = 24; length + 4 < red.size(); length += 4)
    EXPECT_FALSE(fault_of_image_uri(red.substr(0, length)).empty()) << length;
  EXPECT_EQ(fault_of_image_uri("data:image/png;base64,iVBORw0KGgo="),
            "the PNG is truncated: it ends after 8 bytes, before its data do");
}

TEST(DataUri, TellsWhetherAPictureHasAlpha) {
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
