#include <strings.h>

#include "output/dither.h"
#include "output/ending.h"
#include "output/guard.h"
#include "output/pixels.h"
#include "output/sink.h"

static const char *format_of(const char *path, const celspan_file_desc *file) {
  return file->format ? file->format : cs_ending_of(path);
}

bool cs_sink_file_is_numbered(const char *path, const celspan_file_desc *file) {
  static const char *const unnumbered[] = {"png", "tga", "targa", "span"};
  for (size_t i = 0; i < sizeof unnumbered / sizeof *unnumbered; i++)
    if (strcasecmp(format_of(path, file), unnumbered[i]) == 0)
      return false;
  return true;
}

/* PNG and Targa, which are made from spans, or from dithered pixels. */
static celspan_status
create_pixels(celspan_context *context, const char *path, const celspan_file_desc *file,
              celspan_status (*create)(celspan_context *, const char *, const celspan_file_desc *,
                                       celspan_sink *),
              celspan_sink *out) {
  celspan_sink sink;
  celspan_coding coding = cs_pixels_resolve(&file->coding, CELSPAN_DEPTH_8);
  CS_TRY(create(context, path, file, &sink));
  CS_TRY(cs_dither_sink(context, &file->coding, &coding, file->place_x, file->place_y, &sink));
  *out = sink;
  return CELSPAN_OK;
}

static celspan_status create(celspan_context *context, const char *path,
                             const celspan_file_desc *file, celspan_sink *out) {
  const char *format = format_of(path, file);
  if (format[0] == '\0')
    return cs_fail(
        context, CELSPAN_BAD_ARGUMENT,
        "%s: the format is unknown: give the file an ending such as .png, or name a format", path);
  bool is_targa = strcasecmp(format, "tga") == 0 || strcasecmp(format, "targa") == 0;
  if (is_targa || strcasecmp(format, "png") == 0)
    return create_pixels(context, path, file, is_targa ? cs_sink_tga : cs_sink_png, out);
  if (strcasecmp(format, "span") == 0)
    return cs_sink_span(context, path, file, out);
  if (file->strip_height != 0)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT,
                   "%s: strips can be joined in PNG, Targa and span files alone", path);
  return cs_sink_picture(context, path, file, out);
}

celspan_status cs_sink_file(celspan_context *context, const char *path,
                            const celspan_file_desc *file, celspan_sink *out) {
  celspan_sink sink;
  if (!path || !*path)
    return cs_fail(context, CELSPAN_BAD_ARGUMENT, "the file to write has no name");
  CS_TRY(cs_pixels_check(context, &file->coding));
  CS_TRY(create(context, path, file, &sink));
  CS_TRY(cs_guard_sink(context, path, &sink));
  *out = sink;
  return CELSPAN_OK;
}

celspan_status celspan_file_sink_create(celspan_context *context, const char *path,
                                        const celspan_file_desc *file, celspan_sink *out) {
  celspan_file_desc defaults = CELSPAN_FILE_DESC;
  return cs_sink_file(context, path, file ? file : &defaults, out);
}
