#pragma once
/// Text in HTML.
#include <string>
#include <string_view>

namespace seedmesh {

/// Returns the text for the content of an element or for an attribute in double quotes.
std::string html_text(std::string_view text);

}  // namespace seedmesh
