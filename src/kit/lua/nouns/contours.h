/* Contours as tables, { x, y, and six numbers for each piece, closed = true }: celspan_contour. */
#pragma once

#include "lua/bind/form.h"

/* A list of contours: scratch memory. */
typedef struct cs_contour_list {
  celspan_contour *items; /* NULL: not given */
  size_t count;
} cs_contour_list;

/* Reads the value on top of the stack; the scratch memory is then above it. noun: for messages. */
cs_contour_list cs_contours_read(lua_State *L, const char *noun);
/* The field `contours`: its row, and how it is read. */
#define CS_CONTOURS                                                                                \
  "contours", CS_OWN("celspan.contour[]"),                                                         \
      .about = "Lists of numbers: x, y of the beginning, and six for each piece"
cs_contour_list cs_contours_field(const cs_form *form);
