#include "core/generators/lsystem/contours.h"

namespace seedmesh::lsystem {
namespace {

std::vector<glm::dvec2> outline_of(const LsystemParams& params, std::size_t number) {
  std::vector<glm::dvec2> outline;
  for (const auto& point : params.contours[number]) outline.emplace_back(point[0], point[1]);
  return outline;
}

}  // namespace

void check_contours(const LsystemParams& params, std::vector<Issue>& issues) {
  for (std::size_t i = 0; i < params.contours.size(); ++i) {
    const auto error = contour_error(outline_of(params, i));
    if (error) issues.push_back({IssueKind::invalid_value, "/contours/" + std::to_string(i), *error});
  }
}

std::vector<Contour> contours_of(const LsystemParams& params) {
  std::vector<Contour> contours;
  for (std::size_t i = 0; i < params.contours.size(); ++i)
    contours.push_back(make_contour(outline_of(params, i)));
  return contours;
}

}  // namespace seedmesh::lsystem
