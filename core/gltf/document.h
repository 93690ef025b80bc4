#pragma once
/// One glTF document of a model: its JSON, written as text, and the buffer that the JSON describes.
#include <string>
#include <vector>

#include "core/gltf/bin.h"
#include "core/gltf/columns.h"
#include "core/gltf/write.h"
#include "core/model/model.h"

namespace seedmesh::gltf {

/// JSON in two pieces, with the gap where the address of the (first) buffer goes: either nothing or
/// `,"uri":"..."`.
struct Document {
  std::string head, tail;
  std::vector<std::size_t> images;  ///< which of Model::textures it uses
  Bin bin;  ///< arranged; empty if nothing has to be stored, and then nothing may go between head and tail
};

struct DocumentOptions {
  std::string generator = {};
  std::size_t lod = 0;                       ///< nodes with fewer levels show their coarsest
  std::vector<std::string> image_uris = {};  ///< as Model::textures; empty: the images go into the buffer
  Dialect dialect = {};                      ///< `compressed`: `columns` are quantized
  bool last = false;  ///< no other document follows: arrays go as soon as they are stored
};

/// Describes what the scene of this level uses and nothing else: no mesh, material, texture, skin without a
/// user. Spends the bytes of the JSON from `job`, not those of the buffer. `columns` are those of `model`;
/// the last document takes the bytes of both.
Document describe(Model& model, Columns& columns, const DocumentOptions& options, Job& job);

}  // namespace seedmesh::gltf
