#include "server/http/message.h"

#include <algorithm>

#include "server/http/text.h"

namespace seedmesh::http {

std::string field_value(const Headers& headers, std::string_view name) {
  std::string all;
  bool found = false;
  for (const auto& [field, value] : headers) {
    if (!equals_ignoring_case(field, name)) continue;
    if (found) all += ", ";
    all += value;
    found = true;
  }
  return all;
}

std::size_t field_count(const Headers& headers, std::string_view name) {
  const auto named = [&](const auto& field) { return equals_ignoring_case(field.first, name); };
  return static_cast<std::size_t>(std::count_if(headers.begin(), headers.end(), named));
}

}  // namespace seedmesh::http
