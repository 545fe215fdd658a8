/* The layers of paintings: OpenRaster, Krita and Photoshop files.
 * The conventions of celspan/celspan.h hold. */
#ifndef CELSPAN_LAYERS_H
#define CELSPAN_LAYERS_H

#include "celspan/celspan.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The contents of an OpenRaster file (.ora), a Krita document (.kra) or a Photoshop document (.psd,
 * .psb, with 8 or 16 bits per channel, RGB or grey): layers and groups of them. Only the file's
 * tables are read at first; the pixels of a layer are read when they are first visible, and then
 * kept like those of any picture. The file must not change while surfaces of it are in use. */
typedef struct celspan_painting celspan_painting;

typedef struct celspan_painting_layer {
  size_t struct_size;
  const char *name;  /* UTF-8; may be "". This and blend live as long as the painting */
  const char *blend; /* "normal", "multiply", "add", "screen", "pass-through", ... */
  size_t parent;     /* the place of the group that it lies in, after its own; the count: in none */
  bool is_group, is_visible;
  double opacity;              /* 0..1 */
  int32_t x, y, width, height; /* where its pixels lie, from the painting's top left corner */
  celspan_surface *surface;    /* borrowed; NULL: a group, or a layer without pixels */
  const char *colour; /* "srgb" or "linear": for the picture that is made of the surface, whose
                                  pixels are converted by the file's colour profile */
} celspan_painting_layer;

CELSPAN_RESULT(celspan_painting_layer)
#define CELSPAN_PAINTING_LAYER (celspan_painting_layer_initial())

/* A key of a layer of a Krita document that moves: from its frame on the layer, which is a group
 * of drawings, shows one of them, or has an opacity. */
typedef struct celspan_painting_key {
  size_t struct_size;
  size_t layer;   /* its place */
  int32_t frame;  /* as Krita counts, from 0; keys of a layer ascend */
  int32_t colour; /* the number of the label that the key has in Krita, 0: none */
  bool is_opacity;
  size_t drawing;      /* the place of the drawing that is shown, if this is no key of an opacity */
  double opacity;      /* 0..1 */
  const char *between; /* to the next key of an opacity: "constant", "linear" or "bezier" */
  double in[2], out[2]; /* handles of a curve, from the key: frames, and shares of opacity */
} celspan_painting_key;

CELSPAN_RESULT(celspan_painting_key)
#define CELSPAN_PAINTING_KEY (celspan_painting_key_initial())

/* file: borrowed      out: new
 * Errors: INPUT for a file that is missing, damaged or of another format, with the byte or line;
 * LIMIT for more than 65,536 layers and drawings, a million keys, groups more than 100 deep,
 * pictures of more than 1,048,576 pixels a side or 268,435,456 in all, XML of more than 16 MiB;
 * NO_MEMORY, BAD_ARGUMENT. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_painting_read(celspan_context *context,
                                                                 const char *file,
                                                                 celspan_painting **out);
/* Surfaces of its layers live on, where they are kept. NULL is ignored. */
CELSPAN_API celspan_painting *celspan_painting_ref(celspan_painting *painting);
CELSPAN_API void celspan_painting_unref(celspan_painting *painting);
/* Its size in pixels. Shared read, as all that follow. */
CELSPAN_API void celspan_painting_size(const celspan_painting *painting, int32_t *width,
                                       int32_t *height);
CELSPAN_API size_t celspan_painting_layer_count(const celspan_painting *painting);
/* The layer at a place, from 0, rearmost first, a group after all that lies in it. false, and
 * *out is unchanged: there is none, or *out has no size. */
CELSPAN_API bool celspan_painting_layer_at(const celspan_painting *painting, size_t index,
                                           celspan_painting_layer *out);
/* What of the file is not shown as the program that made it does, in sentences; *layer: the place
 * of the layer, or the count of layers where it is about the whole painting. NULL where there is no
 * such note. */
CELSPAN_API size_t celspan_painting_note_count(const celspan_painting *painting);
CELSPAN_API const char *celspan_painting_note_at(const celspan_painting *painting, size_t index,
                                                 size_t *layer);
/* The frames of a painting that moves: how many a second, and the first and the last of them, as
 * Krita counts. false, and nothing is changed: it does not move. */
CELSPAN_API bool celspan_painting_clip(const celspan_painting *painting, double *rate,
                                       int32_t *from, int32_t *to);
CELSPAN_API size_t celspan_painting_key_count(const celspan_painting *painting);
/* false, and *out is unchanged: there is no such key, or *out has no size. */
CELSPAN_API bool celspan_painting_key_at(const celspan_painting *painting, size_t index,
                                         celspan_painting_key *out);

#ifdef __cplusplus
}
#endif
#endif
