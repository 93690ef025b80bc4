#pragma once
/// The name of a request's model, and the description of its origin that a model contains.
#include <string>
#include <vector>

#include "core/model/model.h"
#include "core/pipeline/body.h"

namespace seedmesh {

/// The name of the model, of its root node and of its files. Two requests with different canonical JSON have
/// different names, whatever the format, unless both give the same `output.name`:
/// - `output.name`, unless it is the name of a preset of the same generator;
/// - the name of a preset; with the seed if only the seed differs, or with a hash if more differs;
/// - the generator and a hash, where there is no `output.name`.
std::string model_name(const Request::Body& body);

/// The first part of the names of meshes, materials and images: the same for all seeds.
std::string name_stem(const Request::Body& body);

/// Longer canonical requests are not written into models: they may contain whole images as data URIs.
constexpr std::size_t longest_written_request = 16'384;

/// Returns the origin of the model: engine, generator, seed as text, preset where `output.name` names it, request
/// (canonical JSON) and permalink (a path). If the request is too long, request_hash replaces it: 64 bits of
/// XXH3 as 16 hexadecimal digits. A permalink that is too long for a URL is left out.
std::vector<Extra> provenance(const Request& request);

/// Appends `origin` to the extras of the first root node, without members that the node has already.
void add_to_root(Model& model, const std::vector<Extra>& origin);

}  // namespace seedmesh
