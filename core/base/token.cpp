#include "core/base/token.h"

#include <cassert>

#include "core/base/base64url.h"
#include "core/base/deflate.h"

namespace seedmesh {

std::string write_token(std::string_view canonical, std::string_view engine) {
  assert(canonical.size() >= 2 && canonical.front() == '{');
  std::string text = R"({"engine":")";
  text += engine;
  text += '"';
  if (canonical[1] != '}') text += ',';
  text += canonical.substr(1);
  return base64url(deflate_raw(text));
}

std::string permalink(std::string_view token, std::string_view extension) {
  std::string url = "/v1/models/";
  url += token;
  url += '.';
  url += extension;
  return url;
}

}  // namespace seedmesh
