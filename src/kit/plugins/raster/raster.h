/* A picture that was decoded as a whole, and the formats that it may come from.
 *
 *   bytes --png.c, jpeg.c, webp.c, tiff.c, exr.c--> raster --module.c--> RGBA floats, upright
 *
 * INVARIANT: the sizes of a raster are within the limits of cs_raster_make, which every format asks
 * before it takes memory, and its pixels belong to it until cs_raster_finish.
 */
#pragma once

#include "inside/pictures.h"

#define CS_RASTER_PIXELS ((uint64_t)1 << 28) /* at most, of a picture that is read or written */

typedef struct cs_raster {
  const char *format;             /* "png" */
  const char *colour;             /* "srgb", "linear", ...: how it is read by default */
  char space[CS_PICTURE_SPACE];   /* as in cs_picture_header, with the primaries */
  char profile[CS_PICTURE_SPACE]; /* as in cs_picture_header */
  bool names_colour, has_primaries;
  float primaries[8];
  int32_t width, height;
  int channels;     /* in `pixels`: 1 grey, 2 grey and alpha, 3 colours, 4 colours and alpha */
  int bits;         /* the bits of a value: 8, 16, or 32 for floats */
  bool is_whole;    /* the floats are shares of whole numbers in the file */
  bool lacks_alpha; /* the file has none: that in `pixels` says where the file has pixels */
  int orientation;  /* TIFF's: 1 upright .. 8 */
  double dpi;       /* 0: the file does not say */
  bool is_multiplied;
  cs_picture_part *parts; /* what else is in the file; owned; NULL: nothing */
  int part_count;
  int stored;   /* channels in the file; 0: those in `pixels` */
  void *pixels; /* rows from the top, interleaved, in the machine's byte order */
} cs_raster;

typedef struct cs_raster_file {
  const unsigned char *bytes;
  size_t size;
  const char *layer; /* NULL, or the name of a layer */
  int subimage;
} cs_raster_file;

/* Fails with a sentence about the file, which begins with a verb. Returns the status. */
celspan_status cs_raster_fail(cs_picture_failure *failure, celspan_status status,
                              const char *format, ...) __attribute__((format(printf, 3, 4)));
/* Makes room for pixels of these sizes, all 0. Errors: INPUT, LIMIT, NO_MEMORY. */
celspan_status cs_raster_make(cs_raster *raster, uint64_t width, uint64_t height,
                              cs_picture_failure *failure);
void cs_raster_finish(cs_raster *raster);
/* The bytes of a row. */
size_t cs_raster_row(const cs_raster *raster);

/* Each function decodes a file of its format into `out`, which at first has only its format, and
 * must be finished even after a failure. Errors: INPUT, LIMIT, NO_MEMORY. */
typedef celspan_status (*cs_raster_decode)(const cs_raster_file *file, cs_raster *out,
                                           cs_picture_failure *failure);
celspan_status cs_raster_png(const cs_raster_file *file, cs_raster *out,
                             cs_picture_failure *failure);
celspan_status cs_raster_jpeg(const cs_raster_file *file, cs_raster *out,
                              cs_picture_failure *failure);
celspan_status cs_raster_webp(const cs_raster_file *file, cs_raster *out,
                              cs_picture_failure *failure);
celspan_status cs_raster_tiff(const cs_raster_file *file, cs_raster *out,
                              cs_picture_failure *failure);
celspan_status cs_raster_exr(const cs_raster_file *file, cs_raster *out,
                             cs_picture_failure *failure);
