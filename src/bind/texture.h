/* The picture fields that celspan.picture and celspan.image share. */
#ifndef CS_BIND_TEXTURE_H
#define CS_BIND_TEXTURE_H

#include "bind/pixel_string.h"

#define CS_TEXTURE_PICTURE_FIELDS                                                                  \
  {"file", NULL}, {"colour", NULL}, {"sampling", "auto"}, {"as", "paint"}, {"wrap", "clear"},      \
      {"subimage", NULL}, {"layer", NULL}, {"source", NULL}, {"pixels", NULL}, {"size", NULL},     \
      {"format", NULL}, {                                                                          \
    "alpha", NULL                                                                                  \
  }
/* A picture is a file or pixels in memory. */
#define CS_TEXTURE_PICTURE_EITHER                                                                  \
  .either = {"file", "pixels"}, .second = cs_texture_pixels_fields,                                \
  .complete = cs_pixel_string_complete
extern const char *const cs_texture_pixels_fields[];

/* Reads them for the value at index `holder`; strings are borrowed from the table or from the
 * stack, where the name of the file, as it was found, is left. A surface is
 * kept alive by the value. */
void cs_texture_read_picture(const cs_form *form, int holder, celspan_picture_desc *desc);

#endif
