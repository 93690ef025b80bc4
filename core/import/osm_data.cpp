// Assembly of OpenStreetMap elements; see osm_data.h. Source for areas: the pages "Area" and "Relation:multipolygon" of the
// OpenStreetMap wiki.
#include "core/import/osm_data.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geom/polygon/plan.h"
#include "core/import/map_rings.h"

namespace seedmesh {
namespace {

using glm::dvec2;

// Pairs of an outer ring and a hole that are compared.
constexpr std::size_t most_tried = 2'000'000;

/// Adds the tags whose names `tags` lacks.
void add_tags(MapTags& tags, const MapTags& more) {
  for (const auto& [name, value] : more.all()) {
    if (tags.get(name).empty()) tags.add(name, value);
  }
}

void merge(OsmNode&, const OsmNode&) {}

void merge(OsmWay& way, const OsmWay& other) {
  if (way.nodes.empty()) way.nodes = other.nodes;
  if (way.inline_points.empty()) way.inline_points = other.inline_points;
  if (!way.center) way.center = other.center;
}

void merge(OsmRelation& relation, const OsmRelation& other) {
  if (relation.members.empty()) relation.members = other.members;
  if (!relation.center) relation.center = other.center;
}

/// Sorts, and joins elements that occur twice: Overpass can write tags and nodes of a way apart.
template <class Element>
void sort_by_id(std::vector<Element>& elements) {
  const auto before = [](const Element& a, const Element& b) { return a.id < b.id; };
  std::stable_sort(elements.begin(), elements.end(), before);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (kept > 0 && elements[kept - 1].id == elements[i].id) {
      add_tags(elements[kept - 1].tags, elements[i].tags);
      merge(elements[kept - 1], elements[i]);
      continue;
    }
    if (kept != i) elements[kept] = std::move(elements[i]);
    ++kept;
  }
  elements.erase(elements.begin() + static_cast<std::ptrdiff_t>(kept), elements.end());
}

template <class Element>
const Element* find(const std::vector<Element>& elements, std::int64_t id) {
  const auto before = [](const Element& element, std::int64_t wanted) { return element.id < wanted; };
  const auto at = std::lower_bound(elements.begin(), elements.end(), id, before);
  return at != elements.end() && at->id == id ? &*at : nullptr;
}

/// Whether a closed way with these tags is an area.
bool is_area(const MapTags& tags) {
  if (tags.is("area", "yes") || tags.has("building") || tags.has("building:part")) return true;
  if (tags.is("area", "no")) return false;
  if (tags.has("highway") || tags.has("barrier") || tags.has("railway"))
    return tags.is("railway", "platform");
  if (tags.is("natural", "tree_row") || tags.is("natural", "coastline")) return false;
  constexpr std::array<std::string_view, 10> keys{
      "natural",      "landuse", "leisure",  "amenity",          "place",
      "area:highway", "golf",    "man_made", "public_transport", "boundary"};
  return std::any_of(keys.begin(), keys.end(), [&](std::string_view key) { return tags.has(key); }) ||
         tags.is("waterway", "riverbank") || tags.is("waterway", "dock");
}

WayPoints points_of(const OsmWay& way, const std::vector<OsmNode>& nodes) {
  if (!way.inline_points.empty()) return runs_of(way.inline_points);
  std::vector<dvec2> points;
  points.reserve(way.nodes.size());
  for (const std::int64_t id : way.nodes) {
    const OsmNode* node = find(nodes, id);
    points.push_back(node ? node->position : osm_unknown_point);
  }
  return runs_of(points);
}

class Assembler {
 public:
  Assembler(OsmFile file, const ImportOptions& options) : file_(std::move(file)), options_(options) {}

  MapData assemble() {
    sort_by_id(file_.nodes);
    sort_by_id(file_.ways);
    sort_by_id(file_.relations);
    is_consumed_.assign(file_.ways.size(), false);
    for (const OsmRelation& relation : file_.relations) add_relation(relation);
    for (std::size_t i = 0; i < file_.ways.size(); ++i) {
      if (!is_consumed_[i]) add_way(file_.ways[i]);
    }
    for (const OsmNode& node : file_.nodes) add_node(node);
    data_.bounds = file_.bounds;
    for (MapFeature& feature : features_) data_.features.push_back(std::move(feature));
    data_.warnings = std::move(file_.warnings);
    return std::move(data_);
  }

 private:
  void warn(const char* message, const MapPosition& place) { file_.warnings.add(message, place); }

  void count() {
    if (++elements_ % 256 == 0) options_.check();
  }

  void add_node(const OsmNode& node) {
    count();
    if (node.tags.all().empty()) return;
    MapFeature feature;
    feature.name = "node/" + std::to_string(node.id);
    feature.position = node.location;
    feature.tags = node.tags;
    feature.points.push_back(node.position);
    features_.push_back(std::move(feature));
  }

  /// Adds a way or relation of which only the centre is known, as a point.
  template <class Element>
  void add_center(const Element& element, const char* type) {
    warn(
        "an element has no geometry but a centre (`out center`), which is its position; `out geom` gives "
        "outlines",
        element.location);
    MapFeature feature;
    feature.name = type + std::to_string(element.id);
    feature.position = element.location;
    feature.tags = element.tags;
    feature.points.push_back(*element.center);
    features_.push_back(std::move(feature));
  }

  void add_way(const OsmWay& way) {
    count();
    if (way.tags.all().empty()) return;
    WayPoints read = points_of(way, file_.nodes);
    if (way.center && read.runs.empty()) return add_center(way, "way/");
    const bool is_closed =
        read.runs.size() == 1 && read.runs[0].size() > 3 && read.runs[0].front() == read.runs[0].back();
    const bool wants_area = is_area(way.tags);
    MapFeature feature;
    feature.name = "way/" + std::to_string(way.id);
    feature.position = way.location;
    feature.tags = way.tags;
    if (read.missing > 0) {
      warn(wants_area ? "an area refers to nodes that the file lacks; it is left out"
                      : "a line refers to nodes that the file lacks; it ends there",
           way.location);
    }
    if (wants_area && is_closed && read.missing == 0) {
      read.runs[0].pop_back();
      feature.polygons.push_back({std::move(read.runs[0])});
    } else if (!wants_area) {
      for (MapRing& run : read.runs) {
        if (run.size() > 1) feature.lines.push_back(std::move(run));
      }
      if (feature.lines.empty()) return;
    } else if (wants_area && read.missing == 0) {
      warn("an area is not closed; it is left out", way.location);
      return;
    } else {
      return;
    }
    features_.push_back(std::move(feature));
  }

  /// The tags of a multipolygon: its own, or by an old convention those of its outer way.
  MapTags tags_of(const OsmRelation& relation) const {
    if (is_area(relation.tags)) return relation.tags;
    for (const OsmMember& member : relation.members) {
      const OsmWay* way = member.role == OsmRole::inner ? nullptr : find(file_.ways, member.way);
      if (way && is_area(way->tags)) return way->tags;
    }
    return relation.tags;
  }

  /// The lines of a multipolygon by their roles.
  struct Lines {
    std::vector<MapRing> outer, inner;
    std::size_t missing = 0;
    bool has_unknown = false;
  };

  Lines lines_of(const OsmRelation& relation, MapTags& tags) {
    Lines lines;
    const auto outer_ways =
        std::count_if(relation.members.begin(), relation.members.end(),
                      [](const OsmMember& member) { return member.role != OsmRole::inner; });
    for (const OsmMember& member : relation.members) {
      const OsmWay* way = find(file_.ways, member.way);
      WayPoints read;
      if (!member.inline_points.empty()) {
        read = runs_of(member.inline_points);
      } else if (way) {
        read = points_of(*way, file_.nodes);
      } else {
        ++lines.missing;
      }
      lines.missing += read.missing;
      const bool is_inner = member.role == OsmRole::inner;
      if (member.role == OsmRole::unknown) lines.has_unknown = true;
      (is_inner ? lines.inner : lines.outer).push_back(read.joined());
      if (way && !is_inner) consume(*way, tags, outer_ways == 1);
    }
    return lines;
  }

  void add_relation(const OsmRelation& relation) {
    count();
    const std::string_view type = relation.tags.get("type");
    const bool has_lines =
        std::any_of(relation.members.begin(), relation.members.end(), [this](const OsmMember& member) {
          return !member.inline_points.empty() || find(file_.ways, member.way) != nullptr;
        });
    if (relation.center && !has_lines && !relation.tags.all().empty())
      return add_center(relation, "relation/");
    if (type == "building") add_outline(relation);
    if (type != "multipolygon" && type != "boundary") return;
    if (type == "boundary" && !is_area(relation.tags)) return;
    MapTags tags = tags_of(relation);
    if (tags.is("boundary", "administrative")) return;
    Lines lines = lines_of(relation, tags);
    if (lines.missing > 0)
      warn("a multipolygon refers to ways or nodes that the file lacks", relation.location);
    MapFeature feature;
    feature.name = "relation/" + std::to_string(relation.id);
    feature.position = relation.location;
    feature.tags = std::move(tags);
    std::size_t open = 0;
    std::vector<MapRing> outer = joined_rings(std::move(lines.outer), open),
                         inner = joined_rings(std::move(lines.inner), open);
    if (lines.has_unknown) take_inner(outer, inner);
    for (MapRing& ring : outer) feature.polygons.push_back({std::move(ring)});
    for (MapRing& ring : inner) add_hole(feature, std::move(ring));
    if (open > 0) warn("a ring of a multipolygon is not closed; it is left out", relation.location);
    if (!feature.polygons.empty()) features_.push_back(std::move(feature));
  }

  /// A relation `building` can have the tags of its outline, and with `out geom` also its geometry.
  void add_outline(const OsmRelation& relation) {
    if (!relation.tags.has("building")) return;
    std::vector<MapRing> lines;
    for (const OsmMember& member : relation.members) {
      if (member.role != OsmRole::outline) continue;
      const OsmWay* way = find(file_.ways, member.way);
      if (!way) {
        lines.push_back(runs_of(member.inline_points).joined());
      } else if (!way->tags.has("building:part")) {
        add_tags(file_.ways[static_cast<std::size_t>(way - file_.ways.data())].tags, relation.tags);
      }
    }
    if (lines.empty()) return;
    std::size_t open = 0;
    MapFeature feature;
    for (MapRing& ring : joined_rings(std::move(lines), open)) feature.polygons.push_back({std::move(ring)});
    if (feature.polygons.empty()) {
      return warn("a relation `building` refers to an outline that the file lacks; it is left out",
                  relation.location);
    }
    feature.name = "relation/" + std::to_string(relation.id);
    feature.position = relation.location;
    feature.tags = relation.tags;
    features_.push_back(std::move(feature));
  }

  /// An outer way of the same kind as its multipolygon counts once. All buildings are of the same kind. The only
  /// outer way gives the multipolygon its further tags.
  void consume(const OsmWay& way, MapTags& tags, bool is_only) {
    constexpr std::array<std::string_view, 6> keys{"building", "building:part", "natural",
                                                   "landuse",  "leisure",       "waterway"};
    const auto is_same = [&](std::string_view key) {
      return tags.has(key) &&
             (tags.get(key) == way.tags.get(key) || (key == "building" && way.tags.has(key)));
    };
    if (std::none_of(keys.begin(), keys.end(), is_same)) return;
    is_consumed_[static_cast<std::size_t>(&way - file_.ways.data())] = true;
    if (is_only) add_tags(tags, way.tags);
  }

  /// Whether a ring lies in another that it may touch.
  static bool lies_in(const MapRing& ring, const MapRing& other) {
    return contains(Plan{{other}}, ring[0]) && contains(Plan{{other}}, ring[1]);
  }

  /// Moves the rings inside an odd number of others to the holes.
  void take_inner(std::vector<MapRing>& outer, std::vector<MapRing>& inner) {
    std::vector<bool> is_inner(outer.size(), false);
    for (std::size_t i = 0; i < outer.size(); ++i) {
      std::size_t around = 0;
      for (std::size_t k = 0; k < outer.size() && tried_ < most_tried; ++k) {
        if (k == i || std::abs(signed_area(outer[k])) <= std::abs(signed_area(outer[i]))) continue;
        if (++tried_ % 64 == 0) options_.check();
        if (lies_in(outer[i], outer[k])) ++around;
      }
      is_inner[i] = around % 2 == 1;
    }
    std::vector<MapRing> kept;
    for (std::size_t i = 0; i < outer.size(); ++i)
      (is_inner[i] ? inner : kept).push_back(std::move(outer[i]));
    outer = std::move(kept);
  }

  /// Adds a hole to the smallest polygon around it.
  void add_hole(MapFeature& feature, MapRing ring) {
    std::vector<MapRing>* best = nullptr;
    double least = 0;
    for (std::vector<MapRing>& polygon : feature.polygons) {
      if (++tried_ > most_tried) break;
      options_.check();
      const double size = std::abs(signed_area(polygon[0]));
      const bool is_around = feature.polygons.size() == 1 || contains(Plan{{polygon[0]}}, ring[0]) ||
                             contains(Plan{{polygon[0]}}, ring[1]);
      if (!is_around || (best && size >= least)) continue;
      best = &polygon;
      least = size;
    }
    if (best) {
      best->push_back(std::move(ring));
    } else {
      warn("a hole of a multipolygon lies in none of its outer rings; it is left out", feature.position);
    }
  }

  OsmFile file_;
  const ImportOptions& options_;
  std::size_t elements_ = 0;
  std::vector<bool> is_consumed_;
  std::size_t tried_ = 0;  ///< pairs of an outer ring and a hole
  std::vector<MapFeature> features_;
  MapData data_;
};

}  // namespace

OsmRole osm_role(std::string_view name) {
  if (name == "inner" || name == "enclave") return OsmRole::inner;
  if (name == "outline") return OsmRole::outline;
  return name == "outer" ? OsmRole::outer : OsmRole::unknown;
}

std::optional<Error> stopped_query(OsmFile& file, std::string_view remark, const MapPosition& place,
                                   std::string_view text) {
  const std::size_t first = remark.find_first_not_of(" \t\r\n"), last = remark.find_last_not_of(" \t\r\n");
  if (first == std::string_view::npos) return std::nullopt;
  const std::string reason = shortened(remark.substr(first, last - first + 1), 200);
  if (!file.nodes.empty() || !file.ways.empty() || !file.relations.empty()) {
    file.warnings.add("the server stopped the query, and this map is not complete: " + reason, place);
    return std::nullopt;
  }
  std::string message = "the server stopped the query before it found anything: " + reason;
  Issue issue(IssueKind::invalid_value, place.pointer, std::move(message));
  if (!text.empty()) issue = issue_at(issue.kind, "", text, place.offset, issue.message);
  return Error{Code::invalid, {std::move(issue)}};
}

void add_bounds(std::optional<MapBounds>& bounds, const MapBounds& more) {
  if (!bounds) bounds = more;
  bounds->min = {std::min(bounds->min.x, more.min.x), std::min(bounds->min.y, more.min.y)};
  bounds->max = {std::max(bounds->max.x, more.max.x), std::max(bounds->max.y, more.max.y)};
}

MapData map_of(OsmFile file, const ImportOptions& options) {
  return Assembler(std::move(file), options).assemble();
}

}  // namespace seedmesh
