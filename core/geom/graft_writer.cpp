#include "core/geom/graft_writer.h"

#include <algorithm>
#include <cmath>

#include "core/base/quick_math.h"
#include "core/base/rng.h"

namespace seedmesh {
namespace {

constexpr float pi = static_cast<float>(math::pi);
// Corners fall with this power of the radius: a limb a tenth as thick as the trunk has half its corners.
constexpr double corner_power = 0.3;
// A limb that others leave has at least so many; and rings stand so much of the bulge from loops.
constexpr int least_opened_sides = 6;
constexpr float bulge_share = 1.2F;
// How much thinner, and shorter in radii, chance makes a closed limb at most.
constexpr float most_slimmer = 0.04F;
// A closed limb is at least so many least distances long: 4 mm in a tree of 17 m.
constexpr float least_length = 60;
// The cone that closes a limb inside its parent, and where it begins: shares of the radius.
constexpr float cap_share = 0.5F;
// A child thinner than so many of the least radius is not worth an opening.
constexpr float least_opened = 3;
// What is reserved at first: most trees of fine twigs need about as much, and small ones of thick limbs twice
// that.
constexpr std::size_t vertices_a_joint = 4, triangles_a_joint = 5, more_vertices = std::size_t{1} << 15U,
                      more_vertices_a_joint = 2;
constexpr std::size_t groups_a_limb = 5, triangles_a_group = 6, more_groups = std::size_t{1} << 13U;
constexpr std::size_t added_groups = 1024;  // for a while, by settle()
// Circles up to so many corners are reckoned once for all.
constexpr int usual_corners = 64;
// Of a ring that a vertex cache of 16 entries still holds when the next ring needs it.
constexpr std::size_t cached_corners = 13;

/// Pictures by a radian round a limb: a whole number of a metre each, at least one.
float turns_of(float radius) { return std::max(1.0F, std::floor(2 * pi * radius + 0.5F)) / (2 * pi); }

float fraction(std::uint64_t hash) { return static_cast<float>(hash >> 40U) * 0x1p-24F; }

}  // namespace

std::vector<GraftWriter::Circle> GraftWriter::circles_up_to(int most) {
  std::vector<Circle> circles(static_cast<std::size_t>(most) + 1);
  for (int sides = 3; sides <= most; ++sides) {
    Circle& circle = circles[static_cast<std::size_t>(sides)];
    circle.x.reserve(static_cast<std::size_t>(sides) + Four::size + 1);
    circle.y.reserve(static_cast<std::size_t>(sides) + Four::size + 1);
    for (int i = 0; i < sides; ++i) {
      const math::SinCos at = math::quick_sincos(2 * math::pi * i / sides);
      circle.x.push_back(static_cast<float>(at.cos));
      circle.y.push_back(static_cast<float>(at.sin));
    }
    for (std::size_t i = 0; i <= Four::size; ++i) {
      circle.x.push_back(circle.x[i]);
      circle.y.push_back(circle.y[i]);
    }
  }
  return circles;
}

GraftWriter::Common::Common(const Context& context) {
  const Limbs& limbs = context.limbs;
  const GraftOptions& options = context.options;
  float thickest = 0;
  for (std::size_t i = 0; i < limbs.size(); ++i) {
    if (limbs.parent[i] != Limbs::none) thickest = std::max(thickest, limbs.base_radius[i]);
  }
  static const std::vector<Circle> usual = circles_up_to(usual_corners);
  const int most = 2 * std::max(least_opened_sides, with_ribs(options, options.sides));
  if (most > usual_corners) own_circles = circles_up_to(most);
  circles = most > usual_corners ? std::span<const Circle>(own_circles) : std::span<const Circle>(usual);
  for (int corners = 4; corners <= options.sides; ++corners) {
    const double share = math::pow((corners - 0.5) / options.sides, 1 / corner_power);
    corner_radius.push_back(thickest * static_cast<float>(share));
  }
  const std::size_t count = context.chains.head.size();
  first_child.assign(limbs.size(), none);
  next_sibling.assign(count, none);
  for (std::size_t i = count; i-- > 0;) {
    const std::uint32_t parent = limbs.parent[context.chains.head[i]];
    if (parent == Limbs::none) continue;
    next_sibling[i] = first_child[parent];
    first_child[parent] = static_cast<std::uint32_t>(i);
  }
}

GraftWriter::GraftWriter(const Context& context, Job& job)
    : GraftWriter(context, std::make_shared<const Common>(context), context.limbs.size(), job) {}

GraftWriter::GraftWriter(const Context& context, std::shared_ptr<const Common> common, std::size_t joints,
                         Job& job)
    : context_(context),
      common_(std::move(common)),
      job_(job),
      triangles_(job, Resource::triangles),
      group_(job),
      group_normal_(job),
      loop_triangles_(job),
      joints_(job),
      twin_(job),
      colors_(job),
      loop_vertices_(job) {
  mesh_.position = Array<glm::vec3>(job);
  mesh_.normal = Array<glm::vec3>(job);
  mesh_.uv[0] = Array<glm::vec2>(job);
  mesh_.tangent = Array<glm::vec4>(job);
  mesh_.index.wide = Array<std::uint32_t>(job);
  const std::size_t more =
      std::min(more_vertices + more_vertices_a_joint * joints, vertices_a_joint * joints);
  make_room(vertices_a_joint * joints + more + 64);
  mesh_.index.wide.reserve(3 * (triangles_a_joint * joints + more + more / 2));
  const std::size_t count = context.chains.head.size();
  const std::size_t groups = std::min(more_groups, groups_a_limb * count);
  group_limb_.reserve(groups);
  group_normal_.reserve(2 * groups + added_groups);
  loop_vertices_.reserve(groups);
  loop_triangles_.reserve(triangles_a_group * groups);
  loops_.resize(count);
  range_.resize(count);
  kind_.assign(count, Kind::none);
  dirty_.assign(count, 1);
}

/// Makes room for so many vertices; what is beyond `vertices_` is not written yet.
void GraftWriter::make_room(std::size_t vertices) {
  mesh_.position.resize(vertices);
  mesh_.normal.resize(vertices);
  mesh_.uv[0].resize(vertices);
  if (has_tangents()) mesh_.tangent.resize(vertices);
  group_.resize(vertices);
  twin_.resize(vertices);
  if (context_.options.joints) joints_.resize(vertices);
}

/// Three, or an even number, so that rings of different limbs meet corner to corner.
int GraftWriter::corners_for(float radius) const {
  int wanted = 3;
  for (const float least : common_->corner_radius)
    wanted += radius >= least ? 1 : 0;  // they rise, and are few
  return wanted <= 3 || wanted == context_.options.sides ? std::max(3, wanted) : wanted + wanted % 2;
}

int GraftWriter::sides_for(float radius) const {
  int sides = corners_for(radius);
  sides = std::max(sides, least_sides_);
  if (has_ribs()) sides = with_ribs(context_.options, sides);
  // A limb keeps the corners of its loop until it is clearly thinner.
  return std::abs(sides - loop_sides_) <= 1 ? loop_sides_ : sides;
}

void GraftWriter::write_limb(std::uint32_t limb) {
  const Scale& scale = context_.scale;
  const std::uint32_t head = context_.chains.head[limb];
  if (!axis_.read(context_.limbs, context_.chains, head, scale.shortest)) return;
  if (axis_.radius[0] < std::max(2 * scale.thinnest, context_.options.thinnest)) return;
  if (context_.options.colors) axis_.read_colors(context_.limbs);
  for (float& radius : axis_.radius) radius = std::max(radius, 2 * scale.thinnest);
  const bool is_root = context_.limbs.parent[head] == Limbs::none;
  const Loop& loop = loops_[limb];
  const bool has_loop = loop.first != none;
  // A closed limb that does not come out of its parent is not seen, nor is one as short as this; heaps of
  // such would meet in points that a reader takes for one.
  if (!is_root && !has_loop &&
      axis_.length() <
          std::max(context_.limbs.radius[context_.limbs.parent[head]], least_length * scale.apart)) {
    return;
  }
  kind_[limb] = is_root ? Kind::root : !has_loop ? Kind::closed : (loop.is_fork ? Kind::fork : Kind::collar);

  const std::uint64_t hash = key_at(context_.limbs.key.empty() ? head : context_.limbs.key[head], 0x62AF7);
  const bool is_twig = !is_root && !has_loop && axis_.radius[0] < context_.options.thinnest_joint;
  if (!is_root && !has_loop) {
    // Limbs that lie on others, as those of a split without an angle do, must not share a vertex with them.
    const float widest = is_twig ? 1 + 0.5F * most_slimmer : 1.0F;
    for (float& radius : axis_.radius) radius *= widest - most_slimmer * fraction(hash);
    axis_.point.back() -= axis_.along.back() * (most_slimmer * fraction(mix(hash)) * axis_.radius.back());
  }
  const float last_length = axis_.at.back() - axis_.at[axis_.at.size() - 2];
  const float end = axis_.radius.back();
  const float tip = axis_.length() - std::min(end, 0.3F * last_length);
  const float start = has_loop ? loop.reach : 0;
  if (start > tip - 8 * scale.apart) return;
  glm::vec3 first = any_aside(axis_.along[0]);
  if (has_loop) {
    first = loop.u;
  } else if (is_twig) {
    first = upward_of(limb);
  } else {
    const math::SinCos turn = math::quick_sincos(static_cast<double>(fraction(hash)) * 2 * math::pi);
    first = first * static_cast<float>(turn.cos) +
            glm::cross(axis_.along[0], first) * static_cast<float>(turn.sin);
  }
  axis_.carry(first);
  near_piece_ = 0;
  turns_ = context_.options.wrap ? turns_of(axis_.radius[0]) : 0;
  axis_.stretch(turns_);
  least_sides_ = 3;
  loop_sides_ = has_loop ? static_cast<int>(loop.count) : 0;
  const float middle = axis_.radius_at(0.5F * axis_.length(), axis_.piece_at(0.5F * axis_.length(), 0));
  const int sides = std::max(least_opened_sides, sides_for(middle));
  plan_.begin(start, tip, scale.apart,
              bulge_share * (1 - common_->circles[static_cast<std::size_t>(2 * sides)].x[1]));
  if (context_.trust[limb] <= Trust::detached) plan_children(start);
  if (!plan_.opening.empty()) least_sides_ = least_opened_sides;
  plan_.complete(axis_, has_loop && sides_for(axis_.radius[0]) > 4, context_.options);
  if (context_.options.drawn) tell_drawn(start);
  if (has_loop) {
    begin_loop(loop);
  } else {
    begin_closed(is_root, limb);
    paint(0);
  }
  float before = start;
  for (const Band& band : plan_.band) {
    write_band(band);
    paint(0.5F * (before + band.at));
    before = band.at;
    if (has_loop && &band == &plan_.band.front()) range_[limb].first_end = here().triangle;
  }
  write_tip(end);
  paint(axis_.length());
}

/// The triangles that have no colour yet have that of the piece that holds the length `at`.
void GraftWriter::paint(float at) {
  if (!context_.options.colors) return;
  const std::size_t count = mesh_.index.wide.size() / 3 - colors_.size();
  std::fill_n(colors_.extend(count), count, axis_.color[axis_.first_piece_at(at, near_piece_)]);
}

/// Where the rings of the plan draw the axis' points.
void GraftWriter::tell_drawn(float start) {
  Array<glm::vec3>& drawn = *context_.options.drawn;
  float before = start;
  glm::vec3 from = axis_.point_at(start);
  std::size_t point = 1;
  for (; point + 1 < axis_.point.size() && axis_.at[point] <= start;) ++point;
  for (const Band& band : plan_.band) {
    const glm::vec3 to = axis_.point_at(band.at);
    for (; point + 1 < axis_.point.size() && axis_.at[point] <= band.at; ++point) {
      const float share = band.at > before ? (axis_.at[point] - before) / (band.at - before) : 1.0F;
      drawn[axis_.joint[point]] = from + (to - from) * share;
    }
    before = band.at;
    from = to;
  }
}

/// Where the corner of a collar that is nearest to the parent's tip would be.
glm::vec3 GraftWriter::upward_of(std::uint32_t limb) const {
  const Limbs& limbs = context_.limbs;
  const std::uint32_t joint = limbs.parent[context_.chains.head[limb]];
  std::uint32_t to = context_.chains.next[joint], from = joint;
  if (to == none) {
    to = joint;
    from = limbs.parent[joint];
  }
  const glm::vec3& along = axis_.along[0];
  if (from == none) return any_aside(along);
  const glm::vec3 step = limbs.position[to] - limbs.position[from];
  const glm::vec3 aside = step - along * glm::dot(step, along);
  const float least = 1e-3F * std::sqrt(glm::dot(step, step));
  return glm::dot(aside, aside) > least * least ? math::unit(aside, any_aside(along)) : any_aside(along);
}

Bud GraftWriter::bud_of(std::uint32_t child) const {
  const Limbs& limbs = context_.limbs;
  Bud bud;
  bud.limb = child;
  std::uint32_t joint = context_.chains.head[child];
  glm::vec3 from = limbs.position[limbs.parent[joint]];
  bud.radius = limbs.base_radius[joint];
  float last_length = 0, end = 0;
  for (; joint != Limbs::none; joint = context_.chains.next[joint]) {
    const glm::vec3 step = limbs.position[joint] - from;
    const float length = std::sqrt(glm::dot(step, step));
    if (length <= context_.scale.shortest) continue;
    if (bud.length == 0) {
      bud.along = step * (1 / length);
      bud.first_length = length;
    }
    bud.length += length;
    last_length = length;
    end = std::max(limbs.radius[joint], 2 * context_.scale.thinnest);
    from = limbs.position[joint];
    if (bud.length > 16 * bud.radius) break;
  }
  bud.tip = bud.length - (joint == Limbs::none ? std::min(end, 0.3F * last_length) : 0);
  return bud;
}

void GraftWriter::plan_children(float start) {
  wishes_.clear();
  for (std::size_t point = 1; point + 1 < axis_.point.size(); ++point) {
    if (axis_.at[point] <= start) continue;
    for (std::uint32_t child = common_->first_child[axis_.joint[point]]; child != none;
         child = common_->next_sibling[child]) {
      if (context_.trust[child] != Trust::full) continue;
      Bud bud = bud_of(child);
      if (bud.length == 0 || bud.radius < least_opened * context_.scale.thinnest ||
          bud.radius < std::max(context_.options.thinnest, context_.options.thinnest_joint))
        continue;
      bud.sides = corners_for(bud.radius);
      bud.phases = &phases_;
      wishes_.push_back({point, bud, bud.radius > 0.5F * axis_.radius[point]});
    }
  }
  // Thick ones first: a fork has one place only, a collar of a thin limb may give way.
  for (const bool thick : {true, false}) {
    for (const Wish& wish : wishes_) {
      if (wish.is_thick == thick) plan_.open(axis_, wish.point, wish.bud);
    }
  }
}

void GraftWriter::begin_closed(bool is_root, std::uint32_t limb) {
  is_at_loop_ = false;
  set_seam(0);
  const std::uint32_t head = context_.chains.head[limb];
  if (!is_root && axis_.radius[0] < context_.options.thinnest_joint)
    set_seam(-phases_.of(corners_for(axis_.radius[0])).back().angle);
  const std::uint64_t hash = key_at(context_.limbs.key.empty() ? head : context_.limbs.key[head], 0x0C10);
  Plane plane = plane_at(0, 0);
  stand_at(0);
  const glm::vec3 along = axis_.along[0];
  if (is_root) {
    plane.slope = 0;
    plain_ring(plane, below_);
    note_seam(below_);
    const glm::vec3 down = level_foot(plane);
    const std::uint32_t centre = vertex(plane.centre, down, {0, 0}, none);
    std::vector<std::uint32_t> rim;
    for (std::size_t i = 0; i + 1 < below_.size(); ++i) {
      const glm::vec3 at = mesh_.position[below_[i].vertex];
      const glm::vec3 off = at - plane.centre;
      rim.push_back(vertex(at, down, {glm::dot(off, plane.u), glm::dot(off, plane.v)}, none));
      mark_twin();
    }
    for (std::size_t i = centre; has_tangents() && i <= rim.back(); ++i) {
      mesh_.tangent[i] = {plane.u, 1};  // as a picture from below
      lay_tangent(mesh_, i);
    }
    for (std::size_t i = 0; i < rim.size(); ++i) triangle(centre, rim[(i + 1) % rim.size()], rim[i]);
    return;
  }
  // Rings of limbs that begin at one place are kept apart by chance.
  const float back = (0.05F + 0.4F * fraction(hash)) * plane.radius + context_.scale.apart;
  plane.centre -= along * back;
  plane.at = -back;
  plane.v_at = axis_.v_at(-back, 0);
  plane.slope = -0.5F;
  plain_ring(plane, below_);
  const float cone = cap_share * plane.radius;
  const std::uint32_t apex =
      vertex(plane.centre - along * cone, -along, picture_at(plane.radius, pi, -back - cone), none);
  triangles_to(apex, true);
}

void GraftWriter::write_band(const Band& band) {
  near_piece_ = band.piece;
  stand_at(band.at);
  const std::size_t first = mesh_.index.wide.size() / 3;
  const bool is_at_loop = band.is_open();
  if (!is_at_loop) {
    plain_ring(plane_of(band), upper_);
    note_seam(upper_);
    strip(below_, upper_, !is_at_loop_ && below_.size() == upper_.size());
  } else {
    open_ring(plane_of(band), band);
    note_seam(lower_);
    note_seam(upper_);
    strip(below_, lower_, false);
  }
  if (is_at_loop_ || is_at_loop) note_loop_triangles(first);
  is_at_loop_ = is_at_loop;
  std::swap(below_, upper_);
  corners_ += below_.size();
  if (below_.size() > cached_corners) wide_corners_ += below_.size();
}

}  // namespace seedmesh
