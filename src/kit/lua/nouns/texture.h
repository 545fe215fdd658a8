/* The picture fields that celspan.picture and celspan.image share. */
#pragma once

#include "lua/nouns/pixel_string.h"

/* The fields, while they are read. */
typedef struct cs_texture_picture {
  celspan_picture_desc picture;
  celspan_image_desc image; /* not used by celspan.picture */
  const char *file;         /* NULL: there are pixels instead */
  int frame;                /* the number of the frame, for a file such as roto.####.png */
  bool has_frame;
  cs_pixel_string pixels;
} cs_texture_picture;

extern const cs_field cs_texture_picture_fields[];
/* A picture is a file or pixels in memory. */
#define CS_TEXTURE_PICTURE_EITHER                                                                  \
  .either = {"file", "pixels"}, .second = cs_texture_pixels_fields,                                \
  .complete = cs_pixel_string_complete
extern const char *const cs_texture_pixels_fields[];

/* Reads all fields of the noun for the value at index `holder`; strings are borrowed from the table
 * or from the stack; the path at which the file was found is left on the stack. A surface is kept
 * alive by the value. */
void cs_texture_read_picture(const cs_form *form, int holder, cs_texture_picture *out);
