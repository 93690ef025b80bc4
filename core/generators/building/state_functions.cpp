/// Properties of a shape (scope, component, first shape), assets, and other shapes; see value_functions.h.
#include <algorithm>
#include <cmath>

#include "core/base/math.h"
#include "core/generators/building/value_functions.h"

namespace seedmesh::building {
namespace {

using lang::TaggedValue;

const ShapeState& seen(const Evaluation& at) { return *at.d.seen; }

/// The rotation of axes as angles about x, then y, then z, in degrees (rotation.h).
glm::dvec3 angles_of(const glm::dmat3& m) {
  const double sine = std::clamp(-m[0].z, -1.0, 1.0);
  if (std::abs(sine) > 1 - 1e-12)
    return {math::degrees(math::atan2(-m[2].y, m[1].y)), sine > 0 ? 90.0 : -90.0, 0};
  return {math::degrees(math::atan2(m[1].z, m[2].z)), math::degrees(math::asin(sine)),
          math::degrees(math::atan2(m[0].y, m[0].x))};
}

template <int axis>
TaggedValue rotation(Evaluation& at, ValueArguments) {
  return number_value(angles_of(at.d.out.axes[seen(at).axes])[axis]);
}
TaggedValue elevation(Evaluation& at, ValueArguments) { return number_value(seen(at).origin.y); }
TaggedValue selector(Evaluation& at, ValueArguments) {
  const std::uint16_t word = seen(at).selector;
  return text_value(at, word < at.d.grammar.words.size() ? at.d.grammar.words[word] : std::string());
}

template <int axis>
TaggedValue first_origin(Evaluation& at, ValueArguments) {
  return number_value(at.d.out.shapes[0].origin[axis]);
}
TaggedValue zero(Evaluation&, ValueArguments) { return number_value(0); }
TaggedValue start_rule(Evaluation& at, ValueArguments) {
  return text_value(at, at.d.grammar.symbols[at.d.grammar.start].name);
}
TaggedValue first_name(Evaluation& at, ValueArguments) { return text_value(at, "building"); }
template <int axis>
TaggedValue pivot(Evaluation& at, ValueArguments) {
  return number_value(seen(at).origin[axis]);
}

TaggedValue no_text(Evaluation& at, ValueArguments) { return text_value(at, ""); }

/// The shape's random state from 0 to 714024, as CityEngine counts it.
TaggedValue seedian(Evaluation& at, ValueArguments) {
  return number_value(static_cast<double>(at.d.out.shapes[at.d.seen_shape].key % 714'025));
}
TaggedValue tree_key(Evaluation& at, ValueArguments) {
  return text_value(at, std::to_string(at.d.out.shapes[at.d.seen_shape].key));
}
TaggedValue print(Evaluation& at, ValueArguments a) {
  warn(at.d, at.offset, "print: " + text_in(at, a[0]));
  return a[0];
}

/// convert(x, scope, world, pos, 1, 0, 0): a coordinate of a position or direction in another frame.
TaggedValue convert(Evaluation& at, ValueArguments a) {
  const std::string component = text_in(at, a[0]), kind = text_in(at, a[3]);
  if (component.size() != 1 || component[0] < 'x' || component[0] > 'z' || (kind != "pos" && kind != "dir"))
    reject(at, "convert takes (x | y | z, from, to, pos | dir, x, y, z)");
  glm::dvec3 p(number_in(at, a[4]), number_in(at, a[5]), number_in(at, a[6]));
  const ShapeState& state = seen(at);
  const glm::dmat3& axes = at.d.out.axes[state.axes];
  const auto is_scope = [&](const TaggedValue& value) {
    const std::string frame = text_in(at, value);
    if (frame != "scope" && frame != "pivot" && frame != "object" && frame != "world")
      reject(at, "found the frame " + lang::in_quotes(frame) + ", expected scope, pivot, object or world");
    return frame == "scope" || frame == "pivot";
  };
  const double moves = kind == "pos" ? 1 : 0;
  if (is_scope(a[1])) p = state.origin * moves + axes * p;
  if (is_scope(a[2])) p = glm::transpose(axes) * (p - state.origin * moves);
  return number_value(p[component[0] - 'x']);
}

TaggedValue geo_coordinate(Evaluation& at, ValueArguments) {
  reject(at, "a request has no coordinates on the earth, so that getGeoCoord has no result");
}

const AssetBox* asset_named(const Evaluation& at, std::string name) {
  if (const std::size_t slash = name.find_last_of('/'); slash != std::string::npos)
    name = name.substr(slash + 1);
  for (const bool is_whole : {true, false}) {
    if (!is_whole) name = name.substr(0, name.find_last_of('.'));
    for (const AssetBox& asset : at.d.task.assets) {
      if (asset.name == name) return &asset;
    }
  }
  return nullptr;
}

TaggedValue asset_info(Evaluation& at, ValueArguments a) {
  const std::string key = text_in(at, a[1]);
  const AssetBox* const asset = asset_named(at, text_in(at, a[0]));
  if (asset == nullptr) {
    warn(at.d, at.offset,
         "the request has no asset " + lang::in_quotes(text_in(at, a[0])) + ", so that its sizes are 1");
    return number_value(key.starts_with("s") ? 1 : 0);
  }
  if (key.size() == 2 && key[1] >= 'x' && key[1] <= 'z') {
    if (key[0] == 's') return number_value(asset->size[key[1] - 'x']);
    if (key[0] == 't') return number_value(asset->low[key[1] - 'x']);
  }
  return number_value(0);
}

TaggedValue image_info(Evaluation& at, ValueArguments) {
  warn(at.d, at.offset, "images are not read while rules run, so that imageInfo is 0");
  return number_value(0);
}

/// The difference of the proportions, or of the sizes, of an asset and the scope, over the axes that the text names.
double misfit(const Evaluation& at, const AssetBox& asset, const std::string& axes, bool by_size) {
  const glm::dvec3 size = seen(at).size;
  double sum = 0, scope_sum = 0, asset_sum = 0;
  for (const char c : axes) {
    if (c < 'x' || c > 'z') continue;
    scope_sum += size[c - 'x'];
    asset_sum += asset.size[c - 'x'];
  }
  for (const char c : axes) {
    if (c < 'x' || c > 'z') continue;
    const double a = size[c - 'x'] / (by_size || scope_sum == 0 ? 1 : scope_sum);
    const double b = asset.size[c - 'x'] / (by_size || asset_sum == 0 ? 1 : asset_sum);
    sum += (a - b) * (a - b);
  }
  return sum;
}

/// assetsSortSize("a;b;", xy, ...): names of assets, those that fit the scope best first.
template <bool by_size, bool is_first>
TaggedValue sort_assets(Evaluation& at, ValueArguments a) {
  std::string list = text_in(at, a[0]);
  std::vector<std::pair<double, std::string>> rows;
  for (std::size_t from = 0; from < list.size();) {
    const std::size_t to = std::min(list.find(';', from), list.size());
    const std::string name = list.substr(from, to - from);
    const AssetBox* const asset = asset_named(at, name);
    if (!name.empty()) {
      rows.emplace_back(
          asset == nullptr ? 1e300 : misfit(at, *asset, a.size() > 1 ? text_in(at, a[1]) : "xyz", by_size),
          name);
    }
    from = to + 1;
  }
  std::ranges::stable_sort(rows, {}, &std::pair<double, std::string>::first);
  std::string out;
  for (const auto& row : rows) out += row.second + ";";
  if (is_first) return text_value(at, rows.empty() ? std::string() : rows[0].second);
  return text_value(at, out);
}

/// The keys of a shape and its ancestors, its own first.
std::vector<std::uint64_t> lineage_of(const Evaluation& at) {
  std::vector<std::uint64_t> lineage;
  for (std::uint32_t s = at.d.seen_shape; s != none; s = at.d.out.shapes[s].parent)
    lineage.push_back(at.d.out.shapes[s].key);
  return lineage;
}

template <Query::Kind kind>
TaggedValue ask(Evaluation& at, ValueArguments a) {
  if (at.d.first_pass == nullptr) return number_value(kind == Query::Kind::distance ? 1e6 : 0);
  Query query;
  query.kind = kind;
  query.target = text_in(at, a[a.size() > 1 ? 1 : 0]);
  const std::vector<std::uint64_t> lineage = lineage_of(at);
  return number_value(at.d.first_pass->answer(
      query, {seen(at).origin, seen(at).size, at.d.out.axes[seen(at).axes]}, lineage, at.d.job));
}

TaggedValue context_compare(Evaluation& at, ValueArguments a) {
  warn(at.d, at.offset, "contextCompare compares no values: it is the number of other shapes with the label");
  return ask<Query::Kind::count>(at, a);
}

constexpr ValueFunctionRow rows[] = {
    {"scope.rx", 0, 0, rotation<0>, "", "The rotation of the scope about x, in degrees.",
     "A --> report(\"x\", scope.rx) B."},
    {"scope.ry", 0, 0, rotation<1>, "", "The rotation about y.", "A --> report(\"x\", scope.ry) B."},
    {"scope.rz", 0, 0, rotation<2>, "", "The rotation about z.", "A --> report(\"x\", scope.rz) B."},
    {"scope.elevation", 0, 0, elevation, "", "The height of the scope above the origin of the world.",
     "A --> report(\"x\", scope.elevation) B."},
    {"pivot.px", 0, 0, pivot<0>, "", "The position of the scope along x.",
     "A --> report(\"x\", pivot.px) B."},
    {"pivot.py", 0, 0, pivot<1>, "", "The position along y.", "A --> report(\"x\", pivot.py) B."},
    {"pivot.pz", 0, 0, pivot<2>, "", "The position along z.", "A --> report(\"x\", pivot.pz) B."},
    {"pivot.ox", 0, 0, rotation<0>, "", "The rotation about x.", "A --> report(\"x\", pivot.ox) B."},
    {"pivot.oy", 0, 0, rotation<1>, "", "The rotation about y.", "A --> report(\"x\", pivot.oy) B."},
    {"pivot.oz", 0, 0, rotation<2>, "", "The rotation about z.", "A --> report(\"x\", pivot.oz) B."},
    {"comp.sel", 0, 0, selector, "", "The selector that took the shape in its component split, as a text.",
     "A --> comp(f){ front: case comp.sel == \"front\": B. else: C. }"},
    {"initialShape.name", 0, 0, first_name, "", "The name of the first shape.",
     "A --> label(initialShape.name) B."},
    {"initialShape.startRule", 0, 0, start_rule, "", "The start symbol.",
     "A --> label(initialShape.startRule) B."},
    {"initialShape.origin.px", 0, 0, first_origin<0>, "", "The position of the first shape along x.",
     "A --> report(\"x\", initialShape.origin.px) B."},
    {"initialShape.origin.py", 0, 0, first_origin<1>, "", "The position along y.",
     "A --> report(\"x\", initialShape.origin.py) B."},
    {"initialShape.origin.pz", 0, 0, first_origin<2>, "", "The position along z.",
     "A --> report(\"x\", initialShape.origin.pz) B."},
    {"initialShape.origin.ox", 0, 0, zero, "", "The rotation of the first shape about x, which is 0.",
     "A --> report(\"x\", initialShape.origin.ox) B."},
    {"initialShape.origin.oy", 0, 0, zero, "", "The rotation about y.",
     "A --> report(\"x\", initialShape.origin.oy) B."},
    {"initialShape.origin.oz", 0, 0, zero, "", "The rotation about z.",
     "A --> report(\"x\", initialShape.origin.oz) B."},
    {"trim.horizontal", 0, 0, zero, "",
     "Whether horizontal trim planes cut inserted assets, which they do not.",
     "A --> case trim.horizontal: B. else: C."},
    {"trim.vertical", 0, 0, zero, "", "Whether vertical trim planes cut inserted assets, which they do not.",
     "A --> case trim.vertical: B. else: C."},
    {"seedian", 0, 0, seedian, "", "A number from 0 to 714024 by the position in the derivation.",
     "A --> case seedian >= 0: B. else: C."},
    {"getTreeKey", 0, 0, tree_key, "", "A text that no other shape has.", "A --> label(getTreeKey()) B."},
    {"print", 1, 1, print, "value", "The value; a warning in the response states it.",
     "A --> s(print(2), '1, '1) B."},
    {"convert", 7, 7, convert, "axis, from, to, pos | dir, x, y, z",
     "A coordinate of a position or direction in another of the frames scope, pivot, object and world.",
     "A --> report(\"x\", convert(y, scope, world, pos, 0, scope.sy, 0)) B."},
    {"getGeoCoord", 0, 2, geo_coordinate, "lat | lon",
     "Has no result, because a request has no coordinates on the earth: its use is an error.", ""},
    {"assetInfo", 2, 2, asset_info, "asset, sx | sy | sz | tx | ty | tz",
     "A size or the low corner of an asset.", "A --> s(assetInfo(\"window\", \"sx\"), '1, '1) B."},
    {"assetNamingInfo", 2, 2, no_text, "asset, key",
     "The empty text: assets of a request have no such notes.",
     "A --> label(\"n\" + assetNamingInfo(\"window\", \"lod\")) B."},
    {"assetNamingInfos", 1, 1, no_text, "asset", "The empty text.",
     "A --> label(\"n\" + assetNamingInfos(\"window\")) B."},
    {"assetMetadata", 2, 2, no_text, "asset, key", "The empty text: assets of a request have no such notes.",
     "A --> label(\"n\" + assetMetadata(\"window\", \"author\")) B."},
    {"imageInfo", 2, 2, image_info, "image, key", "0, with a warning: images are not read while rules run.",
     "A --> s(1 + imageInfo(\"a.jpg\", \"sx\"), '1, '1) B."},
    {"imageAspectRatio", 1, 1, image_info, "image", "0, with a warning.",
     "A --> s(1 + imageAspectRatio(\"a.jpg\"), '1, '1) B."},
    {"assetsSortSize", 2, 3, sort_assets<true, false>, "assets, axes, error",
     "A list of assets, the nearest in size to the scope first.",
     "A --> label(assetsSortSize(\"door;window;\", \"xy\", 0)) B."},
    {"assetsSortRatio", 2, 3, sort_assets<false, false>, "assets, axes, error",
     "A list of assets by their proportions.",
     "A --> label(assetsSortRatio(\"door;window;\", \"xy\", 0)) B."},
    {"imagesSortRatio", 1, 3, sort_assets<false, false>, "images, axes, error",
     "The list without a change, because the names of images are no assets.",
     "A --> label(imagesSortRatio(\"a;b;\", \"xy\", 0)) B."},
    {"assetBestSize", 2, 2, sort_assets<true, true>, "assets, axes",
     "The asset that is nearest in size to the scope.",
     "A --> label(assetBestSize(\"door;window;\", \"xy\")) B."},
    {"assetFitSize", 2, 2, sort_assets<true, true>, "assets, axes",
     "The asset that is nearest in size to the scope.",
     "A --> label(assetFitSize(\"door;window;\", \"xy\")) B."},
    {"assetApproxSize", 2, 3, sort_assets<true, true>, "assets, axes, error",
     "The asset that is nearest in size to the scope.",
     "A --> label(assetApproxSize(\"door;window;\", \"xy\", 0.5)) B."},
    {"assetBestRatio", 2, 2, sort_assets<false, true>, "assets, axes",
     "The asset with the nearest proportions.", "A --> label(assetBestRatio(\"door;window;\", \"xy\")) B."},
    {"assetApproxRatio", 2, 3, sort_assets<false, true>, "assets, axes, error",
     "The asset with the nearest proportions.",
     "A --> label(assetApproxRatio(\"door;window;\", \"xy\", 0.5)) B."},
    {"imageBestRatio", 1, 2, sort_assets<false, true>, "images, axes", "The first image of the list.",
     "A --> label(imageBestRatio(\"a;b;\", \"xy\")) B."},
    {"imageApproxRatio", 1, 3, sort_assets<false, true>, "images, axes, error",
     "The first image of the list.", "A --> label(imageApproxRatio(\"a;b;\", \"xy\", 0.5)) B."},
    {"contextCount", 1, 2, ask<Query::Kind::count>, "intra | inter | all, label",
     "The number of other shapes with a label.",
     "A --> split(x){ ~1: label(\"a\") B }*  B --> case contextCount(intra, \"a\") > 1: C. else: D."},
    {"minimumDistance", 1, 2, ask<Query::Kind::distance>, "intra | inter | all, label",
     "The distance of the scopes to the nearest other shape with a label.",
     "A --> split(x){ ~1: label(\"a\") B }*  B --> case minimumDistance(intra, \"a\") < 1: C. else: D."},
    {"contextCompare", 2, 3, context_compare, "intra | inter | all, label, value",
     "The number of other shapes with a label. Values are not compared.",
     "A --> case contextCompare(intra, \"a\", scope.sx) == 0: B. else: C."},
    {"edgeAttr.getFloat", 1, 2, zero, "name", "0: footprints of a request have no attributes of edges.",
     "A --> s(1 + edgeAttr.getFloat(\"width\"), '1, '1) B."},
    {"edgeAttr.getString", 1, 2, no_text, "name", "The empty text.",
     "A --> label(\"e\" + edgeAttr.getString(\"name\")) B."},
    {"edgeAttr.getBool", 1, 2, zero, "name", "False.", "A --> case edgeAttr.getBool(\"open\"): B. else: C."},
};

}  // namespace

std::span<const ValueFunctionRow> state_functions() { return rows; }

}  // namespace seedmesh::building
