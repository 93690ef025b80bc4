#pragma once
#include <string>

namespace seedmesh {

/// Returns the reference as one HTML page without scripts, generated from the OpenAPI document, the schemas and the
/// table of problems. It describes this build and needs no internet. The `type` of a problem links to its row.
std::string docs_page();

}  // namespace seedmesh
