#include "core/texture/link.h"

#include <gtest/gtest.h>

#include "core/texture/paint.h"

namespace seedmesh::texture {
namespace {

Job any_job() { return Job(0, Job::Options{}); }

TEST(TextureLink, ReadsTheNamesThatItWrites) {
  for (const std::string_view kind : texture_kinds()) {
    for (const Channel channel : {Channel::color, Channel::normal, Channel::surface}) {
      Link link{{std::string(kind), 18'446'744'073'709'551'615U, {}, {}}, 64, channel};
      for (const bool has_color : {false, true}) {
        if (has_color) link.recipe.color = {0, 160, 255};
        const std::optional<Link> again = read_link(name_of(link));
        ASSERT_TRUE(again) << name_of(link);
        EXPECT_EQ(again->recipe.kind, kind);
        EXPECT_EQ(again->recipe.seed, link.recipe.seed);
        EXPECT_EQ(again->recipe.color, link.recipe.color);
        EXPECT_EQ(again->size, 64);
        EXPECT_EQ(again->channel, channel);
        EXPECT_LE(name_of(link).size(), 100U);
      }
    }
  }
}

TEST(TextureLink, RefusesNamesThatItNeverWrites) {
  EXPECT_TRUE(read_link("oak_bark.17.512.color"));
  for (const char* name :
       {"", "oak_bark", "oak_bark.17.512", "oak_bark.17.512.colour", "oak_bark.017.512.color",
        "oak.17.512.color", "oak_bark.17.500.color", "oak_bark.17.8.color", "oak_bark.17.8192.color",
        "oak_bark.-1.512.color", "oak_bark.17.512.color.", "oak_bark.17.512.FFFFFF.color",
        "oak_bark.17.512.fff.color", "oak_bark.17.512.ffffff00.color",
        "oak_bark.18446744073709551616.512.color", "oak_bark.17.512.a.b.color"}) {
    EXPECT_FALSE(read_link(name)) << name;
  }
}

TEST(TextureLink, LeadsToTheBytesThatAModelWouldHold) {
  Model embedded, linked;
  for (Model* model : {&embedded, &linked}) {
    model->materials.resize(2);
    model->materials[0].recipe = {"oak_bark", 3, {}, {}};
    model->materials[1].recipe = {"brick", 5, std::array<std::uint8_t, 3>{180, 90, 60}, {}};
  }
  const Job job = any_job();
  paint(embedded, 64, {}, nullptr, job);
  paint(linked, 64, {.is_linked = true, .prefix = "/v1/textures/9-abc."}, nullptr, job);
  ASSERT_EQ(embedded.textures.size(), linked.textures.size());
  for (std::size_t i = 0; i < linked.textures.size(); ++i) {
    const Image& image = *linked.textures[i];
    EXPECT_TRUE(image.bytes.empty());
    EXPECT_EQ(image.name, embedded.textures[i]->name);
    const std::string prefix = "/v1/textures/9-abc.", suffix = ".png";
    ASSERT_TRUE(image.uri.starts_with(prefix) && image.uri.ends_with(suffix)) << image.uri;
    const std::optional<Link> link =
        read_link(image.uri.substr(prefix.size(), image.uri.size() - prefix.size() - suffix.size()));
    ASSERT_TRUE(link) << image.uri;
    EXPECT_EQ(image_of(*link, nullptr, job)->bytes, embedded.textures[i]->bytes);
  }
}

}  // namespace
}  // namespace seedmesh::texture
