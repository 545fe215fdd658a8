/* Planes for the other rooms: rows of one, one after the other, and frames as plane files. */
#pragma once

#include "celspan/celspan.h"
#include "celspan/plane.h"
#include "inside/context.h"
#include "inside/hash.h"

/* Whether a file is read as a plane: it begins as plane files do, or its name has their ending. */
bool cs_plane_accepts(const char *path);
/* celspan_plane_frame of a file, whose name is in the message about a damaged frame. */
CELSPAN_CHECKED celspan_status cs_plane_choose(celspan_context *context, const char *name,
                                               const celspan_plane *plane, int32_t frame,
                                               celspan_plane **out);
/* A plane that is in the file of another one, from 0 to its count of them. out: new. Errors: as of
 * cs_plane_choose. */
CELSPAN_CHECKED celspan_status cs_plane_enter(celspan_context *context, const char *name,
                                              const celspan_plane *plane, uint32_t index,
                                              celspan_plane **out);
/* The depth of a plane, 8 or 16, where a file of pixels would have one. */
static inline int32_t cs_plane_depth(celspan_depth depth) {
  return depth == CELSPAN_DEPTH_8 ? 8 : 16;
}
/* Writes a frame as a plane file of a depth, 8 or 16: its film; size, crop and antialiasing are
 * ignored. Errors: those of making and of writing a plane. */
CELSPAN_CHECKED celspan_status cs_plane_write_frame(celspan_context *context,
                                                    const celspan_frame_desc *frame,
                                                    const char *path, int32_t depth);

/* As celspan_plane_create, of a frame that is the sum of its exposures. */
CELSPAN_CHECKED celspan_status cs_plane_expose(celspan_context *context,
                                               const celspan_exposure *exposures, size_t count,
                                               const celspan_plane_desc *desc, celspan_plane **out);

/* A film of planes as one file, which appears under its name when it is committed, not before. */
typedef struct cs_plane_film cs_plane_film;
typedef struct cs_plane_film_desc {
  double width, height; /* film units, above 0 */
  double frames_second; /* 0: a single plane */
  int32_t depth;        /* 8 or 16 */
} cs_plane_film_desc;
/* out: new; to be committed or discarded. Errors: NO_MEMORY; OUTPUT; LIMIT. */
CELSPAN_CHECKED celspan_status cs_plane_film_create(celspan_context *context, const char *path,
                                                    const cs_plane_film_desc *desc,
                                                    cs_plane_film **out);
/* The next frame. scene: its hash, so that it is not made if it equals the latest one; NULL: it is
 * made. Errors: those of making and of writing a plane; then the film can only be discarded. */
CELSPAN_CHECKED celspan_status cs_plane_film_put(cs_plane_film *film,
                                                 const celspan_frame_desc *frame,
                                                 const cs_hash *scene);
/* Both functions end the film, whatever they return. */
CELSPAN_CHECKED celspan_status cs_plane_film_commit(cs_plane_film *film);
void cs_plane_film_discard(cs_plane_film *film); /* NULL is ignored */

/* The contents of a plane, as counts. A chain or border that crosses several bands counts once for
 * each. */
typedef struct cs_plane_facts {
  size_t parts; /* bands of the file */
  size_t borders, curves;
  size_t colours, gradients; /* cells of one colour; all other cells */
  size_t pictures;           /* the pictures of the file, of this frame and those before it */
  size_t inner, shown;       /* planes in it, and the places where it shows them */
} cs_plane_facts;
cs_plane_facts cs_plane_count(const celspan_plane *plane);

/* The rows of a view. */
typedef struct cs_plane_rows cs_plane_rows;
/* plane: must live as long as the rows. out: new. Errors: those of celspan_plane_render. */
CELSPAN_CHECKED celspan_status cs_plane_rows_create(celspan_context *context,
                                                    const celspan_plane *plane,
                                                    const celspan_plane_view *view,
                                                    cs_plane_rows **out);
void cs_plane_rows_destroy(cs_plane_rows *rows); /* NULL is ignored */
/* y: a row of the crop, from 0. Asking for rows from the top down is quickest. Valid until the next
 * call. */
CELSPAN_CHECKED celspan_status cs_plane_rows_get(cs_plane_rows *rows, int32_t y,
                                                 const celspan_span **spans, size_t *count);
