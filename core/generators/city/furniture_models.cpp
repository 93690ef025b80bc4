#include "core/generators/city/furniture_models.h"

#include <array>

#include "core/generators/city/solid_builder.h"

namespace seedmesh::city {
namespace {

using glm::vec2;
using glm::vec3;

constexpr float below = -0.15F;  // how deep feet go into the ground, m

/// Bodies of one material of a model.
struct Part {
  SolidMaterial look;
  Mesh mesh;
};

class Parts {
 public:
  explicit Parts(Job& job) : job_(job) {}

  /// Adds the bodies that `build` makes with one look.
  template <class Build>
  void add(SolidMaterial look, const Build& build) {
    SolidBuilder solid(job_);
    build(solid);
    parts_.push_back({std::move(look), solid.take(job_)});
  }

  Model model(std::string_view name) {
    Model model;
    model.name = std::string(name);
    MeshGroup group;
    group.name = model.name;
    for (Part& part : parts_) {
      job_.spend(Resource::triangles, part.mesh.elements());
      Primitive primitive;
      primitive.mesh = std::move(part.mesh);
      primitive.material = static_cast<int>(model.materials.size());
      model.materials.push_back(material_of(part.look));
      group.primitives.push_back(std::move(primitive));
    }
    model.meshes.push_back(std::move(group));
    Node node;
    node.name = model.name;
    node.mesh = 0;
    model.nodes.push_back(std::move(node));
    return model;
  }

 private:
  Job& job_;
  std::vector<Part> parts_;
};

void add_lamp(Parts& parts) {
  parts.add({"lamp_post", {0x3a, 0x3f, 0x42}, 0.5F, 0.6F}, [](SolidBuilder& solid) {
    solid.add_prism({0, below, 0}, 1.05F, {0.1F, 0.08F}, 8);
    solid.add_prism({0, 0.85F, 0}, 5.15F, {0.06F, 0.045F}, 8);
    solid.add_box({-0.035F, 5.86F, -0.02F}, {0.035F, 5.94F, 1.5F});
    solid.add_box({-0.14F, 5.8F, 1.0F}, {0.14F, 5.9F, 1.7F});
  });
  parts.add({"lamp_glass", {0xf4, 0xec, 0xd2}, 0.3F, 0}, [](SolidBuilder& solid) {
    solid.add_box({-0.1F, 5.74F, 1.08F}, {0.1F, 5.795F, 1.62F});
  });
}

/// Broadleaf trees of three outlines.
void add_tree(Parts& parts, std::uint32_t number) {
  struct Outline {
    float trunk, crown_low;
    vec3 radii;
    std::array<std::uint8_t, 3> color;
  };
  static constexpr std::array<Outline, 3> outlines = {{{2.6F, 1.9F, {2.1F, 2.6F, 2.1F}, {0x5b, 0x7a, 0x3c}},
                                                       {2.2F, 1.5F, {1.6F, 3.1F, 1.6F}, {0x4f, 0x70, 0x3a}},
                                                       {2.4F, 1.7F, {2.5F, 2.1F, 2.5F}, {0x6a, 0x82, 0x40}}}};
  const Outline& outline = outlines[number % outlines.size()];
  parts.add({"trunk", {0x5d, 0x4c, 0x3d}, 1, 0}, [&](SolidBuilder& solid) {
    solid.add_prism({0, below, 0}, outline.trunk - below, {0.16F, 0.11F}, 6);
  });
  parts.add({"crown", outline.color, 1, 0}, [&](SolidBuilder& solid) {
    solid.add_blob({0, outline.crown_low + outline.radii.y, 0}, outline.radii, 0.22F, 7 + number);
  });
}

void add_bench(Parts& parts) {
  parts.add({"bench_wood", {0x7a, 0x5a, 0x3c}, 0.8F, 0}, [](SolidBuilder& solid) {
    for (const float z : {-0.16F, 0.0F, 0.16F})
      solid.add_box({-0.9F, 0.42F, z - 0.065F}, {0.9F, 0.46F, z + 0.065F});
    for (const float y : {0.62F, 0.78F}) solid.add_box({-0.9F, y - 0.05F, -0.3F}, {0.9F, y + 0.05F, -0.26F});
  });
  parts.add({"bench_iron", {0x2f, 0x33, 0x35}, 0.5F, 0.6F}, [](SolidBuilder& solid) {
    for (const float x : {-0.7F, 0.7F}) {
      solid.add_box({x - 0.03F, below, -0.22F}, {x + 0.03F, 0.415F, -0.16F});
      solid.add_box({x - 0.03F, below, 0.14F}, {x + 0.03F, 0.415F, 0.2F});
      solid.add_box({x - 0.025F, 0.36F, -0.255F}, {x + 0.025F, 0.86F, -0.225F});
    }
  });
}

void add_bin(Parts& parts) {
  parts.add({"bin", {0x3d, 0x52, 0x45}, 0.6F, 0.2F}, [](SolidBuilder& solid) {
    solid.add_prism({0, below, 0}, 0.95F - below, {0.2F, 0.24F}, 10);
    solid.add_prism({0, 0.955F, 0}, 0.12F, {0.25F, 0.08F}, 10);
  });
}

void add_sign(Parts& parts) {
  parts.add({"sign_post", {0x8c, 0x90, 0x92}, 0.4F, 0.7F}, [](SolidBuilder& solid) {
    solid.add_prism({0, below, 0}, 2.35F - below, {0.03F, 0.03F}, 8);
  });
  parts.add({"sign", {0xa8, 0x2b, 0x24}, 0.5F, 0}, [](SolidBuilder& solid) {
    // The plate faces along the street, against the traffic on the right side.
    const std::array<vec2, 3> plate = {{{0, 2.37F}, {0.42F, 3.05F}, {-0.42F, 3.05F}}};
    solid.add_extrusion(plate, -0.015F, 0.015F);
  });
}

/// Cars point along -x.
void add_car(Parts& parts, std::uint32_t number) {
  static constexpr std::array<std::array<std::uint8_t, 3>, 5> colors = {
      {{0xb9, 0xbd, 0xc0}, {0x2b, 0x30, 0x38}, {0x8e, 0x24, 0x22}, {0x2c, 0x4a, 0x6b}, {0xd8, 0xd4, 0xc8}}};
  const bool is_estate = number % 5 == 3;
  parts.add({"car_paint", colors[number % colors.size()], 0.35F, 0.3F}, [&](SolidBuilder& solid) {
    const std::array<vec2, 7> body = {{{-2.15F, 0.3F},
                                       {2.15F, 0.3F},
                                       {2.18F, 0.75F},
                                       {2.0F, 0.92F},
                                       {-0.9F, 0.95F},
                                       {-2.0F, 0.8F},
                                       {-2.2F, 0.6F}}};
    solid.add_extrusion(body, -0.86F, 0.86F);
    const float back = is_estate ? 1.95F : 1.35F;
    const std::array<vec2, 4> roof = {
        {{-0.22F, 1.4F}, {back - 0.25F, 1.4F}, {back - 0.3F, 1.46F}, {-0.17F, 1.46F}}};
    solid.add_extrusion(roof, -0.66F, 0.66F);
  });
  parts.add({"car_glass", {0x1c, 0x22, 0x28}, 0.15F, 0}, [&](SolidBuilder& solid) {
    const float back = is_estate ? 1.95F : 1.6F, top = is_estate ? 1.75F : 1.15F;
    const std::array<vec2, 4> cabin = {{{-0.95F, 0.925F}, {back, 0.925F}, {top, 1.395F}, {-0.25F, 1.395F}}};
    solid.add_extrusion(cabin, -0.74F, 0.74F);
  });
  parts.add({"car_tyre", {0x1a, 0x1a, 0x1b}, 0.9F, 0}, [](SolidBuilder& solid) {
    std::array<vec2, 10> wheel{};
    constexpr std::array<float, 10> x = {1,  0.809F,  0.309F,  -0.309F, -0.809F,
                                         -1, -0.809F, -0.309F, 0.309F,  0.809F};
    constexpr std::array<float, 10> y = {0, 0.588F,  0.951F,  0.951F,  0.588F,
                                         0, -0.588F, -0.951F, -0.951F, -0.588F};
    for (const float at : {-1.35F, 1.3F}) {
      for (std::size_t i = 0; i < wheel.size(); ++i) wheel[i] = {at + 0.32F * x[i], 0.325F + 0.32F * y[i]};
      solid.add_extrusion(wheel, 0.7F, 0.9F);
      solid.add_extrusion(wheel, -0.9F, -0.7F);
    }
  });
}

void build(Parts& parts, std::string_view kind, std::uint32_t number) {
  if (kind == "lamps") return add_lamp(parts);
  if (kind == "benches") return add_bench(parts);
  if (kind == "bins") return add_bin(parts);
  if (kind == "signs") return add_sign(parts);
  if (kind == "cars") return add_car(parts, number);
  add_tree(parts, number);
}

}  // namespace

std::uint32_t built_in_count(std::string_view kind) {
  if (kind == "cars") return 5;
  return kind == "trees" || kind == "park_trees" || kind == "yard_trees" ? 3 : 1;
}

Model built_in_model(std::string_view kind, std::uint32_t number, Job& job) {
  Parts parts(job);
  build(parts, kind, number);
  return parts.model(kind);
}

}  // namespace seedmesh::city
