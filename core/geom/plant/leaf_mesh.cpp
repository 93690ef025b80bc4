#include "core/geom/plant/leaf_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/base/math.h"
#include "core/geom/mesh/sheet.h"
#include "core/geom/polygon/triangulate.h"

namespace seedmesh {
namespace {

using glm::dvec2;
using glm::dvec3;

// Triangles below this share of a leaf's square are lines.
constexpr double least_area = 1e-6;
// From this coarseness on, the finest level of a bent square is not folded, and coarser levels are the same.
constexpr int unfolded = 3;
// The distance of stalks below the blades that they carry.
constexpr double stalk_depth = 0.004;

struct Point {
  dvec3 position, normal;
};

/// A flat leaf in space: each blade is folded about its midrib, then everything is bent down along an arc.
class Bend {
 public:
  Bend(const LeafForm& form)
      : fold_(math::sincos(form.fold)),
        droop_(form.droop),
        is_afar_(form.level > 0 && form.coarseness < unfolded) {}

  /// A point at the distance `off` to the right of the midrib of its blade; `across` is the direction in
  /// which `off` grows.
  Point folded(dvec2 p, double off, dvec2 across) const {
    const double rise = std::abs(off) * fold_.sin;
    const dvec2 in_plane = p - across * (off * (1 - fold_.cos));
    const double side = off > 1e-9 ? 1 : off < -1e-9 ? -1 : 0;
    const dvec2 lean = across * (-side * fold_.sin);
    return drooped({{in_plane, rise}, {lean, side == 0 ? 1 : fold_.cos}});
  }
  Point flat(dvec2 p, double z) const { return drooped({{p, z}, {0, 0, 1}}); }

  /// A corner of an unfolded square of the coarser levels, at the mean position of the folded and bent
  /// square. `row` is the length of each of its rows.
  Point level(dvec2 p, double row) const {
    if (!is_afar_) return flat(p, 0);
    const double rise = 0.5 * std::abs(p.x) * fold_.sin, bulge = droop_ * row * row / 8;
    return flat({p.x * fold_.cos, p.y}, rise + mean_of_arc * bulge);
  }

 private:
  Point drooped(const Point& p) const {
    if (std::abs(droop_) < 1e-6) return p;
    const double y = p.position.y;
    // A raised half stays outside of the centre of the arc; beyond it the leaf would be inside out.
    const double z = std::max(p.position.z * droop_, -nearest_to_centre) / droop_;
    const math::SinCos turn = math::sincos(droop_ * y);
    return {{p.position.x, turn.sin / droop_ + z * turn.sin, (turn.cos - 1) / droop_ + z * turn.cos},
            {p.normal.x, p.normal.y * turn.cos + p.normal.z * turn.sin,
             p.normal.z * turn.cos - p.normal.y * turn.sin}};
  }

  static constexpr double mean_of_arc = 2.0 / 3;     // of a parabola's height above its chord
  static constexpr double nearest_to_centre = 0.75;  // share of the radius of the arc

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

  /// The whole box as `columns` x `rows` squares, folded about x = 0.
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

/// Rotates a vector about +y.
glm::vec3 turned(const glm::vec3& p, math::SinCos turn) {
  const auto s = static_cast<float>(turn.sin), c = static_cast<float>(turn.cos);
  return glm::vec3(p.x * c + p.z * s, p.y, p.z * c - p.x * s) + 0.0F;
}

void turn_all(Mesh& mesh, math::SinCos turn) {
  for (glm::vec3& position : mesh.position) position = turned(position, turn);
  for (glm::vec3& normal : mesh.normal) normal = turned(normal, turn);
}

/// Adds a copy of the first `vertices` vertices and `corners` corners of triangles, rotated about +y.
void add_turned(Mesh& mesh, std::size_t vertices, std::size_t corners, math::SinCos turn) {
  const auto shift = static_cast<std::uint32_t>(mesh.position.size());
  for (std::size_t i = 0; i < vertices; ++i) {
    mesh.position.push_back(turned(mesh.position[i], turn));
    mesh.normal.push_back(turned(mesh.normal[i], turn));
    mesh.uv[0].push_back(mesh.uv[0][i]);
  }
  for (std::size_t i = 0; i < corners; ++i) mesh.index.wide.push_back(mesh.index.wide[i] + shift);
}

/// Triangles across a strongly bent part get their own normal at corners whose shared normal faces away from them.
void give_own_normals(Mesh& mesh) {
  for (std::size_t first = 0; first < mesh.index.wide.size(); first += 3) {
    const glm::vec3 a = mesh.position[mesh.index.wide[first]];
    const glm::vec3 face = glm::cross(mesh.position[mesh.index.wide[first + 1]] - a,
                                      mesh.position[mesh.index.wide[first + 2]] - a);
    for (std::size_t corner = first; corner < first + 3; ++corner) {
      const std::uint32_t i = mesh.index.wide[corner];
      if (!(glm::dot(face, mesh.normal[i]) < 0)) continue;
      const glm::vec3 at = mesh.position[i];
      const glm::vec2 uv = mesh.uv[0][i];
      mesh.index.wide[corner] = static_cast<std::uint32_t>(mesh.position.size());
      mesh.position.push_back(at);
      mesh.normal.push_back(glm::vec3(math::unit(glm::dvec3(face), {0, 0, 1})) + 0.0F);
      mesh.uv[0].push_back(uv);
    }
  }
}

/// Columns and rows. The coarsest square is flat; from level to level the number falls step by step.
std::array<int, 2> bent_square(const LeafForm& form) {
  constexpr std::array<std::array<int, 2>, 4> squares{{{2, 4}, {2, 3}, {2, 2}, {1, 2}}};
  if (form.coarseness >= 4) return {1, 1};
  return squares[static_cast<std::size_t>(std::clamp(form.coarseness + form.level, 0, 3))];
}

}  // namespace

Mesh leaf_mesh(const LeafForm& form, const Job& job) {
  const bool is_twig = form.build == LeafBuild::twig || form.build == LeafBuild::bunch ||
                       (form.shows_twig && form.build != LeafBuild::mesh);
  const int coarse = std::clamp(form.coarseness + form.level, 0, 4);
  constexpr std::array<int, 5> margin_steps{2, 2, 1, 1, 1}, inner_points{2, 1, 1, 0, 0};
  const LeafDrawing drawing = draw_leaf(
      form.shape,
      {form.build == LeafBuild::mesh ? margin_steps[static_cast<std::size_t>(coarse)] : 6, true, false},
      is_twig ? form.twig_leaves : 1);
  Mesh mesh = empty_sheet(job);
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
  if (form.build == LeafBuild::cross) {
    if (form.tilt != 0) turn_all(mesh, math::sincos(form.tilt));
    add_turned(mesh, vertices, corners, form.tilt == 0 ? math::SinCos{1, 0} : math::sincos(-2 * form.tilt));
  }
  if (form.build == LeafBuild::bunch) {
    for (const double degrees : {120.0, 240.0})
      add_turned(mesh, vertices, corners, math::sincos_degrees(degrees));
  }
  drop_unused(mesh, job);
  settle_normals(mesh);
  if (form.build == LeafBuild::mesh) give_own_normals(mesh);
  return mesh;
}

}  // namespace seedmesh
