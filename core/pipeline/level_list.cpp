#include "core/pipeline/level_list.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>

#include "core/base/math.h"
#include "core/schema/json.h"

namespace seedmesh {
namespace {

using List = std::vector<double>;

bool is_share(double entry) { return entry <= 1; }

std::string text_of_number(double number) { return Json(number).dump(); }

}  // namespace

int level_count(const OutputParams& output) {
  if (const auto* count = std::get_if<std::int32_t>(&output.lods)) return *count;
  return static_cast<int>(std::get<List>(output.lods).size());
}

bool has_listed_levels(const OutputParams& output) {
  const auto* list = std::get_if<List>(&output.lods);
  return list && !(list->size() == 1 && list->front() == 1);
}

std::vector<std::uint64_t> listed_triangles(const OutputParams& output, std::uint64_t whole) {
  std::vector<std::uint64_t> triangles;
  for (const double entry : std::get<List>(output.lods)) {
    const double wanted = is_share(entry) ? entry * static_cast<double>(whole) : entry;
    triangles.push_back(std::max<std::uint64_t>(1, static_cast<std::uint64_t>(math::to_int64(wanted + 0.5))));
  }
  return triangles;
}

void check_level_list(const OutputParams& output, IssueList& errors) {
  const auto* list = std::get_if<List>(&output.lods);
  if (!list) return;
  const auto refuse = [&](std::size_t i, std::string message) {
    errors.add({IssueKind::invalid_value, "/output/lods/" + std::to_string(i), std::move(message)});
  };
  for (std::size_t i = 0; i < list->size(); ++i) {
    const double entry = (*list)[i];
    if (!is_share(entry) && entry != std::floor(entry)) {
      refuse(i, "found " + text_of_number(entry) +
                    "; expected a share of the triangles up to 1, or a whole number of triangles");
    }
    // Shares and numbers cannot be compared before the model is made.
    if (i > 0 && is_share(entry) == is_share((*list)[i - 1]) && entry >= (*list)[i - 1]) {
      refuse(i, "found " + text_of_number(entry) + " after " + text_of_number((*list)[i - 1]) +
                    "; expected levels in descending order");
    }
  }
}

}  // namespace seedmesh
