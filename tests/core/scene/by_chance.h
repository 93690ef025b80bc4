#pragma once
/// Random scenes: every method and rule, grounds with and without water, footprints, foundations, crowns.
#include "tests/core/scene/support.h"

namespace seedmesh {

inline bool by_chance(Rng& rng, double share) { return rng.unit() < share; }

inline void ground_by_chance(Rng& rng, std::uint64_t seed, Json& json) {
  if (by_chance(rng, 0.3)) {
    json["ground"] = {{"size", rng.uniform(40, 90)}, {"outline", by_chance(rng, 0.5) ? "square" : "disc"}};
    return;
  }
  json["terrain"] = {{"generator", "terrain"},
                     {"seed", seed},
                     {"parameters",
                      {{"iterations", 5},
                       {"size", rng.uniform(50, 120)},
                       {"amplitude", rng.uniform(5, 30)},
                       {"hurst", 0.9}}}};
  if (by_chance(rng, 0.7)) json["terrain"]["parameters"]["water_level"] = rng.uniform(-6, 2);
}

inline Json line_by_chance(Rng& rng) {
  Json points = Json::array();
  const std::uint32_t count = 2 + rng.below(40);
  for (std::uint32_t i = 0; i < count; ++i) {
    const double x = -45 + 90.0 * i / (count - 1);
    points.push_back({x, rng.uniform(-20, 20)});
  }
  return points;
}

inline void method_by_chance(Rng& rng, Json& place) {
  const auto count = static_cast<int>(10 + rng.below(120));
  switch (rng.below(5)) {
    case 0:
      place["distance"] = rng.uniform(2, 9);
      return;
    case 1:
      place.update({{"method", "scatter"}, {"count", count}});
      return;
    case 2:
      place.update({{"method", "clusters"},
                    {"count", count},
                    {"clusters", {{"count", 1 + rng.below(6)}, {"radius", rng.uniform(2, 9)}}}});
      return;
    case 3:
      place.update({{"method", "rows"},
                    {"spacing", {rng.uniform(2, 9), rng.uniform(2, 9)}},
                    {"angle", rng.uniform(-180, 180)},
                    {"stagger", rng.uniform(0, 1)},
                    {"jitter", rng.uniform(0, 0.5)}});
      return;
    default:
      place.update({{"method", "path"},
                    {"points", line_by_chance(rng)},
                    {"distance", rng.uniform(1, 6)},
                    {"offset", rng.uniform(0, 6)}});
  }
}

inline void rules_by_chance(Rng& rng, Json& place, int number) {
  const auto limits = [&](double low, double high) {
    const double from = rng.uniform(low, high);
    Json made = {{"from", from}, {"to", from + rng.uniform(0.3, 1) * (high - low)}};
    if (by_chance(rng, 0.3)) made.erase(by_chance(rng, 0.5) ? "from" : "to");
    if (by_chance(rng, 0.5)) made["soft"] = rng.uniform(0, 4);
    return made;
  };
  if (by_chance(rng, 0.4)) place["slope"] = {{"to", rng.uniform(8, 40)}, {"soft", rng.uniform(0, 8)}};
  if (by_chance(rng, 0.3)) place["altitude"] = limits(-10, 10);
  if (by_chance(rng, 0.3)) place["edge"] = rng.uniform(0, 12);
  if (by_chance(rng, 0.2)) place["density"] = rng.uniform(0.2, 1);
  if (by_chance(rng, 0.2)) place["area"] = {{-40, -35}, {38, -30}, {rng.uniform(-10, 40), 35}, {-20, 20}};
  if (number > 0 && by_chance(rng, 0.3)) {
    const std::string other = "layer_" + std::to_string(rng.below(static_cast<std::uint32_t>(number)));
    const double from = rng.uniform(0, 5);
    place["near"] = {{{"layer", other}, {"from", from}, {"to", from + rng.uniform(3, 20)}}};
  }
  if (number > 0 && by_chance(rng, 0.2)) place["shade"] = {{"to", rng.uniform(0.1, 0.9)}};
}

/// Only the first layer has foundations, so later layers see the ground that the result shows.
inline Json layer_by_chance(Rng& rng, int number) {
  Json place = Json::object();
  method_by_chance(rng, place);
  rules_by_chance(rng, place, number);
  Json layer = {{"name", "layer_" + std::to_string(number)},
                {"model", cube()},
                {"variants", 1 + rng.below(3)},
                {"scale", {rng.uniform(0.3, 0.9), rng.uniform(1, 1.6)}},
                {"place", place}};
  if (by_chance(rng, 0.4)) layer["crown"] = rng.uniform(0.5, 4);
  if (by_chance(rng, 0.5)) {
    layer["footprint"] =
        by_chance(rng, 0.4) ? Json(rng.uniform(0.3, 3)) : Json({rng.uniform(1, 9), rng.uniform(1, 9)});
    if (number == 0 && by_chance(rng, 0.5)) layer["foundation"] = {{"slope_width", rng.uniform(0, 4)}};
  }
  return layer;
}

inline Json scene_by_chance(std::uint64_t seed) {
  Rng rng = Rng::of_seed(seed).at("scene by chance");
  Json json = {{"layers", Json::array()}, {"chunks", 1 + rng.below(4)}};
  ground_by_chance(rng, seed, json);
  const int layers = 1 + static_cast<int>(rng.below(5));
  for (int i = 0; i < layers; ++i) json["layers"].push_back(layer_by_chance(rng, i));
  if (by_chance(rng, 0.5)) json["competition"] = rng.uniform(0.2, 1);
  if (by_chance(rng, 0.5))
    json["paths"] = {{{"points", line_by_chance(rng)}, {"width", rng.uniform(1, 6)}, {"shown", false}}};
  return json;
}

}  // namespace seedmesh
