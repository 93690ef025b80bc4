#pragma once
/// The texts of one derivation.
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace seedmesh::building {

/// Flag in TaggedValue::text: the value is an array, and the other bits are its index in ValueArrays.
constexpr std::uint32_t array_bit = 0x80000000U;

/// The texts of one derivation, numbered from 1 as in lang::TaggedValue. Copies share those before share().
class Texts {
 public:
  /// Returns the number of the text, which it adds if it is new.
  std::uint32_t id_of(std::string_view text);
  std::size_t size() const { return (shared_ ? shared_->texts.size() : 0) + own_.texts.size(); }
  /// The text with this number; null for 0 (no text) and for arrays.
  const std::string* find(std::uint32_t id) const {
    if (id == 0 || (id & array_bit) != 0) return nullptr;
    const std::size_t before = shared_ ? shared_->texts.size() : 0;
    return id <= before ? &shared_->texts[id - 1] : &own_.texts[id - 1 - before];
  }
  /// From now on, copies of this table share the texts so far, so that a copy costs nothing. Called once.
  void share();

 private:
  struct Table {
    std::map<std::string, std::uint32_t, std::less<>> ids;
    std::vector<std::string> texts;
  };
  std::shared_ptr<const Table> shared_;
  Table own_;
};

}  // namespace seedmesh::building
