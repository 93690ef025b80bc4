#pragma once
/// The address of the shared cache.
#include <optional>
#include <string>
#include <string_view>

namespace seedmesh {

struct RedisAddress {
  std::string host;  ///< "" where `path` is set
  int port = 6379;
  std::string path;  ///< path of a Unix socket
  std::string user, password;
  int database = 0;
};

/// Parses redis://[[user]:password@]host[:port][/database] or unix:///path[?db=n]. Returns "" or an error
/// message, which does not repeat the text, because it may contain a password. An empty text yields no address.
std::string read_redis_address(std::string_view text, std::optional<RedisAddress>& address);

/// Returns the address without user and password, for logs and --print-config.
std::string shown_address(const RedisAddress& address);

}  // namespace seedmesh
