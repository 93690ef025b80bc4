#include "core/geom/lod/coarse_limbs.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/geom/lod/coarsening.h"

namespace seedmesh {
namespace {

// Longer limbs are simplified in pieces of this many stations.
constexpr std::size_t longest_piece = 2048;
// Bisection of the multiplier between the greatest one and this share of it: exact to a few triangles.
constexpr int halvings = 40;
constexpr float multiplier_range = 1e-12F;
// Numbers of corners that skin() may use instead of that of the finest level, in descending order.
constexpr int fewer_corners[] = {48, 32, 24, 16, 12, 10, 8, 6, 5, 4, 3};
// Coefficients of the mean difference of the outline, as a share of a limb's width, over all directions. They
// are measured for limbs whose rings are rotated by half a side, within 0.005.
constexpr float off_by_corners = 0.68F, off_by_finest = 0.52F;
// Cosine of the angle by which a cross-section that is no circle may rotate between joints that can be
// removed.
constexpr float untwisted = 0.99F;
// An end thinner than this share of the previous ring is a point.
constexpr float pointed_share = 0.5F;

}  // namespace

void Coarsening::read() {
  for (const std::uint32_t head : chains_.head) {
    if (first_.size() % check_interval == 0) job_.check();
    first_.push_back(stations_.size());
    corners_.push_back(finest_corners(head));
    read_limb(head);
  }
  first_.push_back(stations_.size());
  kept_.assign(area_.size(), 1);
}

void Coarsening::read_limb(std::uint32_t head) {
  const bool is_root = limbs_.parent[head] == Limbs::none;
  const std::size_t begin = stations_.size();
  const std::uint32_t start = is_root ? head : limbs_.parent[head];
  std::uint32_t joint = is_root ? chains_.next[head] : head;
  const auto add_station = [&](std::uint32_t at, float radius, float error) {
    const int own = options_.skin ? 0 : corners(radius, options_.sides);
    stations_.push_back({at, position_of(at), radius, error, static_cast<float>(own)});
  };
  add_station(start, joint == Limbs::none ? 0.0F : limbs_.base_radius[joint], forever);
  double area = 0;
  for (; joint != Limbs::none; joint = chains_.next[joint]) {
    const glm::vec3 step = position_of(joint) - stations_.back().position;
    const float width = limbs_.base_radius[joint] + limbs_.radius[joint];
    area += static_cast<double>(std::sqrt(glm::dot(step, step)) * width * shown(joint));
    add_station(joint, limbs_.radius[joint], 0);
  }
  const float factor = random_factor(head);
  area_.push_back(factor * static_cast<float>(area));
  const std::size_t end = stations_.size();
  stations_.back().error = forever;
  for (std::size_t i = begin + longest_piece; i < end; i += longest_piece) stations_[i].error = forever;
  for (std::size_t i = begin + 1; i + 1 < end; ++i) {
    if (must_stay(stations_[i].joint, stations_[i + 1].joint)) stations_[i].error = forever;
  }
  for (std::size_t i = begin, next = 0; i + 1 < end; i = next) {
    for (next = i + 1; stations_[next].error != forever;) ++next;
    simplify(i, next);
  }
  for (std::size_t i = begin; i < end; ++i) stations_[i].error *= factor;
}

/// True where a joint has to be kept for another reason than its position.
bool Coarsening::must_stay(std::uint32_t joint, std::uint32_t next) const {
  if (!options_.bones.empty() && options_.bones[joint] != options_.bones[next]) return true;
  if (!limbs_.color.empty() && limbs_.color[joint] != limbs_.color[next]) return true;
  if (limbs_.contour.empty()) return false;
  if (limbs_.contour[joint] != limbs_.contour[next]) return true;
  if (limbs_.contour[joint] == 0 || limbs_.frame.empty()) return false;
  const glm::vec3 left(-1, 0, 0);
  return glm::dot(limbs_.frame[joint] * left, limbs_.frame[next] * left) < untwisted;
}

/// Computes the outline error of all stations between two that are kept. It never exceeds that of the station that
/// splits the enclosing piece.
void Coarsening::simplify(std::size_t first, std::size_t last) {
  struct Piece {
    std::size_t first, last;
    float most;
  };
  std::vector<Piece> pieces{{first, last, forever}};
  while (!pieces.empty()) {
    const Piece piece = pieces.back();
    pieces.pop_back();
    if (piece.last - piece.first < 2) continue;
    const Station &a = stations_[piece.first], &b = stations_[piece.last];
    const glm::vec3 chord = b.position - a.position;
    const float squared = glm::dot(chord, chord);
    float length = 0, worst = 0, farthest = -1;
    std::size_t at = piece.first + 1;
    for (std::size_t i = piece.first + 1; i <= piece.last; ++i) {
      const Station& each = stations_[i];
      const glm::vec3 step = each.position - stations_[i - 1].position;
      length += std::sqrt(glm::dot(step, step));
      if (i == piece.last) break;
      const glm::vec3 from = each.position - a.position;
      const float share = squared > 0 ? std::clamp(glm::dot(from, chord) / squared, 0.0F, 1.0F) : 0.0F;
      const glm::vec3 off = from - chord * share;
      const float between = a.radius + (b.radius - a.radius) * share;
      const float next = limbs_.base_radius[stations_[i + 1].joint];
      const float thicker = std::max(std::abs(each.radius - between), std::abs(next - between));
      const float away = std::sqrt(glm::dot(off, off)), seen = shown(each.joint);
      if ((away + thicker) * seen > farthest) {
        farthest = (away + thicker) * seen;
        at = i;
      }
      // A limb that is displaced by more than its width is missing at one position and superfluous at another.
      worst = std::max(worst, (std::min(away, 2 * each.radius) + thicker) * seen);
    }
    const float error = std::min(piece.most, worst * length);
    stations_[at].error = error;
    pieces.push_back({piece.first, at, error});
    pieces.push_back({at, piece.last, error});
  }
}

/// The triangles of a limb, and the visible area that it loses.
struct Coarsening::LimbCost {
  double triangles = 0, loss = 0;
  LimbCorners corners;
  double sum(float multiplier) const { return loss + static_cast<double>(multiplier) * triangles; }
};

/// `corners` is the number of corners of all rings; 0 uses those of the stations.
Coarsening::LimbCost Coarsening::cost_of(std::size_t limb, int corners, float multiplier) const {
  LimbCost cost;
  float before = stations_[begin(limb)].radius;
  for (std::size_t i = begin(limb); i < end(limb); ++i) {
    const Station& each = stations_[i];
    const float own = corners > 0 ? static_cast<float>(corners) : each.corners;
    if (!stays(each, own, multiplier)) {
      cost.loss += static_cast<double>(each.error);
      continue;
    }
    const auto last = static_cast<double>(own);
    if (i == begin(limb)) {
      cost.triangles += options_.skin ? last - 2 : last;
    } else if (i + 1 < end(limb)) {
      cost.triangles += 2 * last;
      before = each.radius;
    } else {
      const bool is_pointed = options_.pointed && each.radius < pointed_share * before;
      cost.triangles += options_.skin && corners == 3 ? 7 : (is_pointed ? 1 : 3) * last;
    }
  }
  return cost;
}

/// The cost with the number of corners that has the least sum.
Coarsening::LimbCost Coarsening::best_cost(std::size_t limb, float multiplier) const {
  if (!options_.skin) return cost_of(limb, 0, multiplier);
  const int finest = corners_[limb].finest;
  LimbCost best = cost_of(limb, finest, multiplier);
  best.corners = {corners_[limb].finest, corners_[limb].finest};
  for (const int corners : fewer_corners) {
    if (corners >= finest || corners < least_corners_) continue;
    LimbCost cost = cost_of(limb, corners, multiplier);
    const float off = off_by_corners / static_cast<float>(corners * corners) +
                      off_by_finest / static_cast<float>(finest * finest);
    cost.loss += static_cast<double>(off * area_[limb]);
    cost.corners = {static_cast<std::uint8_t>(corners), corners_[limb].finest};
    if (cost.sum(multiplier) < best.sum(multiplier)) best = cost;
  }
  return best;
}

/// Selects what to keep with a multiplier, and returns its triangles.
std::uint64_t Coarsening::count(float multiplier) {
  is_fork_.assign(limbs_.size(), 0);
  double total = 0;
  for (std::size_t limb = area_.size(); limb-- > 0;) {  // children before parents
    if (limb % check_interval == 0) job_.check();
    bool carries = false;
    for (std::size_t i = begin(limb) + 1; i < end(limb); ++i)
      carries = carries || is_fork_[stations_[i].joint] != 0;
    const LimbCost cost = best_cost(limb, multiplier);
    const std::uint32_t head = chains_.head[limb];
    const bool is_root = limbs_.parent[head] == Limbs::none;
    const double lost = options_.skin ? cost.loss : 0;
    const bool loses_more =
        static_cast<double>(area_[limb]) > lost + static_cast<double>(multiplier) * cost.triangles;
    kept_[limb] = carries || (is_root && is_fork_[head]) || loses_more ? 1 : 0;
    if (!kept_[limb]) continue;
    if (options_.skin) corners_[limb] = cost.corners;
    total += cost.triangles;
    if (!is_root) is_fork_[limbs_.parent[head]] = 1;
  }
  return static_cast<std::uint64_t>(total);
}

float Coarsening::multiplier_for(std::uint64_t triangles) {
  if (count(0) <= triangles) return 0;
  float high = 1e-30F;
  for (const float area : area_) high = std::max(high, area);
  float low = high * multiplier_range;
  for (int i = 0; i < halvings && high > low * 1.001F; ++i) {
    const float middle = std::sqrt(low) * std::sqrt(high);
    (count(middle) > triangles ? low : high) = middle;
  }
  return high;
}

CoarseLimbs coarsen(const Limbs& limbs, const CoarseOptions& options, Job& job) {
  return Coarsening(limbs, options, job).run();
}

}  // namespace seedmesh
