#pragma once
/// JSON written as text, for the parts of a document that are too long for a tree of values (100,000 nodes as
/// a tree take ten times as long).
#include <string>
#include <string_view>

namespace seedmesh::gltf {

/// The shortest decimal that reads back as the same float: 0.1 and not 0.10000000149011612. `value` is
/// finite; -0 becomes 0. Does not depend on the locale.
void append_number(std::string& out, float value);

void append_integer(std::string& out, long long value);

/// In quotes, escaped. Bytes that are no UTF-8 become U+FFFD.
void append_string(std::string& out, std::string_view text);

/// The double whose shortest decimal is that of `value`: for libraries that print doubles only.
double shortest(float value);

}  // namespace seedmesh::gltf
