#include "core/generators/world/canopy.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "core/base/math.h"
#include "core/generators/world/palette.h"
#include "core/generators/world/plant_mesh.h"
#include "core/generators/world/plants.h"
#include "core/generators/world/terrain_mesh.h"

namespace seedmesh::world {
namespace {

constexpr double least_height = 3;     ///< metres; lower classes are not seen from afar
constexpr double least_closure = 0.6;  ///< share of the ground that crowns cover at their spacing
constexpr double jitter = 0.28;        ///< share of the spacing of samples, to each side
constexpr double river_gap = 0.75;     ///< share of the spacing of samples, from woods to water
constexpr double brightness = 1.3;     ///< makes up for the mean of the texture
constexpr double edge_light = 0.86;    ///< of the foot of edges
constexpr double ragged = 0.34;        ///< share of the spacing of samples by which edges leave their line

struct Corner {
  Wood wood;
  bool is_wood = false;
  glm::dvec3 at{};      ///< east, north, height
  glm::dvec3 normal{};  ///< east, north, up
  double light = 1;
  int vertex = -1;
};

/// The surface over the woods of a tile, on the lattice of its samples.
class Canopy {
 public:
  Canopy(const World& world, const TileFrame& frame, const TerrainGrid& grid, double base)
      : world_(world), frame_(frame), grid_(grid), base_(base), wide_(grid.count + 2) {
    corners_.resize(static_cast<std::size_t>(wide_) * static_cast<std::size_t>(wide_));
  }

  bool find_woods(Job& job) {
    bool is_any = false;
    for (int row = -1; row <= grid_.count; ++row) {
      job.check();
      for (int column = -1; column <= grid_.count; ++column) {
        Corner& c = at(column, row);
        const double east = east_of(column), north = north_of(row);
        const GroundSample& sample = grid_.at(column, row);
        c.wood = wood_at(world_, sample, climate_at(world_, east, north, sample.height), east, north,
                         grid_.spacing);
        // rivers on the terrain stay in sight
        if (sample.shore < river_gap * grid_.spacing) c.wood.cover = std::min(c.wood.cover, 0.1);
        c.is_wood = c.wood.cover > wood_edge;
        is_any |= c.is_wood;
      }
    }
    return is_any;
  }

  void make() {
    for (int row = 0; row < grid_.count; ++row) {
      for (int column = 0; column < grid_.count; ++column) {
        if (at(column, row).is_wood) {
          place_crown(column, row);
        } else {
          place_edge(column, row);
        }
      }
    }
    for (int row = 0; row + 1 < grid_.count; ++row) {
      for (int column = 0; column + 1 < grid_.count; ++column) {
        add_triangle({{{column, row}, {column + 1, row}, {column + 1, row + 1}}});
        add_triangle({{{column, row}, {column + 1, row + 1}, {column, row + 1}}});
      }
    }
  }

  TileMesh mesh;
  std::vector<float> coordinates;  ///< texture coordinates

 private:
  using Place = std::array<int, 2>;

  Corner& at(int column, int row) {
    return corners_[static_cast<std::size_t>((row + 1) * wide_ + column + 1)];
  }
  double east_of(int column) const { return grid_.west + column * grid_.spacing; }
  double north_of(int row) const { return grid_.south + row * grid_.spacing; }
  bool is_border(int k) const { return k == 0 || k == grid_.count - 1; }

  Rng random_at(int column, int row) const {
    return Rng(cell_key(world_.key ^ 0x43414E4F5059U, math::to_int64(east_of(column) / grid_.spacing),
                        math::to_int64(north_of(row) / grid_.spacing)));
  }

  /// Inside of woods: the top of a crown, moved and tilted so that crowns are uneven. Borders stay in their planes.
  void place_crown(int column, int row) {
    Corner& c = at(column, row);
    Rng rng = random_at(column, row);
    const double by = jitter * grid_.spacing;
    const double x = rng.uniform(-by, by), y = rng.uniform(-by, by), high = rng.uniform(0.6, 0.92);
    // wide cells are no crowns: tilted as much, they would be streaks
    const double tilt = 0.4 - 0.25 * smooth_step(grid_.spacing, 16, 128);
    const double tilt_east = rng.uniform(-tilt, tilt), tilt_north = rng.uniform(-tilt, tilt);
    c.light = rng.uniform(0.8, 1.15);
    c.at = {east_of(column) + (is_border(column) ? 0 : x), north_of(row) + (is_border(row) ? 0 : y),
            grid_.at(column, row).height + high * c.wood.height};
    const double run = 2 * grid_.spacing;
    const double east = (grid_.at(column + 1, row).height - grid_.at(column - 1, row).height) / run;
    const double north = (grid_.at(column, row + 1).height - grid_.at(column, row - 1).height) / run;
    c.normal = math::unit(glm::dvec3(tilt_east - east, tilt_north - north, 1), {0, 0, 1});
  }

  /// Beside woods: the foot of their edge, where the cover falls below that of woods.
  void place_edge(int column, int row) {
    Corner& c = at(column, row);
    Rng rng = random_at(column, row);
    const double bay = rng.uniform(-ragged, ragged);
    glm::dvec3 sum(0), out(0);
    Wood wood;
    int count = 0;
    for (const Place& by :
         {Place{1, 0}, Place{0, 1}, Place{1, 1}, Place{-1, 0}, Place{0, -1}, Place{-1, -1}}) {
      const Corner& other = at(column + by[0], row + by[1]);
      if (!other.is_wood) continue;
      const double line = (wood_edge - c.wood.cover) / (other.wood.cover - c.wood.cover);
      const double t = std::clamp(line + bay, 0.05, 0.8);
      const double height = grid_.at(column, row).height;
      sum += glm::dvec3(by[0] * t * grid_.spacing, by[1] * t * grid_.spacing,
                        t * (grid_.at(column + by[0], row + by[1]).height - height));
      out -= glm::dvec3(by[0], by[1], 0);
      for (std::size_t k = 0; k < 3; ++k) wood.color[k] += other.wood.color[k];
      ++count;
    }
    if (count == 0) return;
    sum /= count;
    for (std::size_t k = 0; k < 3; ++k) c.wood.color[k] = wood.color[k] / count;
    c.light = edge_light * rng.uniform(0.85, 1.1);
    c.at = {east_of(column) + (is_border(column) ? 0 : sum.x), north_of(row) + (is_border(row) ? 0 : sum.y),
            grid_.at(column, row).height + sum.z - 0.2};
    // edges are rows of round crowns, lit from above even on the side away from the sun
    c.normal = math::unit(math::unit(out, {0, 0, 1}) * 0.55 + glm::dvec3(0, 0, 1), {0, 0, 1});
  }

  void add_triangle(const std::array<Place, 3>& places) {
    bool is_any = false;
    for (const Place& p : places) is_any |= at(p[0], p[1]).is_wood;
    if (!is_any) return;
    for (const Place& p : places)
      mesh.indices.push_back(static_cast<std::uint32_t>(vertex_of(at(p[0], p[1]))));
  }

  int vertex_of(Corner& c) {
    if (c.vertex >= 0) return c.vertex;
    c.vertex = static_cast<int>(mesh.vertices.size());
    TileVertex v;
    const auto steps = [&](double metres) {
      return static_cast<std::int16_t>(math::to_int32(std::floor(metres / frame_.step + 0.5)));
    };
    const auto byte = [](double value) {
      return static_cast<std::int8_t>(math::to_int32(std::floor(value * 127 + 0.5)));
    };
    v.x = steps(c.at.x - frame_.middle_east);
    v.y = steps_of(c.at.z, base_, frame_.step);
    v.z = steps(frame_.middle_north - c.at.y);
    v.normal[0] = byte(c.normal.x);
    v.normal[1] = byte(c.normal.z);
    v.normal[2] = byte(-c.normal.y);
    for (std::size_t k = 0; k < 3; ++k) {
      const double value = std::clamp(c.wood.color[k] * brightness * c.light, 0.0, 1.0);
      v.color[k] = static_cast<std::uint8_t>(math::to_int32(value * 255 + 0.5));
    }
    mesh.vertices.push_back(v);
    coordinates.push_back(static_cast<float>((c.at.x - frame_.west) / canopy_texture_side));
    coordinates.push_back(static_cast<float>((c.at.y - frame_.south) / canopy_texture_side));
    return c.vertex;
  }

  static constexpr double canopy_texture_side = 128;  ///< metres; divides the sides of tiles

  const World& world_;
  const TileFrame& frame_;
  const TerrainGrid& grid_;
  double base_;
  int wide_;
  std::vector<Corner> corners_;
};

}  // namespace

bool has_canopy(const WorldClass& plant) {
  return plant.height >= least_height && crown_width(plant) >= least_closure * plant.spacing;
}

Wood wood_at(const World& world, const GroundSample& sample, const Climate& climate, double east,
             double north, double spacing) {
  Wood wood;
  double sum = 0;
  for (std::size_t k = 0; k < world.params.plants.size(); ++k) {
    const WorldClass& plant = world.params.plants[k];
    if (!has_canopy(plant)) continue;
    const double cover = wood_cover(world, static_cast<int>(k), sample, climate, {east, north}, spacing);
    if (cover <= 0) continue;
    const auto color = linear_color(plant.color);
    wood.cover = std::max(wood.cover, cover);
    wood.height += cover * plant.height;
    for (std::size_t n = 0; n < 3; ++n) wood.color[n] += cover * color[n] / 255;
    sum += cover;
  }
  if (sum <= 0) return wood;
  wood.height /= sum;
  for (double& value : wood.color) value /= sum;
  return wood;
}

void add_canopy(Glb& glb, const World& world, const TileFrame& frame, const TileGround& ground, Job& job) {
  Canopy canopy(world, frame, ground.grid, ground.base);
  if (!canopy.find_woods(job)) return;
  canopy.make();
  if (canopy.mesh.indices.empty()) return;
  job.spend(Resource::triangles, canopy.mesh.indices.size() / 3);
  const std::string image = shared_files + canopy_texture(world, job)->hash + ".png";
  glb.add_mesh("plants", canopy.mesh, glb.add_material("canopy", 1, image), frame.step, ground.base,
               canopy.coordinates);
}

}  // namespace seedmesh::world
