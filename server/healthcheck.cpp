#include <httplib.h>

#include <cstdio>
#include <string>

#include "server/serve.h"

namespace seedmesh {
namespace {

/// Returns the exit status: 0 if the service answers GET /healthz with 200 in time, else 1 and a message. The
/// certificate is not verified, because it names the public host of the service and not this machine.
int status_of(httplib::ClientImpl& client, const std::string& address) {
  constexpr int seconds = 3;
  client.set_connection_timeout(seconds);
  client.set_read_timeout(seconds);
  client.set_write_timeout(seconds);
  const httplib::Result answer = client.Get("/healthz");
  if (answer && answer->status == 200) return 0;
  const std::string found = answer ? "status " + std::to_string(answer->status)
                                   : "no response (" + httplib::to_string(answer.error()) + ")";
  std::fprintf(stderr, "seedmesh: %s: found %s, expected status 200 for /healthz\n", address.c_str(),
               found.c_str());
  return 1;
}

}  // namespace

int healthcheck(const Config& config) {
  const bool any = config.host == "0.0.0.0" || config.host == "::";
  const std::string host = any ? "localhost" : config.host;
  const std::string address = host + ":" + std::to_string(config.port);
  if (config.tls) {
    httplib::SSLClient client(host, config.port);
    client.enable_server_certificate_verification(false);
    return status_of(client, address);
  }
  httplib::ClientImpl client(host, config.port);
  return status_of(client, address);
}

}  // namespace seedmesh
