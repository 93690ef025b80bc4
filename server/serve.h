#pragma once
#include "server/config.h"

namespace seedmesh {

/// Serves until SIGTERM or SIGINT: then /readyz turns to 503, after `drain_delay` listening ends, what is in
/// flight is finished, and the status 0 is returned; 1 where the address cannot be had. Prints the URL on
/// standard output; the log goes to standard error. To be called before any other thread exists, since it
/// decides who gets the signals.
int serve(const Config& config, const std::vector<std::string>& warnings);

/// Asks /healthz of a service on this machine, as the environment and flags describe it: status 0 where it
/// answers 200.
int healthcheck(const Config& config);

}  // namespace seedmesh
