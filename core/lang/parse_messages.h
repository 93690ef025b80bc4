#pragma once
/// The messages about names and functions in expressions.
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "core/lang/expression.h"

namespace seedmesh::lang {

/// Returns the rows of a function, one for each number of arguments. Returns an empty span if there is no
/// such function.
std::span<const Function> rows_of(std::string_view name);

/// Return the message about a name or a function that does not exist, with the nearest known name.
std::string unknown_name(const Names& names, std::string_view name);
std::string unknown_function(const Names& names, std::string_view name);
/// Return the message about a call with `found` arguments. `rows` has at least one row.
std::string wrong_number_of_arguments(std::span<const Function> rows, std::size_t found);
std::string wrong_number_of_arguments(std::string_view name, const Names::Defined& function,
                                      std::size_t found);

}  // namespace seedmesh::lang
