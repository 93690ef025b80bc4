#pragma once
#include <string>

namespace seedmesh {

/// The reference as one HTML page without scripts, made from the OpenAPI document, the schemas and the table
/// of problems, so that it says what this very build does and is readable without the internet. The anchor of
/// a problem is its word: a problem's `type` leads here.
std::string docs_page();

}  // namespace seedmesh
