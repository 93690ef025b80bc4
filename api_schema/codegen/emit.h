#pragma once
/// The texts that are generated from a schema, one function for each file.
#include <filesystem>
#include <string>

#include "api_schema/codegen/schema.h"

namespace codegen {

std::string emit_header(
    const Unit& unit);  ///< generated/params/<name>.h: the struct, its enums, reader, writer
std::string emit_source(const Unit& unit);     ///< generated/params/<name>.cpp
std::string emit_reference(const Unit& unit);  ///< docs/reference/<name>.md

/// Whether the parameters can contain requests (x-widget: request), and the function children_of(params) or "".
bool has_children(const Unit& unit);
std::string emit_children(const Unit& unit);

/// generated/params/<name>_unused.h, which declares unused_parameters(params), and the body of the function.
std::string emit_unused_header(const Unit& unit);
std::string emit_unused(const Unit& unit);

/// generated/embedded.cpp, which implements core/schema/embedded.h. `folder` is api_schema.
std::string emit_embedded(const std::filesystem::path& folder);

/// openapi.json with each reference to "<name>.schema.json" replaced by a component with that schema.
Schema openapi_with_components(const std::filesystem::path& folder);

/// A C++ string literal of any length, broken into lines.
std::string quoted(const std::string& text);

/// The C++ expression of a default of this type; "" for the default of the C++ type.
std::string initializer(const Type& type, const Schema& value);

/// "a number from 0 to 1", for docs and comments; "" for an unlimited value.
std::string range_text(const Schema& schema);

/// Breaks a paragraph into lines that begin with `lead`.
std::string wrapped(const std::string& text, const std::string& lead);

/// The enumerator for a word of a choice: the word, with an underscore if it is a C++ keyword ("auto_").
std::string enumerator(const std::string& word);

/// The name of a choice's words: "lsystem_style_words".
std::string words_name(const Type& choice);

}  // namespace codegen
