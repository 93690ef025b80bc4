#include "core/geom/plant/graft/limb_continuation.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/rng.h"
#include "core/geom/plant/graft/junction.h"

namespace seedmesh {
namespace {

// The limb that continues another has at least this share of its radius and turns off by less than 75
// degrees.
constexpr float least_radius_share = 0.4F, least_cosine = 0.26F;
// The weight of a small turn beside a similar radius.
constexpr float straightness_weight = 0.5F;
// Side limbs with at least the first share of the radius are moved where a side limb with the second share
// leaves too.
constexpr float least_moved = 0.1F, thick = 0.4F;
// A collar is wider than its limb by this factor and keeps this number of radii of the parent behind it.
constexpr float collar_width = 1.2F, behind_collar = 0.5F;
// The length that a fork needs, in radii: from the joint up to the crotch, where the tubes part (fork_at()),
// at most `highest_crotch`; that by this factor up to the next ring; and below the joint.
constexpr float parting = 0.9F, to_next_ring = 1.5F, highest_crotch = 6.5F, below_fork = 0.9F;
// The share of an internode that moved limbs may use, and the least sine that is divided by.
constexpr float most_of_internode = 0.7F, least_sine = 0.1F;
// The share of its first internode that a moved limb goes in the direction it was drawn before it turns back
// to its own line.
constexpr float bend_share = 0.3F;
// More limbs than these would find no room at one joint.
constexpr std::size_t most_moved = 6;

float length_of(const glm::vec3& v) { return std::sqrt(glm::dot(v, v)); }

class LimbContinuation {
 public:
  LimbContinuation(const Limbs& limbs, Job& job, std::span<const std::uint8_t> stay)
      : limbs_(limbs),
        job_(job),
        stay_(stay),
        out_{Limbs(job), Array<std::uint32_t>(job), Array<std::uint32_t>(job)} {}

  ContinuedLimbs run() {
    link();
    for (std::size_t i = 0; i < limbs_.size(); ++i) {
      if (i % 4096 == 0) job_.check();
      const auto joint = static_cast<std::uint32_t>(i);
      if (limbs_.parent[joint] != Limbs::none && next_[joint] == Limbs::none) choose_continuation(joint);
    }
    write();
    return std::move(out_);
  }

 private:
  /// A limb that is moved down the internode to a joint, by the distance `before`.
  struct Moved {
    std::uint32_t child;
    float before;
  };

  void link();
  void choose_continuation(std::uint32_t joint);
  void find_moved(std::uint32_t joint, float length);
  float length_needed(std::uint32_t joint, std::uint32_t child) const;
  void write();
  std::uint32_t add_bend(std::uint32_t joint);
  void write_internode(std::uint32_t joint);
  std::uint32_t add(std::uint32_t joint, std::uint32_t parent);

  glm::vec3 step(std::uint32_t joint) const {
    return limbs_.position[joint] - limbs_.position[limbs_.parent[joint]];
  }

  const Limbs& limbs_;
  Job& job_;
  std::span<const std::uint8_t> stay_;
  ContinuedLimbs out_;
  std::vector<std::uint32_t> next_;           ///< of each joint, the one that continues its limb
  std::vector<std::uint32_t> first_, other_;  ///< list of the side limbs of each joint
  std::vector<std::uint32_t> from_;        ///< of each joint, the new number of the joint that it grows from
  std::vector<std::uint32_t> new_number_;  ///< of each joint
  std::vector<Moved> moved_;               ///< of the current joint, the farthest from it first
  float end_radius_ = 0;                   ///< of the limb at that joint
  float taper_length_ = 0;                 ///< over which it tapers to that radius
  std::vector<std::uint32_t> branches_;
};

void LimbContinuation::link() {
  next_.assign(limbs_.size(), Limbs::none);
  first_.assign(limbs_.size(), Limbs::none);
  other_.assign(limbs_.size(), Limbs::none);
  for (std::size_t i = 0; i < limbs_.size(); ++i) {
    const std::uint32_t from = limbs_.parent[i];
    if (from != Limbs::none && !limbs_.starts_limb[i] && next_[from] == Limbs::none)
      next_[from] = static_cast<std::uint32_t>(i);
  }
  for (std::size_t i = limbs_.size(); i-- > 0;) {
    const std::uint32_t from = limbs_.parent[i];
    if (from == Limbs::none || next_[from] == i) continue;
    other_[i] = first_[from];
    first_[from] = static_cast<std::uint32_t>(i);
  }
}

void LimbContinuation::choose_continuation(std::uint32_t joint) {
  const glm::vec3 along = step(joint);
  const float length = length_of(along), radius = limbs_.radius[joint];
  float best = 0;
  std::uint32_t chosen = Limbs::none;
  for (std::uint32_t child = first_[joint]; child != Limbs::none; child = other_[child]) {
    const glm::vec3 on = step(child);
    const float cosine = glm::dot(along, on), least = least_cosine * length * length_of(on);
    if (!(limbs_.base_radius[child] >= least_radius_share * radius) || !(cosine > least)) continue;
    const float share = radius > 0 ? std::min(1.0F, limbs_.base_radius[child] / radius) : 1.0F;
    const float worth = share + straightness_weight * cosine / (length * length_of(on));
    if (worth > best + 1e-4F) {
      best = worth;
      chosen = child;
    }
  }
  if (chosen == Limbs::none) return;
  next_[joint] = chosen;
  std::uint32_t* link = &first_[joint];
  while (*link != chosen) link = &other_[*link];
  *link = other_[chosen];
}

/// The length of the limb that the junction of a child needs.
float LimbContinuation::length_needed(std::uint32_t joint, std::uint32_t child) const {
  const glm::vec3 along = step(joint), on = step(child);
  const float cosine = glm::dot(along, on) / std::max(length_of(along) * length_of(on), 1e-30F);
  const float sine = std::sqrt(std::max(0.0F, 0.5F * (1 - cosine)));  // of half the angle
  const float radius = limbs_.radius[joint], own = std::min(radius, limbs_.base_radius[child]);
  if (own < fork_share * radius) {  // a collar, where the tubes intersect
    const float out = std::sqrt(std::max(least_sine * least_sine, 1 - cosine * cosine));
    return (radius + collar_width * own) * std::abs(cosine) / out + behind_collar * radius;
  }
  return to_next_ring * std::min(parting * own / std::max(sine, least_sine), highest_crotch * radius) +
         below_fork * radius;
}

/// Chooses the limbs that are moved down the internode to the joint, and its taper.
void LimbContinuation::find_moved(std::uint32_t joint, float length) {
  moved_.clear();
  end_radius_ = limbs_.radius[joint];
  taper_length_ = 0;
  const float radius = limbs_.radius[joint];
  if (next_[joint] == Limbs::none || !(radius > 0) || !(length > 0)) return;
  branches_.clear();
  for (std::uint32_t child = first_[joint]; child != Limbs::none; child = other_[child]) {
    if (limbs_.base_radius[child] >= least_moved * radius && length_of(step(child)) > 0)
      branches_.push_back(child);
  }
  std::stable_sort(branches_.begin(), branches_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return limbs_.base_radius[a] > limbs_.base_radius[b];
  });
  if (branches_.size() < 2 || limbs_.base_radius[branches_[0]] < thick * radius) return;
  if (branches_.size() > most_moved) branches_.resize(most_moved);
  float before = 0;
  bool was_thick = true;
  for (std::size_t i = 1; i < branches_.size(); ++i) {
    const std::uint32_t child = branches_[i];
    if (!stay_.empty() && stay_[child]) continue;
    const bool is_thick = limbs_.base_radius[child] >= thick * radius;
    // The collars of thin limbs lie side by side.
    if (is_thick || was_thick) before += length_needed(joint, child);
    was_thick = is_thick;
    if (before > most_of_internode * length) break;
    moved_.push_back({child, before});
    if (limbs_.base_radius[child] >= fork_share * radius) taper_length_ = before;
  }
  // After its forks the limb is as thick as what is left. Otherwise its bark would be dented behind the
  // crotches.
  if (taper_length_ > 0) {
    end_radius_ =
        std::min(radius, std::max(limbs_.base_radius[next_[joint]], limbs_.base_radius[branches_[0]]));
  }
  std::reverse(moved_.begin(), moved_.end());
}

template <class T>
void copy_row(const Array<T>& from, std::uint32_t joint, Array<T>& to) {
  if (!from.empty()) to.push_back(from[joint]);
}

std::uint32_t LimbContinuation::add(std::uint32_t joint, std::uint32_t parent) {
  Limbs& to = out_.limbs;
  to.position.push_back(limbs_.position[joint]);
  to.radius.push_back(limbs_.radius[joint]);
  to.base_radius.push_back(limbs_.base_radius[joint]);
  to.parent.push_back(parent);
  to.starts_limb.push_back(0);
  copy_row(limbs_.color, joint, to.color);
  copy_row(limbs_.order, joint, to.order);
  copy_row(limbs_.frame, joint, to.frame);
  copy_row(limbs_.contour, joint, to.contour);
  copy_row(limbs_.birth, joint, to.birth);
  copy_row(limbs_.key, joint, to.key);
  if (to.size() >= Limbs::none) {
    job_.refuse(limit_issue({Resource::joints, Limbs::none, to.size() + 1},
                            "the limbs have more joints than 32-bit indices can address"));
  }
  out_.original.push_back(joint);
  return static_cast<std::uint32_t>(to.size() - 1);
}

/// The first joint of a moved limb: the limb sets out in its own direction and bends back to its line.
std::uint32_t LimbContinuation::add_bend(std::uint32_t joint) {
  Limbs& to = out_.limbs;
  const std::uint32_t bend = add(joint, from_[joint]);
  to.position[bend] = to.position[from_[joint]] + step(joint) * bend_share;
  to.radius[bend] += (to.base_radius[bend] - to.radius[bend]) * (1 - bend_share);
  to.starts_limb[bend] = 1;
  out_.moved.push_back(bend);
  if (!to.key.empty()) to.key[bend] = key_at(to.key[bend], 0);
  return bend;
}

void LimbContinuation::write_internode(std::uint32_t joint) {
  Limbs& to = out_.limbs;
  const std::uint32_t drawn_from = limbs_.parent[joint];
  const bool is_moved = from_[joint] != new_number_[drawn_from];
  std::uint32_t parent = is_moved ? add_bend(joint) : from_[joint];
  bool starts = !is_moved && next_[drawn_from] != joint;
  const glm::vec3 from = to.position[parent], whole = limbs_.position[joint] - from;
  const float length = length_of(whole);
  // A limb that continues begins at least as thick as the internode before, as in graft().
  const float first_radius = is_moved ? to.radius[parent]
                             : starts || limbs_.parent[drawn_from] == Limbs::none
                                 ? limbs_.base_radius[joint]
                                 : std::max(limbs_.base_radius[joint], to.radius[parent]);
  find_moved(joint, length);
  const auto radius_at = [&](float before) {
    const auto drawn = [&](float off) {
      const float share = length > 0 ? 1 - off / length : 1.0F;
      return first_radius + (limbs_.radius[joint] - first_radius) * share;
    };
    if (before >= taper_length_) return drawn(before);
    return end_radius_ + (drawn(taper_length_) - end_radius_) * (before / taper_length_);
  };
  float radius = first_radius;
  for (std::size_t i = 0; i < moved_.size(); ++i) {
    if (i == 0 || moved_[i].before != moved_[i - 1].before) {
      parent = add(joint, parent);
      to.position[parent] = from + whole * (1 - moved_[i].before / length);
      to.base_radius[parent] = radius;
      to.radius[parent] = radius = radius_at(moved_[i].before);
      if (!to.key.empty()) to.key[parent] = key_at(to.key[parent], i + 1);
      to.starts_limb[parent] = starts ? 1 : 0;
      starts = false;
    }
    from_[moved_[i].child] = parent;
  }
  const std::uint32_t own = add(joint, parent);
  to.base_radius[own] = radius;
  to.radius[own] = end_radius_;
  to.starts_limb[own] = starts ? 1 : 0;
}

/// Joints keep their order: a moved limb still comes after the joint that it was moved from.
void LimbContinuation::write() {
  from_.assign(limbs_.size(), Limbs::none);
  new_number_.assign(limbs_.size(), Limbs::none);
  for (std::size_t i = 0; i < limbs_.size(); ++i) {
    if (i % 4096 == 0) job_.check();
    const auto joint = static_cast<std::uint32_t>(i);
    if (limbs_.parent[joint] == Limbs::none) {
      new_number_[joint] = add(joint, Limbs::none);
      continue;
    }
    if (from_[joint] == Limbs::none) from_[joint] = new_number_[limbs_.parent[joint]];
    write_internode(joint);
    new_number_[joint] = static_cast<std::uint32_t>(out_.limbs.size() - 1);
  }
}

}  // namespace

ContinuedLimbs continue_limbs(const Limbs& limbs, Job& job, std::span<const std::uint8_t> stay) {
  return LimbContinuation(limbs, job, stay).run();
}

}  // namespace seedmesh
