#include "core/geom/leaf_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/base/math.h"
#include "core/geom/triangulate.h"

namespace seedmesh {
namespace {

using glm::dvec2;
using glm::dvec3;

// Below this share of a leaf's square a triangle is a line.
constexpr double least_area = 1e-6;
// Stalks lie a little below the blades that they carry.
constexpr double stalk_depth = 0.004;

Mesh empty_mesh(const Job& job) {
  Mesh mesh;
  mesh.position = Array<glm::vec3>(job);
  mesh.normal = Array<glm::vec3>(job);
  mesh.uv[0] = Array<glm::vec2>(job);
  mesh.index.wide = Array<std::uint32_t>(job);
  return mesh;
}

struct Point {
  dvec3 position, normal;
};

/// A flat leaf bent: each blade folded about its midrib, then everything down along an arc.
class Bend {
 public:
  Bend(const LeafForm& form) : fold_(math::sincos(form.fold)), droop_(form.droop), is_afar_(form.level > 0) {}

  /// A point of the plane that stands `off` beside the midrib of its blade, to the right; `across` is the
  /// direction of growing `off`.
  Point folded(dvec2 p, double off, dvec2 across) const {
    const double rise = std::abs(off) * fold_.sin;
    const dvec2 in_plane = p - across * (off * (1 - fold_.cos));
    const double side = off > 1e-9 ? 1 : off < -1e-9 ? -1 : 0;
    const dvec2 lean = across * (-side * fold_.sin);
    return drooped({{in_plane, rise}, {lean, side == 0 ? 1 : fold_.cos}});
  }
  Point flat(dvec2 p, double z) const { return drooped({{p, z}, {0, 0, 1}}); }

  /// A corner of an unfolded square of the coarser levels, in the mean where the folded and bent one lies;
  /// `row` is as long as each of its rows.
  Point level(dvec2 p, double row) const {
    if (!is_afar_) return flat(p, 0);
    const double rise = 0.5 * std::abs(p.x) * fold_.sin, bulge = droop_ * row * row / 8;
    return flat({p.x * fold_.cos, p.y}, rise + mean_of_arc * bulge);
  }

 private:
  Point drooped(const Point& p) const {
    if (std::abs(droop_) < 1e-6) return p;
    const double y = p.position.y, z = p.position.z;
    const math::SinCos turn = math::sincos(droop_ * y);
    return {{p.position.x, turn.sin / droop_ + z * turn.sin, (turn.cos - 1) / droop_ + z * turn.cos},
            {p.normal.x, p.normal.y * turn.cos + p.normal.z * turn.sin,
             p.normal.z * turn.cos - p.normal.y * turn.sin}};
  }

  static constexpr double mean_of_arc = 2.0 / 3;  // of a parabola's height above its chord

  math::SinCos fold_;
  double droop_;
  bool is_afar_;
};

class LeafWriter {
 public:
  LeafWriter(const LeafDrawing& drawing, const LeafForm& form, Mesh& mesh)
      : drawing_(drawing), bend_(form), mesh_(mesh) {}

  std::uint32_t add(const Point& point, dvec2 flat) {
    mesh_.position.push_back(glm::vec3(point.position) + 0.0F);
    mesh_.normal.push_back(glm::vec3(math::unit(point.normal, {0, 0, 1})) + 0.0F);
    const dvec2 in_box = (flat - drawing_.low) / (drawing_.high - drawing_.low);
    mesh_.uv[0].push_back({static_cast<float>(in_box.x), static_cast<float>(1 - in_box.y)});
    return static_cast<std::uint32_t>(mesh_.position.size() - 1);
  }

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    for (const std::uint32_t i : {a, b, c}) mesh_.index.wide.push_back(i);
  }

  /// The whole box, in `columns` x `rows` squares, folded about x = 0.
  void add_square(int columns, int rows) {
    const auto first = static_cast<std::uint32_t>(mesh_.position.size());
    const auto width = static_cast<std::uint32_t>(columns + 1);
    for (int row = 0; row <= rows; ++row) {
      const double y = drawing_.low.y + (drawing_.high.y - drawing_.low.y) * row / rows;
      for (int column = 0; column <= columns; ++column) {
        const double x = drawing_.low.x + (drawing_.high.x - drawing_.low.x) * column / columns;
        const dvec2 p{columns == 2 && column == 1 ? 0 : x, y};
        add(columns == 2 ? bend_.folded(p, p.x, {1, 0})
                         : bend_.level(p, (drawing_.high.y - drawing_.low.y) / rows),
            p);
      }
    }
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        const std::uint32_t a =
            first + static_cast<std::uint32_t>(row) * width + static_cast<std::uint32_t>(column);
        triangle(a, a + 1, a + width + 1);
        triangle(a, a + width + 1, a + width);
      }
    }
  }

  void add_stalk(const LeafLine& line) {
    const dvec2 along = line.to - line.from;
    const double length = std::sqrt(along.x * along.x + along.y * along.y);
    if (length < 1e-6) return;
    const dvec2 across = dvec2(along.y, -along.x) * (0.5 / length);
    const auto corner = [&](dvec2 p) { return add(bend_.flat(p, -stalk_depth), p); };
    const std::uint32_t a = corner(line.from - across * line.width),
                        b = corner(line.from + across * line.width);
    const std::uint32_t c = corner(line.to + across * line.end_width),
                        d = corner(line.to - across * line.end_width);
    triangle(a, b, c);
    triangle(a, c, d);
  }

  /// Both halves of a blade, with `inner` points along the midrib between its ends.
  void add_blade(const LeafBlade& blade, int inner) {
    const dvec2 along = blade.tip - blade.base;
    const double length = std::sqrt(along.x * along.x + along.y * along.y);
    if (length < 1e-9) return;
    const dvec2 across = dvec2(along.y, -along.x) / length;
    const auto place = [&](dvec2 p) {
      const dvec2 from = p - blade.base;
      return add(bend_.folded(p, from.x * across.x + from.y * across.y, across), p);
    };
    const auto count = blade.right.size();
    std::vector<dvec2> right(blade.right), left{blade.base};
    std::vector<std::uint32_t> right_at, left_at;
    for (const dvec2& p : blade.right) right_at.push_back(place(p));
    left_at.push_back(right_at.front());
    std::vector<dvec2> middle;
    std::vector<std::uint32_t> middle_at;
    for (int i = 1; i <= inner; ++i) {
      middle.push_back(blade.base + along * (static_cast<double>(i) / (inner + 1)));
      middle_at.push_back(place(middle.back()));
    }
    left.insert(left.end(), middle.begin(), middle.end());
    left_at.insert(left_at.end(), middle_at.begin(), middle_at.end());
    left.push_back(blade.tip);
    left_at.push_back(right_at.back());
    for (std::size_t i = count - 1; i-- > 1;) {
      left.push_back(blade.left[i]);
      left_at.push_back(place(blade.left[i]));
    }
    for (std::size_t i = middle.size(); i-- > 0;) {
      right.push_back(middle[i]);
      right_at.push_back(middle_at[i]);
    }
    fill(right, right_at);
    fill(left, left_at);
  }

 private:
  void fill(const std::vector<dvec2>& outline, const std::vector<std::uint32_t>& at) {
    const std::span<const std::uint32_t> corners = triangulator_.run(outline, least_area);
    for (const std::uint32_t corner : corners) mesh_.index.wide.push_back(at[corner]);
  }

  const LeafDrawing& drawing_;
  Bend bend_;
  Mesh& mesh_;
  Triangulator triangulator_;
};

/// Adds a copy of the first `count` vertices and all triangles so far, turned about +y.
void add_turned(Mesh& mesh, std::size_t vertices, std::size_t corners, math::SinCos turn) {
  const auto shift = static_cast<std::uint32_t>(mesh.position.size());
  const auto turned = [&](const glm::vec3& p) {
    const auto s = static_cast<float>(turn.sin), c = static_cast<float>(turn.cos);
    return glm::vec3(p.x * c + p.z * s, p.y, p.z * c - p.x * s) + 0.0F;
  };
  for (std::size_t i = 0; i < vertices; ++i) {
    mesh.position.push_back(turned(mesh.position[i]));
    mesh.normal.push_back(turned(mesh.normal[i]));
    mesh.uv[0].push_back(mesh.uv[0][i]);
  }
  for (std::size_t i = 0; i < corners; ++i) mesh.index.wide.push_back(mesh.index.wide[i] + shift);
}

glm::dvec4 weights(PatchBasis basis, double t) {
  const double s = 1 - t;
  if (basis == PatchBasis::bezier) return {s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
  return glm::dvec4(s * s * s, 3 * t * t * t - 6 * t * t + 4, 1 + 3 * t + 3 * t * t - 3 * t * t * t,
                    t * t * t) /
         6.0;
}

glm::dvec4 slopes(PatchBasis basis, double t) {
  const double s = 1 - t;
  if (basis == PatchBasis::bezier)
    return {-3 * s * s, 3 * s * s - 6 * s * t, 6 * s * t - 3 * t * t, 3 * t * t};
  return glm::dvec4(-3 * s * s, 9 * t * t - 12 * t, 3 + 6 * t - 9 * t * t, 3 * t * t) / 6.0;
}

dvec3 blend(const glm::vec3* points, const glm::dvec4& along_u, const glm::dvec4& along_v) {
  dvec3 sum{0};
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column)
      sum += dvec3(points[4 * row + column]) * (along_v[row] * along_u[column]);
  }
  return sum;
}

/// Where u or v stands still, as at a side drawn together to a point, the normal is looked for a little
/// further in.
dvec3 patch_normal(const glm::vec3* points, PatchBasis basis, double u, double v) {
  for (const double inward : {0.0, 1e-3, 1e-2}) {
    const double a = u + (0.5 - u) * inward, b = v + (0.5 - v) * inward;
    const dvec3 du = blend(points, slopes(basis, a), weights(basis, b));
    const dvec3 dv = blend(points, weights(basis, a), slopes(basis, b));
    const dvec3 normal = glm::cross(du, dv);
    if (glm::dot(normal, normal) > 1e-12 * glm::dot(du, du) * glm::dot(dv, dv) &&
        glm::dot(normal, normal) > 0)
      return math::unit(normal, {0, 0, 1});
  }
  return {0, 0, 1};
}

/// Where a face is bent so far that the normal of a corner looks to its other side, the normal gives way.
void settle_normals(Mesh& mesh) {
  constexpr float least = 0.1F;
  for (int round = 0; round < 4; ++round) {
    bool is_settled = true;
    for (std::size_t i = 0; i + 2 < mesh.index.wide.size(); i += 3) {
      const std::uint32_t* corner = mesh.index.wide.data() + i;
      const glm::vec3 a = mesh.position[corner[0]];
      const glm::vec3 face =
          math::unit(glm::cross(mesh.position[corner[1]] - a, mesh.position[corner[2]] - a), {0, 0, 1});
      for (int k = 0; k < 3; ++k) {
        glm::vec3& normal = mesh.normal[corner[k]];
        const float over = glm::dot(normal, face);
        if (over >= least) continue;
        is_settled = false;
        normal = math::unit(normal + face * (1.5F * least - over), face) + 0.0F;
      }
    }
    if (is_settled) return;
  }
}

/// Lets triangles share vertices that are the same in everything, as where leaflets begin in one point.
void share_vertices(Mesh& mesh) {
  std::map<std::array<float, 8>, std::uint32_t> first;
  for (std::uint32_t& i : mesh.index.wide) {
    const glm::vec3 p = mesh.position[i], n = mesh.normal[i];
    const glm::vec2 t = mesh.uv[0].empty() ? glm::vec2(0) : mesh.uv[0][i];
    i = first.try_emplace({p.x, p.y, p.z, n.x, n.y, n.z, t.x, t.y}, i).first->second;
  }
}

/// Columns and rows. Asked for coarse, a square is flat at once; from level to level it falls by and by.
std::array<int, 2> bent_square(const LeafForm& form) {
  constexpr std::array<std::array<int, 2>, 4> squares{{{2, 4}, {2, 3}, {2, 2}, {1, 2}}};
  if (form.coarseness >= 3) return {1, 1};
  return squares[static_cast<std::size_t>(std::clamp(form.coarseness + form.level, 0, 3))];
}

}  // namespace

void drop_unused(Mesh& mesh, const Job& job) {
  share_vertices(mesh);
  const Box box = bounds_of(mesh.position.span());
  const glm::vec3 extent = box.max - box.min;
  const float least = 1e-10F * glm::dot(extent, extent);
  Array<std::uint32_t> kept(job);
  for (std::size_t i = 0; i + 2 < mesh.index.wide.size(); i += 3) {
    const std::uint32_t* corner = mesh.index.wide.data() + i;
    const glm::vec3 a = mesh.position[corner[0]],
                    across = glm::cross(mesh.position[corner[1]] - a, mesh.position[corner[2]] - a);
    if (glm::dot(across, across) > least * least) kept.append({corner, 3});
  }
  constexpr std::uint32_t unused = 0xFFFFFFFFU;
  std::vector<std::uint32_t> new_place(mesh.position.size(), unused);
  for (const std::uint32_t i : kept) new_place[i] = 0;
  std::uint32_t count = 0;
  for (std::size_t i = 0; i < new_place.size(); ++i) {
    if (new_place[i] == unused) continue;
    mesh.position[count] = mesh.position[i];
    mesh.normal[count] = mesh.normal[i];
    if (!mesh.uv[0].empty()) mesh.uv[0][count] = mesh.uv[0][i];
    new_place[i] = count++;
  }
  mesh.position.resize(count);
  mesh.normal.resize(count);
  if (!mesh.uv[0].empty()) mesh.uv[0].resize(count);
  for (std::uint32_t& i : kept) i = new_place[i];
  mesh.index.wide = std::move(kept);
}

Mesh leaf_mesh(const LeafForm& form, const Job& job) {
  const bool is_twig = form.build == LeafBuild::twig || form.build == LeafBuild::bunch ||
                       (form.shows_twig && form.build != LeafBuild::mesh);
  const int coarse = std::clamp(form.coarseness + form.level, 0, 4);
  constexpr std::array<int, 5> margin_steps{2, 2, 1, 1, 1}, inner_points{2, 1, 1, 0, 0};
  const LeafDrawing drawing = draw_leaf(
      form.shape,
      {form.build == LeafBuild::mesh ? margin_steps[static_cast<std::size_t>(coarse)] : 6, true, false},
      is_twig ? form.twig_leaves : 1);
  Mesh mesh = empty_mesh(job);
  LeafForm straight = form;
  if (form.build == LeafBuild::card || form.build == LeafBuild::cross) straight.droop = straight.level = 0;
  LeafWriter writer(drawing, straight, mesh);
  switch (form.build) {
    case LeafBuild::card:
    case LeafBuild::cross:
      writer.add_square(1, 1);
      break;
    case LeafBuild::curved:
    case LeafBuild::twig:
    case LeafBuild::bunch:
      writer.add_square(bent_square(form)[0], bent_square(form)[1]);
      break;
    case LeafBuild::mesh:
      for (const LeafLine& stalk : drawing.stalks) writer.add_stalk(stalk);
      for (const LeafBlade& blade : drawing.blades)
        writer.add_blade(blade, inner_points[static_cast<std::size_t>(coarse)]);
      break;
  }
  const std::size_t vertices = mesh.position.size(), corners = mesh.index.wide.size();
  if (form.build == LeafBuild::cross) add_turned(mesh, vertices, corners, {1, 0});
  if (form.build == LeafBuild::bunch) {
    for (const double degrees : {120.0, 240.0})
      add_turned(mesh, vertices, corners, math::sincos_degrees(degrees));
  }
  drop_unused(mesh, job);
  settle_normals(mesh);
  return mesh;
}

Mesh fruit_mesh(const FruitForm& form, const Job& job) {
  Mesh mesh = empty_mesh(job);
  const int sides = std::max(form.sides, 3), rows = std::max(sides / 2 + 1, 3);
  for (int row = 0; row <= rows; ++row) {
    const math::SinCos lift = math::sincos(math::pi * row / rows);
    const double share = static_cast<double>(row) / rows, thin = 1 - form.pointed * share * share * 0.7;
    const double radius = 0.5 * form.width * lift.sin * thin, y = 0.5 - 0.5 * lift.cos;
    for (int i = 0; i <= sides; ++i) {
      const math::SinCos round = math::sincos(2 * math::pi * (i % sides) / sides);
      const dvec3 out{round.cos, 0, -round.sin};
      mesh.position.push_back(glm::vec3(dvec3(0, y, 0) + out * radius) + 0.0F);
      const dvec3 normal =
          math::unit(out * (lift.sin + 1e-9) +
                         dvec3(0, -lift.cos * form.width + form.pointed * 0.5 * lift.sin * share, 0),
                     {0, 1, 0});
      mesh.normal.push_back(glm::vec3(row == 0      ? dvec3(0, -1, 0)
                                      : row == rows ? dvec3(0, 1, 0)
                                                    : normal) +
                            0.0F);
      mesh.uv[0].push_back({static_cast<float>(i + (row % rows == 0 ? 0.5 : 0)) / static_cast<float>(sides),
                            static_cast<float>(share)});
    }
  }
  const auto width = static_cast<std::uint32_t>(sides + 1);
  for (std::uint32_t row = 0; row < static_cast<std::uint32_t>(rows); ++row) {
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(sides); ++i) {
      const std::uint32_t a = row * width + i;
      const bool first = row == 0, last = row + 1 == static_cast<std::uint32_t>(rows);
      if (!first) {
        for (const std::uint32_t k : {a, a + 1, last ? a + width : a + width + 1})
          mesh.index.wide.push_back(k);
      }
      if (!last) {
        for (const std::uint32_t k : {a, a + width + 1, a + width}) mesh.index.wide.push_back(k);
      }
    }
  }
  drop_unused(mesh, job);
  settle_normals(mesh);
  return mesh;
}

Mesh patch_mesh(const PatchForm& form, const Job& job) {
  Mesh mesh = empty_mesh(job);
  const int divisions = std::max(form.divisions, 1);
  const auto width = static_cast<std::uint32_t>(divisions + 1);
  for (std::size_t patch = 0; patch + 16 <= form.points.size(); patch += 16) {
    job.check();
    const glm::vec3* points = form.points.data() + patch;
    const auto first = static_cast<std::uint32_t>(mesh.position.size());
    for (int row = 0; row <= divisions; ++row) {
      for (int column = 0; column <= divisions; ++column) {
        const double u = static_cast<double>(column) / divisions, v = static_cast<double>(row) / divisions;
        mesh.position.push_back(glm::vec3(blend(points, weights(form.basis, u), weights(form.basis, v))) +
                                0.0F);
        mesh.normal.push_back(glm::vec3(patch_normal(points, form.basis, u, v)) + 0.0F);
        mesh.uv[0].push_back({static_cast<float>(u), static_cast<float>(1 - v)});
      }
    }
    for (std::uint32_t row = 0; row + 1 < width; ++row) {
      for (std::uint32_t column = 0; column + 1 < width; ++column) {
        const std::uint32_t a = first + row * width + column;
        for (const std::uint32_t k : {a, a + 1, a + width + 1, a, a + width + 1, a + width})
          mesh.index.wide.push_back(k);
      }
    }
  }
  drop_unused(mesh, job);
  settle_normals(mesh);
  return mesh;
}

}  // namespace seedmesh
