#include "core/geom/coarse_limbs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/math.h"
#include "core/base/rng.h"
#include "core/geom/chains.h"

namespace seedmesh {
namespace {

constexpr float forever = std::numeric_limits<float>::infinity();
constexpr std::size_t look_every = 1024;
// Longer limbs are made simpler piece by piece.
constexpr std::size_t longest_piece = 2048;
// Halvings of the price, whose greatest is so many times its least: exact to a few triangles.
constexpr int halvings = 40;
constexpr float price_range = 1e-12F;
// What is hidden counts a little all the same: it is seen through gaps, and when leaves have gone.
constexpr float least_shown = 0.08F;
// By how much chance makes a limb dearer or cheaper at most.
constexpr float most_favour = 0.2F;
// An end thinner than this share of the ring before it is a point.
constexpr float pointed_share = 0.5F;

struct Station {
  std::uint32_t joint = Limbs::none;
  glm::vec3 position{0};
  float radius = 0;
  float worth = 0;    ///< the area by which the outline changes without it
  float corners = 3;  ///< of a ring there
};

class Coarsening {
 public:
  Coarsening(const Limbs& limbs, const CoarseOptions& options, Job& job)
      : limbs_(limbs), options_(options), job_(job), chains_(link_chains(limbs, job)) {
    for (std::size_t i = 0; i < limbs.size(); ++i) {
      if (limbs.parent[i] != Limbs::none) thickest_ = std::max(thickest_, limbs.base_radius[i]);
    }
  }

  CoarseLimbs run() {
    read();
    const float price = price_for(options_.triangles);
    count(price);
    return write(price);
  }

 private:
  void read();
  void read_limb(std::uint32_t head);
  void simplify(std::size_t first, std::size_t last);
  float price_for(std::uint64_t triangles);
  std::uint64_t count(float price);
  bool stays(std::size_t limb, std::size_t station, float price) const;
  bool must_stay(std::uint32_t joint, std::uint32_t next) const;
  CoarseLimbs write(float price);
  void write_limb(std::size_t limb, float price, CoarseLimbs& out, Array<std::uint32_t>& place);
  std::uint32_t add(std::uint32_t joint, std::uint32_t parent, CoarseLimbs& out) const;

  int corners(float radius, int sides, double power) const {
    const double share = thickest_ > 0 ? static_cast<double>(std::min(1.0F, radius / thickest_)) : 1;
    const int wanted = math::to_int32(sides * math::pow(std::max(share, 1e-6), power) + 0.5);
    if (wanted <= 3) return 3;
    return options_.even && wanted != sides ? wanted + wanted % 2 : wanted;
  }
  /// What a tube of as many corners as this level has must be thicker by to look as wide in the mean, after
  /// Cauchy: the mean width of a convex outline is its circumference by pi.
  float widening(float radius) const {
    const auto round = [&](int sides, double power) {
      const int n = corners(radius, sides, power);
      return n * math::sin(math::pi / n);
    };
    return static_cast<float>(round(options_.finest_sides, options_.finest_power) /
                              round(options_.sides, options_.power));
  }
  /// Limbs that are alike do not go all at one price.
  float favour_of(std::uint32_t head) const {
    const std::uint64_t hash = key_at(limbs_.key.empty() ? head : limbs_.key[head], 0xFA70);
    return 1 + most_favour * (static_cast<float>(hash >> 40U) * 0x1p-23F - 1);
  }
  const glm::vec3& place_of(std::uint32_t joint) const {
    return options_.drawn.empty() ? limbs_.position[joint] : options_.drawn[joint];
  }
  float shown(std::uint32_t joint) const {
    return options_.shown.empty() ? 1.0F : std::max(least_shown, options_.shown[joint]);
  }
  std::size_t begin(std::size_t limb) const { return first_[limb]; }
  std::size_t end(std::size_t limb) const { return first_[limb + 1]; }

  const Limbs& limbs_;
  const CoarseOptions& options_;
  Job& job_;
  Chains chains_;
  float thickest_ = 0;
  std::vector<Station> stations_;      ///< limb by limb, from where each begins
  std::vector<std::size_t> first_;     ///< station of each limb; one more at the end
  std::vector<float> area_;            ///< of each limb, what is seen of it
  std::vector<std::uint8_t> kept_;     ///< of each limb, at the last price that was counted
  std::vector<std::uint8_t> is_fork_;  ///< of each joint: limbs that are kept leave it
};

void Coarsening::read() {
  for (const std::uint32_t head : chains_.head) {
    if (first_.size() % look_every == 0) job_.check();
    first_.push_back(stations_.size());
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
  const auto add_station = [&](std::uint32_t at, float radius, float worth) {
    stations_.push_back({at, place_of(at), radius, worth,
                         static_cast<float>(corners(radius, options_.sides, options_.power))});
  };
  add_station(start, joint == Limbs::none ? 0.0F : limbs_.base_radius[joint], forever);
  double area = 0;
  for (; joint != Limbs::none; joint = chains_.next[joint]) {
    const glm::vec3 step = place_of(joint) - stations_.back().position;
    const float width = limbs_.base_radius[joint] + limbs_.radius[joint];
    area += static_cast<double>(std::sqrt(glm::dot(step, step)) * width * shown(joint));
    add_station(joint, limbs_.radius[joint], 0);
  }
  const float favour = favour_of(head);
  area_.push_back(favour * static_cast<float>(area));
  const std::size_t end = stations_.size();
  stations_.back().worth = forever;
  for (std::size_t i = begin + longest_piece; i < end; i += longest_piece) stations_[i].worth = forever;
  for (std::size_t i = begin + 1; i + 1 < end; ++i) {
    if (must_stay(stations_[i].joint, stations_[i + 1].joint)) stations_[i].worth = forever;
  }
  for (std::size_t i = begin, next; i + 1 < end; i = next) {
    for (next = i + 1; stations_[next].worth != forever;) ++next;
    simplify(i, next);
  }
  for (std::size_t i = begin; i < end; ++i) stations_[i].worth *= favour;
}

/// For another reason than its place.
bool Coarsening::must_stay(std::uint32_t joint, std::uint32_t next) const {
  if (!options_.bones.empty() && options_.bones[joint] != options_.bones[next]) return true;
  return options_.for_skin && (limbs_.color[joint] != limbs_.color[next] || !limbs_.contour.empty());
}

/// Gives every station between two that stay its worth: never more than that of the one that it hangs on.
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
      // Off by more than its width, a limb is missed at one place and too much at another.
      worst = std::max(worst, (std::min(away, 2 * each.radius) + thicker) * seen);
    }
    const float worth = std::min(piece.most, worst * length);
    stations_[at].worth = worth;
    pieces.push_back({piece.first, at, worth});
    pieces.push_back({at, piece.last, worth});
  }
}

bool Coarsening::stays(std::size_t limb, std::size_t station, float price) const {
  const Station& each = stations_[station];
  if (each.worth == forever) return true;
  if (options_.for_skin && station > begin(limb) && is_fork_[each.joint]) return true;
  return each.worth > price * 2 * each.corners;
}

/// The triangles of what stays at this price.
std::uint64_t Coarsening::count(float price) {
  is_fork_.assign(limbs_.size(), 0);
  double total = 0;
  for (std::size_t limb = area_.size(); limb-- > 0;) {  // children before parents
    if (limb % look_every == 0) job_.check();
    double cost = 0;
    bool carries = false;
    float before = stations_[begin(limb)].radius;
    for (std::size_t i = begin(limb); i < end(limb); ++i) {
      const Station& each = stations_[i];
      if (i > begin(limb)) carries = carries || is_fork_[each.joint] != 0;
      if (!stays(limb, i, price)) continue;
      const auto last = static_cast<double>(each.corners);
      if (i == begin(limb)) {
        cost += last;
      } else if (i + 1 < end(limb)) {
        cost += 2 * last;
        before = each.radius;
      } else {
        cost += (options_.pointed && each.radius < pointed_share * before ? 1 : 3) * last;
      }
    }
    const std::uint32_t head = chains_.head[limb];
    const bool is_root = limbs_.parent[head] == Limbs::none;
    const bool is_worth = static_cast<double>(area_[limb]) > static_cast<double>(price) * cost;
    kept_[limb] = carries || (is_root && is_fork_[head]) || is_worth ? 1 : 0;
    if (!kept_[limb]) continue;
    total += cost;
    if (!is_root) is_fork_[limbs_.parent[head]] = 1;
  }
  return static_cast<std::uint64_t>(total);
}

float Coarsening::price_for(std::uint64_t triangles) {
  if (count(0) <= triangles) return 0;
  float high = 1e-30F;
  for (const float area : area_) high = std::max(high, area);
  float low = high * price_range;
  for (int i = 0; i < halvings && high > low * 1.001F; ++i) {
    const float middle = std::sqrt(low) * std::sqrt(high);
    (count(middle) > triangles ? low : high) = middle;
  }
  return high;
}

template <class T>
void copy_row(const Array<T>& from, std::uint32_t joint, Array<T>& to) {
  if (!from.empty()) to.push_back(from[joint]);
}

std::uint32_t Coarsening::add(std::uint32_t joint, std::uint32_t parent, CoarseLimbs& out) const {
  Limbs& to = out.limbs;
  to.position.push_back(place_of(joint));
  copy_row(limbs_.radius, joint, to.radius);
  copy_row(limbs_.base_radius, joint, to.base_radius);
  to.parent.push_back(parent);
  to.starts_limb.push_back(0);
  copy_row(limbs_.color, joint, to.color);
  copy_row(limbs_.order, joint, to.order);
  copy_row(limbs_.frame, joint, to.frame);
  copy_row(limbs_.contour, joint, to.contour);
  copy_row(limbs_.birth, joint, to.birth);
  copy_row(limbs_.key, joint, to.key);
  copy_row(limbs_.anchor, joint, to.anchor);
  out.was.push_back(joint);
  return static_cast<std::uint32_t>(to.size() - 1);
}

void Coarsening::write_limb(std::size_t limb, float price, CoarseLimbs& out, Array<std::uint32_t>& place) {
  const std::uint32_t head = chains_.head[limb];
  const bool is_root = limbs_.parent[head] == Limbs::none;
  Limbs& to = out.limbs;
  std::size_t before = begin(limb);
  std::uint32_t parent = is_root ? place[head] = add(head, Limbs::none, out) : place[limbs_.parent[head]];
  glm::vec3 from = to.position[parent];  // of a branch: where its parent's joint stands now
  float from_radius = stations_[before].radius;
  bool starts = !is_root;
  for (std::size_t i = before + 1; i < end(limb); ++i) {
    if (!stays(limb, i, price)) continue;
    const Station& last = stations_[i];
    const glm::vec3 to_position = last.position;
    float length = 0;
    for (std::size_t k = before + 1; k <= i; ++k)
      length += glm::distance(stations_[k].position, stations_[k - 1].position);
    float along = 0, at_radius = from_radius;
    for (std::size_t k = before + 1; k <= i; ++k) {
      const Station& each = stations_[k];
      along += glm::distance(each.position, stations_[k - 1].position);
      if (k < i && !is_fork_[each.joint]) continue;
      const float share = length > 0 ? along / length : 1.0F;
      const float radius = k == i ? last.radius : from_radius + (last.radius - from_radius) * share;
      const std::uint32_t joint = add(each.joint, parent, out);
      place[each.joint] = joint;
      if (k < i) to.position[joint] = from + (to_position - from) * share;
      to.starts_limb[joint] = starts ? 1 : 0;
      starts = false;
      to.base_radius[joint] = at_radius * widening(at_radius);
      to.radius[joint] = radius * widening(radius);
      at_radius = radius;
      parent = joint;
    }
    from = to_position;
    before = i;
    // A limb may go on thicker or thinner than it came.
    from_radius = i + 1 < end(limb) ? limbs_.base_radius[stations_[i + 1].joint] : last.radius;
  }
}

CoarseLimbs Coarsening::write(float price) {
  CoarseLimbs out{Limbs(job_), Array<std::uint32_t>(job_)};
  Array<std::uint32_t> place(job_, limbs_.size(), Limbs::none);
  for (std::size_t limb = 0; limb < area_.size(); ++limb) {
    if (limb % look_every == 0) job_.check();
    if (kept_[limb]) write_limb(limb, price, out, place);
  }
  // What moved with a joint that is gone moves with the nearest one below it that is left.
  for (std::uint32_t& anchor : out.limbs.anchor) {
    std::uint32_t joint = anchor;
    while (joint != Limbs::none && place[joint] == Limbs::none) joint = limbs_.parent[joint];
    anchor = joint == Limbs::none ? Limbs::none : place[joint];
  }
  return out;
}

}  // namespace

CoarseLimbs coarsen(const Limbs& limbs, const CoarseOptions& options, Job& job) {
  return Coarsening(limbs, options, job).run();
}

}  // namespace seedmesh
