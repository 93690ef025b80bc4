/// The images that models name by URL.
#include "core/pipeline.h"
#include "core/pipeline/guarded.h"
#include "core/texture/link.h"

namespace seedmesh {

Result<std::shared_ptr<const Image>> make_texture(std::string_view name, const Job::Options& options,
                                                  TextureStore* texture_store) {
  const std::optional<texture::Link> link = texture::read_link(name);
  if (!link) {
    return Error{Code::invalid,
                 {{IssueKind::not_available, "",
                   "found \"" + std::string(name.substr(0, 100)) +
                       "\"; expected kind, seed, size and channel of a generated texture, as in "
                       "\"oak_bark.17.512.color\""}}};
  }
  return guarded<std::shared_ptr<const Image>>([&]() -> Result<std::shared_ptr<const Image>> {
    const Job job(link->recipe.seed, options);
    return texture::image_of(*link, texture_store, job);
  });
}

}  // namespace seedmesh
