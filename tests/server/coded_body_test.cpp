#include "server/coded_body.h"

#include <gtest/gtest.h>

namespace seedmesh {
namespace {

/// RFC 1918, RFC 3927, RFC 4193, RFC 4291; each range with its neighbours.
TEST(PrivateAddress, IsOfThisMachineOrAPrivateNetwork) {
  for (const char* address :
       {"127.0.0.1", "127.9.9.9", "10.0.0.1", "10.255.255.255", "172.16.0.1", "172.31.9.9", "192.168.0.1",
        "169.254.1.1", "::1", "fc00::1", "fd12:3456::1", "fe80::1"})
    EXPECT_TRUE(is_private_address(address)) << address;
  for (const char* address :
       {"", "9.255.255.255", "11.0.0.1", "126.1.1.1", "128.0.0.1", "172.15.1.1", "172.32.0.1", "192.167.1.1",
        "192.169.1.1", "169.253.1.1", "8.8.8.8", "2001:db8::1", "::", "fe00::1", "unknown"})
    EXPECT_FALSE(is_private_address(address)) << address;
}

}  // namespace
}  // namespace seedmesh
