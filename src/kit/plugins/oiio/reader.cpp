/* Reading: from a file to the facts of its header (reader.h). */
#include <algorithm>
#include <mutex>

#include "common/profile_name.h"
#include "inside/colour.h"
#include "inside/pictures.h"
#include "plugins/oiio/reader.h"

using OIIO::ImageInput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

/* Pixels at most of a picture whose reader keeps it whole in memory. */
static const uint64_t WHOLE = uint64_t(1) << 28;

struct cs_picture_reader : Opened {};

namespace {

void check_size(uint64_t width, uint64_t height, bool is_whole) {
  if (width < 1 || height < 1)
    throw Failure(CELSPAN_INPUT, "is a picture without pixels");
  std::string size = std::to_string(width) + " x " + std::to_string(height);
  if (width > CS_PICTURE_SIDE || height > CS_PICTURE_SIDE)
    throw Failure(CELSPAN_LIMIT, "is " + size + " pixels; at most 1048576 a side are read");
  if (is_whole && width * height > WHOLE)
    throw Failure(CELSPAN_LIMIT, "is " + size +
                                     " pixels in a format that can only be read whole; at "
                                     "most 268435456 pixels are");
}

int find_channel(const ImageSpec &spec, const std::string &prefix, const char *name) {
  for (int i = 0; i < spec.nchannels; i++)
    if (OIIO::Strutil::iequals(spec.channelnames[size_t(i)], prefix + name))
      return i;
  return -1;
}

/* prefix: "" or "layer."; false when the picture has no channels of such names. */
bool choose_channels(cs_picture_reader &reader, const std::string &prefix) {
  const ImageSpec &spec = reader.spec;
  static const char *const names[4] = {"R", "G", "B", "A"};
  int found[4];
  for (int i = 0; i < 4; i++)
    found[i] = find_channel(spec, prefix, names[i]);
  int grey = find_channel(spec, prefix, "Y");
  if (found[0] >= 0 && found[1] >= 0 && found[2] >= 0) {
    std::copy(found, found + 3, reader.channel);
  } else if (grey >= 0) {
    std::fill(reader.channel, reader.channel + 3, grey);
  } else if (prefix.empty()) {
    bool has_colour = spec.nchannels >= 3;
    for (int i = 0; i < 3; i++)
      reader.channel[i] = has_colour ? i : 0;
  } else {
    return false;
  }
  reader.channel[3] = found[3];
  if (found[3] < 0 && prefix.empty() && (spec.nchannels == 2 || spec.nchannels == 4) &&
      spec.alpha_channel == spec.nchannels - 1)
    reader.channel[3] = spec.alpha_channel;
  auto bounds = std::minmax_element(reader.channel, reader.channel + 3);
  reader.first = *bounds.first;
  reader.last = *bounds.second + 1;
  if (reader.channel[3] >= 0) {
    reader.first = std::min(reader.first, reader.channel[3]);
    reader.last = std::max(reader.last, reader.channel[3] + 1);
  }
  return true;
}

/* Where formats have the name of a subimage. */
const char *const name_keys[] = {"oiio:subimagename", "name", "psd:LayerName", "ImageDescription"};
const int SUBIMAGES = 10000;

bool choose_subimage(cs_picture_reader &reader, const std::string &layer) {
  for (int i = 0; i < SUBIMAGES; i++) {
    ImageSpec spec = reader.input->spec(i);
    if (spec.undefined())
      return false;
    for (const char *key : name_keys)
      if (layer == spec.get_string_attribute(key).c_str()) {
        reader.subimage = i;
        return true;
      }
  }
  return false;
}

void choose_layer(cs_picture_reader &reader, const cs_picture_request &request) {
  if (request.layer) {
    if (choose_subimage(reader, request.layer)) {
      if (!reader.input->seek_subimage(reader.subimage, 0))
        fail_input("its layer cannot be read", reader.input->geterror());
      reader.spec = reader.input->spec(reader.subimage);
    } else if (choose_channels(reader, std::string(request.layer) + ".")) {
      return;
    } else {
      throw Failure(CELSPAN_INPUT, std::string("has no layer \"") + request.layer + "\"");
    }
  }
  choose_channels(reader, "");
}

/* The header has the display window, or for a layer of a PSD the whole picture has it. */
void choose_window(cs_picture_reader &reader) {
  const ImageSpec &spec = reader.spec;
  const std::string &format = reader.kind.format;
  int64_t left = 0, top = 0;
  reader.stored_width = spec.width;
  reader.stored_height = spec.height;
  if (format == "openexr" && spec.full_width > 0 && spec.full_height > 0) {
    reader.stored_width = spec.full_width;
    reader.stored_height = spec.full_height;
    left = int64_t(spec.x) - spec.full_x;
    top = int64_t(spec.y) - spec.full_y;
  } else if (format == "psd") {
    ImageSpec whole = reader.input->spec(0);
    reader.stored_width = whole.width;
    reader.stored_height = whole.height;
    left = spec.x;
    top = spec.y;
  }
  if (std::max(std::abs(left), std::abs(top)) > (int64_t(1) << 30))
    throw Failure(CELSPAN_INPUT, "has a data window too far from its display window");
  reader.data_x = int(left);
  reader.data_y = int(top);
  int orientation = spec.get_int_attribute("Orientation", 1);
  reader.orientation = orientation >= 1 && orientation <= 8 ? orientation : 1;
}

/* Film scans name their transfer in the header. Those that do not count as film if they have ten
 * bits. */
const char *film_colour(const ImageSpec &spec) {
  std::string transfer = spec.get_string_attribute("dpx:Transfer").c_str();
  if (transfer == "Linear")
    return "linear";
  if (transfer == "SMPTE 274M" || transfer.find("709") != std::string::npos ||
      transfer.find("601") != std::string::npos)
    return "rec709";
  bool is_log = transfer == "Printing density" || transfer == "Logarithmic";
  return is_log || spec.get_int_attribute("oiio:BitsPerSample") == 10 ? "cineon" : "srgb";
}

bool is_own(const std::string &colour) {
  celspan_transfer unused;
  return cs_transfer_parse(colour.c_str(), &unused);
}

/* celspan writes this text for spaces alone; other programs may mean other things by such names, or
 * by names with capitals, which OpenImageIO finds, too, unless it is asked not to. */
std::string named_in_png(const ImageSpec &spec) {
  const OIIO::ParamValue *found = spec.find_attribute("colour", TypeDesc::STRING, true);
  std::string text = found ? found->get_string() : "";
  return is_own(text) ? "" : text;
}

/* The name of its colours that a file of celspan has; "": none. */
std::string named_colour(const cs_picture_reader &reader) {
  const std::string &format = reader.kind.format;
  const std::string before = CS_PICTURE_PROJECT;
  if (format == "openexr")
    return reader.spec.get_string_attribute("celspan:colour").c_str();
  if (format == "png")
    return named_in_png(reader.spec);
  std::string project =
      format == "dpx" ? reader.spec.get_string_attribute("DocumentName").c_str() : "";
  return project.compare(0, before.size(), before) == 0 ? project.substr(before.size()) : "";
}

/* A gamma of 1 in PNG files is light. */
bool is_light_png(const cs_picture_reader &reader) {
  std::string space = reader.spec.get_string_attribute("oiio:ColorSpace").c_str();
  return reader.kind.format == "png" && (space == "linear" || space == "Linear");
}

bool read_primaries(const cs_picture_reader &reader, float *out) {
  const OIIO::ParamValue *found =
      reader.spec.find_attribute("chromaticities", TypeDesc(TypeDesc::FLOAT, 8));
  if (found && reader.kind.format == "openexr")
    std::copy_n(static_cast<const float *>(found->data()), 8, out);
  return found && reader.kind.format == "openexr";
}

/* Codes in a space that celspan does not have are of no use without it; but light is, if its
 * primaries are known, and PNG files are looked at as if they were sRGB. */
bool is_unknown(const cs_picture_reader &reader) {
  float unused[8];
  std::string named = named_colour(reader);
  return !named.empty() && !is_own(named) && reader.kind.format != "png" &&
         !read_primaries(reader, unused);
}

/* Whether the file says what its codes are; DPX files of celspan and of others name a curve. */
bool names_colour(const cs_picture_reader &reader) {
  std::string transfer = reader.spec.get_string_attribute("dpx:Transfer").c_str();
  bool has_curve = reader.kind.format == "dpx" && !transfer.empty() && transfer != "User defined" &&
                   transfer != "Undefined";
  return is_own(named_colour(reader)) || is_unknown(reader) || is_light_png(reader) || has_curve;
}

std::string default_colour(const cs_picture_reader &reader) {
  std::string named = named_colour(reader);
  if (is_own(named))
    return named;
  if (is_unknown(reader))
    return CS_PICTURE_OTHER;
  if (is_light_png(reader))
    return "linear";
  if (reader.kind.format == "cineon")
    return "cineon";
  if (reader.kind.format == "dpx")
    return film_colour(reader.spec);
  return reader.spec.format.is_floating_point() ? "linear" : "srgb";
}

int coded_bits(const ImageSpec &spec) {
  if (spec.format == TypeDesc::UINT8)
    return 8;
  if (spec.format != TypeDesc::UINT16)
    return 0;
  int bits = spec.get_int_attribute("oiio:BitsPerSample", 16);
  return bits > 8 && bits < 16 ? bits : 16;
}

void read_profile(const ImageSpec &spec, char *out) {
  const OIIO::ParamValue *found = spec.find_attribute("ICCProfile");
  if (found)
    cs_profile_name_read(found->data(), found->type().size(), out);
}

double read_dpi(const ImageSpec &spec) {
  std::string unit = spec.get_string_attribute("ResolutionUnit");
  double inch = unit == "in" ? 1 : unit == "cm" ? 2.54 : unit == "m" ? 0.0254 : 0;
  return inch * double(spec.get_float_attribute("XResolution"));
}

void describe(const cs_picture_reader &reader, cs_picture_header *header) {
  const ImageSpec &spec = reader.spec;
  *header = {};
  header->info.width = is_transposed(reader) ? reader.stored_height : reader.stored_width;
  header->info.height = is_transposed(reader) ? reader.stored_width : reader.stored_height;
  header->info.channels = spec.nchannels;
  header->info.has_alpha = reader.channel[3] >= 0;
  header->info.is_float = spec.format.is_floating_point();
  snprintf(header->info.format, sizeof header->info.format, "%s", reader.kind.format.c_str());
  snprintf(header->info.colour, sizeof header->info.colour, "%s", default_colour(reader).c_str());
  std::string named = named_colour(reader);
  snprintf(header->space, sizeof header->space, "%s", is_own(named) ? "" : named.c_str());
  header->names_colour = names_colour(reader);
  read_profile(spec, header->profile);
  header->has_primaries = read_primaries(reader, header->primaries);
  header->alpha = is_multiplied(reader) ? CS_PICTURE_ALPHA_CODED : CS_PICTURE_ALPHA_STRAIGHT;
  header->bits = coded_bits(spec);
  header->dpi = read_dpi(spec);
  header->is_linear = reader.has_space;
  header->is_turned = reader.orientation != 1;
  header->is_whole = reader.kind.is_whole;
  header->is_sequential = reader.kind.is_sequential;
  const struct stat &status = reader.source->status();
  header->file_size = int64_t(status.st_size);
  header->file_time = int64_t(status.st_mtim.tv_sec) * 1000000000 + status.st_mtim.tv_nsec;
  header->file_number = uint64_t(status.st_ino);
}

#ifdef CELSPAN_WITHOUT_SPACES
void open_space(cs_picture_reader &, const char *, const char *) {
  throw Failure(CELSPAN_BAD_ARGUMENT, "this celspan was built without OpenColorIO; build it with "
                                      "-Dspaces=enabled");
}
#else
void open_space(cs_picture_reader &reader, const char *configuration, const char *space) {
  try {
    reader.conversion = make_conversion({configuration, space, "", "", true});
    reader.has_space = true;
  } catch (const ConversionFailure &e) {
    throw Failure(CELSPAN_BAD_ARGUMENT, e.what());
  }
}
#endif

/* The space that celspan wrote into a file, "SPACE (FILE)", if the configuration has it. */
void find_space(cs_picture_reader &reader, const char *configuration) {
  std::string named = named_colour(reader);
  size_t end = named.rfind(" (");
  if (!configuration || end == std::string::npos)
    return;
  try {
    open_space(reader, configuration, named.substr(0, end).c_str());
  } catch (const Failure &) {
    return; /* the core says that the space is not known */
  }
}

void choose_space(cs_picture_reader &reader, const char *space) {
  const char *configuration = cs_space_configuration();
  if (!space && is_unknown(reader))
    find_space(reader, configuration);
  if (!space)
    return;
  if (!configuration)
    throw Failure(
        CELSPAN_BAD_ARGUMENT,
        std::string("colour \"") + space +
            "\" is not known; \"srgb\", \"linear\", "
            "\"rec709\" and \"cineon\" are, and the spaces of an OpenColorIO configuration "
            "that --ocio or the environment variable OCIO names");
  open_space(reader, configuration, space);
}

std::unique_ptr<cs_picture_reader> make_reader(const cs_picture_request &request) {
  auto reader = std::make_unique<cs_picture_reader>();
  reader->name = request.file;
  reader->source = std::make_unique<Source>(request.file);
  reader->kind = sniff(*reader->source);
  if (reader->kind.width || reader->kind.height)
    check_size(reader->kind.width, reader->kind.height, reader->kind.is_whole);
  check_file(*reader->source, reader->kind.format);
  reader->subimage = request.layer ? 0 : request.subimage;
  open_input(*reader);
  choose_layer(*reader, request);
  choose_window(*reader);
  const ImageSpec &spec = reader->spec;
  check_size(uint64_t(spec.width), uint64_t(spec.height), reader->kind.is_whole);
  check_size(uint64_t(reader->stored_width), uint64_t(reader->stored_height), false);
  if (spec.depth > 1)
    throw Failure(CELSPAN_INPUT, "is a volume, not a picture");
  if (spec.nchannels < 1 || spec.nchannels > CS_PICTURE_CHANNELS)
    throw Failure(CELSPAN_LIMIT, "has " + std::to_string(spec.nchannels) + " channels; at most " +
                                     std::to_string(CS_PICTURE_CHANNELS) + " are read");
  choose_space(*reader, request.space);
  return reader;
}

/* ---------------------------------------------------------------- what else is in the file */

std::string depth_of(const ImageSpec &spec) {
  if (spec.format == TypeDesc::HALF || spec.format == TypeDesc::FLOAT ||
      spec.format == TypeDesc::DOUBLE)
    return spec.format.c_str();
  int bits = int(spec.format.basesize()) * 8;
  return std::to_string(spec.get_int_attribute("oiio:BitsPerSample", bits));
}

cs_picture_part describe_part(const ImageSpec &spec, int subimage, const std::string &name) {
  cs_picture_part part = {};
  part.subimage = subimage;
  part.width = spec.width;
  part.height = spec.height;
  part.channels = spec.nchannels;
  snprintf(part.name, sizeof part.name, "%s", name.c_str());
  snprintf(part.depth, sizeof part.depth, "%s", depth_of(spec).c_str());
  return part;
}

std::string name_of(const ImageSpec &spec) {
  for (const char *key : name_keys)
    if (!spec.get_string_attribute(key).empty())
      return spec.get_string_attribute(key).c_str();
  return "";
}

/* The layers of a subimage are groups of channels such as light.R, light.G, light.B; in order. */
std::vector<cs_picture_part> layers_of(const ImageSpec &spec) {
  std::vector<cs_picture_part> layers;
  for (const std::string &channel : spec.channelnames) {
    size_t dot = channel.rfind('.');
    std::string name = channel.substr(0, dot == std::string::npos ? 0 : dot);
    auto known = std::find_if(layers.begin(), layers.end(),
                              [&](const cs_picture_part &part) { return name == part.name; });
    bool is_colour =
        find_channel(spec, name + ".", "Y") >= 0 ||
        (find_channel(spec, name + ".", "R") >= 0 && find_channel(spec, name + ".", "G") >= 0 &&
         find_channel(spec, name + ".", "B") >= 0);
    if (known != layers.end()) {
      known->channels++;
    } else if (!name.empty() && is_colour) {
      layers.push_back(describe_part(spec, -1, name));
      layers.back().channels = 1;
    }
  }
  return layers;
}

void list_parts(cs_picture_reader &reader, bool (*put)(void *user, const cs_picture_part *part),
                void *user) {
  reader.source->forgive();
  for (int i = 0; i < SUBIMAGES; i++) {
    ImageSpec spec = reader.input->spec(i);
    if (spec.undefined() || (i > 0 && reader.source->has_stand_in))
      return;
    cs_picture_part part = describe_part(spec, i, name_of(spec));
    if (!put(user, &part))
      return;
    for (const cs_picture_part &layer : i == 0 ? layers_of(spec) : std::vector<cs_picture_part>())
      if (!put(user, &layer))
        return;
  }
}

} // namespace

void open_input(Opened &reader) {
  static std::mutex opening; /* some readers have races in their shared state */
  std::lock_guard<std::mutex> guard(opening);
  reader.source->forgive();
  reader.source->seek(0);
  reader.next_row = 0;
  reader.input = ImageInput::create(reader.kind.format);
  if (!reader.input)
    fail_input("cannot be read as " + reader.kind.format, OIIO::geterror());
  ImageSpec wish;
  wish.attribute("oiio:UnassociatedAlpha", 1);
  /* The JPEG reader claims to support a source of ours, and then refuses it. */
  if (reader.input->supports("ioproxy") && reader.kind.format != "jpeg") {
    void *proxy = reader.source.get();
    wish.attribute("oiio:ioproxy", TypeDesc::PTR, &proxy);
  }
  ImageSpec spec;
  if (!reader.input->open(reader.name, spec, wish))
    fail_input("cannot be read as " + reader.kind.format, reader.input->geterror());
  if (reader.subimage && !reader.input->seek_subimage(reader.subimage, 0))
    throw Failure(CELSPAN_INPUT, "has no subimage " + std::to_string(reader.subimage));
  reader.spec = reader.input->spec(reader.subimage);
}

/* All readers are asked for straight alpha. These still multiply by alpha, or their files have
 * multiplied values. */
bool is_multiplied(const Opened &reader) {
  if (reader.channel[3] < 0 || reader.spec.get_int_attribute("oiio:UnassociatedAlpha") == 1)
    return false;
  const std::string &format = reader.kind.format;
  return format == "openexr" || format == "tiff" || format == "webp" || format == "dpx";
}

celspan_status open_reader(const cs_picture_request *request, cs_picture_reader **out,
                           cs_picture_header *header, cs_picture_failure *failure) {
  return fence(failure, CELSPAN_INPUT, request->file, [&] {
    prepare_library();
    auto reader = make_reader(*request);
    cs_picture_header made;
    describe(*reader, &made);
    check_memory();
    *header = made;
    *out = reader.release();
  });
}

celspan_status read_reader(cs_picture_reader *reader, int32_t x, int32_t y, int32_t width,
                           int32_t height, float *rgba, cs_picture_failure *failure) {
  return fence(failure, CELSPAN_INPUT, reader->name, [&] {
    read_rectangle(*reader, x, y, width, height, rgba);
    check_memory();
  });
}

celspan_status list_reader(cs_picture_reader *reader,
                           bool (*put)(void *user, const cs_picture_part *part), void *user,
                           cs_picture_failure *failure) {
  return fence(failure, CELSPAN_INPUT, reader->name, [&] {
    list_parts(*reader, put, user);
    check_memory();
  });
}

void close_reader(cs_picture_reader *reader) {
  cs_picture_failure ignored;
  std::string name = reader->name;
  celspan_status status = fence(&ignored, CELSPAN_INPUT, name, [&] { delete reader; });
  (void)status;
}
