/* PNG, by libpng. Source: PNG (Third Edition). */
#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "common/profile_name.h"
#include "inside/colour.h"
#include "plugins/raster/raster.h"

enum { GAMMA_LINEAR = 100000 }; /* in units of 1/100000 */

/* All data that are in use while libpng may jump out of a function. */
typedef struct reading {
  const cs_raster_file *file;
  size_t at;
  png_structp png;
  png_infop info;
  cs_raster *out;
  cs_picture_failure *failure;
  celspan_status status;
} reading;

static void read_bytes(png_structp png, png_bytep out, size_t size) {
  reading *r = png_get_io_ptr(png);
  if (size > r->file->size - r->at)
    png_error(png, "the file ends");
  memcpy(out, r->file->bytes + r->at, size);
  r->at += size;
}

static void note_error(png_structp png, const char *text) {
  reading *r = png_get_error_ptr(png);
  r->status = cs_raster_fail(r->failure, CELSPAN_INPUT, "is corrupt or truncated: %s", text);
  png_longjmp(png, 1);
}

static void ignore(png_structp png, const char *text) { (void)png, (void)text; }

/* Converts every picture to grey or colours, of 8 or 16 bits, with or without alpha. Returns how
 * often each row must be read. */
static int choose_form(reading *r) {
  png_set_expand(r->png);
  png_set_swap(r->png);
  int passes = png_set_interlace_handling(r->png);
  png_read_update_info(r->png, r->info);
  r->out->channels = png_get_channels(r->png, r->info);
  r->out->bits = png_get_bit_depth(r->png, r->info);
  r->out->dpi = 0.0254 * png_get_x_pixels_per_meter(r->png, r->info);
  return passes;
}

static const char *colour_of(const reading *r) {
  png_fixed_point gamma = 0;
  bool has_gamma = png_get_gAMA_fixed(r->png, r->info, &gamma) != 0;
  return has_gamma && gamma == GAMMA_LINEAR ? "linear" : "srgb";
}

/* The space that celspan names in a text (output/png/png_sink.c), and none of its own names: other
 * programs may mean other things by them. */
static void read_space(const reading *r) {
  png_textp texts = NULL;
  celspan_transfer own;
  int count = png_get_text(r->png, r->info, &texts, NULL);
  for (int i = 0; i < count; i++)
    if (strcmp(texts[i].key, "colour") == 0 && texts[i].text &&
        !cs_transfer_parse(texts[i].text, &own))
      snprintf(r->out->space, sizeof r->out->space, "%s", texts[i].text);
}

static void read_profile(const reading *r) {
  png_charp name;
  png_bytep bytes;
  png_uint_32 size = 0;
  int method;
  if (png_get_iCCP(r->png, r->info, &name, &method, &bytes, &size))
    cs_profile_name_read(bytes, size, r->out->profile);
}

static void decode(reading *r) {
  if (setjmp(png_jmpbuf(r->png)))
    return;
  png_set_read_fn(r->png, r, read_bytes);
  png_set_user_limits(r->png, CS_PICTURE_SIDE, CS_PICTURE_SIDE);
  png_read_info(r->png, r->info);
  r->out->colour = colour_of(r);
  r->out->names_colour = strcmp(r->out->colour, "linear") == 0;
  read_space(r);
  read_profile(r);
  int passes = choose_form(r);
  r->status = cs_raster_make(r->out, png_get_image_width(r->png, r->info),
                             png_get_image_height(r->png, r->info), r->failure);
  if (r->status != CELSPAN_OK)
    return;
  for (int pass = 0; pass < passes; pass++)
    for (int32_t y = 0; y < r->out->height; y++)
      png_read_row(r->png, (png_bytep)r->out->pixels + (size_t)y * cs_raster_row(r->out), NULL);
  png_read_end(r->png, NULL);
}

celspan_status cs_raster_png(const cs_raster_file *file, cs_raster *out,
                             cs_picture_failure *failure) {
  reading r = {.file = file, .out = out, .failure = failure, .status = CELSPAN_OK};
  r.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &r, note_error, ignore);
  r.info = r.png ? png_create_info_struct(r.png) : NULL;
  if (r.info)
    decode(&r);
  else
    r.status = cs_raster_fail(failure, CELSPAN_NO_MEMORY, "out of memory");
  png_destroy_read_struct(&r.png, &r.info, NULL);
  return r.status;
}
