/// Pictures of models against closed forms: the disc of a sphere, the shadow of a box, the light of the sun.
#include "core/render/picture.h"

#include <gmock/gmock.h>

#include <cmath>

#include "core/base/rng.h"
#include "core/render/samples.h"
#include "core/render/shadow.h"

namespace seedmesh::render {
namespace {

Job job_of(int threads = 1) { return Job(1, Job::Options{.threads = threads}); }

void add_vertex(Mesh& mesh, const glm::vec3& position, const glm::vec3& normal) {
  mesh.position.push_back(position);
  mesh.normal.push_back(normal);
}

Mesh empty_mesh(const Job& job) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  return mesh;
}

Model model_of(Mesh mesh) {
  Model model;
  Material material;
  material.base_color = {0.5F, 0.5F, 0.5F, 1};
  model.materials.push_back(material);
  model.meshes.push_back({"mesh", {}});
  model.meshes.back().primitives.push_back({std::move(mesh), 0, {}});
  Node node;
  node.mesh = 0;
  model.nodes.push_back(node);
  return model;
}

/// A sphere of radius 1 around the origin, of `rows` rings.
Model sphere(int rows, const Job& job) {
  Mesh mesh = empty_mesh(job);
  const int columns = 2 * rows;
  for (int i = 0; i <= rows; ++i) {
    for (int j = 0; j <= columns; ++j) {
      const double down = 3.14159265358979 * i / rows, around = 2 * 3.14159265358979 * j / columns;
      const glm::vec3 p(std::sin(down) * std::sin(around), std::cos(down), std::sin(down) * std::cos(around));
      add_vertex(mesh, p, p);
    }
  }
  for (int i = 0; i < rows; ++i) {
    for (int j = 0; j < columns; ++j) {
      const auto a = static_cast<std::uint32_t>(i * (columns + 1) + j),
                 b = a + static_cast<std::uint32_t>(columns) + 1;
      for (const std::uint32_t corner : {a, b, b + 1, a, b + 1, a + 1}) mesh.index.wide.push_back(corner);
    }
  }
  return model_of(std::move(mesh));
}

/// Adds a box as six faces that look outwards.
void add_box(Mesh& mesh, const glm::vec3& low, const glm::vec3& high) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const float side : {-1.0F, 1.0F}) {
      glm::vec3 normal(0), u(0), v(0);
      normal[axis] = side;
      u[(axis + 1) % 3] = 1;
      v[(axis + 2) % 3] = side;
      const auto first = static_cast<std::uint32_t>(mesh.position.size());
      for (const glm::vec2 at : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
        add_vertex(mesh, 0.5F * (low + high) + 0.5F * (high - low) * (normal + at.x * u + at.y * v), normal);
      for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.index.wide.push_back(first + corner);
    }
  }
}

/// The samples of a model, and what they are read from.
struct Drawn {
  Drawn(const Model& model, const Frame& frame, std::uint32_t size, const Job& job,
        const glm::dvec2& share = glm::dvec2(1))
      : items(items_of(model, job)),
        surfaces(model, job),
        scene(scene_of(model, items, surfaces, job)),
        shown(project(scene, Eye(camera_for(model, items, frame, share), size), job)),
        samples(draw_samples(shown, job)) {}
  float near(std::uint32_t x, std::uint32_t y) const { return samples.near[samples.at(x, y)]; }
  Fragment fragment(std::uint32_t x, std::uint32_t y) const {
    const std::size_t at = samples.at(x, y);
    return FragmentReader(shown).at(samples.drawing[at], samples.number[at],
                                    (static_cast<float>(x) + 0.5F) * fixed_one,
                                    (static_cast<float>(y) + 0.5F) * fixed_one);
  }

  Items items;
  Surfaces surfaces;
  Scene scene;
  ProjectedScene shown;
  Samples samples;
};

TEST(Picture, ShowsASphereAsTheDiscThatFitsTheFrame) {
  const Job job = job_of();
  const Model model = sphere(64, job);
  for (const glm::dvec2 view : {glm::dvec2(0, 0), {35, 18.0}, {200, -40}, {90, 89}}) {
    const Drawn drawn(model, frame_of(view.x, view.y), 400, job);
    std::size_t covered = 0;
    for (const float near : drawn.samples.near) covered += near > 0 ? 1 : 0;
    // The sides of the frame stand off by 6 %.
    const double share = static_cast<double>(covered) / (400.0 * 400.0),
                 disc = 3.14159265 / 4 / (1.06 * 1.06);
    EXPECT_NEAR(share, disc, 0.01 * disc) << view.x;
  }
}

TEST(Picture, HasTheNormalsOfASphereInTheMiddle) {
  const Job job = job_of();
  const Model model = sphere(64, job);
  const Frame frame = frame_of(35, 18);
  const Drawn drawn(model, frame, 200, job);
  const glm::dvec3 normal(drawn.fragment(100, 100).normal);
  EXPECT_GT(glm::dot(normal, frame.towards), 0.999);
}

TEST(Picture, FitsASphereIntoTheShorterSide) {
  const Job job = job_of();
  const Model model = sphere(64, job);
  for (const glm::dvec2 share : {glm::dvec2(1, 0.5), {0.5, 1}}) {
    const Drawn drawn(model, frame_of(35, 18), 400, job, share);
    const auto covered = std::ranges::count_if(drawn.samples.near, [](float near) { return near > 0; });
    const double expected = 3.14159265 * 100 * 100 / (1.06 * 1.06);  // a disc in 400 x 200 samples
    EXPECT_NEAR(static_cast<double>(covered), expected, 0.015 * expected) << share.x;
  }
}

TEST(Picture, ShowsLowModelsFromAHigherElevation) {
  const auto elevation = [](float width, float height) {
    return elevation_of({}, Box{{0, 0, 0}, {width, height, 1}});
  };
  EXPECT_EQ(elevation(1, 10), 18);
  EXPECT_EQ(elevation(10, 4), 18);
  EXPECT_NEAR(elevation(10, 2.5F), 28, 1e-4);
  EXPECT_EQ(elevation(10, 0), 38);
  EXPECT_EQ(elevation_of({0, 5.0}, Box{{0, 0, 0}, {10, 0, 10}}), 5) << "as given";
}

TEST(Picture, HasTheSizeThatIsGiven) {
  const Job job = job_of();
  const Model model = sphere(16, job);
  for (const glm::uvec2 size : {glm::uvec2(64, 64), {192, 144}, {50, 201}}) {
    const texture::Picture picture = draw_picture(model, {size.x, size.y, {}, false}, job);
    EXPECT_EQ(picture.width, size.x);
    EXPECT_EQ(picture.height, size.y);
    EXPECT_EQ(picture.bytes.size(), std::size_t{3} * size.x * size.y);
    const auto at = [&](std::uint32_t x, std::uint32_t y) { return picture.bytes[3 * (y * size.x + x)]; };
    EXPECT_NE(at(size.x / 2, size.y / 2), at(1, 1)) << "the sphere is in the middle";
  }
}

TEST(Picture, DrawsNoBackOfAClosedSurface) {
  const Job job = job_of();
  Model model = sphere(32, job);
  const float before = Drawn(model, frame_of(35, 18), 200, job).near(100, 100);
  Array<std::uint32_t>& index = model.meshes[0].primitives[0].mesh.index.wide;
  for (std::size_t i = 0; i < index.size(); i += 3) std::swap(index[i + 1], index[i + 2]);
  const float inside_out = Drawn(model, frame_of(35, 18), 200, job).near(100, 100);
  EXPECT_GT(before, inside_out);  // the far side is seen
  // By the rules of glTF, a mirrored node turns the winding of its mesh, too.
  model.nodes[0].transform.scale = {-1, 1, 1};
  EXPECT_NEAR(Drawn(model, frame_of(35, 18), 200, job).near(100, 100), inside_out, 1e-6F);
}

/// Whether a ray from `from` along `towards` meets the box.
bool meets(const glm::dvec3& from, const glm::dvec3& towards, const glm::dvec3& low, const glm::dvec3& high) {
  double near = 0, far = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (low[axis] - from[axis]) / towards[axis], b = (high[axis] - from[axis]) / towards[axis];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  return near < far;
}

TEST(Picture, CastsTheShadowOfABox) {
  const Job job = job_of();
  Mesh mesh = empty_mesh(job);
  const glm::vec3 low(-0.5F, 0, -0.4F), high(0.5F, 2, 0.4F);
  add_box(mesh, low, high);
  const Model model = model_of(std::move(mesh));
  const Items items = items_of(model, job);
  const Frame sun = frame_of(-40, 48);
  const Surfaces surfaces(model, job);
  const ShadowMap map = draw_shadows(scene_of(model, items, surfaces, job), sun, 512, job);
  const glm::dvec3& towards = sun.towards;
  std::size_t wrong = 0, dark = 0, known = 0;
  for (std::uint64_t i = 0; i < 100'000; ++i) {
    const Rng rng = Rng::of_seed(i);
    const glm::dvec3 p(6 * rng.at(0).unit() - 3, -0.02, 6 * rng.at(1).unit() - 3);
    const bool expected = meets(p, towards, glm::dvec3(low), glm::dvec3(high));
    dark += expected ? 1 : 0;
    const ShadowMap::Position at = map.position_of(glm::vec3(p));
    wrong += expected != map.is_dark(at, 0, 0) ? 1 : 0;
    const float common = map.common_light(at);
    known += common >= 0 ? 1 : 0;
    for (const float dx : {-ShadowMap::reach, 0.0F, ShadowMap::reach}) {
      const bool is_common = map.is_dark(at, dx, -dx) == (common == 0);
      EXPECT_TRUE(common < 0 || is_common);
    }
  }
  EXPECT_GT(dark, 5'000U);
  EXPECT_GT(known, 10'000U);
  EXPECT_LT(wrong, 400U);  // points within a texel of the border
}

double brightness(const texture::Picture& picture, std::uint32_t x, std::uint32_t y) {
  const std::size_t at = 3 * (std::size_t{y} * picture.width + x);
  return picture.bytes[at] + picture.bytes[at + 1] + picture.bytes[at + 2];
}

TEST(Picture, LightsTheSideOfTheSun) {
  const Job job = job_of();
  const texture::Picture picture = draw_picture(sphere(48, job), {128, 128, {35, 18.0}, false}, job);
  ASSERT_EQ(picture.width, 128U);
  // The sun stands to the upper left of the camera.
  EXPECT_GT(brightness(picture, 44, 44), 1.5 * brightness(picture, 92, 84));
}

TEST(Picture, ShowsTheGroundWhereItIsAsked) {
  const Job job = job_of();
  const Model model = sphere(24, job);
  const texture::Picture with = draw_picture(model, {128, 128, {35, 18.0}, true}, job);
  const texture::Picture without = draw_picture(model, {128, 128, {35, 18.0}, false}, job);
  EXPECT_EQ(brightness(with, 64, 40), brightness(without, 64, 40));    // the sphere
  EXPECT_NE(brightness(with, 10, 120), brightness(without, 10, 120));  // beside it
}

/// A box of 1 m, of which the share `below` is below the height 0, and the ground.
texture::Picture box_on_ground(float below, const Job& job) {
  Mesh mesh = empty_mesh(job);
  add_box(mesh, {-0.5F, -below, -0.5F}, {0.5F, 1 - below, 0.5F});
  return draw_picture(model_of(std::move(mesh)), {128, 128, {35, 18.0}, true}, job);
}

/// Pixels that differ by more than a rounding error.
int changed_pixels(const texture::Picture& a, const texture::Picture& b) {
  int sum = 0;
  for (std::uint32_t y = 0; y < a.height; ++y) {
    for (std::uint32_t x = 0; x < a.width; ++x)
      sum += std::abs(brightness(a, x, y) - brightness(b, x, y)) > 8;
  }
  return sum;
}

TEST(Picture, HidesRootsInTheGroundButNoCurveThatDescendsBelowItsStart) {
  const Job job = job_of();
  const texture::Picture standing = box_on_ground(0, job);
  EXPECT_LT(changed_pixels(box_on_ground(0.2F, job), standing), 20);
  EXPECT_GT(changed_pixels(box_on_ground(0.1F, job), standing), 100);
}

/// An upright unit square with a texture of 8 x 8 texels with four channels.
Model square_with(const Array<std::uint8_t>& pixels, const Job& job) {
  Mesh mesh = empty_mesh(job);
  mesh.uv[0] = Array<glm::vec2>(job);
  for (const glm::vec2 at : {glm::vec2(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
    add_vertex(mesh, {at.x - 0.5F, at.y, 0}, {0, 0, 1});
    mesh.uv[0].push_back({at.x, 1 - at.y});
  }
  for (const std::uint32_t corner : {0U, 1U, 2U, 0U, 2U, 3U}) mesh.index.wide.push_back(corner);
  Model model = model_of(std::move(mesh));
  const auto file =
      texture::encode_png({8, 8, 4, 8, std::as_bytes(pixels.span())}, texture::PngEffort::small, job);
  auto image = std::make_shared<Image>();
  image->bytes.assign(file.begin(), file.end());
  model.textures.push_back(image);
  model.materials[0].base_color_texture = {0, 0, false};
  return model;
}

TEST(Picture, CutsHolesWhereATextureIsEmpty) {
  const Job job = job_of();
  // The left half of the texture is empty.
  Array<std::uint8_t> pixels(job);
  for (int i = 0; i < 64; ++i) {
    for (const int channel : {200, 100, 50, i % 8 < 4 ? 0 : 255})
      pixels.push_back(static_cast<std::uint8_t>(channel));
  }
  Model model = square_with(pixels, job);
  model.materials[0].alpha_mode = AlphaMode::mask;
  const Drawn drawn(model, frame_of(0, 0), 200, job);
  EXPECT_EQ(drawn.near(60, 100), 0);
  EXPECT_GT(drawn.near(140, 100), 0);
}

/// Between the middles of two texels, the linear colour changes evenly (bilinear filter).
TEST(Picture, BlendsTexelsThatAreLargerThanItsPixels) {
  const Job job = job_of();
  // Columns 0 to 3 are black, the others white.
  Array<std::uint8_t> pixels(job);
  for (int i = 0; i < 64; ++i) {
    const int shade = i % 8 < 4 ? 0 : 255;
    for (const int channel : {shade, shade, shade, 255}) pixels.push_back(static_cast<std::uint8_t>(channel));
  }
  const Model model = square_with(pixels, job);
  const Drawn drawn(model, frame_of(0, 0), 800, job);
  const auto color = [&](std::uint32_t x) { return drawn.fragment(x, 400).color.x; };
  std::uint32_t left = 0, right = 799;  // the columns of the square
  while (drawn.near(left, 400) == 0) ++left;
  while (drawn.near(right, 400) == 0) --right;
  const auto width = static_cast<double>(right - left + 1);
  const float full = color(right);
  EXPECT_EQ(color(left), 0);
  for (std::uint32_t x = left; x <= right; ++x) {
    const double place = (static_cast<double>(x - left) + 0.5) / width * 8;  // in texels
    const double share = std::clamp(place - 3.5, 0.0, 1.0);
    ASSERT_NEAR(static_cast<double>(color(x) / full), share, 0.02) << x;
  }
}

TEST(Picture, IsTheSameWithAnyNumberOfThreads) {
  const Job one = job_of(), four = job_of(4);
  const texture::Picture a = draw_picture(sphere(40, one), {150, 150, {}, true}, one);
  const texture::Picture b = draw_picture(sphere(40, four), {150, 150, {}, true}, four);
  EXPECT_TRUE(std::equal(a.bytes.begin(), a.bytes.end(), b.bytes.begin(), b.bytes.end()));
}

TEST(Picture, OfAnEmptyModelIsTheBackground) {
  const Job job = job_of();
  const texture::Picture picture = draw_picture(Model{}, {32, 32, {}, true}, job);
  EXPECT_EQ(picture.bytes.size(), 3U * 32 * 32);
  EXPECT_EQ(brightness(picture, 3, 16), brightness(picture, 28, 16));
}

TEST(Picture, EndsWhereTheRequestHasEnded) {
  std::stop_source stop;
  const Job job(1, Job::Options{.stop = stop.get_token()});
  const Model model = sphere(40, job);
  stop.request_stop();
  EXPECT_THROW(draw_picture(model, {64, 64, {}, true}, job), Stop);
}

}  // namespace
}  // namespace seedmesh::render
