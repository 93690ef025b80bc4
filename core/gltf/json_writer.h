#pragma once
/// JSON written as text, value by value. A tree of values would take 900 MB for a document with 100,000
/// meshes.
#include <string>
#include <string_view>
#include <type_traits>

#include "core/base/job.h"

namespace seedmesh::gltf {

/// Appends the shortest decimal that reads back as the same float: 0.1 and not 0.10000000149011612. `value` is
/// finite; -0 becomes 0. Does not depend on the locale.
void append_number(std::string& out, float value);

/// Appends the shortest decimal that reads back as the same double: 22.521484375 and not 22.521484.
void append_number(std::string& out, double value);

/// Appends the same digits as append_number(float), with at least one digit after the point. Numbers from 0.0001 to
/// 1e15 have no exponent. This is the form in which nlohmann/json prints a double.
void append_decimal(std::string& out, float value);

void append_integer(std::string& out, long long value);

/// Appends a text in quotes and with escapes. Bytes that are not UTF-8 become U+FFFD.
void append_string(std::string& out, std::string_view text);

/// Returns the double whose shortest decimal is that of `value`, for libraries that print only doubles.
double shortest(float value);

/// Appends JSON without spaces to a text, with commas where they are needed. The text is its only state, so
/// another writer or other code may continue the text. An empty text is the start of a list without brackets.
class JsonWriter {
 public:
  explicit JsonWriter(std::string& out) : out_(out) {}

  /// Writes the name of the next member.
  void key(std::string_view name) {
    separate();
    append_string(out_, name);
    out_ += ':';
  }

  /// Writes a bool, an integer, a float or a text.
  template <class T>
  void value(const T& given) {
    separate();
    if constexpr (std::is_same_v<T, bool>) {
      out_ += given ? "true" : "false";
    } else if constexpr (std::is_integral_v<T>) {
      append_integer(out_, static_cast<long long>(given));
    } else if constexpr (std::is_same_v<T, float>) {
      append_number(out_, given);
    } else {
      append_string(out_, given);
    }
  }

  /// Writes a value that is JSON text already.
  void json(std::string_view text) {
    separate();
    out_ += text;
  }

  template <class T>
  void member(std::string_view name, const T& given) {
    key(name);
    value(given);
  }

  /// These functions write an object or an array; the argument is called to write its members or values. Functions
  /// with a `name` write a member, the others a value of a list.
  template <class Members>
  void object(const Members& write_members) {
    open('{');
    write_members();
    out_ += '}';
  }
  template <class Members>
  void object(std::string_view name, const Members& write_members) {
    key(name);
    object(write_members);
  }
  template <class Values>
  void array(const Values& write_values) {
    open('[');
    write_values();
    out_ += ']';
  }
  template <class Values>
  void array(std::string_view name, const Values& write_values) {
    key(name);
    array(write_values);
  }

  /// Writes a member that is an array of all values of a range.
  template <class Range>
  void values(std::string_view name, const Range& range) {
    array(name, [&] {
      for (const auto& each : range) value(each);
    });
  }

  /// Writes a member that is an array, from a list without brackets. Writes nothing where the list is empty.
  void list(std::string_view name, std::string_view elements) {
    if (elements.empty()) return;
    array(name, [&] { out_ += elements; });
  }

 private:
  void open(char bracket) {
    separate();
    out_ += bracket;
  }
  void separate() {
    if (out_.empty()) return;
    const char last = out_.back();
    if (last != '{' && last != '[' && last != ':') out_ += ',';
  }

  std::string& out_;
};

/// Spends the bytes of a growing text from a job, in steps of 64 KiB.
class TextMeter {
 public:
  TextMeter(const std::string& text, Job& job) : text_(text), job_(job), counted_(text.size()) {}
  /// Call it after each small part.
  void step() {
    if (text_.size() - counted_ >= step_bytes) finish();
  }
  /// Spends the rest.
  void finish();

 private:
  static constexpr std::size_t step_bytes = 65'536;
  const std::string& text_;
  Job& job_;
  std::size_t counted_;
};

}  // namespace seedmesh::gltf
