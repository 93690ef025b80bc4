/// What writing costs of a request's limits.
#include <gtest/gtest.h>

#include "core/gltf/write/write.h"
#include "tests/core/gltf/samples.h"

namespace seedmesh {
namespace {

using namespace samples;

TEST(Write, RefusesBeforeTheOutputPassesItsLimit) {
  for (const Container container : {Container::glb, Container::gltf, Container::zip}) {
    Limits limits;
    limits.output_bytes = 800;
    Job small = job(limits);
    EXPECT_THROW(write(model_of(square(small), square(small)), container, "", small), Stop);
  }
}

TEST(Write, CountsWhatItWritesAgainstTheLimit) {
  for (const Container container : {Container::glb, Container::gltf, Container::zip}) {
    Job fresh = job();
    const std::uint64_t size = write(textured(fresh), container, "seedmesh", fresh).size();
    EXPECT_LE(fresh.spent(Resource::output_bytes), size);
    EXPECT_GE(fresh.spent(Resource::output_bytes) + 1000, size) << "all but headers";
  }
}

TEST(Write, LeavesNothingChargedWhenThePayloadIsGone) {
  for (const Container container : {Container::glb, Container::gltf, Container::zip}) {
    Job fresh = job();
    {
      const Payload payload = write(model_of(square(fresh)), container, "", fresh);
      EXPECT_GT(fresh.budget()->used(), 0U);
    }
    EXPECT_EQ(fresh.budget()->used(), 0U);
  }
}

}  // namespace
}  // namespace seedmesh
