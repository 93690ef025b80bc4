#include "core/texture/paint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "core/texture/leaf.h"
#include "core/texture/png.h"
#include "core/texture/wall.h"

namespace seedmesh::texture {
namespace {

Job job_of(int threads = 1) { return Job(1, Job::Options{.threads = threads}); }

Picture decoded(const Image& image) {
  const Job job = job_of();
  Result<Picture> picture = decode_png(std::as_bytes(std::span(image.bytes)), {}, job);
  EXPECT_TRUE(picture);
  return *std::move(picture);
}

Maps maps_of(std::string_view kind, int size, std::uint64_t seed, int threads = 1) {
  const Job job = job_of(threads);
  const Painting painting = paint_kind(kind, size, seed, {}, job);
  return make_maps(painting.relief, painting.finish, std::string(kind), {}, job);
}

int at(const Picture& picture, std::size_t x, std::size_t y, std::size_t channel) {
  const auto channels = static_cast<std::size_t>(picture.channels);
  return picture.bytes[(y * picture.width + x) * channels + channel];
}

/// Mean difference of neighbouring columns `x` and `x + 1`, where the last column is next to the first.
double step_over(const Picture& picture, std::size_t x) {
  double sum = 0;
  for (std::size_t y = 0; y < picture.height; ++y) {
    for (std::size_t c = 0; c < static_cast<std::size_t>(std::min(picture.channels, 3)); ++c)
      sum += std::abs(at(picture, x, y, c) - at(picture, (x + 1) % picture.width, y, c));
  }
  return sum / picture.height;
}

class Kinds : public testing::TestWithParam<std::string_view> {};

TEST_P(Kinds, AreTheSameWithAnyNumberOfThreadsAndDifferBySeed) {
  const Maps one = maps_of(GetParam(), 64, 7, 1), more = maps_of(GetParam(), 64, 7, 4),
             other = maps_of(GetParam(), 64, 8);
  EXPECT_EQ(one.color->bytes, more.color->bytes);
  EXPECT_EQ(one.normal->bytes, more.normal->bytes);
  EXPECT_EQ(one.surface->bytes, more.surface->bytes);
  EXPECT_NE(one.color->bytes, other.color->bytes);
}

TEST_P(Kinds, HaveNormalsOfUnitLengthThatFaceOutward) {
  const Picture normals = decoded(*maps_of(GetParam(), 128, 3).normal);
  for (std::size_t y = 0; y < normals.height; ++y) {
    for (std::size_t x = 0; x < normals.width; ++x) {
      double squared = 0;
      for (std::size_t c = 0; c < 3; ++c) squared += std::pow(at(normals, x, y, c) / 127.5 - 1, 2);
      ASSERT_NEAR(std::sqrt(squared), 1, 0.02);
      ASSERT_GT(at(normals, x, y, 2), 127);
    }
  }
}

TEST_P(Kinds, AreNoMetalAndNeverAMirrorButGlass) {
  const int least = std::string_view(GetParam()) == "rooms" ? 10 : 60;
  const Picture surface = decoded(*maps_of(GetParam(), 128, 3).surface);
  for (std::size_t y = 0; y < surface.height; ++y) {
    for (std::size_t x = 0; x < surface.width; ++x) {
      ASSERT_GT(at(surface, x, y, 1), least);
      ASSERT_EQ(at(surface, x, y, 2), 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Kinds, testing::ValuesIn(texture_kinds().begin(), texture_kinds().end()),
                         [](const auto& kind) { return std::string(kind.param); });

TEST(Bark, AndWallsRepeatWithoutASeam) {
  for (const std::string_view kind : texture_kinds()) {
    if (!is_repeating_kind(kind)) continue;
    const Picture color = decoded(*maps_of(kind, 256, 5).color);
    double most = 0;
    for (std::size_t x = 0; x + 1 < color.width; ++x) most = std::max(most, step_over(color, x));
    EXPECT_LE(step_over(color, color.width - 1), 1.05 * most) << kind;
  }
}

TEST(Bark, TakesTheColourOfTheRequest) {
  const Job job = job_of();
  const Painting painting = paint_kind("oak_bark", 64, 1, Tint{{10, 20, 200}}, job);
  const Picture color = decoded(*make_maps(painting.relief, painting.finish, "x", {}, job).color);
  double red = 0, blue = 0;
  for (std::size_t y = 0; y < 64; ++y) {
    for (std::size_t x = 0; x < 64; ++x) {
      red += at(color, x, y, 0);
      blue += at(color, x, y, 2);
    }
  }
  EXPECT_GT(blue, 8 * red);
}

TEST(Wall, TexturesAreSmallFiles) {
  for (const WallKind& kind : wall_kinds()) {
    const Maps maps = maps_of(kind.name, 512, 0);
    // Blades and stones have more detail than walls.
    EXPECT_LT(maps.bytes(), kind.name.ends_with("_ground") ? 900'000U : 310'000U) << kind.name;
    EXPECT_EQ(decoded(*maps.color).channels, kind.name == "grime" ? 4 : kind.is_grey ? 1 : 3) << kind.name;
    EXPECT_GT(kind.tile.x, 0.5);
  }
}

TEST(Wall, GreyOnesHaveTheGreyThatTakesAColour) {
  for (const WallKind& kind : wall_kinds()) {
    if (!kind.is_grey) continue;
    const Picture color = decoded(*maps_of(kind.name, 128, 3).color);
    double sum = 0;
    for (std::size_t i = 0; i < std::size_t{128} * 128; ++i) sum += linear_of_srgb(color.bytes[i]);
    const double mean = sum / (128.0 * 128), grey = static_cast<double>(grey_of(kind.name));
    EXPECT_GT(mean, 0.7 * grey) << kind.name;
    EXPECT_LT(mean, 1.2 * grey) << kind.name;
  }
}

TEST(Wall, BaysHaveOneWindowWithAFrameAndABar) {
  // A window of 1.1 m by 1.3 m in a bay of 2.7 m by 2.8 m, with a frame of 8 cm and a bar of 6 cm.
  const double glass = (1.1 - 2 * 0.08 - 0.06) * (1.3 - 2 * 0.08) / (2.7 * 2.8);
  for (const std::string_view kind : {"brick_bay", "plaster_bay", "planks_bay", "ashlar_bay"}) {
    const Picture color = decoded(*maps_of(kind, 256, 3).color);
    std::size_t dark = 0, dark_in_upper_half = 0;
    for (std::size_t y = 0; y < color.height; ++y) {
      for (std::size_t x = 0; x < color.width; ++x) {
        if (at(color, x, y, 0) > 90) continue;
        ++dark;
        dark_in_upper_half += y < color.height / 2 ? 1U : 0U;
      }
    }
    const double count = static_cast<double>(color.width) * color.height;
    EXPECT_NEAR(static_cast<double>(dark) / count, glass, 0.01) << kind;
    // It reaches from 0.98 m to 2.12 m, and the middle of the bay is at 1.4 m.
    EXPECT_NEAR(static_cast<double>(dark_in_upper_half) / static_cast<double>(dark), 0.72 / 1.14, 0.04)
        << kind;
  }
}

TEST(Wall, BricksOfTwoColoursShareTheirRelief) {
  Model model;
  for (const std::uint8_t red : std::array<std::uint8_t, 3>{120, 160, 120}) {
    Material material;
    material.recipe.kind = "brick";
    material.recipe.color = {{red, 80, 60}};
    model.materials.push_back(material);
  }
  paint(model, 64, {}, nullptr, job_of());
  EXPECT_EQ(model.textures.size(), 4U);  // two of colour, normals, surface
  const auto& m = model.materials;
  EXPECT_EQ(m[0].base_color_texture.texture, m[2].base_color_texture.texture);
  EXPECT_NE(m[0].base_color_texture.texture, m[1].base_color_texture.texture);
  EXPECT_EQ(m[0].normal_texture.texture, m[1].normal_texture.texture);
  EXPECT_TRUE(m[0].base_color_texture.repeat);
  EXPECT_EQ(m[0].alpha_mode, AlphaMode::opaque);
}

TEST(Wall, DirtFadesAwayBelowSillsAndAboveTheGround) {
  const Picture color = decoded(*maps_of("grime", 128, 0).color);
  const auto dirt = [&](int y) {
    double sum = 0;
    for (std::size_t x = 0; x < 128; ++x) sum += at(color, x, static_cast<std::size_t>(y), 3);
    return sum / 128;
  };
  EXPECT_GT(dirt(2), 30) << "below a sill";
  EXPECT_LT(dirt(62), 2);
  EXPECT_LT(dirt(66), 2);
  EXPECT_GT(dirt(126), 40) << "at the ground";
}

TEST(Wall, WindowsShowRoomsThatAreDarkAndDiffer) {
  const Picture color = decoded(*maps_of("rooms", 256, 0).color);
  std::set<double> means;
  double all = 0;
  for (std::size_t room = 0; room < 16; ++room) {
    double sum = 0;
    for (std::size_t y = 0; y < 64; ++y) {
      for (std::size_t x = 0; x < 64; ++x) {
        const auto byte = static_cast<std::uint8_t>(at(color, room % 4 * 64 + x, room / 4 * 64 + y, 1));
        sum += static_cast<double>(linear_of_srgb(byte));
      }
    }
    all += sum / (16 * 64 * 64);
    means.insert(sum);
  }
  EXPECT_EQ(means.size(), 16U);
  // Glass reflects 2 to 5 percent, with what shows in it.
  EXPECT_GT(all, 0.02);
  EXPECT_LT(all, 0.05);
}

TEST(Leaf, IsCutOutWithAnEmptyBorder) {
  for (const std::string_view kind : leaf_kinds()) {
    const Picture color = decoded(*maps_of(kind, 128, 5).color);
    ASSERT_EQ(color.channels, 4);
    std::size_t opaque = 0, on_border = 0;
    for (std::size_t y = 0; y < 128; ++y) {
      for (std::size_t x = 0; x < 128; ++x) {
        const bool is_there = at(color, x, y, 3) > 102;
        opaque += is_there ? 1U : 0U;
        on_border += is_there && (x == 0 || y == 0 || x == 127 || y == 127) ? 1U : 0U;
      }
    }
    EXPECT_GT(opaque, 128U * 128U / 6) << kind << " leaves its texture empty";
    EXPECT_EQ(on_border, 0U) << kind;
  }
}

TEST(Leaf, CoversWhatItsOutlineEncloses) {
  const Picture color = decoded(*maps_of("kite_leaf", 256, 1).color);
  double covered = 0;
  for (std::size_t y = 0; y < 256; ++y) {
    for (std::size_t x = 0; x < 256; ++x) covered += at(color, x, y, 3) / 255.0;
  }
  // A kite is half of its box, and the box has 2 % of room on each side.
  EXPECT_NEAR(covered / (256 * 256), 0.5 / (1.04 * 1.04), 0.002);
}

/// The share of opaque texels of each of six mip levels, whose texels are means of two by two.
std::vector<double> coverage_by_level(const Picture& picture, double cutoff) {
  std::size_t size = picture.width;
  std::vector<double> alpha, shares;
  for (std::size_t i = 3; i < picture.bytes.size(); i += 4) alpha.push_back(picture.bytes[i] / 255.0);
  for (int level = 0; level < 6; ++level, size /= 2) {
    const auto opaque =
        std::count_if(alpha.begin(), alpha.end(), [&](double each) { return each >= cutoff; });
    shares.push_back(static_cast<double>(opaque) / static_cast<double>(alpha.size()));
    std::vector<double> next;
    for (std::size_t y = 0; y < size; y += 2) {
      for (std::size_t x = 0; x < size; x += 2) {
        next.push_back((alpha[y * size + x] + alpha[y * size + x + 1] + alpha[(y + 1) * size + x] +
                        alpha[(y + 1) * size + x + 1]) /
                       4);
      }
    }
    alpha = std::move(next);
  }
  return shares;
}

/// Twigs neither close to paddles nor vanish: packs of trees on sale keep the coverage within a tenth.
TEST(Leaf, KeepsItsCoverageInTheDistance) {
  for (const std::string_view kind : leaf_kinds()) {
    const bool is_twig = leaf_picture(kind).count > 1;
    const Picture picture = decoded(*maps_of(kind, is_twig ? 512 : 256, 3).color);
    const std::vector<double> shares = coverage_by_level(picture, static_cast<double>(leaf_cutoff(kind)));
    const double most = is_twig                                                              ? 0.12
                        : kind == "needles" || kind == "pine_needles" || kind == "palm_leaf" ? 0.25
                                                                                             : 0.12;
    for (const double share : shares) EXPECT_NEAR(share, shares[0], most * shares[0]) << kind;
  }
}

TEST(Paint, MakesOneImageForEqualRecipes) {
  Model model;
  model.materials.resize(3);
  model.materials[0].recipe = {"oak_bark", 1, {}};
  model.materials[1].recipe = {"oak_bark", 1, {}};
  model.materials[2].recipe = {"birch_leaf", 1, {}};
  const Job job = job_of();
  paint(model, 32, {}, nullptr, job);
  EXPECT_EQ(model.textures.size(), 6U);
  EXPECT_EQ(model.materials[0].base_color_texture.texture, model.materials[1].base_color_texture.texture);
  EXPECT_EQ(model.materials[0].alpha_mode, AlphaMode::opaque);
  EXPECT_EQ(model.materials[2].alpha_mode, AlphaMode::mask);
  EXPECT_TRUE(model.materials[2].double_sided);
}

/// Keeps everything and counts.
struct Store : TextureStore {
  std::shared_ptr<const void> find(const std::string& key) override {
    const auto found = kept.find(key);
    hits += found == kept.end() ? 0 : 1;
    return found == kept.end() ? nullptr : found->second;
  }
  void keep(const std::string& key, std::shared_ptr<const void> value, std::uint64_t bytes) override {
    EXPECT_GT(bytes, 0U);
    kept.emplace(key, std::move(value));
  }
  std::map<std::string, std::shared_ptr<const void>> kept;
  int hits = 0;
};

TextureRecipe recipe_of(std::string kind, bool has_own_sides = false) {
  TextureRecipe recipe;
  recipe.kind = std::move(kind);
  recipe.has_own_sides = has_own_sides;
  return recipe;
}

TEST(Paint, MakesNoNormalsThatNoMaterialShows) {
  for (const bool is_linked : {false, true}) {
    Model model;
    model.materials.resize(3);
    model.materials[0].recipe = recipe_of("rooms", true);
    model.materials[1].recipe = recipe_of("grime", true);
    model.materials[2].recipe = recipe_of("grime");
    paint(model, 64, {.is_linked = is_linked}, nullptr, job_of());
    EXPECT_EQ(model.textures.size(), 5U);  // two of the rooms, three of the dirt
    EXPECT_EQ(model.materials[0].normal_texture.texture, -1);
    EXPECT_EQ(model.materials[1].normal_texture.texture, -1);
    EXPECT_GE(model.materials[2].normal_texture.texture, 0);
    for (const auto& image : model.textures) EXPECT_NE(image, nullptr);
  }
}

TEST(Paint, TakesSomeImagesFromAllThatAreStored) {
  Store store;
  const Job job = job_of();
  const TextureRecipe recipe = recipe_of("brick");
  const auto all = texture::maps_of(recipe, 32, {}, &store, job);
  EXPECT_EQ(texture::maps_of(recipe, 32, {.normal = false, .surface = false}, &store, job), all);
  const auto color =
      texture::maps_of(recipe_of("slate"), 32, {.normal = false, .surface = false}, &store, job);
  EXPECT_EQ(color->normal, nullptr);
  EXPECT_EQ(color->surface, nullptr);
  EXPECT_NE(texture::maps_of(recipe_of("slate"), 32, {}, &store, job)->normal, nullptr);
}

TEST(Paint, DrawsDirtAtHalfTheSize) {
  const Job job = job_of();
  EXPECT_EQ(decoded(*texture::maps_of(recipe_of("grime"), 256, {}, nullptr, job)->color).width, 128U);
  EXPECT_EQ(decoded(*texture::maps_of(recipe_of("rooms"), 256, {}, nullptr, job)->color).width, 256U);
}

TEST(Paint, DrawsSingleLeavesAtHalfTheSize) {
  const Job job = job_of();
  for (const std::string kind : {"plaster", "concrete", "brick", "slate", "rooms", "oak_bark"})
    EXPECT_EQ(decoded(*texture::maps_of(recipe_of(kind), 256, {}, nullptr, job)->color).width, 256U) << kind;
  EXPECT_EQ(decoded(*texture::maps_of(recipe_of("oval"), 256, {}, nullptr, job)->color).width, 128U);
}

TEST(Paint, RemovesAllTexturesOnRequest) {
  Model model;
  model.materials.resize(1);
  model.materials[0].recipe = {"oak_bark", 1, {}};
  model.textures.push_back(std::make_shared<Image>());
  model.materials[0].normal_texture.texture = 0;
  const Job job = job_of();
  paint(model, 0, {}, nullptr, job);
  EXPECT_TRUE(model.textures.empty());
  EXPECT_EQ(model.materials[0].normal_texture.texture, -1);
}

TEST(Paint, TakesFromTheStoreWhatItHasPutThere) {
  Store store;
  const Job job = job_of();
  std::vector<std::shared_ptr<const Image>> first;
  for (int i = 0; i < 2; ++i) {
    Model model;
    model.materials.resize(1);
    model.materials[0].recipe = {"pine_bark", 4, {}};
    paint(model, 32, {}, &store, job);
    if (i == 0) first = model.textures;
    EXPECT_EQ(model.textures, first);
  }
  EXPECT_EQ(store.hits, 1);
  Model model;
  model.materials.resize(1);
  model.materials[0].recipe = {"pine_bark", 4, std::array<std::uint8_t, 3>{1, 2, 3}};
  paint(model, 32, {}, &store, job);
  EXPECT_EQ(store.hits, 1) << "another colour is another picture";
}

TEST(Paint, SharesTheReliefOfTwoColours) {
  const Job job = job_of();
  for (const char* const kind : {"oak_bark", "brick", "willow_twig"}) {
    const std::array<std::uint8_t, 3> red{180, 60, 40}, grey{90, 90, 90};
    Model model;
    model.materials.resize(2);
    model.materials[0].recipe = {kind, 4, red};
    model.materials[1].recipe = {kind, 4, grey};
    paint(model, 32, {}, nullptr, job);
    ASSERT_EQ(model.textures.size(), 4U) << kind;
    const Material &first = model.materials[0], &second = model.materials[1];
    EXPECT_EQ(first.normal_texture.texture, second.normal_texture.texture);
    EXPECT_EQ(first.occlusion_texture.texture, second.occlusion_texture.texture);
    EXPECT_NE(first.base_color_texture.texture, second.base_color_texture.texture);
    // The second colour is what a model with this colour alone has.
    Model alone;
    alone.materials.resize(1);
    alone.materials[0].recipe = {kind, 4, grey};
    paint(alone, 32, {}, nullptr, job);
    const auto color = [](const Model& from, const Material& material) {
      return from.textures[static_cast<std::size_t>(material.base_color_texture.texture)]->bytes;
    };
    EXPECT_EQ(color(model, second), color(alone, alone.materials[0]));
  }
}

}  // namespace
}  // namespace seedmesh::texture
