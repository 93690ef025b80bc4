#include "core/pipeline/tileset.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>

#include "core/gltf/json_writer.h"

namespace seedmesh::tiles {
namespace {

using gltf::JsonWriter;

/// Sides of boxes are multiples of 1/64 m, rounded outwards. So centres and half axes are exact and short.
constexpr double grain = 64;

/// Centre and three half axes.
std::array<double, 12> box_of(const Bounds& b) {
  const std::array<double, 3> low = {std::floor(b.west * grain) / grain, std::floor(b.south * grain) / grain,
                                     std::floor(b.low * grain) / grain};
  const std::array<double, 3> high = {std::ceil(b.east * grain) / grain, std::ceil(b.north * grain) / grain,
                                      std::ceil(b.high * grain) / grain};
  std::array<double, 12> box{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box[axis] = (low[axis] + high[axis]) / 2;
    box[3 + 4 * axis] = (high[axis] - low[axis]) / 2;
  }
  return box;
}

void member(JsonWriter& json, std::string_view name, double value) {
  std::string text;
  gltf::append_number(text, value);
  json.key(name);
  json.json(text);
}

void append_box(JsonWriter& json, const Bounds& bounds) {
  json.object("boundingVolume", [&] {
    json.array("box", [&] {
      for (const double number : box_of(bounds)) {
        std::string text;
        gltf::append_number(text, number);
        json.json(text);
      }
    });
  });
}

std::string name_of(std::string_view kind, const Address& at, std::string_view extension) {
  return std::string(kind) + "/" + std::to_string(at.level) + "/" + std::to_string(at.x) + "/" +
         std::to_string(at.y) + std::string(extension);
}

void append_content(JsonWriter& json, const std::string& uri) {
  json.object("content", [&] { json.member("uri", uri); });
}

/// Appends tiles of an explicit tileset as values.
class TileWriter {
 public:
  TileWriter(std::string& out, const Address& root, const Naming& naming, const BoundsOf& bounds_of)
      : json_(out), end_(root.level + levels_a_tileset), naming_(naming), bounds_of_(bounds_of) {}

  void append(const Address& at, bool is_root) {
    const bool is_link = at.level == end_;
    const Bounds bounds = bounds_of_(at);
    json_.object([&] {
      append_box(json_, bounds);
      member(json_, "geometricError", bounds.geometric_error);
      if (is_root) json_.member("refine", "REPLACE");
      if (is_link || at.level >= naming_.first_content) {
        append_content(json_, std::string(naming_.prefix) +
                                  (is_link ? name_of("e", at, ".json") : name_of("c", at, ".glb")));
      }
      if (is_link || at.level + 1 >= naming_.levels) return;
      json_.array("children", [&] {
        for (std::int64_t k = 0; k < 4; ++k) {
          const Address child{at.level + 1, 2 * at.x + k % 2, 2 * at.y + k / 2};
          if (!naming_.has_tile || naming_.has_tile(child)) append(child, false);
        }
      });
    });
  }

 private:
  JsonWriter json_;
  const int end_;
  const Naming& naming_;
  const BoundsOf& bounds_of_;
};

void append_asset(JsonWriter& json) {
  json.object("asset", [&] { json.member("version", "1.1"); });
}

/// The class of the metadata of tiles.
constexpr std::string_view schema =
    R"({"id":"world","classes":{"tile":{"properties":{)"
    R"("box":{"type":"SCALAR","componentType":"FLOAT64","array":true,"count":12,"semantic":"TILE_BOUNDING_BOX","required":true},)"
    R"("error":{"type":"SCALAR","componentType":"FLOAT64","semantic":"TILE_GEOMETRIC_ERROR","required":true}}}}})";

void append_word(std::string& out, std::uint64_t word, int bytes) {
  for (int i = 0; i < bytes; ++i) out += static_cast<char>(word >> (8 * i) & 0xFFU);
}

void append_double(std::string& out, double value) {
  append_word(out, std::bit_cast<std::uint64_t>(value), 8);
}

void pad(std::string& text, char with) {
  constexpr std::size_t alignment = 8;
  while (text.size() % alignment != 0) text += with;
}

/// The binary chunk of a subtree, view by view.
class Chunk {
 public:
  /// Appends a view and returns its number.
  int add(const std::string& bytes) {
    pad(bytes_, '\0');
    JsonWriter json(views_);
    json.object([&] {
      json.member("buffer", 0);
      json.member("byteOffset", bytes_.size());
      json.member("byteLength", bytes.size());
    });
    bytes_ += bytes;
    return count_++;
  }
  const std::string& bytes() const { return bytes_; }
  const std::string& views() const { return views_; }

 private:
  std::string bytes_, views_;
  int count_ = 0;
};

/// The first `count` of `all` bits are 1.
std::string bits_of(std::uint32_t count, std::uint32_t all) {
  std::string bytes((all + 7) / 8, '\0');
  for (std::uint32_t i = 0; i < count; ++i)
    bytes[i >> 3U] = static_cast<char>(static_cast<unsigned char>(bytes[i >> 3U]) | 1U << (i & 7U));
  return bytes;
}

/// The tiles of a subtree in the order of their bits.
template <class Visit>
void each_tile(const Address& root, int levels, const Visit& visit) {
  for (int down = 0; down < levels; ++down) {
    for (std::uint32_t bit = 0; bit < 1U << (2 * down); ++bit) {
      std::uint32_t x = 0, y = 0;
      for (int k = 0; k < down; ++k) {
        x |= (bit >> (2 * k) & 1U) << k;
        y |= (bit >> (2 * k + 1) & 1U) << k;
      }
      visit(Address{root.level + down, (root.x << down) + x, (root.y << down) + y});
    }
  }
}

/// The file of two chunks.
std::string packed(std::string json, std::string bytes) {
  constexpr std::uint32_t magic = 0x74627573, version = 1;
  pad(json, ' ');
  pad(bytes, '\0');
  std::string file;
  file.reserve(24 + json.size() + bytes.size());
  append_word(file, magic, 4);
  append_word(file, version, 4);
  append_word(file, json.size(), 8);
  append_word(file, bytes.size(), 8);
  return file + json + bytes;
}

/// Box and error of each tile.
struct Values {
  std::string boxes, errors;
  std::uint32_t count = 0;
};

std::string written(const Address& root, int levels, const Values& values) {
  const int own = std::min(levels_a_subtree, levels - root.level);
  const bool is_full = own == levels_a_subtree;
  Chunk chunk;
  const int bits = is_full ? -1 : chunk.add(bits_of(tiles_of(own), tiles_of(levels_a_subtree)));
  const int boxes = chunk.add(values.boxes), errors = chunk.add(values.errors);
  const auto tiles = [&](JsonWriter& json) {
    if (is_full) return json.member("constant", 1);
    json.member("availableCount", tiles_of(own));
    json.member("bitstream", bits);
  };
  std::string text;
  JsonWriter json(text);
  json.object([&] {
    json.array("buffers", [&] { json.object([&] { json.member("byteLength", chunk.bytes().size()); }); });
    json.list("bufferViews", chunk.views());
    json.object("tileAvailability", [&] { tiles(json); });
    json.array("contentAvailability", [&] { json.object([&] { tiles(json); }); });
    json.object("childSubtreeAvailability",
                [&] { json.member("constant", root.level + levels_a_subtree < levels ? 1 : 0); });
    json.array("propertyTables", [&] {
      json.object([&] {
        json.member("class", "tile");
        json.member("count", values.count);
        json.object("properties", [&] {
          json.object("box", [&] { json.member("values", boxes); });
          json.object("error", [&] { json.member("values", errors); });
        });
      });
    });
    json.member("tileMetadata", 0);
  });
  return packed(std::move(text), chunk.bytes());
}

/// The error while no tile is drawn. CesiumJS hides a tileset whose error is below 16 pixels, so a world has its width.
double error_of_absence(const Address& root, const Bounds& bounds) {
  return root.level == 0 ? bounds.east - bounds.west : 2 * bounds.geometric_error;
}

}  // namespace

bool operator==(const Address& a, const Address& b) { return a.level == b.level && a.x == b.x && a.y == b.y; }

std::string explicit_tileset(const Address& root, const Naming& naming, const BoundsOf& bounds_of) {
  std::string out;
  JsonWriter json(out);
  json.object([&] {
    append_asset(json);
    member(json, "geometricError", error_of_absence(root, bounds_of(root)));
    json.key("root");
    std::string tiles;
    TileWriter(tiles, root, naming, bounds_of).append(root, true);
    json.json(tiles);
  });
  return out;
}

std::string implicit_tileset(double extent, double error, const Naming& naming, const BoundsOf& bounds_of) {
  Bounds whole = bounds_of({});
  whole.west = whole.south = -extent / 2;
  whole.east = whole.north = extent / 2;
  const std::string prefix(naming.prefix);
  std::string out;
  JsonWriter json(out);
  json.object([&] {
    append_asset(json);
    json.key("schema");
    json.json(schema);
    member(json, "geometricError", error_of_absence({}, whole));
    json.object("root", [&] {
      append_box(json, whole);
      json.member("refine", "REPLACE");
      member(json, "geometricError", error);
      append_content(json, prefix + "c/{level}/{x}/{y}.glb");
      json.object("implicitTiling", [&] {
        json.member("subdivisionScheme", "QUADTREE");
        json.member("availableLevels", naming.levels);
        json.member("subtreeLevels", levels_a_subtree);
        json.object("subtrees", [&] { json.member("uri", prefix + "s/{level}/{x}/{y}.subtree"); });
      });
    });
  });
  return out;
}

std::uint32_t tiles_of(int levels) { return ((1U << (2 * levels)) - 1) / 3; }

std::string subtree(const Address& root, int levels, const BoundsOf& bounds_of) {
  Values values;
  each_tile(root, std::min(levels_a_subtree, levels - root.level), [&](const Address& at) {
    const Bounds bounds = bounds_of(at);
    for (const double number : box_of(bounds)) append_double(values.boxes, number);
    append_double(values.errors, bounds.geometric_error);
    ++values.count;
  });
  return written(root, levels, values);
}

}  // namespace seedmesh::tiles
