#pragma once
/// The table of settings. Flags, environment variables, the configuration file and the help are all read from
/// it. Only config.cpp uses it.
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "server/config.h"

namespace seedmesh {

/// A row of the table. `set` returns "" or an error message that continues "it ...".
struct Setting {
  std::string name;
  std::string text;
  std::function<std::string(Config&, std::string_view)> set;
  std::function<nlohmann::ordered_json(const Config&)> get;
  bool is_switch = false;
  std::string unit = "TEXT";  ///< unit of the value, for the help
};

const std::vector<Setting>& setting_rows();
const Setting* find_setting(std::string_view name);  ///< null where there is none

}  // namespace seedmesh
