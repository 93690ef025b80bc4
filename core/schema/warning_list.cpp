#include "core/schema/warning_list.h"

#include <nlohmann/json.hpp>

namespace seedmesh {

Json warning_list(std::span<const Warning> warnings) {
  Json list = Json::array();
  for (const Warning& warning : warnings) {
    Json row = {{"pointer", warning.pointer}, {"message", warning.message}};
    if (warning.line > 0) {
      row["line"] = warning.line;
      row["column"] = warning.column;
    }
    list.push_back(std::move(row));
  }
  return list;
}

}  // namespace seedmesh
