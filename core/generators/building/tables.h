#pragma once
/// The tables of a request: texts with a row on each line, and cells between commas or semicolons.
#include "core/generators/building/value_functions.h"

namespace seedmesh::building {

enum class TableCells : std::uint8_t { texts, numbers };

/// Returns the text of the table that a path names: by its whole name, or without directories and ending. Rejects
/// a name that the request does not have.
const std::string& table_text(Evaluation& at, std::string_view path);

/// Returns the cells of a table, row by row. The separator is `;`, a tabulator or `,`, whichever the first line
/// contains; cells that contain it are in double quotes. Rows that are too short are filled with empty cells or 0.
ValueArray read_table(Evaluation& at, std::string_view path, TableCells cells);

/// Returns the cells of one table, for tests.
std::vector<std::vector<std::string>> cells_of_table(std::string_view text);

}  // namespace seedmesh::building
