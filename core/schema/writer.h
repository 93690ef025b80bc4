#pragma once
/// Functions that the generated writers of api_schema call. Includes the whole of nlohmann/json, so only .cpp
/// files may include it.
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "core/schema/child.h"
#include "core/schema/geojson.h"
#include "core/schema/json.h"

namespace seedmesh::schema {

/// Returns the seed as a JSON number if JavaScript reads that exactly, otherwise as a string of its digits.
Json write_seed(std::uint64_t seed);

/// Writes a nested request.
Json write_child(const Child& child);

Json write_geojson(const GeoJson& value);

template <class List, class Write>
Json write_list(const List& list, const Write& write) {
  Json json = Json::array();
  for (const auto& entry : list) json.push_back(write(entry));
  return json;
}

template <class Value, class Write>
Json write_map(const std::map<std::string, Value>& map, const Write& write) {
  Json json = Json::object();
  for (const auto& [key, entry] : map) json[key] = write(entry);
  return json;
}

}  // namespace seedmesh::schema
