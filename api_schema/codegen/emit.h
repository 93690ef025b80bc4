#pragma once
/// What is made from a schema. Each gives the text of one file.
#include <filesystem>
#include <string>

#include "api_schema/codegen/schema.h"

namespace codegen {

std::string emit_header(
    const Unit& unit);  ///< generated/params/<name>.h: the struct, its enums, reader, writer
std::string emit_source(const Unit& unit);     ///< generated/params/<name>.cpp
std::string emit_reference(const Unit& unit);  ///< docs/reference/<name>.md

/// Do the parameters hold requests (x-widget: request)? Then the body of children_of(params), else "".
bool has_children(const Unit& unit);
std::string emit_children(const Unit& unit);

/// generated/embedded.cpp: the bodies of core/schema/embedded.h. `folder` is api_schema.
std::string emit_embedded(const std::filesystem::path& folder);

/// openapi.json with every "<name>.schema.json" reference turned to a component that holds the schema.
Schema openapi_with_components(const std::filesystem::path& folder);

/// A C++ string literal of any length, broken into lines.
std::string quoted(const std::string& text);

/// The C++ expression of a default of this type, "" where the type's own is meant.
std::string initializer(const Type& type, const Schema& value);

/// "a number from 0 to 1", as docs and comments say it; "" where nothing is to be said.
std::string range_text(const Schema& schema);

/// Breaks a paragraph into lines that begin with `lead`.
std::string wrapped(const std::string& text, const std::string& lead);

/// What C++ calls a word of a choice: the word, with an underscore where the language has taken it ("auto_").
std::string enumerator(const std::string& word);

/// The name of a choice's words: "lsystem_style_words".
std::string words_name(const Type& choice);

}  // namespace codegen
