#include "core/generators/terrain/build_model.h"

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "core/base/parallel.h"
#include "core/generators/terrain/decimate.h"
#include "core/generators/terrain/ground_classes.h"
#include "core/generators/terrain/ground_cover.h"
#include "core/generators/terrain/maps.h"
#include "core/generators/terrain/model_parts.h"
#include "core/generators/terrain/plan.h"
#include "core/generators/terrain/refined_mesh.h"
#include "core/generators/terrain/scan.h"
#include "core/generators/terrain/surface.h"
#include "core/texture/png_image.h"
#include "generated/params/terrain.h"

namespace seedmesh::terrain {
namespace {

// Most squares along a side of a piece of a large grid. Its vertices then fit 16-bit indices.
constexpr std::int32_t piece = 254;
constexpr std::size_t most_narrow = 65'535;

/// Cuts `squares` into pieces of about equal size. Returns the borders, including both ends.
std::vector<std::int32_t> cuts(std::int32_t squares) {
  const std::int32_t count = (squares + piece - 1) / piece;
  std::vector<std::int32_t> positions;
  for (std::int32_t i = 0; i <= count; ++i) positions.push_back(squares * i / count);
  return positions;
}

Material wall_material() {
  Material material;
  material.name = "earth";
  material.base_color = {linear_of_srgb(104), linear_of_srgb(88), linear_of_srgb(72), 1};
  material.roughness = 1;
  return material;
}

int add_texture(Model& model, std::string name, const texture::Picture& picture, Job& job) {
  model.textures.push_back(
      texture::png_image(std::move(name), picture.view(), texture::PngEffort::small, job));
  return static_cast<int>(model.textures.size()) - 1;
}

/// Builds the model of one request from its heights, colours and meshes.
class FieldModelBuilder {
 public:
  FieldModelBuilder(const TerrainParams& params, const Field& field, const GenerateContext& context)
      : params_(params),
        field_(field),
        job_(context.job),
        demand_(context.demand),
        range_(range_of(field, job_)),
        level_(static_cast<float>(params.water_level.value_or(static_cast<double>(range_.low)))),
        ground_colors_(colors_of(params, range_)),
        shading_(params.texture > 0 ? Shading::upright : Shading::smooth) {}

  Model build() {
    Model model;
    model.name = "terrain";
    add_node(model, "terrain", -1);
    if (has_detail()) {
      sites_.emplace(sites());
      classes_.emplace(field_, window_of(params_), *sites_, ground_colors_, ground_material(params_), model);
    }
    const int ground = has_detail() ? -1 : add_material(model, ground_material(params_));
    if (params_.texture > 0) {
      add_pictures(model, ground);
    } else if (params_.palette != TerrainPalette::none &&
               (params_.mesh == TerrainMesh::grid || demand_.lods > 1)) {
      colors_ = sites_ ? vertex_colors(field_, *sites_, ground_colors_, job_)
                       : vertex_colors(field_, sites(), ground_colors_, job_);
    }
    add_ground(model, ground);
    add_water(model);
    return model;
  }

 private:
  bool has_detail() const { return params_.detail && params_.texture == 0 && demand_.textures > 0; }

  /// Adds a mesh of the ground, or with details its primitives by class.
  int add_ground_mesh(Model& model, std::string name, RefinedMesh mesh, int ground) const {
    if (!classes_) return add_mesh(model, std::move(name), std::move(mesh.mesh), ground);
    return add_mesh(model, {std::move(name), mesh.sites.empty() ? classes_->divide(mesh.mesh, *sites_, job_)
                                                                : classes_->divide(mesh, *sites_, job_)});
  }

  Sites sites() const { return {field_, window_of(params_), job_.rng().at("terrain"), job_}; }

  /// Returns the function that gives the colour of a sample of a coarse mesh; empty without colours. The sites
  /// need as much memory as the field, so they are made with the first colour unless there are some.
  ColorOf color_of() const {
    if (!colors_.empty()) return [this](std::uint32_t sample) { return colors_[sample]; };
    if (params_.texture > 0 || params_.palette == TerrainPalette::none) return {};
    return [this, own = std::shared_ptr<const Sites>()](std::uint32_t sample) mutable {
      if (!sites_ && !own) own = std::make_shared<const Sites>(sites());
      const GridPoint at = grid_point_of(sample, field_.width);
      return vertex_color(sites_ ? *sites_ : *own, ground_colors_, at.x, at.z);
    };
  }

  void add_pictures(Model& model, int ground) {
    const Sites all = sites();
    if (params_.palette != TerrainPalette::none) {
      const texture::Picture colors = color_picture(field_, all, ground_colors_, params_.texture, job_);
      model.materials[static_cast<std::size_t>(ground)].base_color_texture = {
          add_texture(model, "ground_color", colors, job_), 0, false};
    }
    const texture::Picture normals = normal_picture(field_, all, params_.texture, job_);
    model.materials[static_cast<std::size_t>(ground)].normal_texture = {
        add_texture(model, "ground_normal", normals, job_), 0, false};
  }

  void add_ground(Model& model, int ground) {
    const std::size_t samples =
        static_cast<std::size_t>(field_.width) * static_cast<std::size_t>(field_.depth);
    if (params_.mesh == TerrainMesh::grid && !params_.base && !params_.refine && samples > most_narrow) {
      add_pieces(model, ground);
      if (params_.skirt > 0) {
        add_child(model, "skirt",
                  add_mesh(model, "skirt", wall_mesh(border_samples(field_, job_)),
                           add_material(model, wall_material())));
      }
      return write_levels(model);
    }
    const bool walled = params_.skirt > 0 || params_.base;
    int earth = -1;
    for (int level = 0; level < demand_.lods; ++level) {
      Ground made = whole_ground(level, model);
      if (level > 0 && made.refined.mesh.elements() >= coarsest_) break;
      coarsest_ = made.refined.mesh.elements();
      const int mesh = add_ground_mesh(model, level_name("ground", level), std::move(made.refined), ground);
      if (walled) {
        if (earth < 0) earth = add_material(model, wall_material());
        model.meshes[static_cast<std::size_t>(mesh)].primitives.push_back(
            {wall_mesh(made.border), earth, {}});
      }
      show(model.nodes[0], mesh);
    }
    write_levels(model);
  }

  /// A ground that is one mesh, with sites where it is refined, and the samples of its border.
  struct Ground {
    RefinedMesh refined;
    Array<std::uint32_t> border;
  };

  Ground whole_ground(int level, Model& model) {
    const Window all{0, 0, field_.width, field_.depth};
    if (params_.refine && level == 0) return {refined(), border_samples(field_, job_)};
    if (params_.mesh == TerrainMesh::grid && level == 0)
      return {{grid_mesh(field_, all, colors_, shading_, job_), {}}, border_samples(field_, job_)};
    const Border border = params_.tile ? Border::whole : Border::by_error;
    Triangulation plan = params_.mesh == TerrainMesh::grid ? decimated(field_, all, 1 << level, border, job_)
                                                           : reduced(level, border, model);
    if (params_.mesh == TerrainMesh::grid) note(level, note_of(plan));
    Array<std::uint32_t> rim(job_);
    for (const std::uint32_t sample : plan.samples) {
      const GridPoint at = grid_point_of(sample, field_.width);
      if (at.x == 0 || at.z == 0 || at.x == field_.width - 1 || at.z == field_.depth - 1)
        rim.push_back(sample);
    }
    const bool is_grid = params_.mesh == TerrainMesh::grid;
    const CoarseShading coarse{shading_, is_grid ? 1 << level : 1, all, is_grid};
    return {{reduced_mesh(field_, std::move(plan), color_of(), coarse, job_), {}}, std::move(rim)};
  }

  RefinedMesh refined() {
    return refined_mesh(field_, *refined_ground(params_, field_, job_), ground_colors_, colors_, job_);
  }

  void add_pieces(Model& model, int ground) {
    const std::vector<std::int32_t> east = cuts(field_.width - 1), south = cuts(field_.depth - 1);
    std::vector<Window> parts;
    std::vector<std::string> names;
    for (std::size_t z = 0; z + 1 < south.size(); ++z) {
      for (std::size_t x = 0; x + 1 < east.size(); ++x) {
        parts.push_back({east[x], south[z], east[x + 1] - east[x] + 1, south[z + 1] - south[z] + 1});
        names.push_back("ground_" + std::to_string(x) + "_" + std::to_string(z));
      }
    }
    std::vector<Piece> pieces(parts.size());
    parallel_for(job_, parts.size(), 1,
                 [&](std::size_t i, std::size_t, std::size_t) { pieces[i] = made_piece(parts[i]); });
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const std::string& name = names[i];
      Piece& made = pieces[i];
      const int node = add_child(model, name, -1);
      for (std::size_t k = 0; k < made.meshes.size(); ++k) {
        show(model.nodes[static_cast<std::size_t>(node)],
             add_ground_mesh(model, level_name(name, k), {std::move(made.meshes[k]), {}}, ground));
      }
      for (std::size_t k = 0; k < made.notes.size(); ++k) note(static_cast<int>(k), made.notes[k]);
    }
  }

  /// The error of a level in metres, and its number of triangles.
  struct Note {
    double error = 0;
    std::size_t triangles = 0;
  };

  struct Piece {
    std::vector<Mesh> meshes;  ///< finest first
    std::vector<Note> notes;   ///< by level; empty for the finest
  };

  /// Borders keep all their samples, so that adjacent pieces fit together at any levels.
  Piece made_piece(const Window& part) {
    Piece made;
    made.meshes.push_back(grid_mesh(field_, part, colors_, shading_, job_));
    made.notes.resize(1);
    for (int level = 1; level < demand_.lods; ++level) {
      Triangulation plan = decimated(field_, part, 1 << level, Border::whole, job_);
      made.notes.push_back(note_of(plan));
      if (plan.index.size() / 3 >= made.meshes.back().elements()) continue;
      const CoarseShading coarse{shading_, 1 << level, part, true};
      made.meshes.push_back(reduced_mesh(field_, std::move(plan), color_of(), coarse, job_));
    }
    return made;
  }

  static void show(Node& node, int mesh) {
    if (node.mesh < 0) {
      node.mesh = mesh;
    } else {
      node.lods.push_back(mesh);
    }
  }

  Note note_of(const Triangulation& plan) const {
    return {measured_error(field_, plan, job_), plan.index.size() / 3};
  }

  /// Adds error and triangles of one piece to those of its level.
  void note(int level, const Note& own) {
    const auto number = static_cast<std::size_t>(level);
    if (notes_.size() <= number) notes_.resize(number + 1);
    notes_[number].error = std::max(notes_[number].error, own.error);
    notes_[number].triangles += own.triangles;
  }

  void write_levels(Model& model) const {
    Json levels = Json::array();
    for (std::size_t i = 1; i < notes_.size(); ++i)
      levels.push_back({{"max_error", notes_[i].error}, {"triangles", notes_[i].triangles}});
    if (!levels.empty()) model.nodes[0].extras.push_back({"levels", levels.dump()});
  }

  Triangulation reduced(int level, Border border, Model& model) {
    const double finest = params_.max_error.value_or(params_.size / 1000);
    const double max_error = finest * (1 << level);
    Triangulation plan = params_.mesh == TerrainMesh::rtin
                             ? rtin(field_, max_error, border, job_)
                             : greedy(field_, Tolerance{max_error, finest}, border, job_);
    if (level > 0) {
      note(level, note_of(plan));
      return plan;
    }
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
          {"/water_level", "there is no water, because all ground is above it; the lowest height is " +
                               std::to_string(range_.low) + " m"});
      return;
    }
    const int water = add_material(model, water_material());
    add_child(model, "water", add_mesh(model, "water", sheet(field_, level_, job_), water));
  }

  const TerrainParams& params_;
  const Field& field_;
  Job& job_;
  const Demand& demand_;
  Range range_;
  float level_;
  GroundColors ground_colors_;
  Shading shading_;
  std::optional<Sites> sites_;            ///< with details
  std::optional<GroundClasses> classes_;  ///< with details
  Array<glm::u8vec4> colors_;
  std::size_t coarsest_ = 0;  ///< triangles of the coarsest level so far
  std::vector<Note> notes_;   ///< by level; empty for the finest
};

}  // namespace

std::shared_ptr<const RefinedGround> refined_ground(const TerrainParams& params, const Field& field,
                                                    const Job& job) {
  if (!params.refine) return nullptr;
  const Refinement refinement = refinement_of(*params.refine, field.width, field.depth, field.cell);
  const std::uint64_t squares =
      static_cast<std::uint64_t>(field.width - 1) * static_cast<std::uint64_t>(field.depth - 1);
  refuse_refinement(refinement, 2 * squares, job);
  return std::make_shared<const RefinedGround>(refinement, colors_of(params, range_of(field, job)), field,
                                               window_of(params), job.rng().at("terrain"), job);
}

Model build_field_model(const TerrainParams& params, const Field& field, const GenerateContext& context) {
  return FieldModelBuilder(params, field, context).build();
}

}  // namespace seedmesh::terrain
