/* The cels of a frame apart: a layer for each, with its lights, as `--cel` shows it alone.
 *
 *   exposures                            layers, from the back
 *   rostrum: back light  ------------->  backlight   the light behind everything, if there is one
 *            cel "wall"  ------------->  wall        a rostrum with this cel alone
 *            cel "hand"  ------------->  hand
 *            cel "hand"  ------------->  hand_2      an equal name gets a number
 *            cel         ------------->  cel_4       a cel without a name: its place in the rostrum
 *
 * The cels of several exposures that have the same name, and are equally many of that name from the
 * back, are one layer.
 *
 * INVARIANT: names are unique and safe (cs_safe_name). The layers own all that they show.
 */
#pragma once

#include "base/context.h"
#include "celspan/celspan.h"

/* Layers of a frame at most: as many as the picture modules read, with the composite. */
enum { CS_APART_MOST = 255, CS_APART_NAME = 256 };

typedef struct cs_apart_layer {
  char name[CS_APART_NAME];
  celspan_exposure *exposures; /* owned, with their rostrums */
  size_t count, capacity;
  size_t key;             /* how many layers of the same cel name are behind it in the exposure */
  const celspan_cel *cel; /* the first; NULL: the back light. Borrowed from the frame */
} cs_apart_layer;

typedef struct cs_apart {
  celspan_context *context;
  cs_apart_layer *layers;
  size_t count, capacity;
} cs_apart;

/* suffix: the most bytes that will be added to a name, which then has at most 255. Errors:
 * NO_MEMORY; LIMIT for too many layers. */
CELSPAN_CHECKED celspan_status cs_apart_make(celspan_context *context,
                                             const celspan_exposure *exposures, size_t count,
                                             size_t suffix, cs_apart *out);
void cs_apart_finish(cs_apart *apart);

/* ---- safe_name.c */

/* A name for a layer in any program: the bytes that separate names in files (. / and ,)
 * become _. It is cut where it has more than `most` bytes, at the beginning of a character. */
void cs_safe_name(const char *name, size_t most, char out[CS_APART_NAME]);

/* ---- sums.c */

/* Whether the layers over each other are the frame, where edges do not share a pixel. why: else a
 * clause that says what prevents it. film_space: of the frame's rows. */
enum { CS_APART_WHY = 768 };
bool cs_apart_sums(const celspan_exposure *exposures, size_t count, celspan_space film_space,
                   char why[CS_APART_WHY]);

/* ---- apart_exr.c */

/* Writes the frame, and its layers as channels NAME.R NAME.G NAME.B NAME.A, into an OpenEXR file in
 * linear light, row by row. file: its coding has depth DEFAULT, HALF or FLOAT. Errors: OUTPUT,
 * LIMIT, those of rendering. */
CELSPAN_CHECKED celspan_status cs_apart_write_exr(celspan_context *context,
                                                  const celspan_frame_desc *desc, const char *path,
                                                  const celspan_file_desc *file);
