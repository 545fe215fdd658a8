/* Textures: the colours of a primitive. Immutable once made, counted atomically.
 *
 * Invariants, so that no reader checks again: a triangle has an area, a linear gradient a length, a
 * radial one a radius, a picture's box (if any) a size, and there are two stops or more. A texture
 * that would break them is made FLAT at its construction.
 *
 *   FLAT        [ texture ]                      most textures of most scenes: they are kept small
 *   all others  [ texture | its variation ]      one allocation
 *
 * A PATTERN is on no primitive: a primitive that is given a pattern becomes a boolean (pattern.h).
 */
#pragma once

#include "base/hash.h"
#include "base/mark.h"
#include "model/colour/paint.h"
#include "model/pictures/picture.h"
#include "model/scene/noise.h"

typedef enum cs_texture_kind {
  CS_TEXTURE_FLAT,
  CS_TEXTURE_TRIANGLE,
  CS_TEXTURE_LINEAR,
  CS_TEXTURE_RADIAL,
  CS_TEXTURE_CONIC,
  CS_TEXTURE_NOISE,
  CS_TEXTURE_PICTURE,
  CS_TEXTURE_PATTERN
} cs_texture_kind;

typedef struct cs_stop {
  double at;
  cs_paint paint;
} cs_stop;

/* The functions that keep and release a tile. */
typedef struct cs_texture_tile_calls {
  celspan_rostrum *(*keep)(celspan_rostrum *tile);
  void (*release)(celspan_rostrum *tile);
} cs_texture_tile_calls;

/* How a gradient without points lies in the bounds of what it paints: texture_fit.h. */
typedef enum cs_texture_fit_kind {
  CS_TEXTURE_FIT_NONE, /* it has points */
  CS_TEXTURE_FIT_SIDE, /* LINEAR: to a side or to a corner */
  CS_TEXTURE_FIT_ANGLE,
  CS_TEXTURE_FIT_ELLIPSE /* RADIAL */
} cs_texture_fit_kind;

/* The values of textures that vary from point to point. */
typedef struct cs_texture_variation {
  celspan_point points[3]; /* TRIANGLE: corners; LINEAR: from, to; RADIAL: centre, and the way
                              from it to the focus, less than the radius; CONIC: centre, and the
                              direction of 0, of length 1 */
  double radius;           /* RADIAL */
  cs_paint corners[3];     /* TRIANGLE */
  cs_stop *stops;          /* LINEAR, RADIAL, CONIC, NOISE */
  size_t stop_count;
  cs_noise noise;                 /* NOISE */
  celspan_spread spread;          /* LINEAR, RADIAL; HOLD in textures of primitives and lights */
  bool has_matrix;                /* the texture has one, which is not singular: */
  celspan_matrix matrix, inverse; /* from the texture's units to the primitive's */
  celspan_texture *origin;        /* the texture before unrolling, a reference; NULL: none */
  cs_picture *picture;            /* PICTURE */
  cs_picture *medium; /* PICTURE, of a paint: its rgb is T; NULL: T is 1 - alpha of `picture` */
  celspan_sampling sampling;
  celspan_picture_use use;
  celspan_wrap wrap;
  bool has_box;
  celspan_box box; /* where has_box; else the primitive's tight bounds. PATTERN: the repeated box */
  celspan_rostrum *tile; /* PATTERN: one box of it; a reference */
  cs_hash tile_hash;
  const cs_texture_tile_calls *calls; /* how the tile is asked; NULL: there is none */
  cs_texture_fit_kind fit;            /* NONE in textures of primitives */
} cs_texture_variation;

struct celspan_texture {
  atomic_size_t references;
  cs_memory *memory;
  cs_hash hash;
  cs_mark mark;
  cs_texture_kind kind;
  cs_paint flat; /* FLAT */
  /* Its own; all FLAT textures share one that is all zero. */
  const cs_texture_variation *variation;
};

/* An empty texture of a kind: the caller fills it and hashes it again. *out: new. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_texture_create_kind(celspan_context *context,
                                                      cs_texture_kind kind, celspan_texture **out);
/* A texture with stops, checked; the caller fills what its kind needs and hashes it. is_degenerate:
 * there is no length over which the stops could be spread, so every point lies after the last one,
 * and the texture is FLAT, as with one stop. *out: new. Errors: NO_MEMORY, BAD_ARGUMENT. */
CELSPAN_CHECKED celspan_status cs_texture_create_stops(celspan_context *context, const char *noun,
                                                       cs_texture_kind kind,
                                                       const celspan_stop *stops, size_t count,
                                                       bool is_degenerate, celspan_texture **out);
/* *out: `texture` with one more reference, or new opaque black if it is NULL. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_texture_or_black(celspan_context *context,
                                                   celspan_texture *texture, celspan_texture **out);

/* The texture as a light: with clear media, so that T is 1 - beta; a gel gives no light. *out: new,
 * or `texture` with one more reference. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_texture_create_light(celspan_context *context,
                                                       celspan_texture *texture,
                                                       celspan_texture **out);

/* A copy of a texture that is no picture, with its pigments as codes. *out: new. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_texture_create_coded(celspan_context *context,
                                                       const celspan_texture *texture,
                                                       celspan_texture **out);

/* The variation of a texture that is being made and is not FLAT, to be filled. */
cs_texture_variation *cs_texture_own(celspan_texture *texture);
/* A copy with its own mark, which it owns from now on, and room for the given number of stops. It
 * copies as many stops as fit. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_texture_copy(celspan_context *context,
                                               const celspan_texture *texture, size_t stop_count,
                                               cs_mark mark, celspan_texture **out);
/* A copy with another medium, which is kept, or none. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_texture_copy_medium(celspan_context *context,
                                                      const celspan_texture *texture,
                                                      cs_picture *medium, celspan_texture **out);
/* *out: a new texture: a picture that had no box gets this one, and continues beyond its edges,
 * because it ends where the object ends. For other textures `texture` with one more reference.
 * Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_texture_boxed(celspan_context *context, celspan_texture *texture,
                                                const celspan_box *box, celspan_texture **out);
/* Must be called after a copy was changed. */
void cs_texture_rehash(celspan_texture *texture);
/* The end of making a texture: rehashes it. */
celspan_status cs_texture_finish(celspan_texture *texture, celspan_texture **out);
/* *out: new. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_texture_create_flat(celspan_context *context,
                                                      const celspan_paint *paint,
                                                      celspan_texture **out);

/* Whether every colour of the texture lets the three channels through alike. A picture is grey
 * unless it is a gel or has a medium. */
bool cs_texture_is_grey(const celspan_texture *texture);
/* Whether the texture's picture is a surface that only the rendering thread draws. */
bool cs_texture_stays_on_thread(const celspan_texture *texture);
