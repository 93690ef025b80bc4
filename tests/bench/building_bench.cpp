/// Buildings, from the request text to the bytes of a GLB: a block of 1,000 houses, and one tower with shared
/// and with merged windows.
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>

#include "core/pipeline.h"
#include "core/schema/json.h"
#include "tests/bench/report.h"

namespace {

using namespace seedmesh;

constexpr const char* houses = R"(
Block --> split(x){ 12: split(z){ 10: Lot }* }*
Lot --> s('0.8, '1, '0.8) center(xz) extrude(rand(5.5, 9)) comp(f){ side: Facade | top: Top | bottom: NIL }
Top --> material("roof") roofHip(35, 0.4) Roof.
Facade --> split(y){ { ~2.8: Floor }* | 0.3: Ledge. }
Floor --> split(x){ { ~2: Bay }* }
Bay --> 80%: split(x){ ~1: Wall. | 1: Window | ~1: Wall. } else: Wall.
Window --> split(y){ 0.9: Wall. | ~1: Pane | 0.4: Wall. }
Pane --> [ t(0, 0, -0.1) material("glass") Glass. ] s('1.2, 0.1, 0.15) center(x) material("stone") Sill.
)";

constexpr const char* tower = R"(
Lot --> extrude(105) comp(f){ side: Facade | top: Roof. | bottom: NIL }
Facade --> split(y){ { ~3.5: Floor }* }
Floor --> split(x){ { ~2.5: Bay }* }
Bay --> s('1, '1, 0.3) t(0, 0, -0.3) i("window")
)";

Product made(const Json& body, std::uint64_t* shapes) {
  const Result<Request> request = read_request(body.dump(), Limits{});
  if (!request) std::abort();
  Result<Product> product = produce(*request, {});
  if (!product) std::abort();
  if (shapes != nullptr) {
    const Result<std::string> derivation = derive(*request, {});
    if (!derivation) std::abort();
    *shapes = Json::parse(*derivation).at("count").get<std::uint64_t>();
  }
  return *std::move(product);
}

Json request_of(const char* rules, Json size, const char* instancing) {
  return {{"generator", "building"},
          {"parameters", {{"rules", rules}, {"size", std::move(size)}}},
          {"output", {{"instancing", instancing}}}};
}

}  // namespace

int main() {
  const Json block = request_of(houses, {480, 0, 250}, "auto");
  std::uint64_t shapes = 0;
  double triangles = 0;
  const double seconds = bench::median_seconds<bench::CpuClock>(
      7, [&] { triangles = static_cast<double>(made(block, &shapes).statistics.triangles); });
  bench::report("block of 1,000 houses to GLB, 1 thread", "shapes", static_cast<double>(shapes), seconds);
  bench::report("block of 1,000 houses to GLB, 1 thread", "triangles", triangles, seconds);
  for (const char* instancing : {"nodes", "merge"}) {
    const Product product = made(request_of(tower, {20, 0, 20}, instancing), nullptr);
    std::printf(
        "{\"name\":\"bytes: tower of 30 floors, windows as %s\",\"unit\":\"bytes\",\"amount\":%llu}\n",
        instancing, static_cast<unsigned long long>(product.payload.size()));
  }
}
