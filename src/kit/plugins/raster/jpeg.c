/* JPEG, by libjpeg. Source: ISO/IEC 10918-1; Exif 2.3, 4.6 for the orientation. */
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>

#include <jerror.h>

#include "common/profile_name.h"
#include "plugins/raster/raster.h"

enum { APP1 = JPEG_APP0 + 1, APP2 = JPEG_APP0 + 2, MARKER_MOST = 0xffff, ORIENTATION = 0x0112 };

typedef struct reading {
  struct jpeg_error_mgr manager; /* first: libjpeg knows only this part */
  jmp_buf back;
  struct jpeg_decompress_struct jpeg;
  cs_raster *out;
  cs_picture_failure *failure;
  celspan_status status;
} reading;

static void note_error(j_common_ptr jpeg) {
  reading *r = (reading *)(void *)jpeg->err;
  char text[JMSG_LENGTH_MAX];
  jpeg->err->format_message(jpeg, text);
  bool is_starved = jpeg->err->msg_code == JERR_OUT_OF_MEMORY;
  r->status = is_starved ? cs_raster_fail(r->failure, CELSPAN_NO_MEMORY, "out of memory")
                         : cs_raster_fail(r->failure, CELSPAN_INPUT, "is corrupt: %s", text);
  longjmp(r->back, 1);
}

/* The library would fill a missing end with grey and report success. */
static void note_warning(j_common_ptr jpeg, int level) {
  reading *r = (reading *)(void *)jpeg->err;
  if (level >= 0 || jpeg->err->msg_code != JWRN_JPEG_EOF)
    return;
  r->status =
      cs_raster_fail(r->failure, CELSPAN_INPUT, "is truncated: the end of the picture is missing");
  longjmp(r->back, 1);
}

/* ---------------------------------------------------------------- the orientation */

/* A number of two or four bytes in an Exif block; 0 beyond the end of the block. */
static uint32_t number_at(const jpeg_saved_marker_ptr marker, size_t at, int bytes, bool is_big) {
  uint32_t number = 0;
  if (at + (size_t)bytes > marker->data_length)
    return 0;
  for (int i = 0; i < bytes; i++)
    number = number << 8 | marker->data[at + (size_t)(is_big ? i : bytes - 1 - i)];
  return number;
}

static int orientation_in(const jpeg_saved_marker_ptr marker) {
  const size_t head = 6; /* "Exif\0\0", after which offsets are counted */
  if (marker->data_length < 14 || memcmp(marker->data, "Exif\0", head) != 0)
    return 1;
  bool is_big = marker->data[head] == 'M';
  size_t list = head + number_at(marker, head + 4, 4, is_big);
  uint32_t count = number_at(marker, list, 2, is_big);
  for (uint32_t i = 0; i < count; i++) {
    size_t entry = list + 2 + 12 * (size_t)i;
    if (number_at(marker, entry, 2, is_big) == ORIENTATION)
      return (int)number_at(marker, entry + 8, 2, is_big);
  }
  return 1;
}

/* ---------------------------------------------------------------- pixels */

/* Converts inks in the form of Adobe's programs, where greater values are brighter, to colours. In
 * place: four values of each pixel become three. */
static void mix_inks(unsigned char *row, int32_t width) {
  for (int32_t x = 0; x < width; x++)
    for (int c = 0; c < 3; c++)
      row[3 * x + c] = (unsigned char)(row[4 * x + c] * row[4 * x + 3] / 255);
}

static bool has_inks(const reading *r) { return r->jpeg.out_color_space == JCS_CMYK; }

static void read_rows(reading *r, unsigned char *wide) {
  while (r->jpeg.output_scanline < r->jpeg.output_height) {
    unsigned char *row =
        (unsigned char *)r->out->pixels + (size_t)r->jpeg.output_scanline * cs_raster_row(r->out);
    JSAMPROW into = has_inks(r) ? wide : row;
    jpeg_read_scanlines(&r->jpeg, &into, 1);
    if (!has_inks(r))
      continue;
    mix_inks(wide, r->out->width);
    memcpy(row, wide, cs_raster_row(r->out));
  }
}

static void choose_form(reading *r) {
  J_COLOR_SPACE space = r->jpeg.jpeg_color_space;
  bool is_ink = space == JCS_CMYK || space == JCS_YCCK;
  r->jpeg.out_color_space = space == JCS_GRAYSCALE ? JCS_GRAYSCALE : is_ink ? JCS_CMYK : JCS_RGB;
  r->out->channels = space == JCS_GRAYSCALE ? 1 : 3;
  r->out->bits = 8;
  if (r->jpeg.density_unit == 1 || r->jpeg.density_unit == 2) /* dots per inch, or centimetre */
    r->out->dpi = (r->jpeg.density_unit == 1 ? 1 : 2.54) * r->jpeg.X_density;
  r->out->colour = "srgb";
}

static void read_profile(reading *r) {
  JOCTET *bytes = NULL;
  unsigned size = 0;
  if (jpeg_read_icc_profile(&r->jpeg, &bytes, &size))
    cs_profile_name_read(bytes, size, r->out->profile);
  free(bytes);
}

static void decode(reading *r, const cs_raster_file *file) {
  if (setjmp(r->back))
    return;
  jpeg_create_decompress(&r->jpeg);
  jpeg_mem_src(&r->jpeg, file->bytes, (unsigned long)file->size);
  jpeg_save_markers(&r->jpeg, APP1, MARKER_MOST);
  jpeg_save_markers(&r->jpeg, APP2, MARKER_MOST);
  jpeg_read_header(&r->jpeg, TRUE);
  for (jpeg_saved_marker_ptr marker = r->jpeg.marker_list; marker; marker = marker->next)
    if (r->out->orientation == 1)
      r->out->orientation = orientation_in(marker);
  read_profile(r);
  choose_form(r);
  r->status = cs_raster_make(r->out, r->jpeg.image_width, r->jpeg.image_height, r->failure);
  if (r->status != CELSPAN_OK)
    return;
  jpeg_start_decompress(&r->jpeg);
  JSAMPARRAY wide =
      r->jpeg.mem->alloc_sarray((j_common_ptr)&r->jpeg, JPOOL_IMAGE, 4 * r->jpeg.output_width, 1);
  read_rows(r, wide[0]);
  jpeg_finish_decompress(&r->jpeg);
}

celspan_status cs_raster_jpeg(const cs_raster_file *file, cs_raster *out,
                              cs_picture_failure *failure) {
  reading r = {.out = out, .failure = failure, .status = CELSPAN_OK};
  r.jpeg.err = jpeg_std_error(&r.manager);
  r.manager.error_exit = note_error;
  r.manager.emit_message = note_warning;
  out->orientation = 1;
  decode(&r, file);
  jpeg_destroy_decompress(&r.jpeg);
  return r.status;
}
