#include "core/generators/building/tags.h"

#include <algorithm>

#include "core/generators/building/evaluate.h"
#include "core/generators/building/operators.h"

namespace seedmesh::building {

std::uint32_t tag_set(Derivation& d, std::vector<std::uint32_t> tags) {
  std::ranges::sort(tags);
  tags.erase(std::unique(tags.begin(), tags.end()), tags.end());
  if (tags.empty()) return 0;
  const auto [found, is_new] =
      d.tag_set_ids.try_emplace(tags, static_cast<std::uint32_t>(d.out.tag_sets.size()));
  if (is_new) {
    d.job.spend(Resource::shapes, 1 + tags.size() / 16);
    d.out.tag_sets.push_back(std::move(tags));
  }
  return found->second;
}

std::uint32_t joined_tags(Derivation& d, std::uint32_t a, std::uint32_t b) {
  if (a == 0 || b == 0 || a == b) return a == 0 ? b : a;
  std::vector<std::uint32_t> all = d.out.tag_sets[a];
  all.insert(all.end(), d.out.tag_sets[b].begin(), d.out.tag_sets[b].end());
  return tag_set(d, std::move(all));
}

std::uint32_t with_tag(Derivation& d, std::uint32_t set, std::string_view name) {
  std::vector<std::uint32_t> tags = d.out.tag_sets[set];
  tags.push_back(d.out.texts.id_of(name));
  return tag_set(d, std::move(tags));
}

bool has_tag(const Derivation& d, std::uint32_t set, std::string_view name) {
  return std::ranges::any_of(d.out.tag_sets[set],
                             [&](std::uint32_t id) { return *d.out.texts.find(id) == name; });
}

namespace operators {

/// tag("a"), deleteTags("a"), deleteTags(): tags of all components of the shape.
void tag(Derivation& d, const Step& step, ShapeState& state, const Site&) {
  Style style = d.out.styles[state.style];
  const Argument* a = &d.grammar.arguments[step.first_argument];
  std::string name = step.argument_count > 0 ? text_of(d, a[step.argument_count - 1]) : std::string();
  if (step.op == Op::tag) {
    style.tags = with_tag(d, style.tags, name);
  } else {
    std::vector<std::uint32_t> tags = d.out.tag_sets[style.tags];
    const bool is_pattern = name.ends_with('*');
    if (is_pattern) name.pop_back();
    std::erase_if(tags, [&](std::uint32_t id) {
      const std::string& own = *d.out.texts.find(id);
      return step.argument_count == 0 || (is_pattern ? own.starts_with(name) : own == name);
    });
    style.tags = tag_set(d, std::move(tags));
    if (state.has_solid() && step.argument_count == 0) {
      Solid plain = d.out.solid_of(state.geometry);
      for (Face& face : plain.faces) face.tags = 0;
      state.geometry = add_solid(d, std::move(plain));
    }
  }
  state.style = style_with(d, style);
}

}  // namespace operators
}  // namespace seedmesh::building
