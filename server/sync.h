#pragma once
/// `seedmesh sync DIRECTORY`: makes the models of all request files below a directory, and only those that changed
/// (docs/pipelines.md). The Python client does the same on the same lock file (clients/python/src/seedmesh/sync.py).
#include <string>

#include "server/config.h"

namespace seedmesh {

struct SyncOptions {
  std::string directory;
  std::string server;  ///< address; "" = make the models here
  std::string key;     ///< API key for the server
  bool check = false;  ///< compare every byte and write nothing
  bool list = false;   ///< print the paths of the models and end
};

/// Models and lock file are written through temporary files, so that an interrupted run leaves no incomplete
/// file. Two runs on one directory at the same time are not supported. Prints a line for each change, error and
/// removed file, then their numbers.
///
/// A model counts as unchanged if the lock has the hash of its request file, its size and its engine; nothing is
/// sent or made for it. Removes the models of request files that are gone, unless they were changed by hand.
/// Returns the exit status: 0 for success; 1 if a request was refused, a check found a difference, or the run
/// was interrupted; 2 if a file cannot be written or there is no server.
int sync_command(const Config& config, const SyncOptions& options);

}  // namespace seedmesh
