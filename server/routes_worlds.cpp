/// GET /v1/worlds/{world}/...: the files of a world as 3D Tiles.
#include <algorithm>

#include "server/caching.h"
#include "server/coded_body.h"
#include "server/compress.h"
#include "server/cors.h"
#include "server/http/text.h"
#include "server/routes.h"

namespace seedmesh {
namespace {

using Kind = WorldPath::Kind;

constexpr std::size_t smallest_compressed = 1'024;
constexpr std::size_t longest_location = 2'048;

/// A file to answer with: what it is, and what its bytes and its address depend on.
struct WantedFile {
  const NamedWorld& world;
  WorldPath path;
  std::string prefix = {};  ///< from the file to the folder of c, e, s and a; for tilesets
  WorldBox box = {};        ///< of a map
  WorldHeights heights = WorldHeights::none;

  /// Identifies the bytes within one engine version.
  std::string key() const {
    std::string text = "world\n" + world.request.canonical() + "\n";
    const auto add = [&text](auto number) { text += std::to_string(number) + " "; };
    add(static_cast<int>(path.kind));
    add(path.address.level);
    add(path.address.x);
    add(path.address.y);
    text += std::string(path.name) + "\n" + prefix;
    if (path.kind != Kind::map) return text;
    for (const double side : {box.west, box.south, box.east, box.north}) {
      char number[40];
      std::snprintf(number, sizeof number, " %.17g", side);
      text += number;
    }
    return text + (heights == WorldHeights::grid ? " heights" : "");
  }
};

std::string_view pattern_of(Kind kind) {
  switch (kind) {
    case Kind::tileset:
      return "/v1/worlds/{world}/tileset.json";
    case Kind::implicit:
      return "/v1/worlds/{world}/implicit.json";
    case Kind::nested:
      return "/v1/worlds/{world}/e/{level}/{x}/{y}.json";
    case Kind::subtree:
      return "/v1/worlds/{world}/s/{level}/{x}/{y}.subtree";
    case Kind::tile:
      return "/v1/worlds/{world}/c/{level}/{x}/{y}.glb";
    case Kind::shared:
      return "/v1/worlds/{world}/a/{name}";
    case Kind::map:
      return "/v1/worlds/{world}/world.json";
  }
  return {};
}

/// Coarser levels first; maps are no part of a picture.
int order_of(const WorldPath& path) {
  constexpr int last = 64;
  return path.kind == Kind::map ? last : path.address.level;
}

Result<WorldFile> made(const WantedFile& wanted, const Job::Options& options) {
  const OpenWorld& open = wanted.world.open;
  const TileAddress& at = wanted.path.address;
  const auto text = [](Result<std::string> bytes, const char* type) -> Result<WorldFile> {
    if (!bytes) return std::move(bytes).error();
    return WorldFile{*std::move(bytes), type};
  };
  switch (wanted.path.kind) {
    case Kind::tileset:
    case Kind::nested:
      return text(world_tileset(open, at, wanted.prefix, options), "application/json");
    case Kind::implicit:
      return text(world_implicit(open, wanted.prefix, options), "application/json");
    case Kind::subtree:
      return text(world_subtree(open, at, options), "application/octet-stream");
    case Kind::tile:
      return text(world_tile(open, at, options), "model/gltf-binary");
    case Kind::map:
      return text(world_map(open, wanted.box, wanted.heights, options), "application/json");
    case Kind::shared:
      break;
  }
  Result<std::optional<WorldFile>> file = world_file(open, wanted.path.name, options);
  if (!file) return std::move(file).error();
  if (!*file) return WorldFile{};  // without a type: there is none
  return **std::move(file);
}

/// The file from the cache, or made now.
Cache::Lookup file_of(const RequestContext& call, const WantedFile& wanted, const std::string& key) {
  const auto make = [&](const std::stop_token& stop) {
    Cache::Outcome outcome;
    const auto work = [&](const Job::Options& options) {
      Result<WorldFile> file = made(wanted, options);
      if (!file) {
        outcome = problem_of(file.error());
      } else if (file->media_type.empty()) {
        outcome = problem(404, "This world has no file of this name.");
      } else {
        auto entry = std::make_shared<CachedModel>();
        entry->product.media_type = std::move(file->media_type);
        auto payload = std::make_shared<Payload>();
        payload->add(std::move(file->bytes));
        entry->payload = std::move(payload);
        outcome = Cache::Entry(std::move(entry));
      }
    };
    if (auto refused = with_tile_worker(call, order_of(wanted.path), stop, work))
      return Cache::Outcome(*std::move(refused));
    return outcome;
  };
  return call.service.cache.get(key, call.request.disconnect_token, make);
}

/// The payload in the coding; in no coding where the file is small, or a binary file on a private network that the
/// settings except.
std::shared_ptr<const Payload> encoded(const RequestContext& call, const Cache::Entry& entry,
                                       const std::string& key, Coding& coding) {
  const Config& config = call.service.config;
  const bool stays = entry->product.media_type != "application/json" && config.plain_for_private &&
                     is_private_address(call.request.remote);
  if (stays || entry->payload->size() < smallest_compressed) coding = Coding::identity;
  if (coding == Coding::identity) return entry->payload;
  const std::string coded = std::string(name_of(coding)) + " " + key;
  if (const Cache::Entry known = call.service.cache.find(coded)) return known->payload;
  auto payload = std::make_shared<Payload>();
  payload->add(encode(coding, entry->payload->pieces(), Effort::fast));
  auto made = std::make_shared<CachedModel>();
  made->payload = payload;
  call.service.cache.put(coded, made);
  return payload;
}

/// The payload as a body. A tile is not refused for memory: it is small, and connections bound the number.
http::Slice body_of(const RequestContext& call, std::shared_ptr<const Payload> payload) {
  const std::uint64_t size = payload->size();
  if (auto held = call.service.in_flight_memory.hold(payload)) return {std::move(held), 0, size};
  return {std::move(payload), 0, size};
}

http::Response file_answer(const RequestContext& call, const WantedFile& wanted, Caching caching) {
  const auto accepted = choose_coding(call.request.header("Accept-Encoding"));
  if (!accepted) return refuse(call, not_acceptable());
  const std::string key = wanted.key();
  const std::string tag = tag_of(key, engine_version());
  http::Response response;
  response.set("Cache-Control", cache_control(call, caching));
  response.set("Vary", varies(call, "Accept-Encoding"));
  if (call.request.method != "POST" && matches(call.request.header("If-None-Match"), tag)) {
    response.status = 304;
    response.set("ETag", etag(tag, *accepted));
    return response;
  }
  call.service.in_flight_memory.wait(deadline_of(call));
  Cache::Lookup answer = file_of(call, wanted, key);
  if (const auto* refused = std::get_if<Problem>(&answer.outcome)) return refuse(call, *refused);
  const Cache::Entry entry = std::get<Cache::Entry>(answer.outcome);
  Coding coding = *accepted;
  std::shared_ptr<const Payload> payload = encoded(call, entry, key, coding);
  response.cache_use = answer.hit ? "hit" : "miss";
  response.type = entry->product.media_type;
  response.set("ETag", etag(tag, coding));
  if (coding != Coding::identity) response.set("Content-Encoding", std::string(name_of(coding)));
  response.body = body_of(call, std::move(payload));
  return response;
}

/// "../<token>/<grant>/": from a root to the folder of the files below it.
std::string prefix_of(const RequestContext& call, const std::string& token, bool has_segment) {
  return std::string(has_segment ? "../../" : "../") + token + "/" +
         call.service.access.world_segment(call.grant, token);
}

std::string address_of(const RequestContext& call, const std::string& token, std::string_view file) {
  return "/v1/worlds/" + token + "/" + call.service.access.world_segment(call.grant, token) +
         std::string(file);
}

Problem too_long() {
  return problem_of(
      {Code::limit,
       {{IssueKind::limit, "", "found a token of more than 2,000 characters, expected at most 2,000"}}});
}

/// Returns an issue for each key of a query except one.
std::vector<Issue> keys_but(const Overrides& query, std::string_view known) {
  constexpr std::size_t most_issues = 20;
  std::vector<Issue> issues;
  for (const auto& [key, value] : query) {
    if (key == known || issues.size() == most_issues) continue;
    issues.emplace_back(IssueKind::unknown_key, "/" + key,
                        known.empty() ? "expected no query" : "expected " + std::string(known) + " alone");
  }
  return issues;
}

/// Refuses the query of a file or a request that takes none.
http::Response refuse_keys(const RequestContext& call) {
  auto query = parse_query(call);
  if (auto* refusal = std::get_if<http::Response>(&query)) return std::move(*refusal);
  return refuse(call, problem_of({Code::invalid, keys_but(std::get<Overrides>(query), "")}));
}

/// Reads the one parameter of a map's query.
std::variant<WorldBox, http::Response> box_of(const RequestContext& call, const OpenWorld& world) {
  auto query = parse_query(call);
  if (auto* refusal = std::get_if<http::Response>(&query)) return std::move(*refusal);
  const Overrides& given = std::get<Overrides>(query);
  std::vector<Issue> issues = keys_but(given, "box");
  if (issues.empty() && given.size() != 1) {
    issues.emplace_back(given.empty() ? missing_for({"box"}) : conflict_with({}), "/box",
                        "expected one box=west,south,east,north in metres");
  }
  if (!issues.empty()) return refuse(call, problem_of({Code::invalid, std::move(issues)}));
  Result<WorldBox> box = read_world_box(world, given.front().second);
  if (!box) return refuse(call, problem_of(box.error()));
  return *box;
}

/// A URL of a world in parts: "<name>/<segment>/<file>", where the segment may be missing.
struct Parts {
  std::string_view name, segment, file;
};

Parts parts_of(std::string_view path) {
  Parts parts;
  const auto end = std::min(path.find('/'), path.size());
  parts.name = path.substr(0, end);
  parts.file = path.substr(std::min(end + 1, path.size()));
  const std::string_view first = parts.file.substr(0, std::min(parts.file.find('/'), parts.file.size()));
  if (first.find("signature=") == std::string_view::npos) return parts;
  parts.segment = first;
  parts.file.remove_prefix(std::min(first.size() + 1, parts.file.size()));
  return parts;
}

http::Response redirect_to_own(const RequestContext& call, const NamedWorld& world, std::string_view file) {
  http::Response response;
  response.status = 307;
  response.set("Location", address_of(call, world.token, file));
  response.set("Cache-Control", "no-store");
  response.log_text = "world of another engine version";
  return response;
}

/// The world of a URL, from memory or read now.
std::variant<std::shared_ptr<const NamedWorld>, http::Response> world_of(const RequestContext& call,
                                                                         std::string_view name) {
  Worlds& worlds = call.service.worlds;
  const std::string key(name);
  if (auto known = worlds.find(key)) return known;
  auto read = read_world_name(name, options_without_worker(call), worlds.memory());
  if (const auto* refused = std::get_if<Problem>(&read)) return refuse(call, *refused);
  auto world = std::get<std::shared_ptr<const NamedWorld>>(std::move(read));
  if (auto refusal = check_allowed(call, world->request)) return std::move(*refusal);
  worlds.insert(key, world);
  return world;
}

http::Response answer(const RequestContext& call, const NamedWorld& world, const Parts& parts,
                      const WorldPath& path) {
  if (!has_file(path, world.open.levels())) return refuse(call, problem(404, "The world has no such tile."));
  if (world.kind == NamedWorld::Kind::foreign) {
    if (path.is_root() && !world.token.empty()) return redirect_to_own(call, world, parts.file);
    return refuse(
        call,
        problem(404, "Tiles are only available under the token of this engine, which tileset.json names."));
  }
  WantedFile wanted{.world = world, .path = path};
  if (path.kind == Kind::map) {
    auto box = box_of(call, world.open);
    if (auto* refusal = std::get_if<http::Response>(&box)) return std::move(*refusal);
    wanted.box = std::get<WorldBox>(box);
  } else if (call.query().find_first_not_of('&') != std::string_view::npos) {
    return refuse_keys(call);
  }
  if (path.is_root()) {
    if (world.token.empty()) return refuse(call, too_long());
    wanted.prefix = prefix_of(call, world.token, !parts.segment.empty());
    return file_answer(call, wanted, Caching::revalidate);
  }
  if (path.kind == Kind::nested) wanted.prefix = "../../../";
  const bool is_fixed = world.kind == NamedWorld::Kind::own;
  return file_answer(call, wanted, is_fixed ? Caching::immutable : Caching::revalidate);
}

}  // namespace

http::Response get_world(RequestContext& call) {
  const Parts parts = parts_of(call.name);
  auto admitted = call.service.access.admit_world(call.request, parts.name, parts.segment);
  if (const auto* denial = std::get_if<Denial>(&admitted)) return deny(call, *denial);
  call.grant = std::get<Grant>(std::move(admitted));
  if (parts.name.size() > longest_world_token)
    return refuse(call, problem(414, "The token of a world has at most 2,000 characters."));
  const std::optional<WorldPath> path = read_world_path(parts.file);
  if (!path) return refuse(call, problem(404, "A world has no file of this name."));
  auto found = world_of(call, parts.name);
  if (auto* refusal = std::get_if<http::Response>(&found)) return std::move(*refusal);
  const auto world = std::get<std::shared_ptr<const NamedWorld>>(std::move(found));
  http::Response response = answer(call, *world, parts, *path);
  response.route = pattern_of(path->kind);
  if (call.grant.by == Grant::By::key) {
    response.log_fields.emplace_back("key", call.grant.key);
    call.service.metrics.used(call.grant.key);
  }
  return response;
}

http::Response post_world(RequestContext& call, const Request& request) {
  if (const auto error = output_error_of_tiles(request)) return refuse(call, problem_of(*error));
  Result<OpenWorld> open = open_world(request, call.service.worlds.memory());
  if (!open) return refuse(call, problem_of(open.error()));
  const NamedWorld world{NamedWorld::Kind::own, request, *std::move(open), world_token(request)};
  if (world.token.empty()) return refuse(call, too_long());
  WantedFile wanted{.world = world, .path = {Kind::tileset}};
  const std::string location = address_of(call, world.token, "tileset.json");
  // Clients resolve the addresses in it against Content-Location.
  const bool has_segment = std::count(location.begin(), location.end(), '/') > 4;
  wanted.prefix = prefix_of(call, world.token, has_segment);
  http::Response response = file_answer(call, wanted, Caching::revalidate);
  if (location.size() <= longest_location + longest_world_token) response.set("Content-Location", location);
  return response;
}

http::Response derive_world(RequestContext& call, const Request& request) {
  if (!is_world(request)) return refuse_keys(call);
  Result<OpenWorld> open = open_world(request, call.service.worlds.memory());
  if (!open) return refuse(call, problem_of(open.error()));
  const NamedWorld world{NamedWorld::Kind::own, request, *std::move(open), {}};
  auto box = box_of(call, world.open);
  if (auto* refusal = std::get_if<http::Response>(&box)) return std::move(*refusal);
  const WantedFile wanted{
      .world = world, .path = {Kind::map}, .box = std::get<WorldBox>(box), .heights = WorldHeights::grid};
  return file_answer(call, wanted, Caching::revalidate);
}

void open_to_pages(const Service& service, const http::Request& request, http::Response& response) {
  const std::vector<std::string>& origins = service.config.cors_origins;
  const bool any = origins.empty() || std::find(origins.begin(), origins.end(), "*") != origins.end();
  if (!any) return;
  response.set("Access-Control-Allow-Origin", "*");
  if (origins.empty()) allow_origin({"*"}, request, response);
}

}  // namespace seedmesh
