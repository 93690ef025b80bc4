/// scatter(surface | volume | scope, count, uniform | gaussian, centre, deviation){ A }: points at random.
#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/building/interpret.h"
#include "core/generators/building/operator_arguments.h"
#include "core/generators/building/operators.h"
#include "core/generators/building/solid_tools.h"

namespace seedmesh::building::operators {
namespace {

constexpr double most_points = 1'000'000;
constexpr int most_tries = 1'000;  ///< attempts to find a point inside

enum class Domain : std::uint8_t { surface, volume, scope };

/// The triangles of all faces, with the sums of their areas.
struct Surface {
  Solid solid;
  std::vector<std::uint32_t> triangles;
  std::vector<double> sums;

  Surface(Solid given, const Job& job) : solid(std::move(given)) {
    for (const Face& face : solid.faces) {
      for (const std::uint32_t corner : triangles_of(solid, face, job)) triangles.push_back(corner);
    }
    double sum = 0;
    for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
      const glm::dvec3 a = at(t), b = at(t + 1), c = at(t + 2);
      sums.push_back(sum += 0.5 * glm::length(glm::cross(b - a, c - a)));
    }
  }
  const glm::dvec3& at(std::size_t corner) const { return solid.points[triangles[corner]]; }

  /// Uniform over the area (Osada and others, 2002).
  glm::dvec3 point(Rng& random, glm::dvec3& normal) const {
    const double wanted = random.unit() * sums.back();
    const auto found = static_cast<std::size_t>(std::ranges::upper_bound(sums, wanted) - sums.begin());
    const std::size_t t = 3 * std::min(found, sums.size() - 1);
    const double root = std::sqrt(random.unit()), share = random.unit();
    normal = glm::cross(at(t + 1) - at(t), at(t + 2) - at(t));
    return (1 - root) * at(t) + root * (1 - share) * at(t + 1) + root * share * at(t + 2);
  }
};

/// Whether a point lies inside a closed solid, by the crossings of a ray along x with its triangles.
bool is_inside_of(const Surface& surface, const glm::dvec3& p) {
  int crossings = 0;
  for (std::size_t t = 0; t + 2 < surface.triangles.size(); t += 3) {
    const glm::dvec3 a = surface.at(t) - p, b = surface.at(t + 1) - p, c = surface.at(t + 2) - p;
    const double u = b.y * c.z - b.z * c.y, v = c.y * a.z - c.z * a.y, w = a.y * b.z - a.z * b.y;
    if ((u < 0 || v < 0 || w < 0) && (u > 0 || v > 0 || w > 0)) continue;
    const double sum = u + v + w;
    if (sum != 0 && (u * a.x + v * b.x + w * c.x) / sum > 0) ++crossings;
  }
  return crossings % 2 == 1;
}

/// Where a gaussian distribution has its middle, as a share of the scope.
glm::dvec3 centre_of(const Derivation& d, const Step& step, const std::string& word) {
  const std::pair<std::string_view, glm::dvec3> centres[] = {
      {"center", {0.5, 0.5, 0.5}}, {"front", {0.5, 0.5, 1}}, {"back", {0.5, 0.5, 0}},
      {"left", {0, 0.5, 0.5}},     {"right", {1, 0.5, 0.5}}, {"top", {0.5, 1, 0.5}},
      {"bottom", {0.5, 0, 0.5}}};
  for (const auto& [name, at] : centres) {
    if (name == word) return at;
  }
  reject(d, step.offset,
         "found the centre " + lang::in_quotes(word) +
             ", expected center, front, back, left, right, top or bottom");
}

}  // namespace

void scatter(Derivation& d, const Step& step, ShapeState& state, const StepContext& site) {
  const std::string word = word_at(d, step, 0), spread = word_or(d, step, 2, "uniform");
  if (word != "surface" && word != "volume" && word != "scope")
    reject(d, step.offset, "found " + lang::in_quotes(word) + ", expected surface, volume or scope");
  if (spread != "uniform" && spread != "gaussian")
    reject(d, step.offset, "found " + lang::in_quotes(spread) + ", expected uniform or gaussian");
  const double count = std::floor(number_or(d, step, 1, 0) + 1e-9);
  if (!(count <= most_points)) reject(d, step.offset, "scatter would make more than 1,000,000 points");
  take_box_of_asset(d, step, state);
  Domain domain = word == "surface" ? Domain::surface : word == "volume" ? Domain::volume : Domain::scope;
  Solid solid;
  if (dimension(state.size) >= 2) solid = solid_in_metres(d, state);
  const bool is_closed = dimension(state.size) == 3 && (state.geometry == box_geometry || solid.is_closed);
  if (domain == Domain::volume && !is_closed) domain = Domain::surface;
  const Surface surface(std::move(solid), d.job);
  if (domain != Domain::scope && (surface.sums.empty() || !(surface.sums.back() > 0))) domain = Domain::scope;
  const bool is_gaussian = spread == "gaussian";
  const glm::dvec3 centre =
      is_gaussian ? centre_of(d, step, word_or(d, step, 3, "center")) * state.size : glm::dvec3(0);
  const double deviation = number_or(d, step, 4, 0.16) * std::max({state.size.x, state.size.y, state.size.z});
  Frame own = site.frame;
  for (double i = 0; i < count; ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    Rng random(key_at(key_at(site.key, 0xFFFF'FFFF'0003U), index));
    glm::dvec3 p(0), normal(0);
    for (int tries = 0; tries < most_tries; ++tries) {
      if ((tries & 15) == 15) d.job.check();
      if (domain == Domain::surface) {
        p = surface.point(random, normal);
        // A gaussian density by rejection: points far from the centre are kept less often.
        const double far = deviation > 0 ? glm::length(p - centre) / deviation : 0;
        if (!is_gaussian || !(deviation > 0) || random.unit() < math::exp(-0.5 * far * far)) break;
        continue;
      }
      for (int axis = 0; axis < 3; ++axis) {
        p[axis] = is_gaussian ? seedmesh::normal(random, centre[axis], deviation)
                              : random.uniform(0, state.size[axis]);
      }
      bool is_in = true;
      for (int axis = 0; axis < 3; ++axis) is_in &= p[axis] >= 0 && p[axis] <= state.size[axis];
      if (is_in && (domain == Domain::scope || is_inside_of(surface, p))) break;
    }
    if ((index & 255U) == 0) d.job.check();
    ShapeState point = state;
    point.origin = state.origin + d.out.axes[state.axes] * p;
    point.size = glm::dvec3(0);
    point.geometry = box_geometry;
    point.roof_up = no_roof;
    point.split_index = index;
    point.split_total = static_cast<std::uint32_t>(count);
    own.key = key_at(site.key, index);
    run_body(d, d.grammar.parts[step.first_part].body, point, own);
  }
}

}  // namespace seedmesh::building::operators
