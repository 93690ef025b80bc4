#include "core/geom/plant/surroundings.h"

#include <algorithm>
#include <bit>
#include <vector>

namespace seedmesh {
namespace {

constexpr std::size_t check_interval = 1024;
// The number of points of an internode that are tested.
constexpr int probes = 8;

class Pruning {
 public:
  Pruning(Skeleton& skeleton, const Surroundings& surroundings, Membership membership, ShareCache* known,
          Job& job)
      : skeleton_(skeleton),
        limbs_(skeleton.limbs),
        surroundings_(surroundings),
        membership_(membership),
        known_(known),
        job_(job),
        new_number_(job, skeleton.limbs.size()) {}

  void run() {
    for (std::size_t i = 0; i < limbs_.size(); ++i) {
      if (i % check_interval == 0) job_.check();
      test(static_cast<std::uint32_t>(i));
    }
    compact();
    drop_outlines();
    drop_organs();
  }

 private:
  static constexpr std::uint32_t gone = Limbs::none;

  bool is_in(const glm::dvec3& point) const { return !surroundings_.forbids(point); }

  void test(std::uint32_t joint) {
    const std::uint32_t parent = limbs_.parent[joint];
    if (parent == Limbs::none) {
      const std::uint32_t anchor = limbs_.anchor.empty() ? Limbs::none : limbs_.anchor[joint];
      keep(joint, (anchor == Limbs::none || new_number_[anchor] != gone) && is_in(limbs_.position[joint]));
      return;
    }
    if (new_number_[parent] == gone || was_cut_[parent]) return keep(joint, false);
    const double share = share_of(limbs_.position[parent], limbs_.position[joint]);
    keep(joint, share > 0.01);
    if (share == 1 || share <= 0.01) return;
    const glm::dvec3 from = limbs_.position[parent], step = glm::dvec3(limbs_.position[joint]) - from;
    const auto taper = static_cast<float>(share);
    limbs_.position[joint] = glm::vec3(from + share * step) + 0.0F;
    limbs_.radius[joint] =
        limbs_.base_radius[joint] + (limbs_.radius[joint] - limbs_.base_radius[joint]) * taper;
    was_cut_[joint] = true;
  }

  /// The share of an internode that remains: 0 or 1 unless it is clipped.
  double share_of(const glm::vec3& from, const glm::vec3& to) {
    if (const double* known = known_ ? known_->find(from, to) : nullptr) return *known;
    const glm::dvec3 begin = from, step = glm::dvec3(to) - begin;
    double share = 0;
    switch (membership_) {
      case Membership::centre:
        share = is_in(begin + 0.5 * step) ? 1 : 0;
        break;
      case Membership::whole:
        share = inside_share(begin, step) == 1 ? 1 : 0;
        break;
      case Membership::clipped:
        share = inside_share(begin, step);
        break;
    }
    if (known_) known_->keep(from, to, share);
    return share;
  }

  /// The share of the step, from its beginning, that is inside.
  double inside_share(const glm::dvec3& from, const glm::dvec3& step) const {
    double low = 0;
    for (int i = 0; i <= probes; ++i) {
      const double share = static_cast<double>(i) / probes;
      if (is_in(from + share * step)) {
        low = share;
        continue;
      }
      if (i == 0) return 0;
      double high = share;
      for (int k = 0; k < 20; ++k) {
        const double middle = 0.5 * (low + high);
        (is_in(from + middle * step) ? low : high) = middle;
      }
      return low;
    }
    return 1;
  }

  void keep(std::uint32_t joint, bool yes) {
    was_cut_.resize(std::max<std::size_t>(was_cut_.size(), joint + std::size_t{1}), false);
    new_number_[joint] = yes ? kept_++ : gone;
  }

  template <class T>
  void compact(Array<T>& values) {
    if (values.empty()) return;
    for (std::size_t i = 0; i < new_number_.size(); ++i) {
      if (new_number_[i] != gone) values[new_number_[i]] = values[i];
    }
    values.resize(kept_);
  }

  std::uint32_t renamed(std::uint32_t joint) const {
    return joint == Limbs::none ? Limbs::none : new_number_[joint];
  }

  void compact() {
    for (std::uint32_t& parent : limbs_.parent) parent = renamed(parent);
    for (std::uint32_t& anchor : limbs_.anchor) anchor = renamed(anchor);
    compact(limbs_.position);
    compact(limbs_.radius);
    compact(limbs_.base_radius);
    compact(limbs_.parent);
    compact(limbs_.starts_limb);
    compact(limbs_.color);
    compact(limbs_.order);
    compact(limbs_.frame);
    compact(limbs_.contour);
    compact(limbs_.birth);
    compact(limbs_.key);
    compact(limbs_.anchor);
    compact(limbs_.share);
  }

  void drop_outlines() {
    Outlines& outlines = skeleton_.outlines;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < outlines.outline.size(); ++i) {
      if (i % check_interval == 0) job_.check();
      Outline outline = outlines.outline[i];
      if (outline.limb_joint != Limbs::none) {
        if (new_number_[outline.limb_joint] == gone || was_cut_[outline.limb_joint]) continue;
        outline.limb_joint = new_number_[outline.limb_joint];
      }
      glm::dvec3 centre{0};
      bool whole = true;
      for (std::uint32_t k = outline.first; k < outline.first + outline.count; ++k) {
        centre += glm::dvec3(outlines.vertex[k]) / double(outline.count);
        whole = whole && (membership_ != Membership::whole || is_in(outlines.vertex[k]));
      }
      if (whole && is_in(centre)) outlines.outline[kept++] = outline;
    }
    outlines.outline.resize(kept);
  }

  void drop_organs() {
    Array<Organ>& organs = skeleton_.organs.organ;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < organs.size(); ++i) {
      Organ organ = organs[i];
      if (organ.limb_joint != Limbs::none) {
        if (new_number_[organ.limb_joint] == gone || was_cut_[organ.limb_joint]) continue;
        organ.limb_joint = new_number_[organ.limb_joint];
      }
      if (is_in(organ.position)) organs[kept++] = organ;
    }
    organs.resize(kept);
  }

  Skeleton& skeleton_;
  Limbs& limbs_;
  const Surroundings& surroundings_;
  Membership membership_;
  ShareCache* known_;
  Job& job_;
  Array<std::uint32_t> new_number_;  ///< new number of each joint, or gone
  std::vector<bool> was_cut_;
  std::uint32_t kept_ = 0;
};

}  // namespace

std::size_t ShareCache::slot_of(const glm::vec3& from, const glm::vec3& to) const {
  const auto bits = [](float x) { return std::uint64_t{std::bit_cast<std::uint32_t>(x)}; };
  std::uint64_t key = mix(bits(from.x) << 32U | bits(from.y)) + (bits(from.z) << 32U | bits(to.x));
  key = mix(mix(key) + (bits(to.y) << 32U | bits(to.z)));
  const std::size_t mask = entries_.size() - 1;
  std::size_t place = key & mask;
  while (entries_[place].share >= 0 && (entries_[place].from != from || entries_[place].to != to))
    place = (place + 1) & mask;
  return place;
}

const double* ShareCache::find(const glm::vec3& from, const glm::vec3& to) const {
  if (entries_.empty()) return nullptr;
  const Entry& entry = entries_[slot_of(from, to)];
  return entry.share >= 0 ? &entry.share : nullptr;
}

void ShareCache::keep(const glm::vec3& from, const glm::vec3& to, double share) {
  if (2 * (count_ + 1) > entries_.size()) grow();
  Entry& entry = entries_[slot_of(from, to)];
  if (entry.share < 0) ++count_;
  entry = {from, to, share};
}

void ShareCache::grow() {
  constexpr std::size_t least = 1024;
  Array<Entry> before = std::move(entries_);
  entries_ = before.empty_array_of<Entry>();
  entries_.resize(before.empty() ? least : 2 * before.size());
  std::fill(entries_.begin(), entries_.end(), Entry{});
  for (const Entry& entry : before) {
    if (entry.share >= 0) entries_[slot_of(entry.from, entry.to)] = entry;
  }
}

void prune(Skeleton& skeleton, const Surroundings& surroundings, Membership membership, ShareCache* known,
           Job& job) {
  if (surroundings.bounds_growth()) Pruning(skeleton, surroundings, membership, known, job).run();
}

}  // namespace seedmesh
