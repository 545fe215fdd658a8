#include "plugins/ocio/conversion.h"

#include <algorithm>
#include <cctype>
#include <mutex>

namespace OCIO = OCIO_NAMESPACE;

namespace {

/* What configurations call linear light in the primaries of BT.709: names, aliases and roles, which
 * OpenColorIO compares without regard to case. */
const char *const light_names[] = {
    "lin_rec709",
    "lin_rec709_scene",
    "lin_srgb",
    "Linear Rec.709 (sRGB)",
    "Linear Rec.709",
    "Linear BT.709",
    "Utility - Linear - sRGB",
    "Utility - Linear - Rec.709",
    "scene-linear Rec.709-sRGB",
};

/* From light in the primaries of BT.709 to ACES2065-1, the white adapted by Bradford's matrix.
 * Source: SMPTE ST 2065-1 and ITU-R BT.709, with the white points (0.32168, 0.33767) and (0.3127,
 * 0.3290). */
const double to_aces[16] = {
    0.439632981919491,
    0.382988698151554,
    0.177378319928956,
    0, /* red */
    0.0897764429588422,
    0.813439428748981,
    0.0967841282921768,
    0, /* green */
    0.0175411703831729,
    0.111546553302387,
    0.870912276314440,
    0, /* blue */
    0,
    0,
    0,
    1,
};

/* A space in which light can be given to a configuration, and whether it is ACES2065-1. */
struct Light {
  std::string space;
  bool is_aces;
};

std::string first_line(const std::string &message) {
  std::string line = message.substr(0, message.find('\n'));
  while (!line.empty() && (line.back() == '.' || isspace(static_cast<unsigned char>(line.back()))))
    line.pop_back();
  return line.rfind("Error: ", 0) == 0 ? line.substr(7) : line;
}

[[noreturn]] void refuse(const std::string &file, const std::string &sentence) {
  throw ConversionFailure(file + ": " + sentence);
}

OCIO::ConstConfigRcPtr open_configuration(const std::string &file) {
  /* The library would print warnings. */
  static std::once_flag once;
  std::call_once(once, [] { OCIO::SetLoggingLevel(OCIO::LOGGING_LEVEL_NONE); });
  try {
    return OCIO::Config::CreateFromFile(file.c_str());
  } catch (const OCIO::Exception &e) {
    refuse(file, "cannot be read as an OpenColorIO configuration: " + first_line(e.what()));
  }
}

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return char(tolower(c)); });
  return text;
}

/* Whether a text names other primaries than those of BT.709. */
bool names_others(const std::string &text) {
  static const char *const words[] = {"aces", "ap0", "ap1", "2020", "p3", "xyz", "gamut"};
  return std::any_of(std::begin(words), std::end(words),
                     [&](const char *word) { return lower(text).find(word) != std::string::npos; });
}

/* scene_linear has the primaries of BT.709 in configurations that know no others. */
bool is_plain(const OCIO::ConstConfigRcPtr &configuration,
              const OCIO::ConstColorSpaceRcPtr &space) {
  std::string text = std::string(space->getName()) + ' ' + space->getFamily() + ' ' +
                     space->getDescription() + ' ' + configuration->getDescription();
  for (size_t i = 0; i < space->getNumAliases(); i++)
    text += std::string(" ") + space->getAlias(i);
  return !names_others(text);
}

Light find_light(const std::string &file, const OCIO::ConstConfigRcPtr &configuration) {
  for (const char *name : light_names)
    if (auto space = configuration->getColorSpace(name))
      return {space->getName(), false};
  if (configuration->hasRole(OCIO::ROLE_INTERCHANGE_SCENE))
    return {OCIO::ROLE_INTERCHANGE_SCENE, true};
  auto space = configuration->getColorSpace(OCIO::ROLE_SCENE_LINEAR);
  if (!space || !is_plain(configuration, space))
    refuse(file,
           "does not say which of its spaces is linear light in the primaries of BT.709; give "
           "that space the role or alias lin_rec709");
  return {space->getName(), false};
}

OCIO::ConstTransformRcPtr make_matrix(bool decodes) {
  auto matrix = OCIO::MatrixTransform::Create();
  matrix->setMatrix(to_aces);
  matrix->setDirection(decodes ? OCIO::TRANSFORM_DIR_INVERSE : OCIO::TRANSFORM_DIR_FORWARD);
  return matrix;
}

OCIO::TransformRcPtr make_space(const ConversionRequest &request, const std::string &light,
                                const OCIO::ConstConfigRcPtr &configuration) {
  if (!configuration->getColorSpace(request.space.c_str()))
    refuse(request.file, "has no colour space \"" + request.space + "\"");
  auto transform = OCIO::ColorSpaceTransform::Create();
  transform->setSrc(request.decodes ? request.space.c_str() : light.c_str());
  transform->setDst(request.decodes ? light.c_str() : request.space.c_str());
  return transform;
}

std::string list(int count,
                 const char *(*at)(const OCIO::ConstConfigRcPtr &, const std::string &, int),
                 const OCIO::ConstConfigRcPtr &configuration, const std::string &display) {
  std::string text;
  for (int i = 0; i < count; i++)
    text += std::string(i > 0 ? ", " : "") + "\"" + at(configuration, display, i) + "\"";
  return text.empty() ? "none" : text;
}

/* The given name, or the default; the configuration has a list of them. */
std::string choose(const ConversionRequest &request, const char *kind, const std::string &given,
                   const char *usual, const std::string &known) {
  std::string name = given.empty() && usual ? usual : given;
  if (name.empty() || known.find("\"" + name + "\"") == std::string::npos)
    refuse(request.file, std::string("has no ") + kind + " \"" + name + "\"; it has " + known);
  return name;
}

OCIO::TransformRcPtr make_view(const ConversionRequest &request, const std::string &light,
                               const OCIO::ConstConfigRcPtr &configuration, std::string *name) {
  auto display_at = [](const OCIO::ConstConfigRcPtr &c, const std::string &, int i) {
    return c->getDisplay(i);
  };
  auto view_at = [](const OCIO::ConstConfigRcPtr &c, const std::string &of, int i) {
    return c->getView(of.c_str(), i);
  };
  std::string display =
      choose(request, "display", request.display, configuration->getDefaultDisplay(),
             list(configuration->getNumDisplays(), display_at, configuration, ""));
  std::string view =
      choose(request, "view", request.view, configuration->getDefaultView(display.c_str()),
             list(configuration->getNumViews(display.c_str()), view_at, configuration, display));
  auto transform = OCIO::DisplayViewTransform::Create();
  transform->setSrc(light.c_str());
  transform->setDisplay(display.c_str());
  transform->setView(view.c_str());
  *name = view + " on " + display;
  return transform;
}

/* Lossless: the quicker curves of the library are not exact. */
Conversion convert(const ConversionRequest &request) {
  auto configuration = open_configuration(request.file);
  Light light = find_light(request.file, configuration);
  Conversion made;
  made.name = request.space;
  auto group = OCIO::GroupTransform::Create();
  group->appendTransform(request.space.empty()
                             ? make_view(request, light.space, configuration, &made.name)
                             : make_space(request, light.space, configuration));
  if (light.is_aces && request.decodes)
    group->appendTransform(make_matrix(true)->createEditableCopy());
  else if (light.is_aces)
    group->prependTransform(make_matrix(false)->createEditableCopy());
  made.processor =
      configuration->getProcessor(group)->getOptimizedCPUProcessor(OCIO::OPTIMIZATION_LOSSLESS);
  return made;
}

} // namespace

Conversion make_conversion(const ConversionRequest &request) {
  try {
    return convert(request);
  } catch (const OCIO::Exception &e) {
    refuse(request.file, first_line(e.what()));
  }
}
