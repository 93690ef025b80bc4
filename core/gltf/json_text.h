#pragma once
/// JSON written as text, for the lists of a document that may be too long for a tree of values: the tree of a
/// document with 100,000 meshes takes 900 MB.
#include <string>
#include <string_view>

#include "core/base/job.h"

namespace seedmesh::gltf {

/// The shortest decimal that reads back as the same float: 0.1 and not 0.10000000149011612. `value` is
/// finite; -0 becomes 0. Does not depend on the locale.
void append_number(std::string& out, float value);

/// The same with a point at least, 1.0, and in digits from 0.0001 to 1e15, as libraries print doubles.
void append_decimal(std::string& out, float value);

void append_integer(std::string& out, long long value);

/// In quotes, escaped. Bytes that are no UTF-8 become U+FFFD.
void append_string(std::string& out, std::string_view text);

/// Spends the bytes of a growing text from a job, in steps that keep limit, stop and deadline timely.
class TextMeter {
 public:
  TextMeter(const std::string& text, Job& job) : text_(text), job_(job), counted_(text.size()) {}
  /// To be called once for each small thing that has been appended.
  void step() {
    if (text_.size() - counted_ >= step_bytes) settle();
  }
  void settle();

 private:
  static constexpr std::size_t step_bytes = 65'536;
  const std::string& text_;
  Job& job_;
  std::size_t counted_;
};

/// The double whose shortest decimal is that of `value`: for libraries that print doubles only.
double shortest(float value);

}  // namespace seedmesh::gltf
