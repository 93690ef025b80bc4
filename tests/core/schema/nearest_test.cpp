#include "core/schema/nearest.h"

#include <gtest/gtest.h>

#include <string>

namespace seedmesh::schema {
namespace {

constexpr std::string_view words[] = {"angle", "axiom", "iterations", "step", "style"};

TEST(NearestWord, FindsWhatWasMeant) {
  EXPECT_EQ(nearest_word("angel", words), "angle");
  EXPECT_EQ(nearest_word("iteration", words), "iterations");
  EXPECT_EQ(nearest_word("Axiom", words), "axiom");
  EXPECT_EQ(nearest_word("stle", words), "style");
  EXPECT_EQ(nearest_word("ITERATONS", words), "iterations");
  EXPECT_EQ(nearest_word("Angel", words), "angle");
}

TEST(NearestWord, FindsTheOnlyContinuation) {
  constexpr std::string_view shapes[] = {"menger_sponge", "koch_curve", "koch_snowflake", "tree"};
  EXPECT_EQ(nearest_word("menger", shapes), "menger_sponge");
  EXPECT_EQ(nearest_word("menger_sponge_of_cubes", shapes), "menger_sponge");
  EXPECT_EQ(nearest_word("koch", shapes), "") << "two begin with it";
  EXPECT_EQ(nearest_word("men", shapes), "") << "too short";
}

TEST(NearestWord, DoesNotGuessWildly) {
  EXPECT_EQ(nearest_word("colour", words), "");
  EXPECT_EQ(nearest_word("x", words), "");
  EXPECT_EQ(nearest_word(std::string(1'000'000, 'a'), words), "");
}

}  // namespace
}  // namespace seedmesh::schema
