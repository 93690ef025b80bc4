/// Functions on texts, lists in texts, and files; see value_functions.h.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/generators/building/tables.h"
#include "core/generators/building/value_functions.h"

namespace seedmesh::building {
namespace {

using lang::TaggedValue;

constexpr std::size_t most_items = 10'000;  ///< items of a list

/// A place in a text as an argument gives it, cut to the text.
std::size_t place_in(const Evaluation& at, const TaggedValue& value, std::size_t size) {
  const double number = number_in(at, value);
  if (!(number > 0)) return 0;
  return number < static_cast<double>(size) ? static_cast<std::size_t>(number) : size;
}

std::vector<std::string> split_text(std::string_view text, std::string_view separator) {
  std::vector<std::string> out;
  if (separator.empty()) return {std::string(text)};
  while (out.size() < most_items) {
    const std::size_t found = text.find(separator);
    out.emplace_back(text.substr(0, found));
    if (found == std::string_view::npos) break;
    text.remove_prefix(found + separator.size());
  }
  return out;
}

/// The items of a list "a;b;c;".
std::vector<std::string> items_of(const Evaluation& at, const TaggedValue& list) {
  std::vector<std::string> items = split_text(text_in(at, list), ";");
  if (!items.empty() && items.back().empty()) items.pop_back();
  return items;
}

TaggedValue list_of(Evaluation& at, const std::vector<std::string>& items) {
  std::string out;
  for (const std::string& item : items) out += item + ";";
  return text_value(at, out);
}

TaggedValue item_at(Evaluation& at, const std::vector<std::string>& items, double index) {
  const bool is_valid = index >= 0 && index < static_cast<double>(items.size());
  return text_value(at, is_valid ? items[static_cast<std::size_t>(index)] : std::string());
}

TaggedValue to_text(Evaluation& at, ValueArguments a) { return text_value(at, text_in(at, a[0])); }

TaggedValue to_number(Evaluation& at, ValueArguments a) {
  if (!a[0].is_text()) return a[0];
  std::string text = text_in(at, a[0]);
  std::erase_if(text, [](char c) { return c == ' '; });
  if (text == "true") return number_value(1);
  double value = 0;
  const char* first = text.data() + (text.starts_with('+') ? 1 : 0);
  std::from_chars(first, text.data() + text.size(), value);
  return number_value(std::isfinite(value) ? value : 0);
}

TaggedValue to_truth(Evaluation& at, ValueArguments a) {
  if (a[0].is_text()) return truth_value(text_in(at, a[0]) == "true" || to_number(at, a).number != 0);
  return truth_value(a[0].number != 0);
}

TaggedValue length(Evaluation& at, ValueArguments a) {
  return number_value(static_cast<double>(text_in(at, a[0]).size()));
}

TaggedValue find(Evaluation& at, ValueArguments a) {
  const std::string text = text_in(at, a[0]), part = text_in(at, a[1]);
  double occurrence = a.size() > 2 ? number_in(at, a[2]) : 0;
  std::size_t found = text.find(part);
  while (found != std::string::npos && occurrence >= 1 && !part.empty()) {
    found = text.find(part, found + 1);
    --occurrence;
  }
  return number_value(found == std::string::npos ? -1 : static_cast<double>(found));
}

TaggedValue find_last(Evaluation& at, ValueArguments a) {
  const std::size_t found = text_in(at, a[0]).rfind(text_in(at, a[1]));
  return number_value(found == std::string::npos ? -1 : static_cast<double>(found));
}

TaggedValue count(Evaluation& at, ValueArguments a) {
  const std::string text = text_in(at, a[0]), part = text_in(at, a[1]);
  double sum = 0;
  if (part.empty()) return number_value(0);
  for (std::size_t at_part = text.find(part); at_part != std::string::npos;
       at_part = text.find(part, at_part + part.size()))
    ++sum;
  return number_value(sum);
}

TaggedValue substring(Evaluation& at, ValueArguments a) {
  const std::string text = text_in(at, a[0]);
  const std::size_t from = place_in(at, a[1], text.size());
  const std::size_t to = a.size() > 2 ? place_in(at, a[2], text.size()) : text.size();
  return text_value(at, to > from ? text.substr(from, to - from) : std::string());
}

TaggedValue replace(Evaluation& at, ValueArguments a) {
  const std::string text = text_in(at, a[0]), part = text_in(at, a[1]), by = text_in(at, a[2]);
  if (part.empty()) return a[0];
  std::string out;
  std::size_t from = 0;
  for (std::size_t found = text.find(part); found != std::string::npos; found = text.find(part, from)) {
    out += text.substr(from, found - from) + by;
    from = found + part.size();
    if (out.size() > 200'000) break;
  }
  return text_value(at, out + text.substr(from));
}

TaggedValue prefix(Evaluation& at, ValueArguments a) {
  const std::string text = text_in(at, a[0]);
  const std::size_t found = text.find(text_in(at, a[1]));
  return text_value(at, found == std::string::npos ? std::string() : text.substr(0, found));
}

TaggedValue suffix(Evaluation& at, ValueArguments a) {
  const std::string text = text_in(at, a[0]), part = text_in(at, a[1]);
  const std::size_t found = text.rfind(part);
  return text_value(at, found == std::string::npos ? std::string() : text.substr(found + part.size()));
}

TaggedValue range(Evaluation& at, ValueArguments a) {
  const std::string text = text_in(at, a[0]), low = text_in(at, a[1]), high = text_in(at, a[2]);
  const std::size_t first = text.find(low), last = text.rfind(high);
  if (first == std::string::npos || last == std::string::npos || first + low.size() > last)
    return text_value(at, "");
  return text_value(at, text.substr(first + low.size(), last - first - low.size()));
}

TaggedValue split_string(Evaluation& at, ValueArguments a) {
  ValueArray out;
  for (const std::string& each : split_text(text_in(at, a[0]), text_in(at, a[1])))
    out.values.push_back(text_value(at, each));
  return array_value(at, std::move(out));
}

TaggedValue list_add(Evaluation& at, ValueArguments a) {
  std::vector<std::string> items = items_of(at, a[0]);
  items.push_back(text_in(at, a[1]));
  return list_of(at, items);
}
TaggedValue list_item(Evaluation& at, ValueArguments a) {
  return item_at(at, items_of(at, a[0]), number_in(at, a[1]));
}
TaggedValue list_first(Evaluation& at, ValueArguments a) { return item_at(at, items_of(at, a[0]), 0); }
TaggedValue list_last(Evaluation& at, ValueArguments a) {
  const std::vector<std::string> items = items_of(at, a[0]);
  return item_at(at, items, static_cast<double>(items.size()) - 1);
}
TaggedValue list_size(Evaluation& at, ValueArguments a) {
  return number_value(static_cast<double>(items_of(at, a[0]).size()));
}
TaggedValue list_random(Evaluation& at, ValueArguments a) {
  const std::vector<std::string> items = items_of(at, a[0]);
  if (items.empty()) return text_value(at, "");
  return item_at(at, items, at.d.random.below(static_cast<std::uint32_t>(items.size())));
}
TaggedValue list_clean(Evaluation& at, ValueArguments a) {
  std::vector<std::string> items = items_of(at, a[0]);
  std::erase(items, "");
  return list_of(at, items);
}
TaggedValue list_index(Evaluation& at, ValueArguments a) {
  const std::vector<std::string> items = items_of(at, a[0]);
  const auto found = std::ranges::find(items, text_in(at, a[1]));
  return number_value(found == items.end() ? -1 : static_cast<double>(found - items.begin()));
}
TaggedValue list_count(Evaluation& at, ValueArguments a) {
  return number_value(static_cast<double>(std::ranges::count(items_of(at, a[0]), text_in(at, a[1]))));
}
TaggedValue list_range(Evaluation& at, ValueArguments a) {
  const std::vector<std::string> items = items_of(at, a[0]);
  const std::size_t from = place_in(at, a[1], items.size()), to = place_in(at, a[2], items.size());
  std::vector<std::string> out;
  for (std::size_t i = from; i < to; ++i) out.push_back(items[i]);
  return list_of(at, out);
}
TaggedValue list_remove(Evaluation& at, ValueArguments a) {
  std::vector<std::string> items = items_of(at, a[0]);
  const auto found = std::ranges::find(items, text_in(at, a[1]));
  if (found != items.end()) items.erase(found);
  return list_of(at, items);
}
TaggedValue list_remove_all(Evaluation& at, ValueArguments a) {
  std::vector<std::string> items = items_of(at, a[0]);
  const std::vector<std::string> others = items_of(at, a[1]);
  std::erase_if(items,
                [&](const std::string& item) { return std::ranges::find(others, item) != others.end(); });
  return list_of(at, items);
}
TaggedValue list_retain_all(Evaluation& at, ValueArguments a) {
  std::vector<std::string> items = items_of(at, a[0]);
  const std::vector<std::string> others = items_of(at, a[1]);
  std::erase_if(items,
                [&](const std::string& item) { return std::ranges::find(others, item) == others.end(); });
  return list_of(at, items);
}

TaggedValue list_to_array(Evaluation& at, ValueArguments a) {
  ValueArray out;
  for (const std::string& each : items_of(at, a[0])) out.values.push_back(text_value(at, each));
  return array_value(at, std::move(out));
}
TaggedValue list_from_array(Evaluation& at, ValueArguments a) {
  std::vector<std::string> items;
  for (const TaggedValue& each : array_in(at, a[0]).values) items.push_back(text_in(at, each));
  return list_of(at, items);
}
TaggedValue list_terminate(Evaluation& at, ValueArguments a) {
  const std::string list = text_in(at, a[0]);
  return text_value(at, list.empty() || list.ends_with(';') ? list : list + ";");
}

std::string directory_of(std::string_view path) {
  const std::size_t slash = path.find_last_of('/');
  return std::string(slash == std::string_view::npos ? "" : path.substr(0, slash + 1));
}
std::string name_of_file(std::string_view path) {
  const std::size_t slash = path.find_last_of('/');
  return std::string(slash == std::string_view::npos ? path : path.substr(slash + 1));
}
TaggedValue file_directory(Evaluation& at, ValueArguments a) {
  return text_value(at, directory_of(text_in(at, a[0])));
}
TaggedValue file_name(Evaluation& at, ValueArguments a) {
  return text_value(at, name_of_file(text_in(at, a[0])));
}
TaggedValue file_basename(Evaluation& at, ValueArguments a) {
  const std::string name = name_of_file(text_in(at, a[0]));
  return text_value(at, name.substr(0, name.find_last_of('.')));
}
TaggedValue file_extension(Evaluation& at, ValueArguments a) {
  const std::string name = name_of_file(text_in(at, a[0]));
  const std::size_t dot = name.find_last_of('.');
  return text_value(at, dot == std::string::npos ? "" : name.substr(dot + 1));
}
TaggedValue file_exists(Evaluation& at, ValueArguments a) {
  return truth_value(!files_that_fit(at, text_in(at, a[0])).empty());
}
TaggedValue file_search(Evaluation& at, ValueArguments a) {
  return list_of(at, files_that_fit(at, text_in(at, a[0])));
}
TaggedValue files_search(Evaluation& at, ValueArguments a) {
  ValueArray out;
  for (const std::string& each : files_that_fit(at, text_in(at, a[0])))
    out.values.push_back(text_value(at, each));
  return array_value(at, std::move(out));
}
TaggedValue file_random(Evaluation& at, ValueArguments a) {
  const std::string pattern = text_in(at, a[0]);
  const std::vector<std::string> found = files_that_fit(at, pattern);
  if (found.empty()) {
    warn(at.d, at.offset, "no asset, material or table of the request fits " + lang::in_quotes(pattern));
    return text_value(at, "");
  }
  return text_value(at, found[at.d.random.below(static_cast<std::uint32_t>(found.size()))]);
}

TaggedValue read_text_file(Evaluation& at, ValueArguments a) {
  return text_value(at, table_text(at, text_in(at, a[0])));
}
TaggedValue read_string_table(Evaluation& at, ValueArguments a) {
  return array_value(at, read_table(at, text_in(at, a[0]), TableCells::texts));
}
TaggedValue read_float_table(Evaluation& at, ValueArguments a) {
  return array_value(at, read_table(at, text_in(at, a[0]), TableCells::numbers));
}
/// CityEngine has NaN and this private character for missing attributes of a layer.
TaggedValue is_null(Evaluation& at, ValueArguments a) {
  if (is_array(a[0])) return truth_value(false);
  return truth_value(a[0].is_text() ? text_in(at, a[0]) == "\ue000" : std::isnan(a[0].number));
}
TaggedValue select(Evaluation& at, ValueArguments a) { return to_truth(at, a).number != 0 ? a[1] : a[2]; }

constexpr ValueFunctionRow rows[] = {
    {"str", 1, 1, to_text, "value", "The value as a text.", "A --> label(str(3)) B."},
    {"float", 1, 1, to_number, "value", "The number that a text holds, or 0.",
     "A --> s(float(\"2.5\"), '1, '1) B."},
    {"bool", 1, 1, to_truth, "value", "Whether a text is true or holds a number other than 0.",
     "A --> case bool(\"true\"): B. else: C."},
    {"isNull", 1, 1, is_null, "value", "Whether a value is missing: no number, or the text \"\\ue000\".",
     "A --> case isNull(\"a\"): B. else: C."},
    {"sel", 3, 3, select, "condition, a, b", "a if the condition holds, else b.",
     "A --> label(sel(true, \"a\", \"b\")) B."},
    {"len", 1, 1, length, "text", "The number of bytes of a text.", "A --> s(len(\"four\"), '1, '1) B."},
    {"find", 2, 3, find, "text, part, occurrence", "The position of a part in a text, from 0, or -1.",
     "A --> case find(\"abc\", \"c\", 0) == 2: B. else: C."},
    {"findFirst", 2, 2, find, "text, part", "The position of the first occurrence, or -1.",
     "A --> case findFirst(\"abcb\", \"b\") == 1: B. else: C."},
    {"findLast", 2, 2, find_last, "text, part", "The position of the last occurrence, or -1.",
     "A --> case findLast(\"abcb\", \"b\") == 3: B. else: C."},
    {"count", 2, 2, count, "text, part", "How often a part occurs in a text.",
     "A --> case count(\"a-b-c\", \"-\") == 2: B. else: C."},
    {"substring", 2, 3, substring, "text, first, end",
     "The part of a text from one position to before another.",
     "A --> label(substring(\"window\", 0, 3)) B."},
    {"replace", 3, 3, replace, "text, part, by", "The text with every occurrence of a part replaced.",
     "A --> label(replace(\"a_b\", \"_\", \"-\")) B."},
    {"getPrefix", 2, 2, prefix, "text, part", "The text before the first occurrence of a part.",
     "A --> label(getPrefix(\"a_b\", \"_\")) B."},
    {"getSuffix", 2, 2, suffix, "text, part", "The text behind the last occurrence of a part.",
     "A --> label(getSuffix(\"a_b\", \"_\")) B."},
    {"getRange", 3, 3, range, "text, low, high", "The text between two parts.",
     "A --> label(getRange(\"a(b)\", \"(\", \")\")) B."},
    {"splitString", 2, 2, split_string, "text, separator", "The parts of a text as an array.",
     "A --> case size(splitString(\"a,b\", \",\")) == 2: B. else: C."},
    {"listAdd", 2, 2, list_add, "list, item",
     "The list with one more item. Lists are texts such as \"a;b;\".",
     "A --> label(listAdd(\"a;\", \"b\")) B."},
    {"listItem", 2, 2, list_item, "list, index", "An item of a list, from 0.",
     "A --> label(listItem(\"a;b;\", 1)) B."},
    {"listFirst", 1, 1, list_first, "list", "The first item.", "A --> label(listFirst(\"a;b;\")) B."},
    {"listLast", 1, 1, list_last, "list", "The last item.", "A --> label(listLast(\"a;b;\")) B."},
    {"listSize", 1, 1, list_size, "list", "The number of items.", "A --> s(listSize(\"a;b;\"), '1, '1) B."},
    {"listRandom", 1, 1, list_random, "list", "A random item.", "A --> label(listRandom(\"a;b;\")) B."},
    {"listClean", 1, 1, list_clean, "list", "The list without empty items.",
     "A --> label(listClean(\"a;;b;\")) B."},
    {"listIndex", 2, 2, list_index, "list, item", "The position of an item, or -1.",
     "A --> case listIndex(\"a;b;\", \"b\") == 1: B. else: C."},
    {"listCount", 2, 2, list_count, "list, item", "How often an item occurs.",
     "A --> case listCount(\"a;a;\", \"a\") == 2: B. else: C."},
    {"listRange", 3, 3, list_range, "list, first, end", "The items from one position to before another.",
     "A --> label(listRange(\"a;b;c;\", 1, 3)) B."},
    {"listRemove", 2, 2, list_remove, "list, item", "The list without the first item of this value.",
     "A --> label(listRemove(\"a;b;\", \"a\")) B."},
    {"listRemoveAll", 2, 2, list_remove_all, "list, items", "The list without the items of another list.",
     "A --> label(listRemoveAll(\"a;b;\", \"a;\")) B."},
    {"listRetainAll", 2, 2, list_retain_all, "list, items", "The items that another list has too.",
     "A --> label(listRetainAll(\"a;b;\", \"a;\")) B."},
    {"listToArray", 1, 1, list_to_array, "list", "The items as an array of texts.",
     "A --> label(listToArray(\"a;b;\")[1]) B."},
    {"listFromArray", 1, 1, list_from_array, "array", "The values of an array as a list.",
     "A --> label(listFromArray([\"a\", \"b\"])) B."},
    {"listTerminate", 1, 1, list_terminate, "list", "The list with a semicolon at its end.",
     "A --> label(listTerminate(\"a;b\")) B."},
    {"fileDirectory", 1, 1, file_directory, "path", "The directories of a path.",
     "A --> label(fileDirectory(\"a/b.obj\")) B."},
    {"fileName", 1, 1, file_name, "path", "A path without directories.",
     "A --> label(fileName(\"a/b.obj\")) B."},
    {"fileBasename", 1, 1, file_basename, "path", "The name of a file without its extension.",
     "A --> label(fileBasename(\"a/b.obj\")) B."},
    {"fileExtension", 1, 1, file_extension, "path", "The extension of a file name, without the dot.",
     "A --> label(fileExtension(\"a/b.obj\")) B."},
    {"fileExists", 1, 1, file_exists, "path",
     "Whether the request has an asset, material or table of this name.",
     "A --> case fileExists(\"statue.obj\"): B. else: C."},
    {"fileSearch", 1, 1, file_search, "pattern",
     "The names of the request that fit a pattern with *, as a list.",
     "A --> label(\"l\" + fileSearch(\"*.obj\")) B."},
    {"filesSearch", 1, 1, files_search, "pattern",
     "The names of the request that fit a pattern with *, as an array.",
     "A --> case size(filesSearch(\"*.obj\")) == 0: B. else: C."},
    {"fileRandom", 1, 1, file_random, "pattern",
     "A random one of the names of the request that fit a pattern with *.",
     "A --> label(\"l\" + fileRandom(\"*.obj\")) B."},
    {"readTextFile", 1, 1, read_text_file, "path", "The text of a table of the request.",
     "f = readTextFile(\"t\")  A --> B."},
    {"readStringTable", 1, 1, read_string_table, "path", "A table of the request as an array of texts.",
     "f = readStringTable(\"t\")  A --> B."},
    {"readFloatTable", 1, 1, read_float_table, "path", "A table of the request as an array of numbers.",
     "f = readFloatTable(\"t\")  A --> B."},
};

}  // namespace

std::span<const ValueFunctionRow> text_functions() { return rows; }

}  // namespace seedmesh::building
