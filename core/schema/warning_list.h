#pragma once
#include <span>

#include "core/base/result.h"
#include "core/schema/json.h"

namespace seedmesh {

/// [{pointer, message, line?, column?}], as every response of the service lists its warnings.
Json warning_list(std::span<const Warning> warnings);

}  // namespace seedmesh
