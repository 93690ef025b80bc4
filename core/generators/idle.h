#pragma once
/// Parameters that a request gives and its generator does not read. Includes the whole of nlohmann/json: for
/// .cpp files only.
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/model/model.h"
#include "core/schema/json.h"

namespace seedmesh {

/// Collects one warning for each of them. Pointers are relative to the parameters, reasons are clauses:
/// "`Lobes` is 0".
class IdleParameters {
 public:
  /// `given`: the parameters as canonical JSON, which leaves defaults out. Who knows by other means what is
  /// given needs none, and calls warn() and warn_if() alone.
  explicit IdleParameters(Json given = Json::object()) : given_(std::move(given)) {}

  const Json& given() const { return given_; }

  /// Of the parameter at `pointer`, whether it is given or not.
  void warn(std::string pointer, const std::string& reason);
  void warn_if(bool is_idle, std::string pointer, const std::string& reason);

  /// Of those of the names that stand in the object at `pointer`; "" is the parameters themselves.
  void warn_of(const std::string& pointer, std::initializer_list<std::string_view> names,
               const std::string& reason);

  std::vector<Warning> take() { return std::exchange(warnings_, {}); }

 private:
  Json given_;
  std::vector<Warning> warnings_;
};

}  // namespace seedmesh
