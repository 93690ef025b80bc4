#pragma once
/// Names that follow from content. Meshes, materials and images of equal names have equal content, in all
/// files. An engine that keeps one file for each name therefore shows every model correctly.
#include <string>
#include <string_view>
#include <vector>

#include "core/base/job.h"
#include "core/model/model.h"

namespace seedmesh::gltf {

/// Returns eight characters that follow from the bytes: a letter from a to f, then hexadecimal digits. No decimal
/// number has this form.
std::string short_hash(std::string_view bytes);

/// Returns all 64 bits of the same hash, as 16 hexadecimal digits.
std::string long_hash(std::string_view bytes);

struct ContentNames {
  std::string stem = {};  ///< the first part of all names but that of the root
  std::string root = {};  ///< the new Model::name, and the name of the root node
  /// Further input of the stored form of a mesh, such as a grid that several meshes share.
  std::string_view form = {};
};

/// Stores equal images once. Names meshes and materials `<stem>_<name>_<hash of the content>`, and root nodes
/// after `root`. The stem is not repeated where a name begins with it. Collision shapes keep their names.
/// Call it after finish(). It reads each array once (about 10 GB/s).
void name_by_content(Model& model, const ContentNames& names, const Job& job);

/// Returns the names of images in a file, by number of gltf::image_numbered(): `<stem>_<name>_<hash of the content>`.
std::vector<std::string> image_names(const Model& model, std::string_view stem);

}  // namespace seedmesh::gltf
