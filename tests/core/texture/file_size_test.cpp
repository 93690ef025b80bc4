#include "core/texture/file_size.h"

#include <gtest/gtest.h>

#include "core/texture/paint.h"

namespace seedmesh::texture {
namespace {

std::uint64_t made_bytes(const TextureRecipe& recipe, int size) {
  const Job job(1, Job::Options{});
  return maps_of(recipe, size, {true, true}, nullptr, job)->bytes();
}

std::uint64_t bytes_of(const TextureSizes& sizes, int size) {
  std::uint64_t sum = 0;
  for (const auto& [image, bytes] : sizes.images(size)) sum += bytes;
  return sum;
}

TEST(TextureSizes, AreWithinAQuarterOfTheFilesOfEachKind) {
  for (const std::string_view kind : texture_kinds()) {
    Material material;
    material.recipe.kind = kind;
    material.recipe.seed = 5;
    TextureSizes sizes;
    sizes.add(material);
    const auto made = static_cast<double>(made_bytes(material.recipe, 512));
    EXPECT_NEAR(static_cast<double>(bytes_of(sizes, 512)), made, std::max(0.25 * made, 3'000.0)) << kind;
  }
}

TEST(TextureSizes, FollowTheSizeOfTheImages) {
  for (const int size : {256, 1024}) {
    TextureSizes sizes;
    double made = 0;
    for (const char* kind : {"plaster", "brick", "slate", "oak_bark", "concrete"}) {
      Material material;
      material.recipe.kind = kind;
      sizes.add(material);
      made += static_cast<double>(made_bytes(material.recipe, size));
    }
    EXPECT_NEAR(static_cast<double>(bytes_of(sizes, size)), made, 0.25 * made) << size;
  }
}

TEST(TextureSizes, CountTheSharedImagesOfAKindOnce) {
  Material red, blue;
  red.recipe.kind = blue.recipe.kind = "brick";
  red.recipe.color = {200, 0, 0};
  blue.recipe.color = {0, 0, 200};
  TextureSizes one, both;
  one.add(red);
  both.add(red);
  both.add(blue);
  both.add(blue);
  EXPECT_GT(bytes_of(both, 512), bytes_of(one, 512));
  EXPECT_LT(bytes_of(both, 512), bytes_of(one, 512) * 3 / 2);
  EXPECT_EQ(bytes_of(TextureSizes(), 512), 0U);
}

}  // namespace
}  // namespace seedmesh::texture
