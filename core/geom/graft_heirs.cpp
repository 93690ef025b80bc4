#include "core/geom/graft_heirs.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/rng.h"

namespace seedmesh {
namespace {

// An heir has at least this share of the radius of the limb that ends, and turns off by less than 75 degrees.
constexpr float least_heir = 0.4F, least_cosine = 0.26F;
// How much a straight way on counts beside a like radius.
constexpr float straightness = 0.5F;
// Limbs from this share of the radius on are set apart where a thick one leaves too; which limbs are thick,
// and which of them have forks.
constexpr float least_apart = 0.1F, thick = 0.4F, forked = 0.55F;
// A collar is wider than its limb by so much, and has so many radii of the parent behind it.
constexpr float collar_width = 1.2F, behind_collar = 0.5F;
// Room of a fork along the limb: the crotch above, where the tubes part (see fork_at), and more of it to the
// next ring; in radii, the highest crotch that a fork has and what is below.
constexpr float parting = 0.9F, to_next_ring = 1.5F, highest_crotch = 6.5F, below_fork = 0.9F;
// Of an internode, what the forks before its end may take, and the least angle that is reckoned with.
constexpr float most_of_internode = 0.7F, least_sine = 0.1F;
// Of its first internode, what a limb that is set apart goes before it turns to its own line.
constexpr float bend_share = 0.3F;
// Limbs at one joint that are set apart; those beyond find no room anyway.
constexpr std::size_t most_apart = 6;

float length_of(const glm::vec3& v) { return std::sqrt(glm::dot(v, v)); }

class Heirs {
 public:
  Heirs(const Limbs& limbs, Job& job, std::span<const std::uint8_t> stay)
      : limbs_(limbs),
        job_(job),
        stay_(stay),
        out_{Limbs(job), Array<std::uint32_t>(job), Array<std::uint32_t>(job)} {}

  HeirLimbs run() {
    link();
    for (std::size_t i = 0; i < limbs_.size(); ++i) {
      if (i % 4096 == 0) job_.check();
      const auto joint = static_cast<std::uint32_t>(i);
      if (limbs_.parent[joint] != Limbs::none && next_[joint] == Limbs::none) choose_heir(joint);
    }
    write();
    return std::move(out_);
  }

 private:
  /// A limb that leaves the internode before a joint, `before` its end.
  struct Apart {
    std::uint32_t child;
    float before;
  };

  void link();
  void choose_heir(std::uint32_t joint);
  void find_apart(std::uint32_t joint, float length);
  float room_of(std::uint32_t joint, std::uint32_t child) const;
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
  HeirLimbs out_;
  std::vector<std::uint32_t> next_;           ///< of each joint, the one that continues its limb
  std::vector<std::uint32_t> first_, other_;  ///< branches of a joint, and the next one at the same
  std::vector<std::uint32_t> from_;           ///< of each joint, the new number of the one that it grows from
  std::vector<std::uint32_t> place_;          ///< of each joint, its new number
  std::vector<Apart> apart_;                  ///< of the joint at hand, the farthest from it first
  float end_radius_ = 0;                      ///< of the limb at that joint,
  float tapers_ = 0;                          ///< where it tapers to it from so much before it on
  std::vector<std::uint32_t> branches_;
};

void Heirs::link() {
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

void Heirs::choose_heir(std::uint32_t joint) {
  const glm::vec3 along = step(joint);
  const float length = length_of(along), radius = limbs_.radius[joint];
  float best = 0;
  std::uint32_t heir = Limbs::none;
  for (std::uint32_t child = first_[joint]; child != Limbs::none; child = other_[child]) {
    const glm::vec3 on = step(child);
    const float cosine = glm::dot(along, on), least = least_cosine * length * length_of(on);
    if (!(limbs_.base_radius[child] >= least_heir * radius) || !(cosine > least)) continue;
    const float share = radius > 0 ? std::min(1.0F, limbs_.base_radius[child] / radius) : 1.0F;
    const float worth = share + straightness * cosine / (length * length_of(on));
    if (worth > best + 1e-4F) {
      best = worth;
      heir = child;
    }
  }
  if (heir == Limbs::none) return;
  next_[joint] = heir;
  std::uint32_t* link = &first_[joint];
  while (*link != heir) link = &other_[*link];
  *link = other_[heir];
}

/// How far along the limb the fork of a child reaches, and farther by as much as it needs itself.
float Heirs::room_of(std::uint32_t joint, std::uint32_t child) const {
  const glm::vec3 along = step(joint), on = step(child);
  const float cosine = glm::dot(along, on) / std::max(length_of(along) * length_of(on), 1e-30F);
  const float sine = std::sqrt(std::max(0.0F, 0.5F * (1 - cosine)));  // of half the angle
  const float radius = limbs_.radius[joint], own = std::min(radius, limbs_.base_radius[child]);
  if (own < forked * radius) {  // where it comes out of the limb
    const float out = std::sqrt(std::max(least_sine * least_sine, 1 - cosine * cosine));
    return (radius + collar_width * own) * std::abs(cosine) / out + behind_collar * radius;
  }
  return to_next_ring * std::min(parting * own / std::max(sine, least_sine), highest_crotch * radius) +
         below_fork * radius;
}

/// Which limbs leave the internode before the joint instead of it.
void Heirs::find_apart(std::uint32_t joint, float length) {
  apart_.clear();
  end_radius_ = limbs_.radius[joint];
  tapers_ = 0;
  const float radius = limbs_.radius[joint];
  if (next_[joint] == Limbs::none || !(radius > 0) || !(length > 0)) return;
  branches_.clear();
  for (std::uint32_t child = first_[joint]; child != Limbs::none; child = other_[child]) {
    if (limbs_.base_radius[child] >= least_apart * radius && length_of(step(child)) > 0)
      branches_.push_back(child);
  }
  std::stable_sort(branches_.begin(), branches_.end(), [&](std::uint32_t a, std::uint32_t b) {
    return limbs_.base_radius[a] > limbs_.base_radius[b];
  });
  if (branches_.size() < 2 || limbs_.base_radius[branches_[0]] < thick * radius) return;
  if (branches_.size() > most_apart) branches_.resize(most_apart);
  float before = 0;
  bool was_thick = true;
  for (std::size_t i = 1; i < branches_.size(); ++i) {
    const std::uint32_t child = branches_[i];
    if (!stay_.empty() && stay_[child]) continue;
    const bool is_thick = limbs_.base_radius[child] >= thick * radius;
    // Thin ones have their collars side by side.
    if (is_thick || was_thick) before += room_of(joint, child);
    was_thick = is_thick;
    if (before > most_of_internode * length) break;
    apart_.push_back({child, before});
    if (limbs_.base_radius[child] >= forked * radius) tapers_ = before;
  }
  // After each fork the limb is thinner, as thick at last as what is left; else its bark would be dented
  // behind the crotches.
  if (tapers_ > 0)
    end_radius_ =
        std::min(radius, std::max(limbs_.base_radius[next_[joint]], limbs_.base_radius[branches_[0]]));
  std::reverse(apart_.begin(), apart_.end());
}

template <class T>
void copy_row(const Array<T>& from, std::uint32_t joint, Array<T>& to) {
  if (!from.empty()) to.push_back(from[joint]);
}

std::uint32_t Heirs::add(std::uint32_t joint, std::uint32_t parent) {
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
  if (to.size() >= Limbs::none) Job::refuse("the limbs have more joints than 32-bit indices can name");
  out_.was.push_back(joint);
  return static_cast<std::uint32_t>(to.size() - 1);
}

/// The bend of a limb that leaves before its joint: it sets out as it was drawn, and comes back to its line.
std::uint32_t Heirs::add_bend(std::uint32_t joint) {
  Limbs& to = out_.limbs;
  const std::uint32_t bend = add(joint, from_[joint]);
  to.position[bend] = to.position[from_[joint]] + step(joint) * bend_share;
  to.radius[bend] += (to.base_radius[bend] - to.radius[bend]) * (1 - bend_share);
  to.starts_limb[bend] = 1;
  out_.apart.push_back(bend);
  if (!to.key.empty()) to.key[bend] = key_at(to.key[bend], 0);
  return bend;
}

void Heirs::write_internode(std::uint32_t joint) {
  Limbs& to = out_.limbs;
  const std::uint32_t drawn_from = limbs_.parent[joint];
  const bool is_moved = from_[joint] != place_[drawn_from];
  std::uint32_t parent = is_moved ? add_bend(joint) : from_[joint];
  bool starts = !is_moved && next_[drawn_from] != joint;
  const glm::vec3 from = to.position[parent], whole = limbs_.position[joint] - from;
  const float length = length_of(whole);
  // A limb that goes on begins as thick as what it goes on from, as graft() has it.
  const float first_radius = is_moved ? to.radius[parent]
                             : starts || limbs_.parent[drawn_from] == Limbs::none
                                 ? limbs_.base_radius[joint]
                                 : std::max(limbs_.base_radius[joint], to.radius[parent]);
  find_apart(joint, length);
  const auto radius_at = [&](float before) {
    const auto drawn = [&](float off) {
      const float share = length > 0 ? 1 - off / length : 1.0F;
      return first_radius + (limbs_.radius[joint] - first_radius) * share;
    };
    if (before >= tapers_) return drawn(before);
    return end_radius_ + (drawn(tapers_) - end_radius_) * (before / tapers_);
  };
  float radius = first_radius;
  for (std::size_t i = 0; i < apart_.size(); ++i) {
    if (i == 0 || apart_[i].before != apart_[i - 1].before) {
      parent = add(joint, parent);
      to.position[parent] = from + whole * (1 - apart_[i].before / length);
      to.base_radius[parent] = radius;
      to.radius[parent] = radius = radius_at(apart_[i].before);
      if (!to.key.empty()) to.key[parent] = key_at(to.key[parent], i + 1);
      to.starts_limb[parent] = starts ? 1 : 0;
      starts = false;
    }
    from_[apart_[i].child] = parent;
  }
  const std::uint32_t own = add(joint, parent);
  to.base_radius[own] = radius;
  to.radius[own] = end_radius_;
  to.starts_limb[own] = starts ? 1 : 0;
}

/// In the old order, in which a limb that leaves before a joint still comes after it.
void Heirs::write() {
  from_.assign(limbs_.size(), Limbs::none);
  place_.assign(limbs_.size(), Limbs::none);
  for (std::size_t i = 0; i < limbs_.size(); ++i) {
    if (i % 4096 == 0) job_.check();
    const auto joint = static_cast<std::uint32_t>(i);
    if (limbs_.parent[joint] == Limbs::none) {
      place_[joint] = add(joint, Limbs::none);
      continue;
    }
    if (from_[joint] == Limbs::none) from_[joint] = place_[limbs_.parent[joint]];
    write_internode(joint);
    place_[joint] = static_cast<std::uint32_t>(out_.limbs.size() - 1);
  }
}

}  // namespace

HeirLimbs with_heirs(const Limbs& limbs, Job& job, std::span<const std::uint8_t> stay) {
  return Heirs(limbs, job, stay).run();
}

}  // namespace seedmesh
