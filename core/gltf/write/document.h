#pragma once
/// One glTF document: its JSON as text, and the buffer that the JSON describes.
#include <string>
#include <vector>

#include "core/gltf/bin.h"
#include "core/gltf/columns.h"
#include "core/gltf/write/write.h"
#include "core/model/model.h"

namespace seedmesh::gltf {

/// The JSON in two pieces. Between them goes the address of the first buffer, `,"uri":"..."`, or nothing.
struct Document {
  std::string head, tail;
  std::vector<std::size_t> images;  ///< the numbers of the used images, see image_numbered()
  Bin bin;                          ///< arranged; if it is empty, nothing is between head and tail
};

/// Returns an image of the model by number: the elements of Model::textures, and after them their forms as WebP.
const std::shared_ptr<const Image>& image_numbered(const Model& model, std::size_t number);

/// Returns its name: that of `names`, which are by these numbers, or its own where `names` is empty.
std::string image_name(const Model& model, const std::vector<std::string>& names, std::size_t number);

struct DocumentOptions {
  std::string generator = {};
  std::size_t lod = 0;  ///< nodes with fewer levels show their coarsest
  std::vector<std::string> image_uris =
      {};  ///< by number of image_numbered(); empty: the images go into the buffer
  std::vector<std::string> image_names = {};  ///< by number of image_numbered(); empty: their own
  std::vector<Extra> scene_extras = {};
  Dialect dialect = {};                 ///< `compressed` or `quantized`: `columns` are quantized
  std::vector<std::size_t> parts = {};  ///< of an object whose root has the levels (object_levels.h)
  bool last = false;  ///< no other document follows: arrays are released once they are stored
};

/// Describes the scene of one level. Meshes, materials, textures and skins that it does not use are left out.
/// Spends the bytes of the JSON from `job`, not those of the buffer. `columns` are those of `model`; the last
/// document takes the bytes of both.
Document describe(Model& model, Columns& columns, const DocumentOptions& options, Job& job);

}  // namespace seedmesh::gltf
