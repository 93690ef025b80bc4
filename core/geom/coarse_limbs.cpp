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
// Corners fall with this power of the radius, as graft() has them.
constexpr double corner_power = 0.3;
// As graft() has it: of a limb that others leave.
constexpr int least_opened_corners = 6;
// What skin() may give a limb instead of as many as it has at the finest level, most first.
constexpr int fewer_corners[] = {48, 32, 24, 16, 12, 10, 8, 6, 5, 4, 3};
// Of the width of a limb that is seen, what differs in the mean of all sides: measured for limbs whose rings
// turn by half a side, within half a hundredth.
constexpr float off_by_corners = 0.68F, off_by_finest = 0.52F;
// The cosine of the angle by which a cross-section that is no circle may turn between joints that need not
// stay.
constexpr float untwisted = 0.99F;
// An end thinner than this share of the ring before it is a point.
constexpr float pointed_share = 0.5F;

struct Station {
  std::uint32_t joint = Limbs::none;
  glm::vec3 position{0};
  float radius = 0;
  float worth = 0;    ///< the area by which the outline changes without it
  float corners = 3;  ///< of a ring there, for graft()
};

class Coarsening {
 public:
  Coarsening(const Limbs& limbs, const CoarseOptions& options, Job& job)
      : limbs_(limbs), options_(options), job_(job), chains_(link_chains(limbs, job)) {
    for (std::size_t i = 0; i < limbs.size(); ++i) {
      if (limbs.parent[i] != Limbs::none) thickest_ = std::max(thickest_, limbs.base_radius[i]);
    }
    if (!options.skin) return;
    least_corners_ = least_sides_of(*options.skin);
    for (const std::uint32_t head : chains_.head)
      thickest_head_ = std::max(thickest_head_, first_radius(head));
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
  struct Bill;
  Bill bill_of(std::size_t limb, int corners, float price) const;
  Bill best_bill(std::size_t limb, float price) const;
  static bool stays(const Station& station, float corners, float price) {
    return station.worth == forever || station.worth > price * 2 * corners;
  }
  bool stays(std::size_t limb, std::size_t station, float price) const {
    return stays(stations_[station], corners_at(limb, station), price);
  }
  bool must_stay(std::uint32_t joint, std::uint32_t next) const;
  CoarseLimbs write(float price);
  void write_limb(std::size_t limb, float price, CoarseLimbs& out, Array<std::uint32_t>& place);
  std::uint32_t add(std::size_t limb, std::uint32_t joint, std::uint32_t parent, CoarseLimbs& out) const;

  int corners(float radius, int sides) const {
    const double share = thickest_ > 0 ? static_cast<double>(std::min(1.0F, radius / thickest_)) : 1;
    const int wanted = math::to_int32(sides * math::pow(std::max(share, 1e-6), corner_power) + 0.5);
    if (wanted <= 3) return 3;
    return wanted != sides ? wanted + wanted % 2 : wanted;
  }
  float corners_at(std::size_t limb, std::size_t station) const {
    return options_.skin ? static_cast<float>(corners_[limb].now) : stations_[station].corners;
  }
  /// The radius that a limb begins with.
  float first_radius(std::uint32_t head) const {
    const std::uint32_t joint = limbs_.parent[head] == Limbs::none ? chains_.next[head] : head;
    return joint == Limbs::none ? 0 : limbs_.base_radius[joint];
  }
  LimbCorners finest_corners(std::uint32_t head) const {
    if (!options_.skin) return {};
    if (options_.was_grafted) {
      int own = std::max(least_corners_, corners(first_radius(head), options_.skin->sides));
      for (std::uint32_t joint = head; joint != Limbs::none; joint = chains_.next[joint]) {
        if (chains_.mark[joint] & fork) own = std::max(own, least_opened_corners);
      }
      own = std::min(own, options_.skin->sides);
      return {static_cast<std::uint8_t>(own), static_cast<std::uint8_t>(own)};
    }
    const auto sides = static_cast<std::uint8_t>(
        options_.skin->adapt ? sides_of_limb(*options_.skin, first_radius(head), thickest_head_)
                             : options_.skin->sides);
    return {sides, sides};
  }
  /// What a tube of as many corners as this level has must be thicker by to look as wide in the mean, after
  /// Cauchy: the mean width of a convex outline is its circumference by pi.
  float widening(std::size_t limb, float radius) const {
    const auto round = [](int n) { return n * math::sin(math::pi / n); };
    const LimbCorners own =
        options_.skin ? corners_[limb]
                      : LimbCorners{static_cast<std::uint8_t>(corners(radius, options_.sides)),
                                    static_cast<std::uint8_t>(corners(radius, options_.finest_sides))};
    return own.now == own.finest ? 1.0F : static_cast<float>(round(own.finest) / round(own.now));
  }
  /// Limbs that are alike do not go all at one price.
  float favour_of(std::uint32_t head) const {
    const std::uint64_t hash = key_at(key_of(head), 0xFA70);
    return 1 + most_favour * (static_cast<float>(hash >> 40U) * 0x1p-23F - 1);
  }
  std::uint64_t key_of(std::uint32_t joint) const { return limbs_.key.empty() ? joint : limbs_.key[joint]; }
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
  float thickest_ = 0, thickest_head_ = 0;
  int least_corners_ = 3;
  std::vector<LimbCorners> corners_;   ///< of each limb, for skin(), at the last price that was counted
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
  const auto add_station = [&](std::uint32_t at, float radius, float worth) {
    const int own = options_.skin ? 0 : corners(radius, options_.sides);
    stations_.push_back({at, place_of(at), radius, worth, static_cast<float>(own)});
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
  if (!limbs_.color.empty() && limbs_.color[joint] != limbs_.color[next]) return true;
  if (limbs_.contour.empty()) return false;
  if (limbs_.contour[joint] != limbs_.contour[next]) return true;
  if (limbs_.contour[joint] == 0 || limbs_.frame.empty()) return false;
  const glm::vec3 left(-1, 0, 0);
  return glm::dot(limbs_.frame[joint] * left, limbs_.frame[next] * left) < untwisted;
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

/// What a limb of so many corners costs, in triangles, and what it loses of what is seen.
struct Coarsening::Bill {
  double cost = 0, loss = 0;
  LimbCorners corners;
  double sum(float price) const { return loss + static_cast<double>(price) * cost; }
};

/// `corners` 0: as the stations have them.
Coarsening::Bill Coarsening::bill_of(std::size_t limb, int corners, float price) const {
  Bill bill;
  float before = stations_[begin(limb)].radius;
  for (std::size_t i = begin(limb); i < end(limb); ++i) {
    const Station& each = stations_[i];
    const float own = corners > 0 ? static_cast<float>(corners) : each.corners;
    if (!stays(each, own, price)) {
      bill.loss += static_cast<double>(each.worth);
      continue;
    }
    const auto last = static_cast<double>(own);
    if (i == begin(limb)) {
      bill.cost += options_.skin ? last - 2 : last;
    } else if (i + 1 < end(limb)) {
      bill.cost += 2 * last;
      before = each.radius;
    } else {
      const bool is_pointed = options_.pointed && each.radius < pointed_share * before;
      bill.cost += options_.skin && corners == 3 ? 7 : (is_pointed ? 1 : 3) * last;
    }
  }
  return bill;
}

/// With the corners that are the best for the price.
Coarsening::Bill Coarsening::best_bill(std::size_t limb, float price) const {
  if (!options_.skin) return bill_of(limb, 0, price);
  const int finest = corners_[limb].finest;
  Bill best = bill_of(limb, finest, price);
  best.corners = {corners_[limb].finest, corners_[limb].finest};
  for (const int corners : fewer_corners) {
    if (corners >= finest || corners < least_corners_) continue;
    Bill bill = bill_of(limb, corners, price);
    const float off = off_by_corners / static_cast<float>(corners * corners) +
                      off_by_finest / static_cast<float>(finest * finest);
    bill.loss += static_cast<double>(off * area_[limb]);
    bill.corners = {static_cast<std::uint8_t>(corners), corners_[limb].finest};
    if (bill.sum(price) < best.sum(price)) best = bill;
  }
  return best;
}

/// The triangles of what stays at this price.
std::uint64_t Coarsening::count(float price) {
  is_fork_.assign(limbs_.size(), 0);
  double total = 0;
  for (std::size_t limb = area_.size(); limb-- > 0;) {  // children before parents
    if (limb % look_every == 0) job_.check();
    bool carries = false;
    for (std::size_t i = begin(limb) + 1; i < end(limb); ++i)
      carries = carries || is_fork_[stations_[i].joint] != 0;
    const Bill bill = best_bill(limb, price);
    const std::uint32_t head = chains_.head[limb];
    const bool is_root = limbs_.parent[head] == Limbs::none;
    const double lost = options_.skin ? bill.loss : 0;
    const bool is_worth = static_cast<double>(area_[limb]) > lost + static_cast<double>(price) * bill.cost;
    kept_[limb] = carries || (is_root && is_fork_[head]) || is_worth ? 1 : 0;
    if (!kept_[limb]) continue;
    if (options_.skin) corners_[limb] = bill.corners;
    total += bill.cost;
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

std::uint32_t Coarsening::add(std::size_t limb, std::uint32_t joint, std::uint32_t parent,
                              CoarseLimbs& out) const {
  Limbs& to = out.limbs;
  to.position.push_back(place_of(joint));
  copy_row(limbs_.radius, joint, to.radius);
  copy_row(limbs_.base_radius, joint, to.base_radius);
  to.parent.push_back(parent);
  to.starts_limb.push_back(0);
  if (options_.skin) out.corners.push_back(corners_[limb]);
  copy_row(limbs_.color, joint, to.color);
  copy_row(limbs_.order, joint, to.order);
  copy_row(limbs_.frame, joint, to.frame);
  copy_row(limbs_.contour, joint, to.contour);
  copy_row(limbs_.birth, joint, to.birth);
  if (options_.skin) {
    to.key.push_back(key_of(joint));
  } else {
    copy_row(limbs_.key, joint, to.key);
  }
  copy_row(limbs_.anchor, joint, to.anchor);
  out.was.push_back(joint);
  return static_cast<std::uint32_t>(to.size() - 1);
}

void Coarsening::write_limb(std::size_t limb, float price, CoarseLimbs& out, Array<std::uint32_t>& place) {
  const std::uint32_t head = chains_.head[limb];
  const bool is_root = limbs_.parent[head] == Limbs::none;
  Limbs& to = out.limbs;
  std::size_t before = begin(limb);
  std::uint32_t parent =
      is_root ? place[head] = add(limb, head, Limbs::none, out) : place[limbs_.parent[head]];
  glm::vec3 from = to.position[parent];  // of a branch: where its parent's joint stands now
  float from_radius = stations_[before].radius;
  bool starts = !is_root, is_first = true;
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
      const std::uint32_t joint = add(limb, each.joint, parent, out);
      place[each.joint] = joint;
      if (k < i) to.position[joint] = from + (to_position - from) * share;
      to.starts_limb[joint] = starts ? 1 : 0;
      starts = false;
      // By the key of its first joint a limb turns.
      if (options_.skin && is_first) to.key[joint] = key_of(stations_[begin(limb) + 1].joint);
      is_first = false;
      to.base_radius[joint] = at_radius * widening(limb, at_radius);
      to.radius[joint] = radius * widening(limb, radius);
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
  CoarseLimbs out{Limbs(job_), Array<std::uint32_t>(job_), {}};
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
