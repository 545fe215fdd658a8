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

#include "celspan/celspan.h"
#include "inside/context.h"
#include "inside/hash.h"

/* Layers of a frame at most: as many as the picture modules read, with the composite. */
enum { CS_APART_MOST = 255, CS_APART_NAME = 256 };

typedef struct cs_apart_layer {
  char name[CS_APART_NAME];
  celspan_exposure *exposures; /* owned, with their rostrums */
  size_t count, capacity;
  size_t key;             /* how many layers of the same cel name are behind it in the exposure */
  const celspan_cel *cel; /* the first; NULL: the back light. Borrowed from the frame */
  double opacity;         /* with which it is put over the layers behind it */
  celspan_blend blend;    /* likewise */
} cs_apart_layer;

typedef struct cs_apart {
  celspan_context *context;
  cs_apart_layer *layers;
  size_t count, capacity;
} cs_apart;

typedef enum cs_apart_mattes {
  CS_APART_MATTES_NONE,
  CS_APART_MATTES_CELS,
  CS_APART_MATTES_NAMES
} cs_apart_mattes;

/* Whether anything of an exposure is in the frame. */
static inline bool cs_apart_shows(const celspan_exposure *exposure) { return exposure->weight > 0; }

/* A hash of exposures as cs_scene_hash, and of all names of cels and objects, which are in files
 * with layers. */
cs_hash cs_apart_hash(const celspan_exposure *exposures, size_t count);

/* suffix: the most bytes that will be added to a name, which then has at most 255. Errors:
 * NO_MEMORY; LIMIT for too many layers. */
CELSPAN_CHECKED celspan_status cs_apart_make(celspan_context *context,
                                             const celspan_exposure *exposures, size_t count,
                                             size_t suffix, cs_apart *out);
void cs_apart_finish(cs_apart *apart);
/* Takes the opacities and modes of cels out of what the layers show, for files that have both.
 * steps: opacities are whole numbers of this part of 1, and what is too much is taken from alpha;
 * 0: any. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_apart_take_mixings(cs_apart *apart, int steps);
/* What a painting program calls the layer: the unchanged name of its cel, if it has one.
 * Borrowed from the layer. */
const char *cs_apart_title(const cs_apart_layer *layer);

/* ---- safe_name.c */

/* A name for a layer in any program: the bytes that separate names in files (. / and ,)
 * become _. It is cut where it has more than `most` bytes, at the beginning of a character. */
void cs_safe_name(const char *name, size_t most, char out[CS_APART_NAME]);

/* ---- write.c */

/* What a file has beside the frame. */
typedef struct cs_apart_contents {
  bool has_layers;
  size_t place;           /* PNG: where the names of layers come into the file's name */
  cs_apart_mattes mattes; /* EXR: Cryptomatte */
} cs_apart_contents;

typedef struct cs_apart_format cs_apart_format;

/* A file with layers that is written: the first member of what its format keeps. */
typedef struct cs_apart_writing {
  celspan_context *context;
  const cs_apart_format *format;
  cs_apart_contents contents;
  celspan_frame_desc frame;
  const char *path;
  celspan_file_desc file;
  celspan_coding coding; /* resolved */
  int32_t width, height; /* the size of all pictures, in pixels */
  size_t suffix;         /* the most bytes that are added to a layer's name */
  cs_apart apart;
  size_t done, count; /* pictures: for the progress */
} cs_apart_writing;

/* What a format of files with layers can say, and how it is written: `check`, `begin`, `put` for
 * the frame as picture 0 and for all layers, from the rearmost one, and `end`. The frame comes
 * first, so that a picture that cannot be read is reported with its place in the frame. All
 * functions but `put` may be NULL. */
struct cs_apart_format {
  celspan_depth depth; /* where none is given */
  bool is_light;       /* layers have linear light without a limit, also where alpha is 0 */
  bool (*has_mode)(celspan_blend blend); /* NULL: layers have no modes and opacities */
  int steps;                             /* opacities are whole numbers of this part of 1; 0: any */
  size_t size;                           /* bytes of what is kept, which are 0 at the beginning */
  celspan_status (*check)(cs_apart_writing *writing); /* before there are layers */
  celspan_status (*begin)(cs_apart_writing *writing);
  celspan_status (*put)(cs_apart_writing *writing, const celspan_frame_desc *picture, size_t index);
  /* In any case after `begin`. outcome: of all that came before. */
  celspan_status (*end)(cs_apart_writing *writing, celspan_status outcome);
};

/* OpenEXR in linear light, row by row, with layers as channels NAME.R NAME.G NAME.B NAME.A, and
 * with mattes; coding: depth DEFAULT, HALF or FLOAT. PNG: a file for each layer. OpenRaster;
 * Photoshop. These two: straight alpha, and depth DEFAULT, 8 or 16. */
extern const cs_apart_format cs_apart_exr, cs_apart_png, cs_apart_ora, cs_apart_psd;

/* Writes the frame and what it contains. Errors: OUTPUT; LIMIT, for example of a frame that is too
 * large for the format, before it is rendered; those of rendering. */
CELSPAN_CHECKED celspan_status cs_apart_write(celspan_context *context,
                                              const cs_apart_format *format,
                                              cs_apart_contents contents,
                                              const celspan_frame_desc *desc, const char *path,
                                              const celspan_file_desc *file);

/* For formats: makes a picture report its progress as the next one. */
void cs_apart_report_to(cs_apart_writing *writing, celspan_frame_desc *picture);
/* The same, and renders it into the sink. */
CELSPAN_CHECKED celspan_status cs_apart_render(cs_apart_writing *writing,
                                               const celspan_frame_desc *picture,
                                               celspan_sink *sink);

/* ---- adding_up.c */

/* Whether the layers over each other are the frame, where edges do not share a pixel. why: else a
 * clause that says what prevents it. coding: of the files. film_space: of the frame's
 * rows. */
enum { CS_APART_WHY = 768 };
bool cs_apart_sums(const celspan_exposure *exposures, size_t count, const cs_apart_format *format,
                   const celspan_coding *coding, celspan_space film_space, char why[CS_APART_WHY]);
