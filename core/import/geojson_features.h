#pragma once
/// The features of a large GeoJSON file as texts, so that they are parsed one after the other: a whole map as JSON values
/// takes many times the memory of its text.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/schema/json.h"

namespace seedmesh {

struct FeatureTexts {
  std::string shell;                    ///< the file with an empty list of features
  std::vector<std::string_view> texts;  ///< of the features, in the file
};

/// Divides the text of an object with one member `features`, a list of objects. nullopt: the text is something else or
/// has errors, which parse_json reports. Cost: linear.
std::optional<FeatureTexts> feature_texts(std::string_view text);

/// Parses feature `index`; errors have the position in the whole text.
Result<Json> parse_feature(std::string_view text, const FeatureTexts& features, std::size_t index,
                           const Job* job);

}  // namespace seedmesh
