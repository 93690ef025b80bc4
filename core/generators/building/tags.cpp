#include "core/generators/building/tags.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/building/evaluate.h"
#include "core/generators/building/operators.h"

namespace seedmesh::building {
namespace {

// The first characters of tags of edges and of vertices; no name can contain them.
constexpr char edge_sign = '\x01', vertex_sign = '\x02';

constexpr std::size_t longest_tag = 1'000;  ///< bytes

/// The parts of a tag between its points.
std::vector<std::string_view> parts_of(std::string_view tag) {
  std::vector<std::string_view> out;
  for (std::size_t from = 0; from <= tag.size();) {
    const std::size_t to = std::min(tag.find('.', from), tag.size());
    out.push_back(tag.substr(from, to - from));
    from = to + 1;
  }
  return out;
}

std::string_view name_of_operation(Op op) {
  constexpr std::pair<Op, std::string_view> names[] = {
      {Op::extrude, "extrude"},         {Op::taper, "taper"},          {Op::envelope, "envelope"},
      {Op::roof_hip, "roofHip"},        {Op::roof_gable, "roofGable"}, {Op::roof_pyramid, "roofPyramid"},
      {Op::roof_shed, "roofShed"},      {Op::roof_ridge, "roofRidge"}, {Op::roof_mansard, "roofMansard"},
      {Op::roof_gambrel, "roofGambrel"}};
  const auto* const found = std::ranges::find(names, op, &std::pair<Op, std::string_view>::first);
  return found == std::end(names) ? std::string_view() : found->second;
}

/// The corners of the holes of a flat shape, in the world.
std::vector<glm::dvec3> corners_of_holes(const Derivation& d, const ShapeState& state) {
  std::vector<glm::dvec3> out;
  if (state.geometry == box_geometry) return out;
  const Solid& solid = d.out.solid_of(state.geometry);
  for (const Face& face : solid.faces) {
    for (const Loop& loop : loops_of(solid, face).subspan(1)) {
      for (const std::uint32_t point : points_of(solid, loop))
        out.push_back(state.origin + d.out.axes[state.axes] * (solid.points[point] * state.size));
    }
  }
  return out;
}

}  // namespace

std::uint32_t tag_set(Derivation& d, std::vector<std::uint32_t> tags) {
  std::ranges::sort(tags);
  tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
  if (tags.empty()) return 0;
  const auto [found, is_new] =
      d.tag_set_ids.try_emplace(tags, static_cast<std::uint32_t>(d.out.tag_sets.size()));
  if (is_new) {
    d.job.spend(Resource::shapes, 1 + tags.size() / 16);
    d.out.tag_sets.push_back(std::move(tags));
  }
  return found->second;
}

std::uint32_t joined_tags(Derivation& d, std::uint32_t a, std::uint32_t b) {
  if (a == 0 || b == 0 || a == b) return a == 0 ? b : a;
  std::vector<std::uint32_t> all = d.out.tag_sets[a];
  all.insert(all.end(), d.out.tag_sets[b].begin(), d.out.tag_sets[b].end());
  return tag_set(d, std::move(all));
}

std::uint32_t with_tag(Derivation& d, std::uint32_t set, std::string_view name) {
  std::vector<std::uint32_t> tags = d.out.tag_sets[set];
  tags.push_back(d.out.texts.id_of(name));
  return tag_set(d, std::move(tags));
}

bool fits_tag(std::string_view tag, std::string_view query) {
  if (query.empty()) return true;
  const std::vector<std::string_view> own = parts_of(tag), wanted = parts_of(query);
  std::size_t t = 0, q = 0, star = wanted.size(), behind = 0;
  while (q < wanted.size()) {
    const std::string_view part = wanted[q];
    if (part == "*") {
      if (t >= own.size()) return false;
      star = q++;
      behind = ++t;
      continue;
    }
    // A star at the end of a part is any ending, as in older rules.
    const bool is_open = part.size() > 1 && part.ends_with('*');
    const bool fits = t < own.size() && (part == "?" || own[t] == part ||
                                         (is_open && own[t].starts_with(part.substr(0, part.size() - 1))));
    if (fits) {
      ++t;
      ++q;
    } else if (star < wanted.size() && behind < own.size()) {
      t = ++behind;
      q = star + 1;
    } else {
      return false;
    }
  }
  return true;
}

std::string_view name_of_tag(std::string_view tag) {
  return tag.starts_with(edge_sign) || tag.starts_with(vertex_sign) ? tag.substr(1) : tag;
}

bool has_tag(const Derivation& d, std::uint32_t set, std::string_view query, int dimension) {
  if (query.size() > longest_tag) return false;
  return std::ranges::any_of(d.out.tag_sets[set], [&](std::uint32_t id) {
    const std::string& tag = *d.out.texts.find(id);
    if (tag.starts_with(edge_sign) && dimension > 1) return false;
    if (tag.starts_with(vertex_sign) && dimension > 0) return false;
    return fits_tag(name_of_tag(tag), query);
  });
}

namespace operators {

/// tag("a", faces), deleteTags("a"), deleteTags(): tags of all components of the shape.
void tag(Derivation& d, const Step& step, ShapeState& state, const StepContext&) {
  Style style = d.out.styles[state.style];
  const Argument* a = &d.grammar.arguments[step.first_argument];
  const std::string name = step.argument_count > 0 ? text_of(d, a[0]) : std::string();
  if (name.size() > longest_tag) reject(d, step.offset, "the tag is longer than 1,000 bytes");
  if (step.op == Op::tag) {
    const std::string kind = step.argument_count > 1 ? d.grammar.words[a[1].word] : std::string("auto");
    if (kind != "auto" && kind != "faces" && kind != "edges" && kind != "vertices")
      reject(d, step.offset, "found " + lang::in_quotes(kind) + ", expected auto, faces, edges or vertices");
    std::string plain = kind == "edges"      ? std::string(1, edge_sign)
                        : kind == "vertices" ? std::string(1, vertex_sign)
                                             : std::string();
    for (const char c : name) plain += c == '*' || c == '?' ? std::string() : std::string(1, c);
    style.tags = with_tag(d, style.tags, plain);
  } else {
    const auto without = [&](std::uint32_t set) {
      std::vector<std::uint32_t> tags = d.out.tag_sets[set];
      std::erase_if(tags, [&](std::uint32_t id) {
        return step.argument_count == 0 || fits_tag(name_of_tag(*d.out.texts.find(id)), name);
      });
      return tag_set(d, std::move(tags));
    };
    style.tags = without(style.tags);
    if (state.has_solid()) {
      Solid plain = d.out.solid_of(state.geometry);
      for (Face& face : plain.faces) face.tags = without(face.tags);
      state.geometry = add_solid(d, std::move(plain));
    }
  }
  state.style = style_with(d, style);
}

}  // namespace operators

std::uint32_t style_of_edge(Derivation& d, const Solid& solid, std::span<const std::uint32_t> faces,
                            std::uint32_t style) {
  std::uint32_t tags = 0;
  bool has_a = false, has_b = false;
  for (const std::uint32_t face : faces) {
    const std::uint32_t own = solid.faces[face].tags;
    if (own == 0) continue;
    const bool is_a = has_tag(d, own, "bool.A", 2), is_b = has_tag(d, own, "bool.B", 2);
    has_a |= is_a && !is_b;
    has_b |= is_b && !is_a;
    tags = joined_tags(d, tags, own);
  }
  if (has_a && has_b) tags = with_tag(d, tags, "bool.cut");
  if (tags == 0) return style;
  Style made = d.out.styles[style];
  made.tags = joined_tags(d, made.tags, tags);
  return style_with(d, made);
}

void add_auto_tags(Derivation& d, Op op, const ShapeState& before, ShapeState& after) {
  const std::string_view name = name_of_operation(op);
  if (name.empty() || after.has_asset() || dimension(before.size) != 2 || dimension(after.size) != 3) return;
  const glm::dvec3 base = d.out.axes[before.axes][flat_axis(before.size)];
  const std::vector<glm::dvec3> holes = corners_of_holes(d, before);
  const double near = 1e-6 * std::max({after.size.x, after.size.y, after.size.z});
  Solid solid = solid_of(d, after);
  const bool is_closed = solid.is_closed || after.geometry == box_geometry;
  for (Face& face : solid.faces) {
    d.job.check();
    const glm::dvec3 normal =
        d.out.axes[after.axes] * math::unit(area_vector(solid, face, after.size), glm::dvec3(0));
    bool is_base = std::abs(glm::dot(normal, base)) > 1 - 1e-6;
    std::size_t of_holes = 0, of_base = 0;
    for (const std::uint32_t point : points_of(solid, solid.loops[face.first_loop])) {
      const glm::dvec3 p = after.origin + d.out.axes[after.axes] * (solid.points[point] * after.size);
      const bool is_low = std::abs(glm::dot(p - before.origin, base)) <= near;
      is_base &= is_low;
      of_base += is_low ? 1 : 0;
      of_holes += std::ranges::any_of(holes, [&](const glm::dvec3& q) { return glm::length(p - q) <= near; });
    }
    const bool is_side = std::abs(glm::dot(normal, base)) < 1e-6;
    const bool is_inner = of_holes > 0 && of_holes == of_base;
    const std::string_view part = is_base             ? "bottom"
                                  : !is_side          ? "top"
                                  : op != Op::extrude ? "side"
                                  : is_inner          ? "side.inner"
                                                      : "side.outer";
    face.tags = with_tag(d, face.tags, std::string(name) + "." + std::string(part));
  }
  solid.is_closed = is_closed;
  after.geometry = add_solid(d, std::move(solid));
}

}  // namespace seedmesh::building
