#pragma once
#include "server/config.h"

namespace seedmesh {

/// Serves until SIGTERM or SIGINT. Then /readyz answers 503, listening ends after `drain_delay`, requests in
/// progress are completed, and the exit status 0 is returned; 1 where the address cannot be bound. Prints the
/// URL on standard output and the log on standard error. Has to be called before other threads start, because
/// it blocks these signals for them.
int serve(const Config& config, const std::vector<std::string>& warnings);

/// Asks /healthz of the service on this machine that `config` describes. Returns the exit status: 0 where it
/// answers 200, else 1.
int healthcheck(const Config& config);

}  // namespace seedmesh
