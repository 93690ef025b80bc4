#include "core/geom/plant/graft/face_check.h"

#include <algorithm>

#include "core/base/parallel.h"
#include "core/base/wide.h"
#include "core/geom/plant/graft/creases.h"
#include "core/geom/plant/graft/junction_normals.h"
#include "core/geom/plant/graft/rib_normals.h"

namespace seedmesh {
namespace {

// The largest area of a face that counts as zero, as a share of the squared size of the model.
constexpr float least_area = 4e-12F;

/// Of four faces those that are sound.
Mask4 sound_four(const FaceCheck& check, const std::uint32_t* corner) {
  constexpr float flattest = least_face_cosine * least_face_cosine;
  const Vec3x4 a = Vec3x4::gather(check.position, corner);
  const Vec3x4 face = cross(difference(Vec3x4::gather(check.position, corner + 1), a),
                            difference(Vec3x4::gather(check.position, corner + 2), a));
  const Float4 size = dot(face, face), least = flattest * size;
  Mask4 flags = size > check.least_square;
  for (std::size_t k = 0; k < 3; ++k) {
    // Three floats are read: the next one may belong to a normal that another thread writes.
    const auto normal = [&](std::size_t i) { return spread_out(check.normal[corner[k + i]]); };
    const Float4 over = dot(face, Vec3x4::of_rows(normal(0), normal(3), normal(6), normal(9)));
    flags &= (over > 0.0F) & (over * over > least);
  }
  return flags;
}

/// The number of faces before the first four that are not all sound.
SEEDMESH_WIDE std::size_t sound_faces(const FaceCheck& check, const std::uint32_t* corner,
                                      std::size_t count) {
  std::size_t sound = 0;
  while (sound + Vec3x4::size <= count && all_of(sound_four(check, corner + 3 * sound)))
    sound += Vec3x4::size;
  return sound;
}

/// The bad triangles of a limb, as far as something has changed for them.
void find_bad_faces_of(const FaceCheck& check, const BarkBuffers& bark, const BarkRounds& rounds,
                       std::size_t limb, std::vector<std::uint32_t>& bad) {
  const std::uint32_t* index = bark.mesh.index.wide.data();
  if (rounds.dirty[limb]) {
    return find_bad_faces(check, index, bark.range[limb].begin.triangle, recheck_end(bark, rounds, limb),
                          bad);
  }
  for_loop_triangles(bark, rounds, limb, [&](std::uint32_t triangle) {
    find_bad_faces(check, index, triangle, triangle + 1, bad);
  });
}

/// Lowers the join modes of the limbs whose loops the triangle touches. Returns false where it touches none.
bool lower_loop_modes(const BarkBuffers& bark, std::uint32_t triangle, std::vector<JoinMode>& join,
                      bool is_late) {
  bool touches = false;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t group = bark.group[bark.corners_of(triangle)[k]];
    if (group == Limbs::none) continue;
    touches = true;
    JoinMode& child = join[bark.group_limb[group / 2]];
    child = std::max(child, is_late ? JoinMode::closed : JoinMode::detached);
  }
  return touches;
}

/// Sorts bad triangles into creases and defects, and lowers the modes of the limbs with defects.
class DefectSorter {
 public:
  DefectSorter(const GraftInput& in, const BarkBuffers& bark, std::vector<JoinMode>& join,
               std::vector<std::uint32_t>& creased, bool is_late)
      : in_(in), bark_(bark), join_(join), creased_(creased), is_late_(is_late) {}

  /// The bad triangles of limbs from number `limb` on, limb by limb.
  void add(const std::vector<std::uint32_t>& bad, std::size_t limb) {
    // The triangles of a limb are contiguous; those of limbs that were written again lie behind all others.
    const auto is_of_limb = [&](std::uint32_t triangle) {
      return triangle >= bark_.range[limb].begin.triangle && triangle < bark_.range[limb].end.triangle;
    };
    for (std::size_t i = 0; i < bad.size();) {
      while (!is_of_limb(bad[i])) ++limb;
      bool is_limb_defect = false;
      for (; i < bad.size() && is_of_limb(bad[i]); ++i) {
        if (can_be_creased(in_, bark_, bad[i], limb)) {
          creased_.push_back(bad[i]);
          continue;
        }
        ++defects_;
        is_limb_defect = !lower_loop_modes(bark_, bad[i], join_, is_late_) || is_limb_defect;
      }
      if (is_limb_defect)
        join_[limb] = join_[limb] < JoinMode::closed && !is_late_ ? JoinMode::closed : JoinMode::none;
    }
  }

  std::size_t defects() const { return defects_; }

 private:
  const GraftInput& in_;
  const BarkBuffers& bark_;
  std::vector<JoinMode>& join_;
  std::vector<std::uint32_t>& creased_;
  bool is_late_;
  std::size_t defects_ = 0;
};

}  // namespace

float least_face_square(float model_size) {
  const float least = 2 * least_area * model_size * model_size;
  return least * least;
}

void find_bad_faces(const FaceCheck& check, const std::uint32_t* index, std::uint32_t first,
                    std::uint32_t last, std::vector<std::uint32_t>& bad) {
  for (std::uint32_t t = first; t < last;) {
    t += static_cast<std::uint32_t>(sound_faces(check, index + std::size_t{3} * t, last - t));
    const std::uint32_t begin = t, end = std::min(last, t + static_cast<std::uint32_t>(Vec3x4::size));
    if (begin == end) return;
    std::uint32_t corner[3 * Vec3x4::size];
    for (std::uint32_t i = 0; i < Vec3x4::size; ++i)
      std::copy_n(index + std::size_t{3} * std::min(t + i, end - 1), 3, corner + std::size_t{3} * i);
    const Mask4 sound = sound_four(check, corner);
    for (; t < end; ++t) {
      if (!sound[t - begin]) bad.push_back(t);
    }
  }
}

std::size_t check_round(const GraftInput& in, BarkBuffers& bark, const BarkRounds& rounds,
                        const BarkRepairs& repairs, const Job& job) {
  solve_junction_normals(bark, rounds, job);
  const FaceCheck check{bark.mesh.position.data(), bark.mesh.normal.data(), least_face_square(in.scale.size)};
  const std::size_t limbs = bark.range.size(), chunk = limbs_a_chunk(limbs);
  std::vector<std::vector<std::uint32_t>> bad(chunk_count(limbs, chunk));
  for_chunks(rounds, job, limbs, chunk, [&](std::size_t begin, std::size_t end, std::size_t index) {
    job.check();
    for (std::size_t limb = begin; limb < end; ++limb) store_junction_normals(bark, rounds, limb);
    if (rounds.is_first()) {  // the limbs are contiguous and are checked at once unless ribs may be repaired
      find_bad_faces(check, bark.mesh.index.wide.data(), bark.range[begin].begin.triangle,
                     bark.range[end - 1].end.triangle, bad[index]);
      if (bad[index].empty() || bark.rib_seams.empty()) return;
      bad[index].clear();
    }
    for (std::size_t limb = begin; limb < end; ++limb) {
      const std::size_t before = bad[index].size();
      find_bad_faces_of(check, bark, rounds, limb, bad[index]);
      if (bad[index].size() == before || !rounds.dirty[limb] || !has_rib_seams(bark, limb)) continue;
      bad[index].resize(before);
      smooth_rib_normals(bark, limb);
      find_bad_faces_of(check, bark, rounds, limb, bad[index]);
    }
  });
  DefectSorter sorter(in, bark, repairs.join, repairs.creased, repairs.is_late);
  for (std::size_t i = 0; i < bad.size(); ++i) sorter.add(bad[i], i * chunk);
  return sorter.defects();
}

}  // namespace seedmesh
