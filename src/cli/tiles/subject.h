/* What the tiles show: a frame of a script's film, or a picture.
 */
#ifndef CS_CLI_TILES_SUBJECT_H
#define CS_CLI_TILES_SUBJECT_H

#include "cli/script.h"
#include "cli/still.h"

enum { CS_TILE_SUBJECT_NAME = 128 };

typedef struct cs_tile_subject {
  celspan_context *context;
  bool is_script;
  cs_script script;         /* open where is_script */
  cs_still still;           /* open where not */
  celspan_frame_desc frame; /* the whole of it, under the options */
  char name[CS_TILE_SUBJECT_NAME];
  const char *title;
} cs_tile_subject;

/* Opens the first operand of the request: a script where its name ends in .lua, else a picture. OK,
 * or reported; either way *out has to be closed. */
cs_exit cs_tile_subject_open(celspan_context *context, const cs_request *request,
                             cs_tile_subject *out);
void cs_tile_subject_close(cs_tile_subject *subject);
/* The light behind everything, linear and premultiplied; nothing for a picture. */
void cs_tile_subject_background(const cs_tile_subject *subject, float out[4]);
/* The frame, or another size or crop of it, into a sink. */
CELSPAN_CHECKED celspan_status cs_tile_subject_render(const cs_tile_subject *subject,
                                                      const celspan_frame_desc *frame,
                                                      const celspan_sink *sink);

#endif
