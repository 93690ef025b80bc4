#pragma once
/// Organs -> Mesh: copies of small meshes where leaves, petals and fruits stand.
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/geom/limbs.h"
#include "core/geom/wind.h"
#include "core/model/model.h"

namespace seedmesh {

/// All organs of one surface and one colour index, as one mesh.
struct Foliage {
  std::uint32_t surface = 0;
  std::int16_t color = 0;
  Mesh mesh;
};

/// The same as places of one mesh.
struct FoliagePlaces {
  std::uint32_t surface = 0;
  std::int16_t color = 0;
  std::vector<Transform> places;
};

struct FoliageOptions {
  /// By Organ::surface; borrowed. Each has positions, normals and wide indices, and may have uv[0]
  /// and colours.
  std::span<const Mesh> surfaces;
  /// The diagonal of the whole model. Organs smaller than a 5,000th of it are passed over: whoever welds
  /// vertices at a millionth of the diagonal would make points of their triangles.
  float model_size = 0;
  /// Where given, normals look away from this point as those of a ball would, mixed with the organs' own, so
  /// that a crown is lit as one body. They stay on the side of their face: a renderer turns normals of the
  /// back side round.
  std::optional<glm::vec3> crown;
  float crown_share = 0.75F;
  /// Organs differ in brightness by up to this share, by the hash of their key, as vertex colours; 0: none.
  float tint = 0;
  /// Of each joint of the limbs, what moves it: fills Mesh::bone with that of Organ::limb_joint.
  std::span<const std::uint16_t> bones = {};
  /// Where given, wind weights as in wind.h.
  const WindField* wind = nullptr;
  /// Tangents along uv[0], which surfaces then have, as add_tangents() would make them of the result.
  bool tangents = false;
};

/// One Foliage for each surface and colour in use, both rising. Organs that stand exactly on an earlier one
/// of their surface are passed over, and so are those without extent. Spends Resource::triangles before it
/// allocates. Runs on job.threads(); the result does not depend on it. 3 ns a vertex and thread, twice that
/// with a crown. Tangents of a surface come along.
std::vector<Foliage> place_organs(const Organs& organs, const FoliageOptions& options, Job& job);

/// place_organs() in pieces, for whoever shares them out himself: prepare() returns how many there are, each
/// is placed once, by any thread, and take() returns the whole. `organs` and `job` are borrowed.
class OrganPlacing {
 public:
  OrganPlacing(const Organs& organs, const FoliageOptions& options, Job& job);
  ~OrganPlacing();
  std::size_t prepare();
  void place(std::size_t piece) const;
  std::vector<Foliage> take();

 private:
  struct Share;
  const Organs& organs_;
  FoliageOptions options_;
  Job& job_;
  std::vector<std::unique_ptr<Share>> shares_;
};

/// The same organs as transforms, for formats that share one mesh among nodes.
std::vector<FoliagePlaces> organ_places(const Organs& organs, const FoliageOptions& options, Job& job);

}  // namespace seedmesh
