#pragma once
/// The requests of the buildings on the lots of a city.
#include <nlohmann/json.hpp>
#include <vector>

#include "core/generators/api.h"
#include "core/generators/city/plan.h"
#include "core/schema/child.h"

namespace seedmesh {
struct CityParams;
}

namespace seedmesh::city {

/// Makes requests from the rules of a city. Does not own the parameters.
class HouseRequests {
 public:
  explicit HouseRequests(const CityParams& params);

  /// Returns the request of a house. Generated alone, it gives the same building as in the city.
  Child of(const House& house) const;

 private:
  const CityParams& params_;
  std::vector<Json> bases_;  ///< for each rule, the parameters without size and floors
};

/// A building that stands in the city, once or often.
struct SharedHouse {
  Child request;
  std::uint32_t rule = 0;
  std::vector<std::uint32_t> lots;
};

/// Returns the different requests of all houses, in the order of their first lots.
std::vector<SharedHouse> shared_houses(const CityPlan& plan, const CityParams& params);

/// Adds the errors of the requests that rules make: a generator other than building, and attributes that their
/// buildings do not have.
void check_house_requests(const CityParams& params, const CheckContext& context, std::vector<Issue>& issues);

}  // namespace seedmesh::city
