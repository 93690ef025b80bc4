#pragma once
/// Answers that are no models: height maps, clouds of points.
#include <string_view>

namespace seedmesh {

/// A form of an answer that is no model: a height map, a cloud of points.
struct OwnForm {
  std::string_view format;  ///< as output.format names it
  std::string_view media_type;
  std::string_view extension;
  bool has_profiles = false;  ///< output.profile chooses among conventions of it
  bool has_models = false;    ///< models are files of it: output.textures and output.tangents bear on them
};

/// A form and whose conventions it is to follow, as output names both.
struct WantedForm {
  std::string_view format;
  std::string_view profile = "core";
};

}  // namespace seedmesh
