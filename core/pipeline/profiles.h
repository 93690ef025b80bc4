#pragma once
/// What the readers behind each output.profile support. Sources: the readers' own lists of extensions
/// (three.js r187, Babylon 9.28, glTFast 6.14, UnityGLTF 2.21, Unreal 5's Interchange, Godot 4.5, Blender
/// 4.2). docs/output.md has them as a table.
#include <string>

#include "core/gltf/write/write.h"
#include "generated/params/output.h"

namespace seedmesh {

struct Profile {
  OutputProfile name;
  bool quantized;      ///< files use KHR_mesh_quantization
  bool compressed;     ///< files also use EXT_meshopt_compression
  bool gpu_instances;  ///< reads EXT_mesh_gpu_instancing
  bool prefers_gpu;    ///< files use it if output.instancing is auto
  bool lods_inside;    ///< reads MSFT_lod
  bool reads_webp;     ///< reads EXT_texture_webp
  bool prefers_webp;   ///< files use it if output.image_format is auto
  bool morphs;         ///< levels of detail have _NEXT_POSITION
};

const Profile& profile_of(OutputProfile name);

/// The names of the profiles with this property: "web, unity".
std::string profiles_where(bool Profile::*reads);

/// Changes the names of a finished model to those that the profile's program understands. Names stay unique.
/// - Collision shapes are called UCX_bark_00 and similar (by shape) for Unreal, and
///   bark_collision_00-convcolonly for Godot.
/// - Unity: the finest of several levels is called bark_LOD0.
/// - Godot: no `. : @ / " %`; the wind animation is called "wind-loop", which makes it repeat.
/// - Unreal: letters, digits, `-` and `_` only.
/// - Blender: at most 63 bytes.
void name_for(Model& model, OutputProfile profile);

}  // namespace seedmesh
