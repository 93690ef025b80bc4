#include "core/geom/lod/foliage_levels.h"

#include <cmath>

#include "core/base/rng.h"

namespace seedmesh {
namespace {

constexpr std::uint32_t none = 0xFFFFFFFFU;
constexpr std::size_t check_interval = 1024;
// Meshes with more triangles are replaced by their bounding boxes.
constexpr std::size_t most_triangles = 16;
// Texels that one organ alone covers, in all views; greater scores are treated as equal.
constexpr std::uint32_t most_score = 1023;
// Every level keeps at least this share.
constexpr double least_share = 0.2;
// Limbs thinner than this, in texels, do not hide leaves.
constexpr double least_width = 1.5;
// Factors by which a leaf may be enlarged, greatest first.
constexpr float growths[] = {2.4F, 1.8F, 1.35F};
// Every n-th view is used for that.
constexpr int growth_views = 2;

// More views find more gaps.
constexpr std::size_t most_views = 12;

// One organ takes the time of this many joints.
constexpr std::size_t joints_an_organ = 8;

int views_for(const FoliageLevels::Plant& plant) {
  const std::size_t work =
      std::max({plant.organs.organ.size(), plant.limbs.size() / joints_an_organ, std::size_t{1}});
  return static_cast<int>(std::clamp<std::size_t>(600'000 / work, 2, most_views));
}

Box box_of(const FoliageLevels::Plant& plant) {
  Box box = plant.limbs.size() > 0 ? bounds_of(plant.limbs.position.span()) : Box{};
  if (plant.limbs.size() == 0 && plant.organs.organ.size() > 0)
    box = {plant.organs.organ[0].position, plant.organs.organ[0].position};
  for (const Organ& organ : plant.organs.organ) {
    const glm::vec3 tip = organ.position + glm::mat3_cast(organ.frame)[1] * organ.scale.y;
    box.min = glm::min(box.min, glm::min(organ.position, tip));
    box.max = glm::max(box.max, glm::max(organ.position, tip));
  }
  return box;
}

/// Triangles that cover about the same area as the mesh.
std::vector<glm::vec3> footprint_of(const Mesh& mesh, float filled) {
  std::vector<glm::vec3> corners;
  if (mesh.position.empty()) return corners;
  const Box box = bounds_of(mesh.position.span());
  const glm::vec3 middle = 0.5F * (box.min + box.max);
  const auto put = [&](const glm::vec3& at) { corners.push_back(middle + filled * (at - middle)); };
  if (mesh.elements() <= most_triangles) {
    for (std::size_t i = 0; i < mesh.index.size(); ++i) put(mesh.position[mesh.index.at(i)]);
    return corners;
  }
  // Three rectangles on the middle planes of the box.
  for (int axis = 0; axis < 3; ++axis) {
    const int side = (axis + 1) % 3, other = (axis + 2) % 3;
    glm::vec3 corner[4];
    for (int i = 0; i < 4; ++i) {
      corner[i][axis] = middle[axis];
      corner[i][side] = i == 0 || i == 3 ? box.min[side] : box.max[side];
      corner[i][other] = i < 2 ? box.min[other] : box.max[other];
    }
    for (const int i : {0, 1, 2, 0, 2, 3}) put(corner[i]);
  }
  return corners;
}

std::uint64_t hash_of(const Organ& organ, std::uint32_t index) { return key_at(organ.key, index); }

}  // namespace

FoliageLevels::FoliageLevels(const Plant& plant, Job& job)
    : view_samples_(box_of(plant), views_for(plant)),
      leaves_(job, slot(view_samples_.views(), 0), std::uint16_t{0}),
      limbs_(job, slot(view_samples_.views(), 0), std::uint16_t{0}),
      owner_(job, slot(view_samples_.views(), 0), 0U),
      last_visit_(job, slot(view_samples_.views(), 0), 0U),
      rank_(job, plant.organs.organ.size(), none) {
  for (const Mesh& surface : plant.surfaces) footprints_.push_back(footprint_of(surface, plant.filled));
  draw_limbs(plant.limbs, job);
  const Array<Organ>& organs = plant.organs.organ;
  for (std::size_t i = 0; i < organs.size(); ++i) {
    if (i % check_interval == 0) job.check();
    cover(organs[i], [&](std::size_t at) {
      leaves_[at] = static_cast<std::uint16_t>(std::min(leaves_[at] + 1, 0xFFFF));
      owner_[at] ^= static_cast<std::uint32_t>(i);
    });
  }
  rank(plant.organs, job);
  owner_ = Array<std::uint32_t>(job);
  last_visit_ = Array<std::uint32_t>(job);
}

/// Calls put(slot) for each texel that the organ covers in every `step`-th view, for some more than once.
template <class Put>
void FoliageLevels::draw(const Organ& organ, float growth, const Put& put, int step) {
  const Corners& corners = footprints_[organ.surface];
  const glm::mat3 axes = glm::mat3_cast(organ.frame);
  const glm::vec3 scale = growth * organ.scale;
  placed_.clear();
  for (const glm::vec3& corner : corners) placed_.push_back(organ.position + axes * (scale * corner));
  for (int view = 0; view < view_samples_.views(); view += step) {
    const std::size_t first = slot(view, 0);
    for (std::size_t i = 0; i + 2 < placed_.size(); i += 3) {
      ViewSamples::fill(view_samples_.at(view, placed_[i]), view_samples_.at(view, placed_[i + 1]),
                        view_samples_.at(view, placed_[i + 2]),
                        [&](std::size_t texel) { put(first + texel); });
    }
  }
}

/// Calls put(slot) once for each texel that the organ covers.
template <class Put>
void FoliageLevels::cover(const Organ& organ, const Put& put) {
  const std::uint32_t visit = ++visits_;
  draw(organ, 1, [&](std::size_t at) {
    if (last_visit_[at] == visit) return;
    last_visit_[at] = visit;
    put(at);
  });
}

/// Counts the thick limbs at each texel, internode by internode.
void FoliageLevels::draw_limbs(const Limbs& limbs, Job& job) {
  const double scale = view_samples_.texels_a_metre();
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (i % check_interval == 0) job.check();
    const std::uint32_t parent = limbs.parent[i];
    if (parent == Limbs::none) continue;
    const double base = scale * static_cast<double>(limbs.base_radius[i]),
                 end = scale * static_cast<double>(limbs.radius[i]);
    if (2 * std::max(base, end) < least_width) continue;
    for (int view = 0; view < view_samples_.views(); ++view) {
      const glm::dvec2 from = view_samples_.at(view, limbs.position[parent]),
                       to = view_samples_.at(view, limbs.position[i]);
      const glm::dvec2 along = to - from;
      const double length = std::sqrt(glm::dot(along, along));
      if (!(length > 0)) continue;
      const glm::dvec2 aside = glm::dvec2(-along.y, along.x) / length;
      const auto put = [&](std::size_t texel) {
        std::uint16_t& count = limbs_[slot(view, texel)];
        if (count < 0xFFFF) ++count;
      };
      ViewSamples::fill(from + base * aside, from - base * aside, to - end * aside, put);
      ViewSamples::fill(from + base * aside, to - end * aside, to + end * aside, put);
    }
  }
}

Array<float> FoliageLevels::shown(const Limbs& limbs, Job& job) const {
  Array<float> shown(job, limbs.size(), 1.0F);
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (i % check_interval == 0) job.check();
    const std::uint32_t parent = limbs.parent[i];
    if (parent == Limbs::none) continue;
    std::uint32_t looked = 0, free = 0;
    for (int view = 0; view < view_samples_.views(); ++view) {
      const glm::dvec2 from = view_samples_.at(view, limbs.position[parent]),
                       to = view_samples_.at(view, limbs.position[i]);
      const glm::dvec2 along = to - from;
      const int steps = 1 + std::min(ViewSamples::across, math::to_int32(std::sqrt(glm::dot(along, along))));
      for (int step = 0; step < steps; ++step) {
        const std::size_t texel = ViewSamples::texel(from + along * ((step + 0.5) / steps));
        if (texel == ViewSamples::texels) continue;
        ++looked;
        free += leaves_[slot(view, texel)] == 0 && limbs_[slot(view, texel)] <= 1 ? 1 : 0;
      }
    }
    shown[i] = looked > 0 ? static_cast<float>(free) / static_cast<float>(looked) : 1.0F;
  }
  return shown;
}

void FoliageLevels::rank(const Organs& organs, Job& job) {
  const auto count = static_cast<std::uint32_t>(organs.organ.size());
  // The number of remaining leaves at each texel.
  Array<std::uint16_t> left(job);
  left.append(leaves_.span());
  Array<std::uint32_t> score(job, count, 0U), order(job, count), next(job, count, none);
  const auto is_sole = [&](std::size_t at) { return left[at] == 1 && limbs_[at] == 0; };
  for (std::uint32_t i = 0; i < count; ++i) {
    if (i % check_interval == 0) job.check();
    order[i] = i;
    cover(organs.organ[i], [&](std::size_t at) { score[i] += is_sole(at) ? 1 : 0; });
  }
  Array<std::uint64_t> hash(job, count);
  for (std::uint32_t i = 0; i < count; ++i) hash[i] = hash_of(organs.organ[i], i);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return hash[a] != hash[b] ? hash[a] < hash[b] : a < b; });
  std::vector<std::uint32_t> first(most_score + 1, none);
  const auto put = [&](std::uint32_t organ) {
    std::uint32_t& head = first[std::min(score[organ], most_score)];
    next[organ] = head;
    head = organ;
  };
  for (const std::uint32_t organ : order) put(organ);
  const auto gone = static_cast<std::uint32_t>((1 - least_share) * count);
  const auto covered = static_cast<double>(
      std::count_if(leaves_.begin(), leaves_.end(), [](std::uint16_t many) { return many > 0; }));
  double lost = 0;
  lost_.assign(1, 0.0F);
  lost_.reserve(gone + 1);
  std::uint32_t lowest = 0;
  for (std::uint32_t taken = 0; taken < gone;) {
    if (taken % check_interval == 0) job.check();
    while (first[lowest] == none) ++lowest;
    const std::uint32_t organ = first[lowest];
    first[lowest] = next[organ];
    if (std::min(score[organ], most_score) > lowest) {  // its score has risen since
      put(organ);
      continue;
    }
    rank_[organ] = taken++;
    lost += score[organ];
    lost_.push_back(static_cast<float>(lost / std::max(covered, 1.0)));
    cover(organs.organ[organ], [&](std::size_t at) {
      owner_[at] ^= organ;
      // The counter is saturated at 0xFFFF.
      if (left[at] != 0xFFFF && --left[at] == 1 && limbs_[at] == 0) ++score[owner_[at]];
    });
  }
}

/// The factor that maximises the regained texels minus those that were never covered.
float FoliageLevels::best_growth(const Organ& organ, const Array<std::int8_t>& gain) {
  float best = 1;
  int most = 0;
  for (const float growth : growths) {
    int won = 0;
    bool has_gain = false;
    draw(
        organ, growth,
        [&](std::size_t at) {
          won += gain[at];
          has_gain = has_gain || gain[at] > 0;
        },
        growth_views);
    if (!has_gain) break;  // smaller factors cover subsets of the same texels
    if (won <= most) continue;
    most = won;
    best = growth;
  }
  return best;
}

double FoliageLevels::share_for(double loss) const {
  if (lost_.size() < 2) return 1;
  const auto more = std::upper_bound(lost_.begin(), lost_.end(), static_cast<float>(loss));
  return 1 - static_cast<double>(more - lost_.begin() - 1) / static_cast<double>(rank_.size());
}

Organs FoliageLevels::keep(const Organs& organs, double share, Job& job) {
  const auto gone = static_cast<std::uint32_t>((1 - std::max(share, least_share)) *
                                               static_cast<double>(organs.organ.size()));
  Organs kept(job);
  // For each texel: 1 where a leaf is missing, 0 where it is covered, -1 where nothing was.
  Array<std::int8_t> gain(job, leaves_.size());
  for (std::size_t i = 0; i < gain.size(); ++i)
    gain[i] = static_cast<std::int8_t>(limbs_[i] > 0 ? 0 : leaves_[i] > 0 ? 1 : -1);
  const auto cover_with = [&](const Organ& organ, float growth) {
    draw(organ, growth, [&](std::size_t at) { gain[at] = 0; });
  };
  for (std::size_t i = 0; i < organs.organ.size(); ++i) {
    if (rank_[i] < gone) continue;
    kept.organ.push_back(organs.organ[i]);
    cover_with(kept.organ.back(), 1);
  }
  for (std::size_t i = 0; i < kept.organ.size(); ++i) {
    if (i % check_interval == 0) job.check();
    Organ& organ = kept.organ[i];
    const float growth = best_growth(organ, gain);
    if (growth == 1) continue;
    cover_with(organ, growth);
    organ.scale *= growth;
  }
  return kept;
}

}  // namespace seedmesh
