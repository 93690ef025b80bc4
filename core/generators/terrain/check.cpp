/// Checks of rules between parameters; see plan.h.
#include <array>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>

#include "core/generators/terrain/layers.h"
#include "core/generators/terrain/plan.h"
#include "core/generators/terrain/profile.h"
#include "core/generators/terrain/triangulation.h"
#include "core/schema/json.h"
#include "generated/params/terrain.h"

namespace seedmesh::terrain {
namespace {

using Algorithm = TerrainAlgorithm;

// The number of rounds that gives the longest side, and the greatest number of octaves with visible detail in
// a float.
constexpr int most_rounds = 14, most_octaves = 16;
constexpr int longest_sphere = 1025, least_texture = 16;

class Check {
 public:
  Check(const TerrainParams& params, const Limits& limits) : params_(params), limits_(limits) {}

  std::vector<Issue> run() {
    belongings();
    iterations();
    heights();
    if (params_.shape == TerrainShape::sphere) sphere();
    if (is({Algorithm::fracture})) rock();
    profile();
    if (params_.tile) tile();
    if (params_.hydraulic) hydraulic();
    if (params_.onto) onto();
    mesh();
    for (Issue& issue : layer_errors(params_)) issues_.push_back(std::move(issue));
    return std::move(issues_);
  }

 private:
  void error_if(bool is_error, IssueCause cause, std::string pointer, std::string message) {
    if (is_error) error(std::move(cause), std::move(pointer), std::move(message));
  }
  void error(IssueCause cause, std::string pointer, std::string message) {
    issues_.emplace_back(std::move(cause), std::move(pointer), std::move(message));
  }

  bool is(std::initializer_list<Algorithm> algorithms) const {
    for (const Algorithm each : algorithms) {
      if (params_.algorithm == each) return true;
    }
    return false;
  }

  /// Refuses a parameter that the algorithm does not have.
  template <class Value>
  void belongs(const char* name, const std::optional<Value>& value, std::initializer_list<Algorithm> to) {
    if (!value || is(to)) return;
    std::string owners;
    for (const Algorithm each : to) owners += (owners.empty() ? "" : ", ") + std::string(text_of(each));
    error(conflict_with({"algorithm"}), std::string("/") + name,
          std::string(text_of(params_.algorithm)) + " has no " + name +
              "; only these algorithms have it: " + owners);
  }

  void belongings() {
    using enum TerrainAlgorithm;
    belongs("resolution", params_.resolution,
            {fault_formation, poisson_faulting, fbm, brownian, expression, fracture});
    belongs("expression", params_.expression, {expression});
    if (is({expression}) && !params_.expression)
      error(missing_for({"expression", "algorithm"}), "",
            "\"expression\" is missing; the algorithm expression takes its heights from it");
    belongs("amplitude", params_.amplitude,
            {triangular_edge, diamond_square, square_square, fbm, brownian, fracture});
    belongs("hurst", params_.hurst, {triangular_edge, diamond_square, square_square, fbm, brownian});
    belongs("corners", params_.corners, {triangular_edge, diamond_square});
    belongs("grid", params_.grid, {square_square});
    belongs("edge", params_.edge, {diamond_square});
    belongs("mode", params_.mode, {triangular_edge});
    belongs("fault_max", params_.fault_max, {fault_formation, poisson_faulting});
    belongs("fault_min", params_.fault_min, {fault_formation, poisson_faulting});
    belongs("fault_step", params_.fault_step, {fault_formation, poisson_faulting});
    belongs("fault_width", params_.fault_width, {fault_formation, poisson_faulting});
    belongs("noise", params_.noise, {fbm});
    belongs("wavelength", params_.wavelength, {fbm});
    belongs("lacunarity", params_.lacunarity, {fbm});
    belongs("warp", params_.warp, {fbm});
    belongs("fracture", params_.fracture, {fracture});
    belongs("image", params_.image, {image});
    if (is({image}) && !params_.image)
      error(missing_for({"image", "algorithm"}), "",
            "\"image\" is missing; the algorithm image reads its heights from it");
    if (is({triangular_edge}) && params_.hurst &&
        params_.mode.value_or(TerrainMode::random) == TerrainMode::random)
      error(conflict_with({"mode"}), "/hurst",
            "the mode random does not use hurst; only the mode midpoint does");
    if (params_.fault_width &&
        params_.fault_step.value_or(TerrainFaultStep::hard) == TerrainFaultStep::hard &&
        is({fault_formation, poisson_faulting}))
      error(conflict_with({"fault_step"}), "/fault_width",
            "a hard step has no width; expected fault_step line or cosine");
  }

  void iterations() {
    const int planned = planned_iterations(params_), all = all_iterations(params_);
    const std::string found =
        "found " + std::to_string(planned) +
        (params_.extra_iterations > 0 ? " and " + std::to_string(params_.extra_iterations) + " extra" : "");
    using enum TerrainAlgorithm;
    if (is({image, expression, brownian})) {
      const std::string reason =
          std::string("the algorithm ") + std::string(text_of(params_.algorithm)) + " has no iterations";
      if (params_.iterations) error(conflict_with({"algorithm"}), "/iterations", reason);
      if (params_.extra_iterations > 0) error(conflict_with({"algorithm"}), "/extra_iterations", reason);
    } else if (is({triangular_edge, diamond_square, square_square}) && all > most_rounds) {
      error(IssueKind::out_of_range, "/iterations",
            found + "; expected at most " + std::to_string(most_rounds) +
                " rounds of subdivision, which give " + std::to_string(longest_side) +
                " samples along a side");
    } else if (is({fbm}) && (all < 1 || all > most_octaves)) {
      error(IssueKind::out_of_range, "/iterations",
            found + "; expected 1 to " + std::to_string(most_octaves) + " octaves of noise");
    } else if (static_cast<std::uint32_t>(all) > limits_.iterations) {
      issues_.push_back(
          limit_issue({Resource::iterations, limits_.iterations, static_cast<std::uint64_t>(all)},
                      found + "; the limit is " + std::to_string(limits_.iterations), "/iterations"));
    }
  }

  void check_image(const TerrainImage& image) {
    const TerrainEncoding encoding = image.encoding;
    const bool is_raw = encoding == TerrainEncoding::r16 || encoding == TerrainEncoding::r16_big ||
                        encoding == TerrainEncoding::s16 || encoding == TerrainEncoding::s16_big;
    error_if(image.width && !is_raw, conflict_with({"encoding"}), "/image/width",
             "the file states its own width; this belongs to raw data (r16, r16_big, s16, s16_big)");
    const bool has_range = encoding == TerrainEncoding::grey || encoding == TerrainEncoding::rgb24 ||
                           encoding == TerrainEncoding::rgba32 || encoding == TerrainEncoding::r16 ||
                           encoding == TerrainEncoding::r16_big;
    const TerrainImage usual;
    error_if(!has_range && image.low != usual.low, conflict_with({"encoding"}), "/image/low",
             "has no effect, because the values of this encoding are metres");
    error_if(!has_range && image.high != usual.high, conflict_with({"encoding"}), "/image/high",
             "has no effect, because the values of this encoding are metres");
    error_if(has_range && image.low == image.high, IssueKind::invalid_value, "/image/high",
             "low and high are the same height");
  }

  void heights() {
    if (is({Algorithm::fault_formation, Algorithm::poisson_faulting})) {
      const FaultPlan plan = fault_plan(params_);
      if (plan.least > plan.greatest) {
        error(IssueKind::out_of_range, "/fault_min",
              "the smallest fault is above the greatest, " + std::to_string(plan.greatest) + " m");
      }
    }
    error_if(params_.normalise && params_.normalise->low > params_.normalise->high, IssueKind::out_of_range,
             "/normalise/low", "the lowest height is above the highest");
    if (params_.normalise) rising("/normalise/from", params_.normalise->from);
    if (params_.terraces) rising("/terraces/from", params_.terraces->from);
    error_if(params_.island && params_.island->floor && params_.island->depth, conflict_with({"floor"}),
             "/island/depth",
             "found both floor and depth; expected one of them, because each sets the height of the rim");
    if (params_.image) check_image(*params_.image);
    const TerrainHeightmap& map = params_.heightmap;
    error_if(map.low && map.high && *map.low >= *map.high, IssueKind::out_of_range, "/heightmap/low",
             "low is not below high; expected a smaller value");
  }

  void rising(const char* pointer, const std::optional<std::array<double, 2>>& pair) {
    error_if(pair && (*pair)[0] >= (*pair)[1], IssueKind::out_of_range, pointer,
             "the first height is not below the second");
  }

  void sphere() {
    using enum TerrainAlgorithm;
    if (!is({fault_formation, poisson_faulting, fbm, expression, fracture})) {
      return error(IssueKind::not_available, "/shape",
                   std::string(text_of(params_.algorithm)) +
                       " cannot make a sphere; expected fault_formation, poisson_faulting, fbm, expression "
                       "or fracture");
    }
    if (params_.resolution && *params_.resolution > longest_sphere) {
      error(IssueKind::out_of_range, "/resolution",
            "found " + std::to_string(*params_.resolution) + "; expected at most " +
                std::to_string(longest_sphere) + " samples along an edge of the cube of a sphere");
    }
    error_if(params_.fault_step.value_or(TerrainFaultStep::hard) != TerrainFaultStep::hard,
             IssueKind::not_available, "/fault_step", "a sphere has only hard steps");
    planes_only("a sphere");
  }

  void rock() {
    error_if(params_.shape != TerrainShape::sphere, conflict_with({"algorithm"}), "/shape",
             "found \"" + std::string(text_of(params_.shape)) +
                 "\"; fracture breaks a solid, expected \"sphere\"");
    error_if(params_.fracture && params_.fracture->depth[0] > params_.fracture->depth[1],
             IssueKind::out_of_range, "/fracture/depth",
             "the least distance of a plane is above the greatest");
  }

  void planes_only(const std::string& shape) {
    const auto refuse = [&](bool given, const char* pointer) {
      if (given) {
        error(IssueKind::not_available, pointer,
              shape + " does not have this parameter; expected the shape plane");
      }
    };
    refuse(params_.tile.has_value(), "/tile");
    refuse(params_.smooth > 0, "/smooth");
    refuse(params_.normalise.has_value(), "/normalise");
    refuse(params_.island.has_value(), "/island");
    refuse(params_.terraces.has_value(), "/terraces");
    refuse(params_.thermal.has_value(), "/thermal");
    refuse(params_.hydraulic.has_value(), "/hydraulic");
    refuse(params_.resample.has_value(), "/resample");
    refuse(params_.mesh != TerrainMesh::grid, "/mesh");
    refuse(params_.skirt > 0, "/skirt");
    refuse(params_.base.has_value(), "/base");
    refuse(params_.texture > 0, "/texture");
    refuse(params_.refine.has_value(), "/refine");
    if (params_.shape != TerrainShape::profile) return;
    refuse(params_.detail, "/detail");
    refuse(!params_.layers.empty(), "/layers");
    refuse(params_.water_level.has_value(), "/water_level");
    refuse(params_.onto.has_value(), "/onto");
  }

  /// The graph of one line.
  void profile() {
    using enum TerrainAlgorithm;
    const bool is_profile = params_.shape == TerrainShape::profile;
    if (is({brownian})) {
      if (!is_profile) {
        error(conflict_with({"algorithm"}), "/shape",
              "found \"" + std::string(text_of(params_.shape)) +
                  "\"; brownian is a motion along a line, expected \"profile\"");
      }
      if (params_.hurst && !(*params_.hurst > 0 && *params_.hurst < 1)) {
        error(IssueKind::out_of_range, "/hurst",
              "found " + number_text(*params_.hurst) + "; brownian needs more than 0 and less than 1");
      }
      if (made_side(params_) > longest_brownian) {
        error(IssueKind::out_of_range, "/resolution",
              "found " + std::to_string(made_side(params_)) + "; expected at most " +
                  std::to_string(longest_brownian) + " samples of brownian");
      }
    }
    if (!is_profile) return;
    if (!is({brownian, fbm})) {
      error(IssueKind::not_available, "/shape",
            std::string(text_of(params_.algorithm)) + " has no profile; expected brownian or fbm");
    }
    planes_only("a profile");
  }

  void tile() {
    using enum TerrainAlgorithm;
    if (is({image})) return error(IssueKind::not_available, "/tile", "an image cannot be divided into tiles");
    const bool faults = is({fault_formation, poisson_faulting});
    error_if(
        !faults && params_.tile->across && !params_.island && !params_.hydraulic,
        conflict_with({"algorithm", "island", "hydraulic"}), "/tile/across",
        "this world is infinite; across needs fault_formation, poisson_faulting, an island or hydraulic");
    const int across = params_.tile->across.value_or(1);
    const bool finite = faults || params_.hydraulic;
    if (finite && (params_.tile->x < 0 || params_.tile->x >= across)) {
      error(IssueKind::out_of_range, "/tile/x",
            "found " + std::to_string(params_.tile->x) + "; expected 0 to " + std::to_string(across - 1));
    }
    if (finite && (params_.tile->z < 0 || params_.tile->z >= across)) {
      error(IssueKind::out_of_range, "/tile/z",
            "found " + std::to_string(params_.tile->z) + "; expected 0 to " + std::to_string(across - 1));
    }
    if (params_.edge.value_or(TerrainEdge::two_neighbours) != TerrainEdge::two_neighbours)
      error(conflict_with({"tile"}), "/edge",
            "tiles only fit together under the rule two_neighbours; with others, the border depends on the "
            "inside");
    error_if(params_.corners.has_value(), conflict_with({"tile"}), "/corners",
             "tiles share their corners with their neighbours, so the seed determines them");
    error_if(params_.grid.has_value(), conflict_with({"tile"}), "/grid",
             "tiles share their start heights with their neighbours, so the seed determines them");
    tile_filters(faults);
  }

  /// A filter of a tile must not read samples beyond the margin, unless it has the values of the whole world.
  void tile_filters(bool faults) {
    constexpr int farthest_smooth = 256;
    if (smooth_reach(params_.smooth) > farthest_smooth) {
      error(IssueKind::out_of_range, "/smooth",
            "found " + Json(params_.smooth).dump() + " %, which reads samples farther than " +
                std::to_string(farthest_smooth) + " samples away; expected at most 93.7 % for a tile");
    }
    error_if(params_.normalise && !params_.normalise->from, missing_for({"from", "tile"}), "/normalise",
             "\"from\" is missing; a tile cannot use the range of heights of all tiles");
    error_if(params_.terraces && !params_.terraces->from, missing_for({"from", "tile"}), "/terraces",
             "\"from\" is missing; a tile cannot use the range of heights of all tiles");
    error_if(params_.island && !params_.island->floor, missing_for({"floor", "tile"}), "/island",
             "\"floor\" is missing; a tile cannot use the lowest height of all tiles");
    error_if(params_.island && !faults && !params_.tile->across,
             missing_for({"across", "algorithm", "island"}), "/tile",
             "\"across\" is missing; an island needs the number of its tiles along a side");
    if (params_.hydraulic) hydraulic_tile();
    error_if(params_.resample.has_value(), conflict_with({"tile"}), "/resample",
             "the samples of a tile are those of the world; expected resolution or iterations instead");
  }

  /// Water runs over the whole world, so each tile needs all of it.
  void hydraulic_tile() {
    constexpr std::int64_t longest_side = 4'097;
    if (!params_.tile->across) {
      return error(missing_for({"across", "hydraulic"}), "/tile",
                   "\"across\" is missing; water needs the number of tiles of its world along a side");
    }
    if (const std::int64_t side = samples_across(params_); side > longest_side) {
      error(IssueKind::out_of_range, "/tile/across",
            "found a world of " + std::to_string(side) + " samples along a side; the limit with water is " +
                std::to_string(longest_side));
    }
  }

  void hydraulic() {
    const TerrainHydraulic& given = *params_.hydraulic;
    const bool drops = given.method == TerrainMethod::droplets;
    const auto belongs_to = [&](bool has, bool to_drops, const char* name) {
      if (has && drops != to_drops) {
        error(conflict_with({"method"}), std::string("/hydraulic/") + name,
              std::string(text_of(given.method)) + " does not have this parameter; expected the method " +
                  (to_drops ? "droplets" : "stream_power"));
      }
    };
    belongs_to(given.droplets.has_value(), true, "droplets");
    belongs_to(given.lifetime.has_value(), true, "lifetime");
    belongs_to(given.inertia.has_value(), true, "inertia");
    belongs_to(given.capacity.has_value(), true, "capacity");
    belongs_to(given.erosion.has_value(), true, "erosion");
    belongs_to(given.deposition.has_value(), true, "deposition");
    belongs_to(given.evaporation.has_value(), true, "evaporation");
    belongs_to(given.radius.has_value(), true, "radius");
    belongs_to(given.iterations.has_value(), false, "iterations");
    belongs_to(given.strength.has_value(), false, "strength");
    belongs_to(given.area_exponent.has_value(), false, "area_exponent");
  }

  void onto() {
    const auto refuse = [&](bool given, const char* pointer) {
      error_if(given, conflict_with({"onto"}), pointer,
               "heights on a model do not have this parameter; expected a request without onto");
    };
    refuse(params_.shape == TerrainShape::sphere, "/shape");
    refuse(params_.tile.has_value(), "/tile");
    refuse(params_.mesh != TerrainMesh::grid, "/mesh");
    refuse(params_.skirt > 0, "/skirt");
    refuse(params_.base.has_value(), "/base");
    refuse(params_.water_level.has_value(), "/water_level");
    refuse(params_.detail, "/detail");
    refuse(params_.refine.has_value(), "/refine");
    const bool moves = params_.onto->mapping == TerrainMapping::displacement;
    error_if(moves && params_.texture > 0, conflict_with({"onto/mapping"}), "/texture",
             "a displacement has no texture; expected the mapping normal_map");
    error_if(!moves && params_.onto->subdivide > 0, conflict_with({"mapping"}), "/onto/subdivide",
             "a normal map does not subdivide; expected the mapping displacement");
  }

  void mesh() {
    error_if(params_.refine && (params_.mesh != TerrainMesh::grid || params_.texture > 0),
             conflict_with({"mesh", "texture"}), "/refine",
             "divides the squares of a grid; expected the mesh grid and texture 0");
    error_if(params_.max_error && params_.mesh == TerrainMesh::grid, conflict_with({"mesh"}), "/max_error",
             "a grid has every sample and no error; expected the mesh rtin or greedy");
    error_if(params_.base && params_.skirt > 0, conflict_with({"base"}), "/skirt",
             "a closed solid has no skirt");
    error_if(params_.detail && params_.texture > 0, conflict_with({"texture"}), "/detail",
             "a ground with a texture of the whole field has no details that repeat; expected texture 0");
    error_if(params_.texture > 0 && params_.texture < least_texture, IssueKind::out_of_range, "/texture",
             "found " + std::to_string(params_.texture) + "; expected 0, or " +
                 std::to_string(least_texture) + " to 4096");
    if (!issues_.empty() || params_.mesh != TerrainMesh::rtin || params_.algorithm == Algorithm::image)
      return;
    const int side = finished_side(params_);
    error_if(!fits_rtin(side, side), conflict_with({"resolution", "iterations", "resample"}), "/mesh",
             "this field has " + std::to_string(side) +
                 " samples along a side; rtin needs 2^n + 1; resample the field, or use greedy");
  }

  const TerrainParams& params_;
  const Limits& limits_;
  std::vector<Issue> issues_;
};

}  // namespace

std::vector<Issue> errors_between(const TerrainParams& params, const Limits& limits) {
  return Check(params, limits).run();
}

}  // namespace seedmesh::terrain
