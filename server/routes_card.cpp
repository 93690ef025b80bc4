/// GET /m/{token}: the address of a model for people. Programs that show links as cards read the name and picture of
/// the model; browsers go on to the page, whose fragment they do not send.
#include "server/html_text.h"
#include "server/permalink.h"
#include "server/routes.h"

namespace seedmesh {
namespace {

constexpr std::uint64_t largest_token_text = 1U << 20U;  ///< bytes of a decompressed token
constexpr const char* picture_query = "?size=1000x524";

/// The preset by whose name the model is called, for its title; null for none.
const PresetInfo* preset_of(const Request& request) {
  const PresetInfo* found = nullptr;
  for (const PresetInfo& preset : presets()) {
    const bool is_first = request.name() == preset.name || request.name().starts_with(preset.name + "_");
    if (is_first && preset.generator == request.generator() &&
        (!found || preset.name.size() > found->name.size()))
      found = &preset;
  }
  return found;
}

std::string meta(std::string_view attribute, std::string_view name, std::string_view content) {
  return "<meta " + std::string(attribute) + "=\"" + std::string(name) + "\" content=\"" +
         html_text(content) + "\">\n";
}

/// `picture`: its signed path; "" for none.
std::string page_of(const Request& request, const std::string& token, const std::string& origin,
                    const std::string& picture) {
  const PresetInfo* preset = preset_of(request);
  const std::string title = preset ? preset->title : request.name();
  const std::string text =
      preset ? preset->description : "A 3D model of the generator " + std::string(request.generator());
  const std::string place = "../#" + token + (preset ? "." + preset->name : "");
  std::string html = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>" +
                     html_text(title) + "</title>\n";
  html += meta("name", "description", text);
  html += meta("property", "og:type", "website") + meta("property", "og:site_name", "Seedmesh");
  html += meta("property", "og:title", title) + meta("property", "og:description", text);
  html += meta("property", "og:url", origin + "/m/" + token);
  if (!picture.empty()) {
    html += meta("property", "og:image", origin + picture) + meta("property", "og:image:alt", title);
    html += meta("property", "og:image:type", "image/webp");
    html += meta("property", "og:image:width", "1000") + meta("property", "og:image:height", "524");
  }
  html += meta("name", "twitter:card", "summary_large_image");
  html += meta("http-equiv", "refresh", "0;url=" + place);
  return html + "</head>\n<body><p><a href=\"" + html_text(place) + "\">" + html_text(title) +
         "</a></p></body>\n</html>\n";
}

}  // namespace

http::Response get_card(RequestContext& call) {
  Result<Token> token = read_token(call.name, std::min(call.service.config.body_limit, largest_token_text));
  if (!token) return refuse(call, problem_of(token.error()));
  auto read = read_text(call, token->request);
  if (auto* refusal = std::get_if<http::Response>(&read)) return std::move(*refusal);
  const Request request = std::get<Request>(std::move(read));
  const std::string own = token_of(request);
  if (own.empty()) return refuse(call, problem(414, "The request is too long for a permalink."));
  const std::string picture =
      call.service.access.signed_for(call.grant, permalink(own, "webp") + std::string(picture_query));
  http::Response response =
      json_response(call, page_of(request, own, origin_of(call), picture), "text/html; charset=utf-8");
  response.set("Content-Security-Policy", "default-src 'none'");
  response.set("Referrer-Policy", "no-referrer");
  return response;
}

}  // namespace seedmesh
