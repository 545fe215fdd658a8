#include "program/layers_target.h"

#include <string.h>
#include <strings.h>

#include "frames/film/sequence.h"
#include "output/sinks/file.h"

static const struct {
  const char *ending;
  cs_apart_format format;
} formats[] = {{"exr", CS_APART_EXR},
               {"openexr", CS_APART_EXR},
               {"png", CS_APART_PNG},
               {"ora", CS_APART_ORA},
               {"psd", CS_APART_PSD}};

/* false: files of this kind have no layers. */
static bool find_format(const cs_request *request, cs_apart_format *out) {
  const char *format = cs_request_text(request, "--format"),
             *output = cs_request_text(request, "-o");
  const char *ending = format ? format : output ? cs_file_ending(output) : "";
  for (size_t i = 0; i < sizeof formats / sizeof *formats; i++)
    if (strcasecmp(formats[i].ending, ending) == 0) {
      *out = formats[i].format;
      return true;
    }
  return false;
}

cs_apart_contents cs_layers_target_read(const cs_request *request) {
  cs_apart_contents contents = {.has_layers = cs_request_has(request, "--layers")};
  const char *output = cs_request_text(request, "-o");
  cs_request_read(request, "--cryptomatte", &contents.mattes);
  contents.place = output ? cs_sequence_place(output) : 0;
  (void)find_format(request, &contents.format);
  return contents;
}

bool cs_layers_target_is_wanted(const cs_request *request) {
  return cs_request_has(request, "--layers") || cs_request_has(request, "--cryptomatte");
}

/* Whether a colour or a view is asked for that is not `usual`. */
static bool has_colour(const cs_request *request, const char *usual) {
  const char *colour = cs_request_text(request, "--colour");
  return (colour && strcmp(colour, usual) != 0) || cs_request_has(request, "--display") ||
         cs_request_has(request, "--view");
}

static cs_exit refuse_colour(const cs_request *request, const char *option,
                             cs_apart_format format) {
  const char *usual = format == CS_APART_EXR ? "linear" : "srgb";
  if (format == CS_APART_PNG || !has_colour(request, usual))
    return CS_EXIT_OK;
  return cs_report_usage("%s: such files are in %s: leave %s out", option,
                         format == CS_APART_EXR ? "linear light" : "sRGB",
                         cs_request_has(request, "--colour") ? "--colour" : "--display and --view");
}

static bool is_painting(cs_apart_format format) {
  return format == CS_APART_ORA || format == CS_APART_PSD;
}

/* What the writers of paintings cannot do, which others do. */
static cs_exit refuse_painting(const cs_request *request) {
  static const char *const options[] = {"--dither", "--strip"};
  celspan_depth depth = CELSPAN_DEPTH_8;
  celspan_alpha alpha = CELSPAN_ALPHA_STRAIGHT;
  for (size_t i = 0; i < sizeof options / sizeof *options; i++)
    if (cs_request_has(request, options[i]))
      return cs_report_usage("%s: a painting is written without it: leave it out", options[i]);
  cs_request_read(request, "--depth", &depth);
  cs_request_read(request, "--alpha", &alpha);
  if (depth == CELSPAN_DEPTH_HALF || depth == CELSPAN_DEPTH_FLOAT)
    return cs_report_usage("--depth: a painting has 8 or 16 bits");
  return alpha == CELSPAN_ALPHA_STRAIGHT
             ? CS_EXIT_OK
             : cs_report_usage("--alpha: a painting has straight alpha");
}

/* What a file of a format cannot be made with. */
static cs_exit refuse_format(const cs_request *request, cs_apart_format format) {
  if (is_painting(format))
    return refuse_painting(request);
  return format == CS_APART_PNG && cs_request_has(request, "--strip")
             ? cs_report_usage("--strip: the layers of strips are not joined: leave it out")
             : CS_EXIT_OK;
}

static cs_exit refuse_endings(const char *option) {
  return strcmp(option, "--layers") == 0
             ? cs_report_usage("--layers: only OpenEXR, PNG, OpenRaster and Photoshop files have "
                               "layers: give -o shot.####.exr, .png, .ora or .psd")
             : cs_report_usage("--cryptomatte: only OpenEXR files have mattes: give -o "
                               "shot.####.exr");
}

cs_exit cs_layers_target_refuse(const cs_request *request) {
  cs_apart_format format = CS_APART_EXR;
  if (!cs_layers_target_is_wanted(request))
    return CS_EXIT_OK;
  bool has_mattes = cs_request_has(request, "--cryptomatte");
  const char *option = has_mattes ? "--cryptomatte" : "--layers";
  if (!find_format(request, &format) || (has_mattes && format != CS_APART_EXR))
    return refuse_endings(option);
  if (cs_request_has(request, "--hash"))
    return cs_report_usage("--hash is of one picture: leave it or %s out", option);
  CS_TRY_EXIT(refuse_format(request, format));
  return refuse_colour(request, option, format);
}

bool cs_layers_target_is_painting(const cs_request *request) {
  cs_apart_format format = CS_APART_EXR;
  return cs_request_has(request, "--layers") && find_format(request, &format) &&
         is_painting(format);
}

celspan_status cs_layers_target_write(celspan_context *context, cs_apart_contents contents,
                                      const celspan_frame_desc *desc, const char *path,
                                      const celspan_file_desc *file) {
  switch (contents.format) {
  case CS_APART_PNG:
    return cs_apart_write_png(context, contents, desc, path, file);
  case CS_APART_ORA:
    return cs_apart_write_ora(context, desc, path, file);
  case CS_APART_PSD:
    return cs_apart_write_psd(context, desc, path, file);
  case CS_APART_EXR:
    break;
  }
  return cs_apart_write_exr(context, contents, desc, path, file);
}
