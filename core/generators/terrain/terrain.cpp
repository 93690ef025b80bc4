#include "core/generators/terrain/terrain.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "core/base/parallel.h"
#include "core/generators/child.h"
#include "core/generators/terrain/maps.h"
#include "core/generators/terrain/onto.h"
#include "core/generators/terrain/plan.h"
#include "core/generators/terrain/surface.h"
#include "generated/params/terrain.h"

namespace seedmesh::terrain {
namespace {

// Heights are told one by one up to this many samples a side.
constexpr int longest_told = 257;
// Squares a side of a piece of a large grid, whose vertices indices of 16 bit can name.
constexpr std::int32_t piece = 254;
constexpr std::size_t most_narrow = 65'535;
constexpr std::uint64_t bytes_a_vertex = 36;  // position, normal, texture coordinates, colour

Material ground_material() {
  Material material;
  material.name = "ground";
  material.roughness = 0.95F;
  return material;
}

Material wall_material() {
  Material material;
  material.name = "earth";
  material.base_color = {linear_of_srgb(104), linear_of_srgb(88), linear_of_srgb(72), 1};
  material.roughness = 1;
  return material;
}

Material water_material() {
  Material material;
  material.name = "water";
  material.base_color = {linear_of_srgb(38), linear_of_srgb(92), linear_of_srgb(120), 0.78F};
  material.roughness = 0.08F;
  material.alpha_mode = AlphaMode::blend;
  return material;
}

int add_material(Model& model, Material material) {
  model.materials.push_back(std::move(material));
  return static_cast<int>(model.materials.size()) - 1;
}

int add_mesh(Model& model, std::string name, Mesh mesh, int material) {
  MeshGroup group;
  group.name = std::move(name);
  group.primitives.push_back({std::move(mesh), material, {}});
  model.meshes.push_back(std::move(group));
  return static_cast<int>(model.meshes.size()) - 1;
}

void add_child(Model& model, std::string name, int mesh) {
  Node node;
  node.name = std::move(name);
  node.parent = 0;
  node.mesh = mesh;
  model.nodes.push_back(std::move(node));
}

int add_texture(Model& model, std::string name, const texture::Picture& picture, Job& job) {
  const Array<std::uint8_t> file = texture::encode_png(picture.view(), texture::PngEffort::small, job);
  auto image = std::make_shared<Image>();
  image->name = std::move(name);
  image->bytes.assign(file.begin(), file.end());
  model.textures.push_back(std::move(image));
  return static_cast<int>(model.textures.size()) - 1;
}

/// Heights, looks and meshes of one request on their way into a model.
class Dressing {
 public:
  Dressing(const TerrainParams& params, const Field& field, Job& job)
      : params_(params),
        field_(field),
        job_(job),
        range_(range_of(field, job)),
        level_(static_cast<float>(params.water_level.value_or(static_cast<double>(range_.low)))),
        sites_(field, place_of(params), job.rng().at("terrain"), job),
        looks_(palette_of(params), params.tile ? nominal_range(params) : range_, level_),
        shading_(params.texture > 0 ? Shading::upright : Shading::smooth) {}

  Model dress() {
    Model model;
    model.name = "terrain";
    Node root;
    root.name = "terrain";
    model.nodes.push_back(std::move(root));
    const int ground = add_material(model, ground_material());
    if (params_.texture > 0) {
      add_pictures(model, ground);
    } else if (params_.palette != TerrainPalette::none) {
      colors_ = vertex_colors(field_, sites_, looks_, job_);
    }
    add_ground(model, ground);
    add_water(model);
    return model;
  }

 private:
  void add_pictures(Model& model, int ground) {
    if (params_.palette != TerrainPalette::none) {
      const texture::Picture colors = color_picture(field_, sites_, looks_, params_.texture, job_);
      model.materials[static_cast<std::size_t>(ground)].base_color_texture = {
          add_texture(model, "ground_color", colors, job_), 0, false};
    }
    const texture::Picture normals = normal_picture(field_, sites_, params_.texture, job_);
    model.materials[static_cast<std::size_t>(ground)].normal_texture = {
        add_texture(model, "ground_normal", normals, job_), 0, false};
  }

  void add_ground(Model& model, int ground) {
    const std::size_t samples =
        static_cast<std::size_t>(field_.width) * static_cast<std::size_t>(field_.depth);
    if (params_.mesh == TerrainMesh::grid && !params_.base && samples > most_narrow) {
      add_pieces(model, ground);
      if (params_.skirt > 0)
        add_child(model, "skirt",
                  add_mesh(model, "skirt", wall_mesh(border_samples(field_, job_)),
                           add_material(model, wall_material())));
      return;
    }
    Array<std::uint32_t> border(job_);
    if (params_.mesh == TerrainMesh::grid) {
      model.nodes[0].mesh =
          add_mesh(model, "ground",
                   grid_mesh(field_, {0, 0, field_.width, field_.depth}, colors_, shading_, job_), ground);
      border = border_samples(field_, job_);
    } else {
      Triangulation plan = reduced(model);
      for (const std::uint32_t sample : plan.samples) {
        const auto wide = static_cast<std::uint32_t>(field_.width);
        const std::uint32_t x = sample % wide, z = sample / wide;
        if (x == 0 || z == 0 || x == wide - 1 || z == static_cast<std::uint32_t>(field_.depth - 1))
          border.push_back(sample);
      }
      Mesh mesh = reduced_mesh(field_, std::move(plan), colors_, shading_, job_);
      model.nodes[0].mesh = add_mesh(model, "ground", std::move(mesh), ground);
    }
    if (params_.skirt > 0 || params_.base) {
      const int earth = add_material(model, wall_material());
      model.meshes[static_cast<std::size_t>(model.nodes[0].mesh)].primitives.push_back(
          {wall_mesh(border), earth, {}});
    }
  }

  void add_pieces(Model& model, int ground) {
    for (std::int32_t z = 0; z < field_.depth - 1; z += piece) {
      for (std::int32_t x = 0; x < field_.width - 1; x += piece) {
        const Window part{x, z, std::min(piece, field_.width - 1 - x) + 1,
                          std::min(piece, field_.depth - 1 - z) + 1};
        std::string name = "ground_" + std::to_string(x / piece) + "_" + std::to_string(z / piece);
        const int mesh = add_mesh(model, name, grid_mesh(field_, part, colors_, shading_, job_), ground);
        add_child(model, std::move(name), mesh);
      }
    }
  }

  Triangulation reduced(Model& model) {
    const double max_error = params_.max_error.value_or(params_.size / 1000);
    const Border border = params_.tile ? Border::whole : Border::by_error;
    Triangulation plan = params_.mesh == TerrainMesh::rtin ? rtin(field_, max_error, border, job_)
                                                           : greedy(field_, max_error, border, job_);
    const Json reached{{"max_error", measured_error(field_, plan, job_)},
                       {"triangles", plan.index.size() / 3},
                       {"grid_triangles", 2 * std::int64_t{field_.width - 1} * (field_.depth - 1)}};
    model.nodes[0].extras.push_back({"reduced", reached.dump()});
    return plan;
  }

  Mesh wall_mesh(const Array<std::uint32_t>& border) {
    WallPlan plan;
    plan.depth = params_.skirt;
    plan.closed = params_.base.has_value();
    plan.floor = static_cast<float>(static_cast<double>(range_.low) - params_.base.value_or(0));
    return walls(field_, border, plan, job_);
  }

  void add_water(Model& model) {
    if (!params_.water_level) return;
    if (level_ <= range_.low) {
      model.warnings.push_back(
          {"/water_level", "all ground lies above the water, so that there is none; the lowest height is " +
                               std::to_string(range_.low) + " m"});
      return;
    }
    const int water = add_material(model, water_material());
    add_child(model, "water", add_mesh(model, "water", sheet(field_, level_, job_), water));
  }

  const TerrainParams& params_;
  const Field& field_;
  Job& job_;
  Range range_;
  float level_;
  Sites sites_;
  Looks looks_;
  Shading shading_;
  Array<glm::u8vec4> colors_;
};

Model planet_model(const TerrainParams& params, Job& job) {
  const Planet planet = planet_of(params, job);
  job.progress("mesh", 0);
  const Range range = range_of(planet);
  const auto level = static_cast<float>(params.water_level.value_or(static_cast<double>(range.low)));
  const Looks looks(palette_of(params), range, level);
  Model model;
  model.name = "terrain";
  Node root;
  root.name = "terrain";
  model.nodes.push_back(std::move(root));
  const int ground = add_material(model, ground_material());
  Mesh mesh = planet_mesh(planet, params.palette == TerrainPalette::none ? nullptr : &looks,
                          job.rng().at("terrain"), job);
  model.nodes[0].mesh = add_mesh(model, "planet", std::move(mesh), ground);
  if (params.water_level && level > range.low) {
    Planet sea = sphere_of(std::min(planet.side, 65), planet.radius, job);
    for (float& height : sea.height) height = level;
    const int water = add_material(model, water_material());
    add_child(model, "water", add_mesh(model, "water", planet_mesh(sea, nullptr, job.rng(), job), water));
  } else if (params.water_level) {
    model.warnings.push_back(
        {"/water_level", "all ground lies above the water, so that there is none; the lowest height is " +
                             std::to_string(range.low) + " m"});
  }
  return model;
}

/// The model that the field is laid on.
Result<Model> clad_model(const TerrainParams& params, const Field& field, Job& job) {
  constexpr std::int32_t usual_picture = 512;
  Result<Model> model = generate_child(params.onto->model, "/onto/model", job.rng().at("onto"), job);
  if (!model) return model;
  if (params.onto->mapping == TerrainMapping::displacement) {
    displace(*model, field, static_cast<int>(params.onto->subdivide), job);
  } else {
    const auto side = static_cast<std::int32_t>(params.texture);
    add_normal_map(*model, field, side > 0 ? side : usual_picture, job);
  }
  return model;
}

std::optional<Error> refusal(const TerrainParams& params, const Limits& limits) {
  std::vector<Issue> issues = check(params, limits);
  if (issues.empty()) return std::nullopt;
  return Error{Code::invalid, std::move(issues)};
}

Error no_rtin_of(const Field& field) {
  return Error{Code::invalid,
               {{"/mesh", "rtin wants a square of 2^n + 1 samples a side and this image has " +
                              std::to_string(field.width) + " x " + std::to_string(field.depth) +
                              "; resample it, or use greedy"}}};
}

double mean_of(const Array<float>& heights) {
  double sum = 0;
  for (const float height : heights) sum += static_cast<double>(height);
  return sum / static_cast<double>(heights.size());
}

}  // namespace

std::vector<Issue> check(const TerrainParams& params, const Limits& limits) {
  return faults_between(params, limits);
}

Result<Model> generate(const TerrainParams& params, Job& job) {
  if (auto refused = refusal(params, job.limits())) return std::move(*refused);
  job.progress("derive", 0);
  if (params.shape == TerrainShape::sphere) return planet_model(params, job);
  const Result<Field> field = field_of(params, job);
  if (!field) return field.error();
  if (params.onto) return clad_model(params, *field, job);
  if (params.mesh == TerrainMesh::rtin && !fits_rtin(field->width, field->depth)) {
    return no_rtin_of(*field);
  }
  job.progress("mesh", 0);
  return Dressing(params, *field, job).dress();
}

Result<Model> dressed(const TerrainParams& params, const Field& field, Job& job) {
  if (params.mesh == TerrainMesh::rtin && !fits_rtin(field.width, field.depth)) return no_rtin_of(field);
  return Dressing(params, field, job).dress();
}

Result<Json> derive(const TerrainParams& params, Job& job) {
  if (auto refused = refusal(params, job.limits())) return std::move(*refused);
  Json answer{{"width", nullptr}, {"height", nullptr}, {"heights", nullptr}, {"warnings", Json::array()}};
  if (params.shape == TerrainShape::sphere) {
    const Planet planet = planet_of(params, job);
    const Range range = range_of(planet);
    answer.update({{"min", range.low},
                   {"max", range.high},
                   {"mean", mean_of(planet.height)},
                   {"samples", planet.height.size()}});
    return answer;
  }
  Result<Field> made = field_of(params, job);
  if (!made) return made.error();
  const Field field = cropped(std::move(*made), 0, job);
  const Range range = range_of(field, job);
  answer.update({{"width", field.width},
                 {"height", field.depth},
                 {"min", range.low},
                 {"max", range.high},
                 {"mean", mean_of(field.heights)},
                 {"samples", field.heights.size()}});
  if (field.width <= longest_told && field.depth <= longest_told) {
    Json heights = Json::array();
    for (const float height : field.heights) heights.push_back(height + 0.0F);
    answer["heights"] = std::move(heights);
  }
  return answer;
}

Result<Appraisal> appraise(const TerrainParams& params, const Job& job) {
  if (auto refused = refusal(params, job.limits())) return std::move(*refused);
  Appraisal appraisal;
  if (params.onto) {
    Result<Appraisal> child = appraise_child(params.onto->model, "/onto/model", job.rng().at("onto"), job);
    if (child) child->estimate.reset();
    return child;
  }
  const bool sphere = params.shape == TerrainShape::sphere;
  if (params.algorithm == TerrainAlgorithm::image || (!sphere && params.mesh != TerrainMesh::grid))
    return appraisal;
  const auto squares = static_cast<std::uint64_t>(finished_side(params) - 1);
  Estimate estimate;
  if (sphere) {
    estimate.triangles = 12 * squares * squares;
  } else {
    estimate.triangles = 2 * squares * squares;
    if (params.skirt > 0) estimate.triangles += 8 * squares;
    if (params.base) estimate.triangles += 12 * squares;
  }
  estimate.exact = !params.water_level;
  estimate.bytes = estimate.triangles / 2 * bytes_a_vertex + estimate.triangles * 6;
  appraisal.estimate = estimate;
  return appraisal;
}

Json vocabulary() { return Json::object(); }

Result<Array<std::uint8_t>> encode(const TerrainParams& params, std::string_view format, Job& job) {
  if (auto refused = refusal(params, job.limits())) return std::move(*refused);
  return map_file(params, format, job);
}

}  // namespace seedmesh::terrain
