#include "core/lang/parse_messages.h"

namespace seedmesh::lang {
namespace {

std::string_view nearest_function(const Names& names, std::string_view name) {
  if (!names.may_hint()) return {};
  std::string_view best;
  std::uint32_t least = hint_distance(name) + 1;
  for (const Function& row : functions()) {
    const std::uint32_t distance = name_distance(name, row.name);
    if (distance >= least) continue;
    least = distance;
    best = row.name;
  }
  return best;
}

std::string did_you_mean(std::string_view hint) {
  return hint.empty() ? "" : "; did you mean " + in_quotes(hint) + "?";
}

}  // namespace

std::span<const Function> rows_of(std::string_view name) {
  const std::span<const Function> all = functions();
  std::size_t first = 0;
  while (first < all.size() && all[first].name != name) ++first;
  std::size_t count = 0;
  while (first + count < all.size() && all[first + count].name == name) ++count;
  return all.subspan(first, count);
}

std::string wrong_number_of_arguments(std::span<const Function> rows, std::size_t found) {
  std::string counts;
  for (const Function& row : rows) counts += (counts.empty() ? "" : " or ") + std::to_string(row.arity);
  const bool is_one = rows.size() == 1 && rows[0].arity == 1;
  return in_quotes(rows[0].name) + " takes " + counts + (is_one ? " argument (" : " arguments (") +
         std::string(rows.back().arguments) + "), found " + std::to_string(found);
}

std::string unknown_name(const Names& names, std::string_view name) {
  const std::span<const Function> rows = rows_of(name);
  if (rows.empty()) return "unknown name " + in_quotes(name) + did_you_mean(names.nearest(name));
  const std::string call = std::string(name) + "(" + std::string(rows.back().arguments) + ")";
  return in_quotes(name) + " is a function: write " + in_quotes(call);
}

std::string wrong_number_of_arguments(std::string_view name, const Names::Defined& function,
                                      std::size_t found) {
  std::string parameters;
  for (const std::string& each : function.parameters) parameters += (parameters.empty() ? "" : ", ") + each;
  const std::size_t count = function.parameters.size();
  return in_quotes(name) + " takes " + std::to_string(count) + (count == 1 ? " argument (" : " arguments (") +
         parameters + "), found " + std::to_string(found);
}

std::string unknown_function(const Names& names, std::string_view name) {
  if (names.find(name) != nullptr) {
    return in_quotes(name) + " is a value, not a function: write `*` between it and the bracket";
  }
  return "unknown function " + in_quotes(name) + did_you_mean(nearest_function(names, name));
}

}  // namespace seedmesh::lang
