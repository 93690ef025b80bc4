#pragma once
/// `seedmesh tiles world.json --levels 0-14 --box west,south,east,north -o dir`: a part of a world as files, for a
/// static file server or a CDN.
#include <string>

#include "server/config.h"

namespace seedmesh {

struct TilesOptions {
  std::string world;   ///< a file with the request, "-", or `preset.seed`
  std::string folder;  ///< created if it does not exist
  std::string levels;  ///< "0-14" or "7"; "": all
  std::string box;     ///< "west,south,east,north" in metres; "": the whole world
  std::string part;    ///< "3/8": part 3 of the parts 0 to 7; "": all
  bool quiet = false;  ///< no progress
};

/// Writes tileset.json, nested tilesets, tiles and the files that they share, on all cores. Files of the same
/// world and engine that the folder already has are kept. The same command therefore resumes an interrupted
/// run. Returns the exit status: 0; 1 for a refused request; 2 for wrong options, or a file that cannot be
/// written.
int tiles_command(const Config& config, const TilesOptions& options);

}  // namespace seedmesh
