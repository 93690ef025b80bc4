#include "core/gltf/payload.h"

#include <gtest/gtest.h>

namespace seedmesh {
namespace {

std::span<const std::byte> bytes_of(const std::string& text) { return std::as_bytes(std::span(text)); }

TEST(Payload, JoinsItsPiecesInOrder) {
  Payload payload;
  payload.add("seed");
  const auto shared = std::make_shared<const std::string>("mesh");
  payload.add(shared, bytes_of(*shared));
  EXPECT_EQ(payload.text(), "seedmesh");
  EXPECT_EQ(payload.size(), 8U);
  EXPECT_EQ(payload.pieces().size(), 2U);
}

TEST(Payload, KeepsOwnersAliveAndDoesNotCopyTheirBytes) {
  Payload payload;
  auto shared = std::make_shared<const std::string>(100, 'x');
  const auto* address = bytes_of(*shared).data();
  std::weak_ptr<const std::string> watch = shared;
  payload.add(shared, bytes_of(*shared));
  shared.reset();
  EXPECT_FALSE(watch.expired());
  EXPECT_EQ(payload.pieces()[0].data(), address);
  payload = {};
  EXPECT_TRUE(watch.expired());
}

TEST(Payload, HasNoEmptyPieces) {
  Payload payload;
  payload.add("");
  payload.add(nullptr, {});
  EXPECT_TRUE(payload.pieces().empty());
  EXPECT_EQ(payload.size(), 0U);
}

TEST(Payload, AppendsAnotherWithWhatItOwns) {
  Payload first, second;
  first.add("a");
  second.add(std::string(1000, 'b'));
  first.append(std::move(second));
  EXPECT_EQ(first.size(), 1001U);
  EXPECT_EQ(first.text(), 'a' + std::string(1000, 'b'));
}

}  // namespace
}  // namespace seedmesh
