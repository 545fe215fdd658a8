/* The answers of a film that is being watched (celspan watch): pictures and sounds in memory, the
 * objects at a point, the costs of cels, and the files that it reads. They are methods of a film in
 * Lua. */
#pragma once

#include <lua.h>

#include "inside/png.h"
#include "inside/scene.h"
#include "program/film/script.h"
#include "program/film/service.h"

/* Reads which part of the frame that was built last is wanted: the size of the frame, and a crop of
 * it, as six numbers from index 2 on. false: the crop is outside of the frame, or has too many
 * pixels; nil and a message are pushed. */
bool cs_stage_frame(lua_State *L, const cs_script *script, celspan_frame_desc *out);

/* What a picture shows, and its form: straight codes of sRGB with 8 bits, or the kinds of spans. */
typedef enum cs_stage_kind {
  CS_STAGE_CODES,
  CS_STAGE_PNG,
  CS_STAGE_KINDS,
  CS_STAGE_RUNS /* codes, packed */
} cs_stage_kind;

/* A picture in memory. One that is all zero may be released, too. */
typedef struct cs_stage_picture {
  bool is_opaque;   /* of a PNG: it has no alpha */
  bool has_workers; /* of a PNG: those of the frame pack it, too */
  celspan_coding coding;
  celspan_context *context; /* whose memory has the bytes; borrowed */
  unsigned char *bytes;     /* owned */
  size_t size, capacity;
  size_t stride; /* bytes of a row; 0 for a PNG */
  int workers;
  cs_png_strips *strips; /* the strips of a PNG that is being made */
} cs_stage_picture;

/* p: all zero, except is_opaque and has_workers. It must be released, whatever this returns. Any
 * thread. */
CELSPAN_CHECKED celspan_status cs_stage_make(cs_stage_picture *p, celspan_context *context,
                                             const celspan_frame_desc *desc, cs_stage_kind kind);
void cs_stage_release(cs_stage_picture *p);

/* The label of a cel of a rostrum: its name, or its place from the rear in the form that sheets
 * have, "cel 2", which is written to `label`. */
enum { CS_STAGE_LABEL = 32 };
const char *cs_stage_label(const celspan_rostrum *rostrum, size_t i, char label[CS_STAGE_LABEL]);
/* The shot that a cel of a frame of a cut shows, if it shows nothing else; NULL: none. Borrowed. */
celspan_rostrum *cs_stage_part(const celspan_cel *cel);

int cs_stage_draw(lua_State *L);
int cs_stage_hits(lua_State *L);
int cs_stage_tree(lua_State *L);
int cs_stage_files(lua_State *L);
int cs_stage_sound(lua_State *L);
int cs_stage_wave(lua_State *L);
int cs_stage_alter(lua_State *L);
int cs_stage_keep_line(lua_State *L);
int cs_stage_costs(lua_State *L);
int cs_stage_camera(lua_State *L);
/* by: the frame whose camera is used. */
int cs_stage_use_camera(lua_State *L, cs_script *script, const celspan_rostrum *by);
