/// Cutting shapes into pieces: boxes by arithmetic, solids by planes.
#include <algorithm>
#include <cmath>

#include "core/generators/building/deriver.h"

namespace seedmesh::building {
namespace {

constexpr double apart = 1e-7;  ///< metres: snap lines nearer to a border than this are on it

std::string count_text(double count) {
  return count < 1e15 ? std::to_string(static_cast<std::uint64_t>(count)) : "more than 10^15";
}

}  // namespace

/// Snap lines that cross the scope inside, as distances from its low end, rising.
void Deriver::snapped(const Step& step, const State& state, std::vector<double>& lines) const {
  if (!step.listens || first_ == nullptr) return;
  const glm::dvec3 axis = out_.axes[state.axes][step.axis];
  for (const SnapPlane& plane : first_->snaps()) {
    const double along = glm::dot(plane.normal, axis);
    if (std::abs(along) < 0.9999) continue;
    const double at = (plane.distance - glm::dot(plane.normal, state.origin)) / along;
    if (at > apart && at < state.size[step.axis] - apart) lines.push_back(at);
  }
  std::ranges::sort(lines);
  lines.erase(std::unique(lines.begin(), lines.end(), [](double a, double b) { return b - a < apart; }),
              lines.end());
}

std::vector<Cut> Deriver::cuts_of(const Step& step, double whole) {
  cells_.clear();
  const auto fill = [&](auto&& self, std::uint32_t first_part, std::uint32_t count) -> std::uint32_t {
    const auto first = static_cast<std::uint32_t>(cells_.size());
    cells_.resize(cells_.size() + count);
    for (std::uint32_t i = 0; i < count; ++i) {
      const Part& part = grammar_.parts[first_part + i];
      Cell cell;
      cell.part = first_part + i;
      cell.is_group = part.is_group;
      if (part.is_group) {
        cell.first = self(self, part.first_part, part.part_count);
        cell.count = part.part_count;
      } else {
        cell.size = number(part.size.value);
        cell.measure = part.size.measure;
      }
      cells_[first + i] = cell;
    }
    return first;
  };
  fill(fill, step.first_part, step.part_count);
  std::vector<Cut> cuts;
  if (!spare_cuts_.empty()) {
    cuts = std::move(spare_cuts_.back());
    spare_cuts_.pop_back();
    cuts.clear();
  }
  const auto room = static_cast<double>(job_.limits().shapes -
                                        std::min(job_.limits().shapes, job_.spent(Resource::shapes)));
  double wanted = 0;
  if (!cut(cells_, 0, step.part_count, whole, plan_.rounding.value_or(Rounding::nearest), room, cuts,
           wanted)) {
    const Issue issue =
        issue_in_rules(plan_, step.offset,
                       "this split makes " + count_text(wanted) + " shapes or more; the limit is " +
                           std::to_string(job_.limits().shapes) + " in all");
    throw Stop(Code::limit, issue);
  }
  return cuts;
}

void Deriver::split(const Step& step, const State& given, const Frame& frame, std::uint64_t key) {
  if ((given.geometry & asset_bit) != 0) reject(step.offset, "an inserted asset cannot be cut");
  int axis = step.axis;
  double unit = 1;  // metres
  const bool is_texture = step.axis >= axis_u;
  const State turned = is_texture ? along_texture(step, given, axis, unit) : State{};
  const State& state = is_texture ? turned : given;
  const double whole = state.size[axis];
  if (!(whole > 0)) {
    warn(step.offset, "the shape has no size along the axis of this split, so that nothing comes of it");
    return;
  }
  std::vector<Cut> cuts = cuts_of(step, whole / unit);
  if (unit != 1) {
    for (Cut& each : cuts) each = {each.start * unit, each.size * unit, each.part};
  }
  std::vector<double> lines;
  snapped(step, state, lines);
  std::size_t moved = 1;  // each line draws the nearest border that is still free
  for (const double line : lines) {
    std::size_t best = 0;
    for (std::size_t i = moved; i < cuts.size(); ++i) {
      if (best == 0 || std::abs(cuts[i].start - line) < std::abs(cuts[best].start - line)) best = i;
    }
    if (best == 0) break;
    const double end = cuts[best].start + cuts[best].size;
    if (line <= cuts[best - 1].start + apart || line >= end - apart) continue;
    cuts[best - 1].size = line - cuts[best - 1].start;
    cuts[best] = {line, end - line, cuts[best].part};
    moved = best + 1;
  }
  pieces(step, state, frame, key, cuts, axis);
  spare_cuts_.push_back(std::move(cuts));
}

void Deriver::repeat(const Step& step, const State& state, const Frame& frame, std::uint64_t key) {
  if ((state.geometry & asset_bit) != 0) reject(step.offset, "an inserted asset cannot be cut");
  const double whole = state.size[step.axis];
  if (!(whole > 0)) {
    warn(step.offset, "the shape has no size along the axis of this repeat, so that nothing comes of it");
    return;
  }
  const Argument& argument = grammar_.arguments[step.first_argument + 1];
  const double size =
      argument.measure == Measure::relative ? length(argument, whole) : number(argument.value);
  if (!(size > 0)) reject(step.offset, "the size of Repeat is not above 0");
  std::vector<double> borders{0};
  snapped(step, state, borders);
  borders.push_back(whole);
  const auto room = static_cast<double>(job_.limits().shapes -
                                        std::min(job_.limits().shapes, job_.spent(Resource::shapes)));
  std::vector<Cut> cuts;
  double wanted = 0;
  for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
    const double span = borders[i + 1] - borders[i];
    const double copies = copies_of(span, size, plan_.rounding.value_or(Rounding::ceil));
    wanted += copies;
    if (wanted > room) {
      const Issue issue =
          issue_in_rules(plan_, step.offset,
                         "this Repeat makes " + count_text(wanted) + " shapes or more; the limit is " +
                             std::to_string(job_.limits().shapes) + " in all");
      throw Stop(Code::limit, issue);
    }
    for (double k = 0; k < copies; ++k) {
      const double from = borders[i] + span * (k / copies), to = borders[i] + span * ((k + 1) / copies);
      cuts.push_back({from, to - from, step.first_part});
    }
  }
  pieces(step, state, frame, key, cuts, step.axis);
}

/// The successors of the pieces, each with its own place for random numbers.
void Deriver::pieces(const Step& step, const State& state, const Frame& frame, std::uint64_t key,
                     std::span<const Cut> cuts, int axis) {
  const bool is_box = state.geometry == box_geometry;
  const Solid* solid = is_box ? nullptr : &out_.solid_of(state.geometry);
  const double whole = state.size[axis];
  const glm::dvec3 along = out_.axes[state.axes][axis];
  Frame own = frame;
  State piece = state;
  piece.split_total = static_cast<std::uint32_t>(cuts.size());
  for (std::uint32_t i = 0; i < cuts.size(); ++i) {
    const Cut& each = cuts[i];
    piece.split_index = i;
    piece.geometry = state.geometry;
    if (is_box) {
      piece.origin = state.origin + along * each.start;
      piece.size[axis] = each.size;
    } else {
      const double low = each.start / whole, high = (each.start + each.size) / whole;
      Solid part = low > 1e-12 ? clipped(*solid, axis, low, -1) : *solid;
      if (high < 1 - 1e-12) part = clipped(part, axis, high, 1);
      if (part.faces.empty()) continue;
      glm::dvec3 from, extent;
      if (step.keeps_slab) {
        // The slab stays the scope: its share of the old cube is stretched over the new one.
        for (glm::dvec3& p : part.points) p[axis] = std::clamp((p[axis] - low) / (high - low), 0.0, 1.0);
        from = glm::dvec3(0);
        extent = glm::dvec3(1);
        from[axis] = low;
        extent[axis] = high - low;
      } else {
        fit(part, from, extent);
      }
      piece.origin = state.origin + out_.axes[state.axes] * (from * state.size);
      piece.size = extent * state.size;
      piece.geometry = add_solid(std::move(part));
      if ((i & 63U) == 0) job_.check();
    }
    own.key = key_at(key, i);
    run_body(grammar_.parts[each.part].body, piece, own);
  }
}

}  // namespace seedmesh::building
