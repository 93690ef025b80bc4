#pragma once
#include "server/config.h"

namespace seedmesh {

/// Logs `warnings`, then serves until SIGTERM or SIGINT. From the signal on, /readyz returns 503. After
/// `drain_delay` no connections are accepted, and requests in progress are completed. Returns the exit status
/// 0, or 1 if the address cannot be bound. Prints the URL on standard output and the log on standard error.
/// Has to be called before other threads start, because it blocks these signals for them.
int serve(const Config& config, const std::vector<std::string>& warnings);

/// Requests /healthz of the service on this machine that `config` describes. Returns the exit status: 0 if the
/// response is 200, else 1 after a message on standard error.
int healthcheck(const Config& config);

}  // namespace seedmesh
