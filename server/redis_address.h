#pragma once
/// Where the shared cache is.
#include <optional>
#include <string>
#include <string_view>

namespace seedmesh {

struct RedisAddress {
  std::string host;  ///< "" where `path` is set
  int port = 6379;
  std::string path;  ///< of a Unix socket
  std::string user, password;
  int database = 0;
};

/// redis://[[user]:password@]host[:port][/database], or unix:///path[?db=n]. "" or what is wrong with the
/// text, which is not repeated, since it may hold a password. An empty text is no address.
std::string read_redis_address(std::string_view text, std::optional<RedisAddress>& address);

/// The address without user and password, for logs and --print-config.
std::string shown_address(const RedisAddress& address);

}  // namespace seedmesh
