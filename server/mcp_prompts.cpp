/// Prompts for three jobs: a grammar, a scene, and the correction of a request.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "server/mcp.h"

namespace seedmesh::mcp {
namespace {

struct Prompt {
  std::string_view name, title, text;
  std::string_view argument, argument_text;
  std::string_view message;  ///< $ is replaced by the argument
};

constexpr Prompt prompts[] = {
    {"write_grammar", "Write a grammar", "Writes a grammar for a plant, a fractal or a building.", "subject",
     "What the grammar should make.",
     "Write a Seedmesh request whose grammar makes: $\n\n"
     "1. Search list_presets for the nearest preset and read its request as seedmesh://presets/{name}.\n"
     "2. Read seedmesh://docs/lsystem for plants and curves, or seedmesh://docs/buildings for buildings. "
     "describe_generator shows each parameter.\n"
     "3. Change one thing at a time. Call validate after each change and correct what it reports: each error "
     "has a JSON Pointer, and line and column inside a grammar.\n"
     "4. Call derive to check the derived word or shapes, then generate, and give the link and the request."},
    {"compose_scene", "Compose a scene", "Composes a scene of terrain, plants and buildings.", "subject",
     "What the scene should show.",
     "Compose a Seedmesh scene that shows: $\n\n"
     "1. Search list_presets with the generator scene, and read the nearest as seedmesh://presets/{name}.\n"
     "2. Read seedmesh://docs/scenes. Choose presets of plants and buildings for the layers, and a terrain.\n"
     "3. Call validate and compare the estimate of triangles with what the scene may cost; lower `density` "
     "or set `output.max_triangles` where it is too much.\n"
     "4. Call generate with the output profile of the program that shows the scene, and give the link."},
    {"fix_errors", "Correct a request", "Corrects a request that was refused.", "request",
     "The request as JSON.",
     "This Seedmesh request is refused. Correct it with as few changes as possible:\n\n$\n\n"
     "1. Call validate. Each line of the result begins with the JSON Pointer of an error; line and column "
     "point into a grammar.\n"
     "2. Look up the parameter with describe_generator and the pointer's path as topic.\n"
     "3. Change only what the pointers name, and call validate again until the request is valid.\n"
     "4. Say what was wrong, and give the corrected request and its link from generate."},
};

}  // namespace

RpcResult list_prompts(Context&, const Json&) {
  Json list = Json::array();
  for (const Prompt& prompt : prompts) {
    list.push_back({{"name", prompt.name},
                    {"title", prompt.title},
                    {"description", prompt.text},
                    {"arguments", Json::array({{{"name", prompt.argument},
                                                {"description", prompt.argument_text},
                                                {"required", true}}})}});
  }
  return Json{{"prompts", std::move(list)}};
}

RpcResult get_prompt(Context&, const Json& parameters) {
  const std::string name = text_in(parameters, "name");
  const auto prompt = std::ranges::find_if(prompts, [&](const Prompt& each) { return each.name == name; });
  if (prompt == std::end(prompts))
    return Failure{Code::wrong_parameters, "There is no prompt \"" + name.substr(0, 100) + "\"."};
  const std::string value = text_in(parameters.value("arguments", Json::object()), prompt->argument);
  if (value.empty()) {
    return Failure{Code::wrong_parameters,
                   "The argument \"" + std::string(prompt->argument) + "\" is missing."};
  }
  std::string text(prompt->message);
  text.replace(text.find('$'), 1, value);
  const Json message = {{"role", "user"}, {"content", {{"type", "text"}, {"text", std::move(text)}}}};
  return Json{{"description", prompt->text}, {"messages", Json::array({message})}};
}

}  // namespace seedmesh::mcp
