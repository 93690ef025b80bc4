#pragma once
/// What the reader of each output.profile takes. Sources: the readers' own lists of extensions (three.js
/// r187, Babylon 9.28, glTFast 6.14, UnityGLTF 2.21, Unreal 5's Interchange, Godot 4.5, Blender 4.2);
/// docs/output.md has them as a table.
#include <string>
#include <vector>

#include "core/gltf/write.h"
#include "generated/params/output.h"

namespace seedmesh {

struct Profile {
  OutputProfile name;
  bool compressed;     ///< written with KHR_mesh_quantization and EXT_meshopt_compression
  bool gpu_instances;  ///< reads EXT_mesh_gpu_instancing
  bool prefers_gpu;    ///< and gets it where output.instancing is auto
  bool lods_inside;    ///< reads MSFT_lod
};

const Profile& profile_of(OutputProfile name);

/// The names of the profiles for which `reads` holds: "web, unity".
std::string profiles_where(bool Profile::*reads);

/// Turns names to those that the program understands, after finish(). Collision shapes: UCX_bark_00 and its
/// like (by shape) for Unreal, bark_collision_00-convcolonly for Godot, where bark is the mesh that they
/// stand for. What output.collision asked for, in UCX_bark_01 or collision_01-convcolonly, stays so whatever
/// the profile, after the mesh and with numbers that count all models of the file. Finest levels in a file
/// with several: bark_LOD0 for Unity. Godot: no `. : @ / " %`, and an animation of wind goes on
/// ("wind-loop"). Unreal: letters, digits, `-` and
/// `_` only. Blender: at most 63 bytes. Names stay unique.
void name_for(Model& model, OutputProfile profile);

}  // namespace seedmesh
