#include "core/generators/building/shape_grammar/open_search.h"

#include <algorithm>
#include <bit>
#include <numeric>

namespace seedmesh::building {
namespace {

bool lies_on(const glm::dvec3& p, const PictureLine& line, double near) {
  const glm::dvec3 along = line.to - line.from;
  const double length = glm::length(along);
  if (!(length > 0)) return false;
  const double at = glm::dot(p - line.from, along) / length;
  return at >= -near && at <= length + near && glm::length(p - line.from - along * (at / length)) <= near;
}

class PointSearch {
 public:
  PointSearch(const std::vector<OpenAnchor>& anchors, std::span<const std::uint32_t> order,
              const PicturePoints& points, const std::function<void()>& look,
              const std::function<void(const std::vector<glm::dvec3>&)>& found)
      : anchors_(anchors), order_(order), points_(points), look_(look), found_(found) {}

  void run() {
    if (chosen_.size() == order_.size()) return found_(at_);
    const OpenAnchor& anchor = anchors_[order_[chosen_.size()]];
    const auto of_kind = points_.by_kind.find(anchor.kind);
    if (of_kind == points_.by_kind.end()) return;
    for (const std::uint32_t each : choices(anchor, of_kind->second)) {
      look_();
      const PictureAnchor& point = of_kind->second[each];
      if (!fits(anchor, each, point)) continue;
      chosen_.push_back(each);
      taken_.push_back(point);
      at_.push_back(point.at);
      run();
      chosen_.pop_back();
      taken_.pop_back();
      at_.pop_back();
    }
  }

 private:
  bool is_joined(const OpenAnchor& anchor, std::size_t before) const {
    return anchor.kind == anchor_crossing && anchors_[order_[before]].kind == anchor_crossing &&
           std::ranges::find(anchor.beside, order_[before]) != anchor.beside.end();
  }

  /// The points that can be meant: all, or those on lines through a point that is chosen.
  std::vector<std::uint32_t> choices(const OpenAnchor& anchor, const std::vector<PictureAnchor>& all) const {
    std::vector<std::uint32_t> out;
    for (std::size_t before = 0; before < chosen_.size(); ++before) {
      if (!is_joined(anchor, before)) continue;
      for (const std::uint32_t line : points_.on_lines.lines_of_point[chosen_[before]]) {
        const std::vector<std::uint32_t>& on = points_.on_lines.points_of_line[line];
        out.insert(out.end(), on.begin(), on.end());
      }
      std::ranges::sort(out);
      out.erase(std::unique(out.begin(), out.end()), out.end());
      return out;
    }
    out.resize(all.size());
    std::iota(out.begin(), out.end(), 0U);
    return out;
  }

  bool fits(const OpenAnchor& anchor, std::uint32_t number, const PictureAnchor& point) const {
    for (std::size_t before = 0; before < chosen_.size(); ++before) {
      const OpenAnchor& other = anchors_[order_[before]];
      if (other.kind == anchor.kind && chosen_[before] == number) return false;
      if (anchor.owner != no_owner && other.owner != no_owner &&
          (anchor.owner == other.owner) != (point.owner == taken_[before].owner))
        return false;
      // Corners have a bit for each direction, so that those of an edge differ in one.
      if (anchor.owner != no_owner && anchor.owner == other.owner && anchor.kind == other.kind &&
          std::popcount(anchor.corner ^ other.corner) != std::popcount(point.corner ^ taken_[before].corner))
        return false;
      if (is_joined(anchor, before) && !on_one_line(chosen_[before], number)) return false;
    }
    return true;
  }

  bool on_one_line(std::uint32_t a, std::uint32_t b) const {
    const std::vector<std::uint32_t>& mine = points_.on_lines.lines_of_point[a];
    const std::vector<std::uint32_t>& theirs = points_.on_lines.lines_of_point[b];
    return std::ranges::any_of(
        mine, [&](std::uint32_t line) { return std::ranges::find(theirs, line) != theirs.end(); });
  }

  const std::vector<OpenAnchor>& anchors_;
  std::span<const std::uint32_t> order_;
  const PicturePoints& points_;
  const std::function<void()>& look_;
  const std::function<void(const std::vector<glm::dvec3>&)>& found_;
  std::vector<std::uint32_t> chosen_;
  std::vector<PictureAnchor> taken_;
  std::vector<glm::dvec3> at_;
};

}  // namespace

LinePoints line_points(const std::vector<PictureLine>& lines, const std::vector<PictureAnchor>& crossings,
                       double near, const Job& job) {
  LinePoints out;
  out.lines_of_point.resize(crossings.size());
  out.points_of_line.resize(lines.size());
  std::size_t all = 0;
  for (std::uint32_t i = 0; i < lines.size(); ++i) {
    job.check();
    for (std::uint32_t k = 0; k < crossings.size(); ++k) {
      if (!lies_on(crossings[k].at, lines[i], near)) continue;
      out.points_of_line[i].push_back(k);
      out.lines_of_point[k].push_back(i);
      ++all;
    }
  }
  out.per_line = lines.empty() ? 0 : static_cast<double>(all) / static_cast<double>(lines.size());
  return out;
}

void search_points(const std::vector<OpenAnchor>& anchors, std::span<const std::uint32_t> order,
                   const PicturePoints& points, const std::function<void()>& look,
                   const std::function<void(const std::vector<glm::dvec3>&)>& found) {
  PointSearch(anchors, order, points, look, found).run();
}

}  // namespace seedmesh::building
