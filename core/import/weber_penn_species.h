#pragma once
/// Parameters of a tree of Weber and Penn from a file of another program, by the names of the paper. Each
/// value has its offset in the file.
#include <array>
#include <map>
#include <string>

#include "core/import/foreign_text.h"

namespace seedmesh {

class WeberPennSpecies {
 public:
  explicit WeberPennSpecies(ForeignText& source) : source_(source) {}

  /// Sets a parameter by the name of the schema, such as "Shape" or "2Curve". `at`: the offset of its value.
  void set(const std::string& name, double value, std::size_t at);
  /// Sets a parameter unless the file has set it.
  void set_default(const std::string& name, double value) { values_.emplace(name, Value{value, none}); }

  /// Sets a value in the place of one that the file has for it.
  void replace(const std::string& name, double value, std::size_t at) { values_[name] = {value, at}; }

  /// Returns the value of a parameter; `otherwise` where the file has none.
  double value(const std::string& name, double otherwise) const {
    const auto found = values_.find(name);
    return found == values_.end() ? otherwise : found->second.value;
  }

  /// Returns the request. Parameters of levels that do not exist are left out, because files have 0 there.
  Imported made(std::uint64_t seed) const;

  /// Whether a name has the digit of a level before it.
  static bool is_of_levels(const std::string& name);

 private:
  static constexpr std::size_t none = ~std::size_t{0};
  struct Value {
    double value = 0;
    std::size_t at = none;
  };
  ForeignText& source_;
  std::map<std::string, Value> values_;
};

/// Returns the name of the leaf shape that a program stores as a number; "simple" if `names` has none for it.
std::string leaf_shape_of(double number, std::array<const char*, 11> names);

}  // namespace seedmesh
