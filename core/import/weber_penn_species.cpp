#include "core/import/weber_penn_species.h"

#include <algorithm>
#include <cmath>

#include "core/base/math.h"

namespace seedmesh {
namespace {

constexpr const char* whole_numbers[] = {"Shape",     "Levels",     "Lobes",     "0BaseSplits", "0Branches",
                                         "1Branches", "2Branches",  "3Branches", "1Whorl",      "2Whorl",
                                         "3Whorl",    "0CurveRes",  "1CurveRes", "2CurveRes",   "3CurveRes",
                                         "Leaves",    "LeafDistrib"};

bool is_whole(const std::string& name) {
  return std::find(std::begin(whole_numbers), std::end(whole_numbers), name) != std::end(whole_numbers);
}

}  // namespace

bool WeberPennSpecies::is_of_levels(const std::string& name) { return !name.empty() && is_digit(name[0]); }

void WeberPennSpecies::set(const std::string& name, double value, std::size_t at) {
  const auto known = values_.find(name);
  if (known != values_.end() && known->second.at != none) {
    source_.report(at, "found a second value of `" + name + "`", IssueKind::duplicate_key);
    return;
  }
  values_[name] = {value, at};
}

Imported WeberPennSpecies::made(std::uint64_t seed) const {
  Imported imported;
  Json parameters = Json::object();
  const auto count = values_.find("Levels");
  const int levels = count == values_.end() ? 3 : static_cast<int>(std::clamp(count->second.value, 0.0, 9.0));
  const auto trunks = values_.find("0Branches");
  const bool has_trunks = trunks != values_.end() && trunks->second.value > 1;
  for (const auto& [name, value] : values_) {
    if (name == "0BranchDist" && !has_trunks) continue;
    if (is_of_levels(name)) {
      const int level = name[0] - '0';
      // The angles of leaves are those of the level after the last.
      const bool is_angle =
          name.find("DownAngle") != std::string::npos || name.find("Rotate") != std::string::npos;
      if (level > levels || (level == levels && !is_angle)) continue;
    }
    const double clean = std::abs(value.value) < 1e-12 ? 0 : value.value;
    if (is_whole(name)) {
      parameters[name] =
          static_cast<std::int64_t>(clean < 0 ? std::ceil(clean - 0.5) : std::floor(clean + 0.5));
    } else {
      parameters[name] = clean;
    }
    if (value.at != none) imported.origins.push_back({"/parameters/" + name, {{0, value.at, false}}});
  }
  imported.request = {{"generator", "tree"}, {"seed", seed}, {"parameters", std::move(parameters)}};
  return imported;
}

std::string leaf_shape_of(double number, std::array<const char*, 11> names) {
  const auto index = static_cast<std::size_t>(math::to_int32(std::clamp(number, 0.0, 10.0)));
  return names[index];
}

}  // namespace seedmesh
