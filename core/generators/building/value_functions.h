#pragma once
/// The functions and properties of the CGA reference that lang::functions() does not have: texts, lists, arrays, files,
/// colours, geometry and context. One table for the parser, the evaluation, the docs and GET /v1/vocabulary.
#include <span>
#include <string_view>

#include "core/generators/building/derivation.h"

namespace seedmesh::building {

/// The context of a call: the derivation, whose current shape the function reads, and a byte offset in the rules.
struct Evaluation {
  Derivation& d;
  std::uint32_t offset = 0;
};

using ValueArguments = std::span<const lang::TaggedValue>;
using ValueFunction = lang::TaggedValue(Evaluation& at, ValueArguments arguments);

struct ValueFunctionRow {
  std::string_view name;
  int least, most;  ///< number of arguments; a property has none and no brackets
  ValueFunction* call;
  std::string_view parameters, text, example;
};

/// The tables of text_functions.cpp, array_functions.cpp, geometry_functions.cpp, state_functions.cpp,
/// color_functions.cpp and material_functions.cpp.
std::span<const ValueFunctionRow> text_functions();
std::span<const ValueFunctionRow> array_functions();
std::span<const ValueFunctionRow> geometry_functions();
std::span<const ValueFunctionRow> state_functions();
std::span<const ValueFunctionRow> color_functions();
std::span<const ValueFunctionRow> material_functions();

/// Returns the number of a function in all of these tables; none if there is none of this name.
std::uint32_t find_value_function(std::string_view name);
const ValueFunctionRow& value_function(std::uint32_t number);
std::uint32_t value_function_count();

/// Ends the derivation with an error at the call.
[[noreturn]] void reject(const Evaluation& at, const std::string& message);

// Arguments and results.
/// Returns a text; a number becomes its decimal digits.
std::string text_in(const Evaluation& at, const lang::TaggedValue& value);
double number_in(const Evaluation& at, const lang::TaggedValue& value);  ///< a text is rejected
lang::TaggedValue text_value(Evaluation& at, std::string_view text);
inline lang::TaggedValue number_value(double number) { return {number, 0}; }
inline lang::TaggedValue truth_value(bool truth) { return {truth ? 1.0 : 0.0, 0}; }

/// Returns the values of an array; of any other value an array of one.
ValueArray array_in(const Evaluation& at, const lang::TaggedValue& value);
/// Stores an array of at most 100,000 values.
lang::TaggedValue array_value(Evaluation& at, ValueArray array);

/// Whether a text has the form of a pattern, in which * matches any text.
bool fits(std::string_view text, std::string_view pattern);
/// Returns the names of assets, materials and tables of the request that fit a pattern, sorted.
std::vector<std::string> files_that_fit(const Evaluation& at, std::string_view pattern);

}  // namespace seedmesh::building
