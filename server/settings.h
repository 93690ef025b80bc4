#pragma once
/// The table of settings: one row for each, which flags, environment, file and documentation share. Behind
/// config.h.
#include <charconv>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/config.h"

namespace seedmesh {

/// A row of the table. `set` gives "" or what is wrong with the text.
struct Setting {
  std::string name;
  std::string text;
  std::function<std::string(Config&, std::string_view)> set;
  std::function<nlohmann::ordered_json(const Config&)> get;
  bool is_switch = false;
};

const std::vector<Setting>& setting_rows();
const Setting* find_setting(std::string_view name);  ///< null where there is none

/// The whole of a text as a number.
template <class Number>
std::optional<Number> number(std::string_view text) {
  Number value{};
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace seedmesh
