#include "server/http/message.h"

#include <algorithm>

namespace seedmesh::http {
namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

}  // namespace

bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](char x, char y) { return lower(x) == lower(y); });
}

std::string joined(const Headers& headers, std::string_view name) {
  std::string all;
  bool found = false;
  for (const auto& [field, value] : headers) {
    if (!same_name(field, name)) continue;
    if (found) all += ", ";
    all += value;
    found = true;
  }
  return all;
}

bool has(const Headers& headers, std::string_view name) {
  return std::any_of(headers.begin(), headers.end(),
                     [&](const auto& field) { return same_name(field.first, name); });
}

}  // namespace seedmesh::http
