/// Published L-systems against what the literature and other engines say they derive to;
/// tests/corpus/lsystem.json holds the facts. Everything goes through the door that a request goes through:
/// read_request() and derive().
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/pipeline.h"

namespace seedmesh {
namespace {

using Json = nlohmann::json;

/// Parameters are printed with six digits, so sums taken from a string carry the rounding of every term.
constexpr double rounded_sum = 3e-5;
constexpr double length_tolerance = 1e-6;
constexpr double point_tolerance = 2e-5;

const Json& corpus() {
  static const Json all = Json::parse(std::ifstream(SEEDMESH_SOURCE_DIR "/tests/corpus/lsystem.json"));
  return all;
}

Json derived(const Json& parameters, std::uint64_t seed = 1) {
  const Json body = {{"generator", "lsystem"}, {"seed", seed}, {"parameters", parameters}};
  const Result<Request> request = read_request(body.dump(), Limits{});
  if (!request) {
    ADD_FAILURE() << body.dump() << ": " << request.error().issues.front().message;
    return Json::object();
  }
  const Result<std::string> answer = derive(*request, {});
  if (!answer) {
    ADD_FAILURE() << body.dump() << ": " << answer.error().issues.front().message;
    return Json::object();
  }
  return Json::parse(*answer);
}

struct Module {
  std::string symbol;
  std::vector<double> parameters;
};

/// "F(1,2)[+A]" -> F with 1 and 2, [, +, A, ]. Symbols are one character, or two where the first is `@`.
std::vector<Module> modules_of(const std::string& text) {
  std::vector<Module> modules;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t width = text[i] == '@' ? 2 : 1;
    modules.push_back({text.substr(i, width), {}});
    i += width;
    if (i >= text.size() || text[i] != '(') continue;
    const std::size_t close = text.find(')', i);
    for (std::size_t from = i + 1; from < close;) {
      const std::size_t to = std::min(text.find(',', from), close);
      modules.back().parameters.push_back(std::stod(text.substr(from, to - from)));
      from = to + 1;
    }
    i = close + 1;
  }
  return modules;
}

/// "G/2" -> the sums of the first and of the second parameter over all G with two.
std::map<std::string, std::vector<double>> sums_of(const std::vector<Module>& modules) {
  std::map<std::string, std::vector<double>> sums;
  for (const Module& module : modules) {
    if (module.parameters.empty()) continue;
    auto& sum = sums[module.symbol + "/" + std::to_string(module.parameters.size())];
    sum.resize(module.parameters.size());
    for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += module.parameters[k];
  }
  return sums;
}

std::string fnv1a(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  std::string digits(16, '0');
  for (int k = 0; k < 16; ++k)
    digits[15 - static_cast<std::size_t>(k)] = "0123456789abcdef"[hash >> (4 * k) & 15U];
  return digits;
}

void expect_near(const Json& got, const Json& want, double tolerance, const std::string& what) {
  const std::vector<double> a =
      got.is_array() ? got.get<std::vector<double>>() : std::vector{got.get<double>()};
  const std::vector<double> b =
      want.is_array() ? want.get<std::vector<double>>() : std::vector{want.get<double>()};
  ASSERT_EQ(a.size(), b.size()) << what;
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_NEAR(a[k], b[k], tolerance * std::max(1.0, std::abs(b[k]))) << what << '[' << k << ']';
  }
}

std::string plain_name(const Json& entry) {
  std::string name = entry.at("name");
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
}

const Json& system_at(std::size_t place) { return corpus().at("systems").at(place); }

std::vector<std::size_t> places_with_a_walk() {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < corpus().at("systems").size(); ++i) {
    if (system_at(i).at("expect").contains("turtle")) places.push_back(i);
  }
  return places;
}

std::string name_of_place(const testing::TestParamInfo<std::size_t>& place) {
  return plain_name(system_at(place.param));
}

class CorpusWords : public testing::TestWithParam<std::size_t> {};
class CorpusWalks : public testing::TestWithParam<std::size_t> {};

TEST_P(CorpusWords, AreAsPublished) {
  const Json& entry = system_at(GetParam());
  const Json& expect = entry.at("expect");
  const Json got = derived(entry.at("parameters"));
  ASSERT_TRUE(got.contains("length")) << entry.at("source");
  EXPECT_EQ(got.at("length"), expect.at("length"));
  EXPECT_EQ(got.at("counts"), expect.at("counts"));
  const std::string text = got.value("string", "");
  EXPECT_EQ(text, expect.value("string", text));
  if (expect.contains("fnv1a")) {
    EXPECT_EQ(fnv1a(text), expect.at("fnv1a").get<std::string>());
  }
  if (expect.contains("sums") && !got.value("truncated", false)) {
    const auto sums = sums_of(modules_of(text));
    for (const auto& [name, want] : expect.at("sums").items()) {
      ASSERT_TRUE(sums.contains(name)) << name;
      expect_near(Json(sums.at(name)), want, rounded_sum, "sum of " + name);
    }
  }
}

TEST_P(CorpusWalks, EndAndReachAsPublished) {
  const Json& entry = system_at(GetParam());
  const Json& expect = entry.at("expect").at("turtle");
  const Json got = derived(entry.at("parameters")).value("turtle", Json::object());
  ASSERT_TRUE(got.contains("segments"));
  EXPECT_EQ(got.at("segments"), expect.at("segments"));
  expect_near(got.at("total_length"), expect.at("total_length"), length_tolerance, "total length");
  expect_near(got.at("position"), expect.at("position"), point_tolerance, "position");
  expect_near(got.at("bounds").at("min"), expect.at("min"), point_tolerance, "least corner");
  expect_near(got.at("bounds").at("max"), expect.at("max"), point_tolerance, "greatest corner");
}

INSTANTIATE_TEST_SUITE_P(Systems, CorpusWords, testing::Range(std::size_t{0}, corpus().at("systems").size()),
                         name_of_place);
INSTANTIATE_TEST_SUITE_P(Systems, CorpusWalks, testing::ValuesIn(places_with_a_walk()), name_of_place);

TEST(CorpusFrames, TurnTheTurtleTheWayTheBookDoes) {
  for (const Json& frame : corpus().at("frames")) {
    const std::string axiom = frame.at("after");
    const Json turtle = derived({{"axiom", axiom}}).value("turtle", Json::object());
    ASSERT_TRUE(turtle.contains("heading")) << axiom;
    for (const char* axis : {"heading", "left", "up"}) {
      expect_near(turtle.at(axis), frame.at(axis), 1e-8, axis + (" after " + axiom));
    }
  }
}

TEST(CorpusChances, GiveEachSuccessorItsShareOverManySeeds) {
  constexpr int seeds = 2000;
  constexpr double five_sigmas = 0.056;  // of a share of a half over 2,000 draws
  for (const Json& entry : corpus().at("chances")) {
    std::map<std::string, int> seen;
    for (std::uint64_t seed = 0; seed < seeds; ++seed)
      ++seen[derived(entry.at("parameters"), seed).value("string", "")];
    for (const auto& [text, share] : entry.at("shares").items()) {
      EXPECT_NEAR(seen[text] / double{seeds}, share.get<double>(), five_sigmas)
          << entry.at("name") << " " << text;
    }
    EXPECT_EQ(seen.size(), entry.at("shares").size()) << entry.at("name") << " derives to something else too";
  }
}

TEST(CorpusChances, GrowAsFastAsTheirMean) {
  constexpr int seeds = 200;
  for (const Json& entry : corpus().at("growth")) {
    double sum = 0;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      sum +=
          derived(entry.at("parameters"), seed).at("counts").value(entry.at("symbol").get<std::string>(), 0);
    }
    const double mean = entry.at("mean");
    EXPECT_NEAR(sum / seeds, mean, mean * entry.at("tolerance").get<double>()) << entry.at("name");
  }
}

}  // namespace
}  // namespace seedmesh
