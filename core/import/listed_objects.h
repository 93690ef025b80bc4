#pragma once
/// Splits the list in a large JSON file (features of GeoJSON, elements of Overpass) into the texts of its
/// objects. They are then parsed one after the other, because a whole map as JSON values takes many times the
/// memory of its text.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/schema/json.h"

namespace seedmesh {

/// Size in bytes above which files are parsed object by object.
constexpr std::size_t largest_whole_file = 1024 * 1024;

struct ListedObjects {
  std::string_view name;                ///< name of the member with the list
  std::string shell;                    ///< the file with an empty list
  std::vector<std::string_view> texts;  ///< texts of the objects; parts of the text of the file
};

/// Divides the text of an object with one member `name`, a list of objects. Returns nullopt if the text is
/// something else or has errors, which parse_json() reports. Cost: linear.
std::optional<ListedObjects> listed_objects(std::string_view text, std::string_view name);

/// Parses object `index`; errors have the position in the whole text.
Result<Json> parse_listed(std::string_view text, const ListedObjects& objects, std::size_t index,
                          const Job* job);

}  // namespace seedmesh
