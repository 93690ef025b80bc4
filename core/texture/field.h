#pragma once
/// Square images of one number for each texel. They tile in both directions.
#include <functional>

#include "core/base/array.h"

namespace seedmesh::texture {

class Field {
 public:
  /// `size` is a power of two. The values are not initialised.
  Field(const Job& job, int size);
  Field(const Job& job, int size, float value);

  int size() const { return size_; }
  float* row(int y) { return values_.data() + index(0, y); }
  const float* row(int y) const { return values_.data() + index(0, y); }
  float& at(int x, int y) { return values_[index(x & (size_ - 1), y & (size_ - 1))]; }
  float at(int x, int y) const { return values_[index(x & (size_ - 1), y & (size_ - 1))]; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(x);
  }
  int size_;
  Array<float> values_;
};

/// Calls body(begin, end) for ranges of rows of an image, in parallel.
void for_rows(const Job& job, int rows, const std::function<void(int begin, int end)>& body);

/// Returns a smooth step from 0 at `low` to 1 at `high`.
inline float step_between(float low, float high, float x) {
  const float t = (x - low) * (1 / (high - low));
  const float from = t < 0 ? 0 : t, c = from > 1 ? 1 : from;
  return c * c * (3 - 2 * c);
}

}  // namespace seedmesh::texture
