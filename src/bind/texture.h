/* The picture fields that celspan.picture and celspan.image share. */
#ifndef CS_BIND_TEXTURE_H
#define CS_BIND_TEXTURE_H

#include "bind/form.h"

#define CS_TEXTURE_PICTURE_FIELDS                                                                  \
  {"file", NULL}, {"colour", NULL}, {"sampling", "auto"}, {"as", "paint"}, {"wrap", "clear"},      \
      {"subimage", NULL}, {                                                                        \
    "layer", NULL                                                                                  \
  }

/* Reads them; strings are borrowed from the table or from the stack, where the name of the file,
 * resolved against the script's folder, is left. */
void cs_texture_read_picture(const cs_form *form, celspan_picture_desc *desc);

#endif
