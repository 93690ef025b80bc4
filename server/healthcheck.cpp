#include <httplib.h>

#include "server/serve.h"

namespace seedmesh {
namespace {

/// Whether the service answers GET /healthz with 200 in time. The certificate is not verified, because it
/// names the public host of the service and not this machine.
bool answers(httplib::ClientImpl& client) {
  constexpr int seconds = 3;
  client.set_connection_timeout(seconds);
  client.set_read_timeout(seconds);
  client.set_write_timeout(seconds);
  const httplib::Result answer = client.Get("/healthz");
  return answer && answer->status == 200;
}

}  // namespace

int healthcheck(const Config& config) {
  const bool any = config.host == "0.0.0.0" || config.host == "::";
  const std::string host = any ? "localhost" : config.host;
  if (config.tls) {
    httplib::SSLClient client(host, config.port);
    client.enable_server_certificate_verification(false);
    return answers(client) ? 0 : 1;
  }
  httplib::ClientImpl client(host, config.port);
  return answers(client) ? 0 : 1;
}

}  // namespace seedmesh
