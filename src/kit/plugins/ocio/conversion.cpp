#include "plugins/ocio/conversion.h"

#include <sys/stat.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <deque>
#include <functional>
#include <mutex>
#include <tuple>
#include <utility>
#include <vector>

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

/* The words of a text in lower case: runs of letters and digits. */
std::vector<std::string> words_of(const std::string &text) {
  std::vector<std::string> words(1);
  for (char c : lower(text))
    if (isalnum(static_cast<unsigned char>(c)))
      words.back() += c;
    else if (!words.back().empty())
      words.emplace_back();
  return words;
}

bool has_word(const std::string &text, const std::function<bool(const std::string &)> &is_wanted) {
  std::vector<std::string> words = words_of(text);
  return std::any_of(words.begin(), words.end(), is_wanted);
}

bool names_others(const std::string &word) {
  static const char *const others[] = {"ap0",    "ap1",   "2020",      "rec2020", "bt2020",
                                       "p3",     "dcip3", "displayp3", "xyz",     "egamut",
                                       "sgamut", "awg",   "sgamut3",   "vgamut",  "adobergb"};
  return word.rfind("aces", 0) == 0 || word.find("widegamut") != std::string::npos ||
         std::find(std::begin(others), std::end(others), word) != std::end(others);
}

/* Names of primaries that are two words. */
bool has_other_gamut(const std::string &text) {
  std::string line = " ";
  for (const std::string &word : words_of(text))
    line += word + ' ';
  for (const char *name : {" wide gamut ", " adobe rgb ", " s gamut", " v gamut ", " e gamut "})
    if (line.find(name) != std::string::npos)
      return true;
  return false;
}

bool names_bt709(const std::string &word) {
  static const char *const own[] = {"709", "rec709", "bt709", "srgb"};
  return std::find(std::begin(own), std::end(own), word) != std::end(own);
}

bool is_near(const float *colour, float red, float green, float blue) {
  const float wanted[3] = {red, green, blue};
  for (int c = 0; c < 3; c++)
    if (!(std::abs(colour[c] - wanted[c]) < 1e-3F))
      return false;
  return true;
}

enum class Screens { None, Alike, Others };

/* Whether red, green and blue of this space equal the configuration's space for screens. */
Screens compare_screens(const OCIO::ConstConfigRcPtr &configuration, const char *space) {
  for (const char *name : {"sRGB", "sRGB - Texture", "Rec709", "Rec.709"}) {
    if (!configuration->getColorSpace(name))
      continue;
    float colours[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    OCIO::PackedImageDesc image(colours, 3, 1, 3);
    configuration->getProcessor(space, name)->getDefaultCPUProcessor()->apply(image);
    return is_near(colours[0], 1, 0, 0) && is_near(colours[1], 0, 1, 0) &&
                   is_near(colours[2], 0, 0, 1)
               ? Screens::Alike
               : Screens::Others;
  }
  return Screens::None;
}

/* scene_linear has the primaries of BT.709 if it and the configuration name no others, and it has
 * those of screens or, where no space for screens is known, one of them says so. */
bool is_plain(const OCIO::ConstConfigRcPtr &configuration,
              const OCIO::ConstColorSpaceRcPtr &space) {
  std::string text = std::string(space->getName()) + ' ' + space->getFamily() + ' ' +
                     space->getDescription() + ' ' + configuration->getDescription();
  for (size_t i = 0; i < space->getNumAliases(); i++)
    text += std::string(" ") + space->getAlias(i);
  Screens screens = compare_screens(configuration, space->getName());
  bool has_others = has_word(text, names_others) || has_other_gamut(text);
  bool says_so = screens == Screens::None && has_word(text, names_bt709);
  return !has_others && (screens == Screens::Alike || says_so);
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

OCIO::ConstColorSpaceRcPtr find_space(const ConversionRequest &request,
                                      const OCIO::ConstConfigRcPtr &configuration) {
  auto space = configuration->getColorSpace(request.space.c_str());
  if (!space)
    refuse(request.file, "has no colour space \"" + request.space + "\"");
  return space;
}

OCIO::TransformRcPtr make_space(const ConversionRequest &request, const std::string &light) {
  auto transform = OCIO::ColorSpaceTransform::Create();
  transform->setSrc(request.decodes ? request.space.c_str() : light.c_str());
  transform->setDst(request.decodes ? light.c_str() : request.space.c_str());
  return transform;
}

std::string list(const std::vector<std::string> &names) {
  std::string text;
  for (const std::string &name : names)
    text += (text.empty() ? "\"" : ", \"") + name + "\"";
  return text.empty() ? "none" : text;
}

/* The given name, or the default, as the configuration writes it; OpenColorIO compares names
 * without regard to case. */
std::string choose(const ConversionRequest &request, const char *kind, const std::string &given,
                   const char *usual, const std::vector<std::string> &known) {
  std::string name = given.empty() && usual ? usual : given;
  auto found = std::find_if(known.begin(), known.end(),
                            [&](const std::string &one) { return lower(one) == lower(name); });
  if (found == known.end())
    refuse(request.file,
           std::string("has no ") + kind + " \"" + name + "\"; it has " + list(known));
  return *found;
}

std::string choose_display(const ConversionRequest &request,
                           const OCIO::ConstConfigRcPtr &configuration) {
  std::vector<std::string> displays;
  for (int i = 0; i < configuration->getNumDisplays(); i++)
    displays.emplace_back(configuration->getDisplay(i));
  return choose(request, "display", request.display, configuration->getDefaultDisplay(), displays);
}

std::string choose_view(const ConversionRequest &request, const char *display,
                        const OCIO::ConstConfigRcPtr &configuration) {
  std::vector<std::string> views;
  for (int i = 0; i < configuration->getNumViews(display); i++)
    views.emplace_back(configuration->getView(display, i));
  return choose(request, "view", request.view, configuration->getDefaultView(display), views);
}

OCIO::TransformRcPtr make_view(const ConversionRequest &request, const std::string &light,
                               const OCIO::ConstConfigRcPtr &configuration, std::string *name) {
  std::string display = choose_display(request, configuration);
  std::string view = choose_view(request, display.c_str(), configuration);
  auto transform = OCIO::DisplayViewTransform::Create();
  transform->setSrc(light.c_str());
  transform->setDisplay(display.c_str());
  transform->setView(view.c_str());
  *name = view + " on " + display;
  return transform;
}

/* Lossless: the quicker curves of the library are not exact. A space of data, such as Raw, has the
 * numbers of the light. */
Conversion convert(const ConversionRequest &request) {
  auto configuration = open_configuration(request.file);
  bool is_data = !request.space.empty() && find_space(request, configuration)->isData();
  Light light = is_data ? Light{request.space, false} : find_light(request.file, configuration);
  Conversion made;
  made.name = request.space;
  auto group = OCIO::GroupTransform::Create();
  group->appendTransform(request.space.empty()
                             ? make_view(request, light.space, configuration, &made.name)
                             : make_space(request, light.space));
  if (light.is_aces && request.decodes)
    group->appendTransform(make_matrix(true)->createEditableCopy());
  else if (light.is_aces)
    group->prependTransform(make_matrix(false)->createEditableCopy());
  made.processor =
      configuration->getProcessor(group)->getOptimizedCPUProcessor(OCIO::OPTIMIZATION_LOSSLESS);
  return made;
}

/* ---------------------------------------------------------------- kept conversions */

/* How many conversions are kept: a film reads files in few spaces. */
const size_t KEPT = 16;

/* What a conversion was made of. A configuration that was changed has another time or size. Tables
 * that it names do not count: OpenColorIO keeps those that it has read, too. */
using Key = std::tuple<std::string, std::string, bool, int64_t, int64_t, int64_t>;

Key key_of(const ConversionRequest &request) {
  struct stat found = {};
  bool is_there = stat(request.file.c_str(), &found) == 0;
  return {request.file,
          request.space,
          request.decodes,
          is_there ? int64_t(found.st_mtim.tv_sec) : 0,
          is_there ? int64_t(found.st_mtim.tv_nsec) : 0,
          is_there ? int64_t(found.st_size) : -1};
}

/* Configurations of ACES have megabytes, and each file of a sequence would read them again. */
Conversion find_or_convert(const ConversionRequest &request) {
  static std::mutex lock;
  static std::deque<std::pair<Key, Conversion>> kept;
  Key key = key_of(request);
  std::lock_guard<std::mutex> guard(lock);
  for (const auto &one : kept)
    if (one.first == key)
      return one.second;
  Conversion made = convert(request);
  if (kept.size() == KEPT)
    kept.pop_front();
  kept.emplace_back(std::move(key), made);
  return made;
}

} // namespace

Conversion make_conversion(const ConversionRequest &request) {
  try {
    return request.space.empty() ? convert(request) : find_or_convert(request);
  } catch (const OCIO::Exception &e) {
    refuse(request.file, first_line(e.what()));
  }
}

void apply_conversion(const Conversion &conversion, float *rgba, size_t count) {
  const ptrdiff_t value = sizeof *rgba, pixel = 4 * value;
  const size_t most = 1 << 16; /* pixels at a time, a row for the library */
  for (size_t portion; count > 0; count -= portion, rgba += 4 * portion) {
    portion = std::min(count, most);
    OCIO::PackedImageDesc row(rgba, long(portion), 1, OCIO::CHANNEL_ORDERING_RGB,
                              OCIO::BIT_DEPTH_F32, value, pixel, pixel * ptrdiff_t(portion));
    conversion.processor->apply(row);
  }
}
