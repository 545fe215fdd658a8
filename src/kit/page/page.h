/* A film in a page, for the files whose functions engine.mjs calls. */
#pragma once

#include "celspan/lua.h"
#include "lua/bind/built_in.h"

/* JavaScript calls them: no header declares them. */
#pragma GCC diagnostic ignored "-Wmissing-prototypes"
#define TO_PAGE(name) __attribute__((export_name(#name)))
#define FROM_PAGE(name) __attribute__((import_module("page"), import_name(#name)))

typedef struct page {
  celspan_context *context;
  lua_State *L; /* with the film at 1, when a script has run, and perhaps its sounds at 2 */
  celspan_film film;
  celspan_parameter parameter; /* the one asked for last */
  celspan_sound sound;         /* likewise; of those at 2 */
  size_t sound_count;
  celspan_frame_desc frame;
  celspan_coding coding;
  bool has_line; /* the line of `keep` made something */
  char *printed; /* NULL: nothing */
  size_t printed_size;
  unsigned char *png; /* the latest; NULL: none */
} page;

/* Builds a frame, which is in `frame` then. */
celspan_status cs_page_frame(page *p, double number);

/* writers.lua, and what it runs. */
extern const cs_built_in cs_page_texts[];
