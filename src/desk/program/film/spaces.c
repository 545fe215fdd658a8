#include "program/film/spaces.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/utf8.h"
#include "inside/colour.h"
#include "inside/module.h"
#include "inside/pictures.h"

enum { NAME_SIZE = 8192 }; /* bytes; paths may be 4096 long */

static celspan_status load(celspan_context *context, const cs_space_module **out) {
  const void *table;
  CS_TRY(
      cs_module_load(context, &cs_modules_space, CS_SPACE_MODULE_VERSION, CELSPAN_INPUT, &table));
  *out = table;
  return CELSPAN_OK;
}

static const char *file_name(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

/* "SPACE (FILE)". Headers of files are UTF-8, so that it is not cut within a character. */
static void name_colour(cs_spaces *out, const char *file) {
  char whole[NAME_SIZE];
  int size =
      snprintf(whole, sizeof whole, "%s (%s)", out->module->name(out->conversion), file_name(file));
  size_t kept = size < 0 ? 0 : cs_utf8_cut(whole, sizeof out->colour - 1);
  memcpy(out->colour, whole, kept);
  out->colour[kept] = '\0';
}

static cs_exit convert(celspan_context *context, const cs_space_request *wanted, cs_spaces *out) {
  cs_picture_failure failure;
  CS_TRY_EXIT(cs_report_failure(context, load(context, &out->module), NULL));
  celspan_status status = out->module->open(wanted, &out->conversion, &failure);
  if (status == CELSPAN_BAD_ARGUMENT)
    return cs_report_usage("%s", failure.text);
  if (status != CELSPAN_OK)
    return cs_report_failure(context, cs_fail_memory(context), NULL);
  out->digest = out->module->digest(out->conversion);
  name_colour(out, wanted->file);
  return CS_EXIT_OK;
}

/* The space that a request names; NULL: one of celspan's own, or none. */
static const char *space_of(const cs_request *request) {
  celspan_transfer transfer;
  const char *colour = cs_request_text(request, "--colour");
  return colour && !cs_transfer_parse(colour, &transfer) ? colour : NULL;
}

static cs_exit refuse_without_file(const cs_request *request, const char *space) {
  if (space)
    return cs_report_usage(
        "--colour: '%s' is not srgb, linear, rec709 or cineon, nor a space of an "
        "OpenColorIO configuration: none is named by --ocio or OCIO",
        space);
  return cs_report_usage("%s is of an OpenColorIO configuration: name one with --ocio or OCIO",
                         cs_request_has(request, "--display") ? "--display" : "--view");
}

cs_exit cs_spaces_open(celspan_context *context, cs_request *request, cs_spaces *out) {
  const char *file = cs_request_text(request, "--ocio"), *space = space_of(request);
  const char *display = cs_request_text(request, "--display");
  const char *view = cs_request_text(request, "--view");
  *out = (cs_spaces){.conversion = NULL};
  if (file && setenv("OCIO", file, 1) != 0)
    return cs_report_failure(context, cs_fail_memory(context), NULL);
  if ((display || view) && cs_request_has(request, "--colour"))
    return cs_report_usage("--colour and %s both say how colours are written: leave one out",
                           display ? "--display" : "--view");
  if (!space && !display && !view)
    return CS_EXIT_OK;
  file = cs_space_configuration();
  if (!file)
    return refuse_without_file(request, space);
  const cs_space_request wanted = {file, space, display, view};
  CS_TRY_EXIT(convert(context, &wanted, out));
  request->spaces = out;
  return CS_EXIT_OK;
}

void cs_spaces_close(cs_spaces *spaces) {
  if (spaces->conversion)
    spaces->module->close(spaces->conversion);
}

void cs_spaces_set(const cs_request *request, celspan_coding *coding) {
  const cs_spaces *spaces = request->spaces;
  const char *colour = cs_request_text(request, "--colour");
  if (colour)
    cs_transfer_parse(colour, &coding->transfer);
  if (!spaces)
    return;
  coding->convert = spaces->module->convert;
  coding->user = spaces->conversion;
  coding->colour = spaces->colour;
}
