/// Faults between parameters; see plan.h.
#include <array>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>

#include "core/generators/terrain/plan.h"
#include "core/generators/terrain/triangulation.h"
#include "core/schema/json.h"
#include "generated/params/terrain.h"

namespace seedmesh::terrain {
namespace {

using Algorithm = TerrainAlgorithm;

// Rounds that give the longest side, and octaves beyond which a float holds no more detail.
constexpr int most_rounds = 14, most_octaves = 16;
constexpr int longest_sphere = 1025;
constexpr int least_texture = 16;

class Check {
 public:
  Check(const TerrainParams& params, const Limits& limits) : params_(params), limits_(limits) {}

  std::vector<Issue> run() {
    belongings();
    iterations();
    heights();
    if (params_.shape == TerrainShape::sphere) sphere();
    if (params_.tile) tile();
    if (params_.hydraulic) hydraulic();
    if (params_.onto) onto();
    mesh();
    return std::move(issues_);
  }

 private:
  void fault(std::string pointer, std::string message) {
    issues_.push_back({std::move(pointer), std::move(message)});
  }

  bool is(std::initializer_list<Algorithm> algorithms) const {
    for (const Algorithm each : algorithms) {
      if (params_.algorithm == each) return true;
    }
    return false;
  }

  /// A parameter that means nothing to the algorithm is refused, not overlooked.
  template <class Value>
  void belongs(const char* name, const std::optional<Value>& value, std::initializer_list<Algorithm> to) {
    if (!value || is(to)) return;
    std::string owners;
    for (const Algorithm each : to) owners += (owners.empty() ? "" : ", ") + std::string(text_of(each));
    fault(std::string("/") + name,
          std::string(text_of(params_.algorithm)) + " has no " + name + "; it belongs to " + owners);
  }

  void belongings() {
    using enum TerrainAlgorithm;
    belongs("resolution", params_.resolution, {fault_formation, poisson_faulting, fbm});
    belongs("amplitude", params_.amplitude, {triangular_edge, diamond_square, square_square, fbm});
    belongs("hurst", params_.hurst, {triangular_edge, diamond_square, square_square, fbm});
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
    belongs("image", params_.image, {image});
    if (is({image}) && !params_.image)
      fault("", "\"image\" is missing: the algorithm image takes its heights from it");
    if (is({triangular_edge}) && params_.hurst &&
        params_.mode.value_or(TerrainMode::random) == TerrainMode::random)
      fault("/hurst", "the random mode has deviations of one size; hurst belongs to the mode midpoint");
    if (params_.fault_width &&
        params_.fault_step.value_or(TerrainFaultStep::hard) == TerrainFaultStep::hard &&
        is({fault_formation, poisson_faulting}))
      fault("/fault_width", "a hard step has no width; choose fault_step line or cosine");
  }

  void iterations() {
    const int planned = planned_iterations(params_), all = all_iterations(params_);
    const std::string found =
        "found " + std::to_string(planned) +
        (params_.extra_iterations > 0 ? " and " + std::to_string(params_.extra_iterations) + " extra" : "");
    using enum TerrainAlgorithm;
    if (is({image})) {
      if (params_.iterations) fault("/iterations", "an image has no iterations");
      if (params_.extra_iterations > 0) fault("/extra_iterations", "an image has no iterations");
    } else if (is({triangular_edge, diamond_square, square_square}) && all > most_rounds) {
      fault("/iterations", found + "; a subdivision has at most " + std::to_string(most_rounds) +
                               " rounds, which give " + std::to_string(longest_side) + " samples a side");
    } else if (is({fbm}) && (all < 1 || all > most_octaves)) {
      fault("/iterations", found + "; noise has 1 to " + std::to_string(most_octaves) + " octaves");
    } else if (static_cast<std::uint32_t>(all) > limits_.iterations) {
      fault("/iterations", found + "; the limit is " + std::to_string(limits_.iterations));
    }
  }

  void heights() {
    if (is({Algorithm::fault_formation, Algorithm::poisson_faulting})) {
      const FaultPlan plan = fault_plan(params_);
      if (plan.least > plan.greatest)
        fault("/fault_min", "the least fault is above the greatest, " + std::to_string(plan.greatest) + " m");
    }
    if (params_.normalise && params_.normalise->low > params_.normalise->high)
      fault("/normalise/low", "the lowest height is above the highest");
    if (params_.normalise) rising("/normalise/from", params_.normalise->from);
    if (params_.terraces) rising("/terraces/from", params_.terraces->from);
    if (params_.island && params_.island->floor && params_.island->depth)
      fault("/island/depth", "the floor says already how deep the rim lies");
    if (params_.image && params_.image->width && params_.image->encoding != TerrainEncoding::r16 &&
        params_.image->encoding != TerrainEncoding::r16_big)
      fault("/image/width", "a PNG tells its own width; this belongs to raw data (r16, r16_big)");
    if (params_.image && params_.image->low == params_.image->high)
      fault("/image/high", "low and high are the same height");
    const TerrainHeightmap& map = params_.heightmap;
    if (map.low && map.high && *map.low >= *map.high) fault("/heightmap/low", "low is not below high");
  }

  void rising(const char* pointer, const std::optional<std::array<double, 2>>& pair) {
    if (pair && (*pair)[0] >= (*pair)[1]) fault(pointer, "the first height is not below the second");
  }

  void sphere() {
    using enum TerrainAlgorithm;
    if (!is({poisson_faulting, fbm}))
      return fault("/shape", std::string(text_of(params_.algorithm)) +
                                 " makes planes; spheres are made by poisson_faulting and fbm");
    if (params_.resolution && *params_.resolution > longest_sphere)
      fault("/resolution", "found " + std::to_string(*params_.resolution) + "; a sphere has at most " +
                               std::to_string(longest_sphere) + " samples along an edge of its cube");
    if (params_.fault_step.value_or(TerrainFaultStep::hard) != TerrainFaultStep::hard)
      fault("/fault_step", "faults of a sphere are hard");
    const auto refuse = [&](bool given, const char* pointer) {
      if (given) fault(pointer, "a sphere has none; this belongs to the plane");
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
  }

  void tile() {
    using enum TerrainAlgorithm;
    if (is({image})) return fault("/tile", "an image is one piece");
    const bool faults = is({fault_formation, poisson_faulting});
    if (!faults && params_.tile->across && !params_.island)
      fault(
          "/tile/across",
          "this world has no end; across belongs to fault_formation and poisson_faulting, and to an island");
    const int across = params_.tile->across.value_or(1);
    if (faults && (params_.tile->x < 0 || params_.tile->x >= across))
      fault("/tile/x",
            "found " + std::to_string(params_.tile->x) + " in a world of 0 to " + std::to_string(across - 1));
    if (faults && (params_.tile->z < 0 || params_.tile->z >= across))
      fault("/tile/z",
            "found " + std::to_string(params_.tile->z) + " in a world of 0 to " + std::to_string(across - 1));
    if (params_.edge.value_or(TerrainEdge::two_neighbours) != TerrainEdge::two_neighbours)
      fault(
          "/edge",
          "tiles meet under the rule two_neighbours alone: the others carry a tile's inside into its border");
    if (params_.corners)
      fault("/corners", "corners of a tile belong to its neighbours too and are drawn from the seed");
    if (params_.grid)
      fault("/grid", "start heights of a tile belong to its neighbours too and are drawn from the seed");
    tile_filters(faults);
  }

  /// Filters of tiles look no farther than a tile can see, or know the whole world beforehand.
  void tile_filters(bool faults) {
    constexpr int farthest_smooth = 256;
    if (smooth_reach(params_.smooth) > farthest_smooth)
      fault("/smooth", "found " + Json(params_.smooth).dump() + " %, which carries a height farther than " +
                           std::to_string(farthest_smooth) +
                           " samples, deep into the next tile; tiles take at most 93.7 %");
    if (params_.normalise && !params_.normalise->from)
      fault("/normalise",
            "\"from\" is missing: a tile does not know the lowest and the highest height of its neighbours");
    if (params_.terraces && !params_.terraces->from)
      fault("/terraces",
            "\"from\" is missing: a tile does not know the lowest and the highest height of its neighbours");
    if (params_.island && !params_.island->floor)
      fault("/island", "\"floor\" is missing: a tile does not know the lowest height of its neighbours");
    if (params_.island && !faults && !params_.tile->across)
      fault("/tile", "\"across\" is missing: it says how many tiles the island fills");
    if (params_.hydraulic && params_.hydraulic->method == TerrainMethod::droplets)
      fault(
          "/hydraulic",
          "drops change the ground for those that fall after them, batch by batch, so that what one does is "
          "felt many tiles away; erode one field and cut that, or use thermal");
    if (params_.hydraulic && params_.hydraulic->method == TerrainMethod::stream_power)
      fault("/hydraulic",
            "a river depends on all the ground that it drains, which no tile sees; erode one field and cut "
            "that, or use thermal");
    if (params_.resample)
      fault("/resample", "samples of tiles lie where the world has them; choose resolution or iterations");
  }

  void hydraulic() {
    const TerrainHydraulic& given = *params_.hydraulic;
    const bool drops = given.method == TerrainMethod::droplets;
    const auto belongs_to = [&](bool has, bool to_drops, const char* name) {
      if (has && drops != to_drops)
        fault(std::string("/hydraulic/") + name, std::string(text_of(given.method)) +
                                                     " has none; it belongs to " +
                                                     (to_drops ? "droplets" : "stream_power"));
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
      if (given) fault(pointer, "heights that lie on a model have none; this belongs to a ground");
    };
    refuse(params_.shape == TerrainShape::sphere, "/shape");
    refuse(params_.tile.has_value(), "/tile");
    refuse(params_.mesh != TerrainMesh::grid, "/mesh");
    refuse(params_.skirt > 0, "/skirt");
    refuse(params_.base.has_value(), "/base");
    refuse(params_.water_level.has_value(), "/water_level");
    const bool moves = params_.onto->mapping == TerrainMapping::displacement;
    if (moves && params_.texture > 0) fault("/texture", "a displacement has no picture; normal_map has");
    if (!moves && params_.onto->subdivide > 0)
      fault("/onto/subdivide", "a normal map moves nothing; displacement does");
  }

  void mesh() {
    if (params_.max_error && params_.mesh == TerrainMesh::grid)
      fault("/max_error", "a grid has every sample; greatest errors belong to rtin and greedy");
    if (params_.base && params_.skirt > 0) fault("/skirt", "a closed solid has no skirt");
    if (params_.texture > 0 && params_.texture < least_texture)
      fault("/texture", "found " + std::to_string(params_.texture) + "; expected 0, or " +
                            std::to_string(least_texture) + " to 4096");
    if (!issues_.empty() || params_.mesh != TerrainMesh::rtin || params_.algorithm == Algorithm::image)
      return;
    const int side = finished_side(params_);
    if (!fits_rtin(side, side))
      fault("/mesh", "rtin wants 2^n + 1 samples a side and this field has " + std::to_string(side) +
                         "; resample it, or use greedy");
  }

  const TerrainParams& params_;
  const Limits& limits_;
  std::vector<Issue> issues_;
};

}  // namespace

std::vector<Issue> faults_between(const TerrainParams& params, const Limits& limits) {
  return Check(params, limits).run();
}

}  // namespace seedmesh::terrain
