#include "server/worlds.h"

#include <algorithm>
#include <charconv>

#include "server/permalink.h"

namespace seedmesh {
namespace {

constexpr std::uint64_t largest_token_text = 1U << 20U;  ///< bytes of a decompressed token

using Named = std::variant<std::shared_ptr<const NamedWorld>, Problem>;

/// A whole number without sign or leading zeros.
template <class Number>
std::optional<Number> whole_number(std::string_view text) {
  if (text.empty() || (text.size() > 1 && text.front() == '0') || text.front() == '-') return std::nullopt;
  Number value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

Named named(NamedWorld::Kind kind, const Result<Request>& request,
            const std::shared_ptr<WorldMemory>& memory) {
  if (!request) return problem_of(request.error());
  if (!is_world(*request)) {
    return problem(404,
                   "This is a request for " + std::string(request->generator()) + ", which has no tiles.");
  }
  if (const auto error = output_error_of_tiles(*request)) return problem_of(*error);
  Result<OpenWorld> open = open_world(*request, memory);
  if (!open) return problem_of(open.error());
  return std::make_shared<const NamedWorld>(
      NamedWorld{kind, *request, *std::move(open), world_token(*request)});
}

Named preset_world(std::string_view name, const Job::Options& options,
                   const std::shared_ptr<WorldMemory>& memory) {
  const auto dot = name.rfind('.');
  const std::string seed(name.substr(dot + 1));
  if (!whole_number<std::uint64_t>(seed))
    return problem(404, "A world by preset is named as preset.seed, with a seed below 2^64.");
  const std::string preset(name.substr(0, dot));
  const auto request = read_preset(preset, {{"seed", seed}}, options.limits);
  if (!request) return problem(404, no_preset(preset));
  return named(NamedWorld::Kind::preset, *request, memory);
}

/// The part of `text` before the first separator, which is removed with it.
std::string_view take(std::string_view& text, char separator) {
  const auto end = std::min(text.find(separator), text.size());
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return part;
}

std::optional<WorldPath> in_tree(WorldPath::Kind kind, std::string_view numbers, std::string_view extension) {
  if (!numbers.ends_with(extension)) return std::nullopt;
  numbers.remove_suffix(extension.size());
  const auto level = whole_number<int>(take(numbers, '/'));
  const auto x = whole_number<std::int64_t>(take(numbers, '/'));
  const auto y = whole_number<std::int64_t>(numbers);
  if (!level || !x || !y) return std::nullopt;
  return WorldPath{kind, {*level, *x, *y}, {}};
}

}  // namespace

std::string world_token(const Request& request) {
  std::string token = write_token(request.canonical(), engine_version());
  if (token.size() > longest_world_token) token.clear();
  return token;
}

Named read_world_name(std::string_view name, const Job::Options& options,
                      const std::shared_ptr<WorldMemory>& memory) {
  if (name.size() > longest_world_token) {
    return problem(
        414, "The token of a world has at most 2,000 characters, because the URL of every tile has it.");
  }
  if (name.find('.') != std::string_view::npos) return preset_world(name, options, memory);
  Result<Token> token = read_token(name, largest_token_text);
  if (!token && read_preset(name, {}, options.limits)) {
    const std::string preset(name);
    return problem(404, "\"" + preset + "\" is a preset; its worlds have a seed behind a dot, such as " +
                            preset + ".1.");
  }
  if (!token) return problem_of(token.error());
  const bool is_own = token->engine && *token->engine == engine_version();
  return named(is_own ? NamedWorld::Kind::own : NamedWorld::Kind::foreign,
               read_request(token->request, options), memory);
}

std::shared_ptr<const NamedWorld> Worlds::find(const std::string& name) {
  const std::lock_guard lock(mutex_);
  return by_name_.find(name);
}

void Worlds::insert(const std::string& name, std::shared_ptr<const NamedWorld> world) {
  constexpr std::uint64_t overhead = 4'096, copies = 4;
  const std::uint64_t bytes = overhead + name.size() + copies * world->request.canonical().size();
  const std::lock_guard lock(mutex_);
  by_name_.insert(name, std::move(world), bytes);
}

std::optional<WorldPath> read_world_path(std::string_view path) {
  using Kind = WorldPath::Kind;
  if (path == "tileset.json") return WorldPath{Kind::tileset};
  if (path == "implicit.json") return WorldPath{Kind::implicit};
  if (path == "world.json") return WorldPath{Kind::map};
  if (path.size() < 3 || path[1] != '/') return std::nullopt;
  const std::string_view rest = path.substr(2);
  switch (path[0]) {
    case 'c':
      return in_tree(Kind::tile, rest, ".glb");
    case 'e':
      return in_tree(Kind::nested, rest, ".json");
    case 's':
      return in_tree(Kind::subtree, rest, ".subtree");
    case 'a':
      if (rest.find('/') != std::string_view::npos) return std::nullopt;
      return WorldPath{Kind::shared, {}, rest};
    default:
      return std::nullopt;
  }
}

bool has_file(const WorldPath& path, int levels) {
  using Kind = WorldPath::Kind;
  const auto [level, x, y] = path.address;
  if (level >= levels || std::max(x, y) >= std::int64_t{1} << level) return false;
  if (path.kind == Kind::nested) return level > 0 && level % world_tileset_levels == 0;
  if (path.kind == Kind::subtree) return level % world_subtree_levels == 0;
  return true;
}

}  // namespace seedmesh
