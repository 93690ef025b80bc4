/// Functions on arrays; see value_functions.h. An array has values and perhaps a number of columns.
#include <algorithm>
#include <numeric>

#include "core/generators/building/value_functions.h"

namespace seedmesh::building {
namespace {

using lang::TaggedValue;

std::size_t columns_of(const ValueArray& array) { return array.columns == 0 ? 1 : array.columns; }
std::size_t rows_of(const ValueArray& array) { return array.values.size() / columns_of(array); }

TaggedValue size(Evaluation& at, ValueArguments a) {
  return number_value(static_cast<double>(array_in(at, a[0]).values.size()));
}
TaggedValue row_count(Evaluation& at, ValueArguments a) {
  return number_value(static_cast<double>(rows_of(array_in(at, a[0]))));
}
TaggedValue column_count(Evaluation& at, ValueArguments a) {
  const ValueArray array = array_in(at, a[0]);
  return number_value(array.values.empty() ? 0 : static_cast<double>(columns_of(array)));
}

TaggedValue sum(Evaluation& at, ValueArguments a) {
  double out = 0;
  for (const TaggedValue& each : array_in(at, a[0]).values) out += number_in(at, each);
  return number_value(out);
}

TaggedValue transpose(Evaluation& at, ValueArguments a) {
  const ValueArray array = array_in(at, a[0]);
  ValueArray out;
  const std::size_t columns = columns_of(array), rows = rows_of(array);
  out.columns = static_cast<std::uint32_t>(rows);
  for (std::size_t c = 0; c < columns; ++c) {
    for (std::size_t r = 0; r < rows; ++r) out.values.push_back(array.values[r * columns + c]);
  }
  return array_value(at, std::move(out));
}

TaggedValue index_of(Evaluation& at, ValueArguments a) {
  const ValueArray array = array_in(at, a[0]);
  const auto found = std::ranges::find(array.values, a[1]);
  return number_value(found == array.values.end() ? -1 : static_cast<double>(found - array.values.begin()));
}

bool comes_before(const Evaluation& at, const TaggedValue& left, const TaggedValue& right) {
  if (left.is_text() || right.is_text()) return text_in(at, left) < text_in(at, right);
  return left.number < right.number;
}

TaggedValue sort_indices(Evaluation& at, ValueArguments a) {
  const ValueArray array = array_in(at, a[0]);
  std::vector<std::size_t> order(array.values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t l, std::size_t r) {
    return comes_before(at, array.values[l], array.values[r]);
  });
  ValueArray out;
  for (const std::size_t each : order) out.values.push_back(number_value(static_cast<double>(each)));
  return array_value(at, std::move(out));
}

TaggedValue sort_row_indices(Evaluation& at, ValueArguments a) {
  const ValueArray array = array_in(at, a[0]);
  const std::size_t columns = columns_of(array);
  const double wanted = a.size() > 1 ? number_in(at, a[1]) : 0;
  const std::size_t column =
      wanted >= 0 && wanted < static_cast<double>(columns) ? static_cast<std::size_t>(wanted) : 0;
  std::vector<std::size_t> order(rows_of(array));
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, [&](std::size_t l, std::size_t r) {
    return comes_before(at, array.values[l * columns + column], array.values[r * columns + column]);
  });
  ValueArray out;
  for (const std::size_t each : order) out.values.push_back(number_value(static_cast<double>(each)));
  return array_value(at, std::move(out));
}

TaggedValue as_array(Evaluation& at, ValueArguments a) {
  ValueArray out;
  for (const TaggedValue& each : a) {
    const ValueArray inner = array_in(at, each);
    out.values.insert(out.values.end(), inner.values.begin(), inner.values.end());
    if (a.size() == 1) out.columns = inner.columns;
  }
  return array_value(at, std::move(out));
}

TaggedValue as_texts(Evaluation& at, ValueArguments a) {
  ValueArray out;
  for (const TaggedValue& each : a) {
    for (const TaggedValue& value : array_in(at, each).values)
      out.values.push_back(text_value(at, text_in(at, value)));
  }
  return array_value(at, std::move(out));
}

/// setElems(array, index, values) or setElems(array, row, column, values): the array with other values from there on.
TaggedValue set_elements(Evaluation& at, ValueArguments a) {
  ValueArray out = array_in(at, a[0]);
  const std::size_t columns = columns_of(out);
  const double first = number_in(at, a[1]), second = a.size() > 3 ? number_in(at, a[2]) : 0;
  const double place = a.size() > 3 ? first * static_cast<double>(columns) + second : first;
  const ValueArray values = array_in(at, a[a.size() - 1]);
  if (!(place >= 0) ||
      place + static_cast<double>(values.values.size()) > static_cast<double>(out.values.size())) {
    reject(at, "found a position of setElems outside of the array of " + std::to_string(out.values.size()) +
                   " values");
  }
  std::ranges::copy(values.values, out.values.begin() + static_cast<std::ptrdiff_t>(place));
  return array_value(at, std::move(out));
}

constexpr ValueFunctionRow rows[] = {
    {"setElems", 3, 4, set_elements, "array, index or row and column, values",
     "The array with other values from a position on.",
     "const a = setElems([1, 2, 3], 1, 7)  A --> s(a[1], '1, '1) B."},
    {"size", 1, 1, size, "array", "The number of values of an array.",
     "const a = [1, 2, 3]  A --> s(size(a), '1, '1) B."},
    {"nRows", 1, 1, row_count, "array", "The number of rows.",
     "const a = [1, 2; 3, 4]  A --> s(nRows(a), '1, '1) B."},
    {"nColumns", 1, 1, column_count, "array", "The number of columns.",
     "const a = [1, 2; 3, 4]  A --> s(nColumns(a), '1, '1) B."},
    {"sum", 1, 1, sum, "array", "The sum of the values.", "const a = [1, 2, 3]  A --> s(sum(a), '1, '1) B."},
    {"transpose", 1, 1, transpose, "array", "Rows as columns.",
     "const a = transpose([1, 2; 3, 4])  A --> s(a[0, 1], '1, '1) B."},
    {"index", 2, 2, index_of, "array, value", "The position of a value, or -1.",
     "const a = [5, 7]  A --> case index(a, 7) == 1: B. else: C."},
    {"sortIndices", 1, 1, sort_indices, "array", "The positions of the values in rising order.",
     "const a = [5, 3]  const o = sortIndices(a)  A --> s(a[o[0]], '1, '1) B."},
    {"sortRowIndices", 1, 2, sort_row_indices, "array, column", "The rows in the rising order of a column.",
     "const a = [5, 1; 3, 2]  const o = sortRowIndices(a, 0)  A --> s(a[o[0], 1], '1, '1) B."},
    {"floatArray", 0, 32, as_array, "values", "An array of the values.",
     "const a = floatArray(1, 2)  A --> s(a[1], '1, '1) B."},
    {"boolArray", 0, 32, as_array, "values", "An array of the truth values.",
     "const a = boolArray(true, false)  A --> case a[1]: B. else: C."},
    {"stringArray", 0, 32, as_texts, "values", "An array of the values as texts.",
     "const a = stringArray(\"x\", \"y\")  A --> label(a[1]) B."},
};

}  // namespace

std::span<const ValueFunctionRow> array_functions() { return rows; }

}  // namespace seedmesh::building
