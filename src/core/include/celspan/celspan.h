/* celspan - a compositing engine for cel animation: scenes in, rows of colour spans out.
 *
 * What draws a frame. A program builds a scene from immutable values (textures, objects, cels, a
 * rostrum), describes a frame (size, crop, exposures) and renders it into a sink, into pixels, into
 * a file, or row by row. There is no frame buffer: work and memory follow the number of colour
 * spans, so a frame may be a million pixels a side. Tools have headers of their own beside this
 * one: operators.h, text.h, svg.h, layers.h, trace.h, plane.h, relight.h, track.h, film.h, and
 * lua.h for Lua. It is one header, because a frame needs all of it.
 *
 * Conventions
 *   Coordinates  origin top left, x right, y down, in film units. Pixel i covers [i, i+1).
 *   Order        later is nearer the camera, in every list.
 *   Colour       linear light, float, wherever it is given. What comes out is premultiplied RGBA in
 *                the frame's working space, which is linear light unless the frame says otherwise.
 *   Angles       clockwise on screen, in the unit of their name: radians, or degrees in a blur.
 *   Matrices     row-major 3x3, column vectors: x' = (a x + b y + c)/(g x + h y + i).
 *   Intervals    [x0, x1) is half-open everywhere.
 *
 * Ownership, in four words
 *   borrowed  the callee uses it during the call and forgets it
 *   copied    the callee takes a copy of the bytes
 *   kept      the callee takes a reference of its own
 *   new       the caller must release it
 *
 * Errors: every call that can fail returns a celspan_status; outputs are untouched unless it is
 * CELSPAN_OK. The sentence for people stands in celspan_context_error(); it names fields as scripts
 * do and counts lists from 1. The library never exits, prints, or keeps globals; after any error
 * the context can be used again.
 *
 * Threads: a context belongs to one thread at a time. Scene values are immutable and counted
 * atomically: they may be shared by all threads ("shared read").
 *
 * Descriptions: structures that a program fills begin with struct_size, the size that the structure
 * has in the header that the program was compiled with, so that a later library knows which fields
 * there are. Begin with the defaults, then set what differs:
 *
 *   celspan_cel_desc desc = CELSPAN_CEL_DESC;
 *   desc.opacity = 0.5;
 *
 * In C, CELSPAN_DESC(celspan_rect_desc, .width = 3, .height = 2) is a description in one
 * expression; fields that are not named are 0 there, so it is for those whose defaults are all 0.
 * A description may end after any field once it has those that it needs: the rest has its defaults.
 * It may be longer than the library knows if the further bytes are 0. Sizes are multiples of 8.
 *
 * Results: structures that the library fills for a program begin with struct_size too, so that it
 * fills what the program has. Begin with their macro: celspan_statistics s = CELSPAN_STATISTICS.
 * Those that it lends by a pointer, one at a time (celspan_fault, celspan_glyph and
 * celspan_svg_element), may get fields at their end. All others, as celspan_point, never change.
 *
 * Not given: a pointer that is NULL, or a value whose flag has_... is false. All other fields have
 * the default that is named beside them, 0 if none is.
 *
 * One file, because it is the manual too: read from top to bottom it goes from values to frames,
 * and no part of it can be used without the one before.
 */
#ifndef CELSPAN_H
#define CELSPAN_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* What compilers other than GNU's and clang do not know. */
#ifdef __GNUC__
#define CELSPAN_API __attribute__((visibility("default")))
#define CELSPAN_CHECKED __attribute__((warn_unused_result))
#define CELSPAN_FORMAT(text, first) __attribute__((format(printf, text, first)))
#else
#define CELSPAN_API
#define CELSPAN_CHECKED
#define CELSPAN_FORMAT(text, first)
#endif

/* What every field of a structure is set to by "= CELSPAN_ZERO": C and C++ write it differently. */
#ifdef __cplusplus
#define CELSPAN_ZERO                                                                               \
  {}
#else
#define CELSPAN_ZERO                                                                               \
  { 0 }
#endif

/* The functions of a description: _default writes the defaults of its first struct_size bytes,
 * struct_size among them, and zeros what the library does not know; _initial returns them. Any
 * thread. */
#define CELSPAN_DESCRIPTION(type)                                                                  \
  CELSPAN_API void type##_default(type *out, size_t struct_size);                                  \
  static inline type type##_initial(void) {                                                        \
    type desc;                                                                                     \
    type##_default(&desc, sizeof desc);                                                            \
    return desc;                                                                                   \
  }

/* A structure that the library fills: _initial returns one with its struct_size, for the call. */
#define CELSPAN_RESULT(type)                                                                       \
  static inline type type##_initial(void) {                                                        \
    type result = CELSPAN_ZERO;                                                                    \
    result.struct_size = sizeof result;                                                            \
    return result;                                                                                 \
  }

#ifndef __cplusplus
#define CELSPAN_DESC(type, ...) ((type){.struct_size = sizeof(type), __VA_ARGS__})
#endif

#define CELSPAN_VERSION_MAJOR 0
#define CELSPAN_VERSION_MINOR 1
#define CELSPAN_VERSION_PATCH 0

/* The version of the library that is linked, "0.1.0". Any thread. */
CELSPAN_API const char *celspan_version(void);

/* ---------------------------------------------------------------- status and context */

typedef enum celspan_status {
  CELSPAN_OK = 0,
  CELSPAN_NO_MEMORY,    /* an allocation failed */
  CELSPAN_BAD_ARGUMENT, /* a number, a name or a combination that is refused */
  CELSPAN_LIMIT,        /* a stated limit would be passed */
  CELSPAN_INPUT,        /* a picture is missing, unreadable, corrupt or changed */
  CELSPAN_OUTPUT,       /* a file cannot be written */
  CELSPAN_CALLBACK,     /* a function of the caller's reported failure */
  CELSPAN_CANCELLED,    /* the progress function asked to stop */
  CELSPAN_INTERNAL      /* celspan broke a rule of its own: please report it */
} celspan_status;

/* "no memory", "bad argument", ... Any thread. */
CELSPAN_API const char *celspan_status_name(celspan_status status);

typedef struct celspan_context celspan_context;

/* One hook for all memory, as in Lua: block == NULL allocates, new_size == 0 frees and returns
 * NULL, else resizes. Must be safe to call from several threads. */
typedef void *(*celspan_resize)(void *user, void *block, size_t old_size, size_t new_size);

typedef struct celspan_context_desc {
  size_t struct_size;
  celspan_resize resize; /* NULL: the C library's */
  void *resize_user;
  size_t picture_bytes; /* decoded picture tiles kept in memory; 512 MiB */
  size_t defocus_bytes; /* defocused cels, maps of drawings (a quarter of it) and outlines of
                           strokes (a thirty-second), kept from frame to frame; 256 MiB */
} celspan_context_desc;

CELSPAN_DESCRIPTION(celspan_context_desc)
#define CELSPAN_CONTEXT_DESC (celspan_context_desc_initial())

/* desc  borrowed, NULL for the defaults      out  new
 * Errors: NO_MEMORY, BAD_ARGUMENT. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_context_create(const celspan_context_desc *desc,
                                                                  celspan_context **out);
/* Scene values may outlive their context. NULL is ignored. */
CELSPAN_API void celspan_context_destroy(celspan_context *context);
/* The last failure in a sentence, "" before any; of NULL, what lacks. Valid until the next call. */
CELSPAN_API const char *celspan_context_error(const celspan_context *context);
/* Records a sentence and returns `status`: for sinks and callbacks that fail. */
CELSPAN_API celspan_status celspan_context_fail(celspan_context *context, celspan_status status,
                                                const char *format, ...) CELSPAN_FORMAT(3, 4);
/* The place in a script at which the next values are made: messages about them name it. A value
 * made from another one by a transform, a fade or a name keeps the place of the other one. source:
 * copied, its first 255 bytes; NULL, or line 0: not known, as in a new context. What cannot be
 * kept, without memory or after 4096 different sources, is not known either. */
CELSPAN_API void celspan_context_set_origin(celspan_context *context, const char *source,
                                            int32_t line);
/* Bytes held now, the most ever held, and allocations made so far. If the host gave no function for
 * memory, up to 64 MiB of freed memory are kept for later frames; these are not counted. */
CELSPAN_API void celspan_context_memory(const celspan_context *context, size_t *bytes,
                                        size_t *peak_bytes, uint64_t *allocations);

/* ---------------------------------------------------------------- plain values */

/* Where a value was made; source lives as long as the value. */
typedef struct celspan_origin {
  const char *source; /* "shot.lua"; "" when it is not known */
  int32_t line;       /* from 1; 0 when it is not known */
} celspan_origin;

typedef struct celspan_point {
  double x, y;
} celspan_point;

typedef struct celspan_box { /* x, y: the least corner; width, height >= 0 */
  double x, y, width, height;
} celspan_box;

typedef struct celspan_matrix {
  double m[9];
} celspan_matrix;

CELSPAN_API celspan_matrix celspan_matrix_identity(void);
CELSPAN_API celspan_matrix celspan_matrix_translation(double dx, double dy);
CELSPAN_API celspan_matrix celspan_matrix_scaling(double sx, double sy);
CELSPAN_API celspan_matrix celspan_matrix_rotation(double radians, celspan_point centre);
CELSPAN_API celspan_matrix celspan_matrix_skewing(double radians_x, double radians_y);
/* The same about a centre, which stays where it is. */
CELSPAN_API celspan_matrix celspan_matrix_scaling_about(double sx, double sy, celspan_point centre);
CELSPAN_API celspan_matrix celspan_matrix_skewing_about(double radians_x, double radians_y,
                                                        celspan_point centre);
/* first, then second. */
CELSPAN_API celspan_matrix celspan_matrix_then(celspan_matrix first, celspan_matrix second);
/* false, and *out untouched, when singular. */
CELSPAN_API bool celspan_matrix_inverse(celspan_matrix matrix, celspan_matrix *out);
/* The perspective that takes four points to four others; false when there is none. */
CELSPAN_API bool celspan_matrix_quad(const celspan_point from[4], const celspan_point to[4],
                                     celspan_matrix *out);

/* A paint of the Beta colour model: straight values in 0..1. Light F from the front and I from
 * behind leave it as beta*pigment*F + (1-beta)*medium*I. */
typedef struct celspan_paint {
  float pigment[3];
  float medium[3];
  float beta;
} celspan_paint;

/* Paints are plain values, checked where a texture is made of them. Any thread.
 * Pigment r, g, b, beta alpha, medium clear. */
CELSPAN_API celspan_paint celspan_paint_rgb(float r, float g, float b, float alpha);
/* A pure filter: beta 0, medium r, g, b. */
CELSPAN_API celspan_paint celspan_paint_gel(float r, float g, float b);
/* Nothing at all: beta 0, medium 1. */
CELSPAN_API celspan_paint celspan_paint_clear(void);
/* (1-u) p + u q, premultiplied; u is clamped to 0..1. */
CELSPAN_API celspan_paint celspan_paint_mix(celspan_paint p, celspan_paint q, float u);
/* "#rgb", "#rgba", "#rrggbb", "#rrggbbaa": sRGB-coded, alpha straight; false for any other text. */
CELSPAN_API bool celspan_paint_parse(const char *text, celspan_paint *out);

typedef enum celspan_alpha {
  CELSPAN_ALPHA_DEFAULT = 0, /* integers straight, floats premultiplied */
  CELSPAN_ALPHA_STRAIGHT,
  CELSPAN_ALPHA_PREMULTIPLIED
} celspan_alpha;

/* Working spaces: what the numbers are that are mixed, lit, faded, blended and blurred, in a frame,
 * in a rostrum or in a group. In SRGB they are sRGB codes: pigments are converted to codes; media,
 * beta, mattes and brightness are not. What leaves a group or a rostrum for another space is
 * converted, channel by channel: S is divided by the greater of 1 - T and min(S, 1), taken along
 * the curve of sRGB (odd about 0, extended above 1), and multiplied back. So white stays 1. */
typedef enum celspan_space {
  CELSPAN_SPACE_AROUND = 0, /* the space around it; of a frame: LINEAR */
  CELSPAN_SPACE_LINEAR,
  CELSPAN_SPACE_SRGB
} celspan_space;

/* r, g, b >= 0 without upper limit; a in 0..1 is the matte of a back light (unused in front). */
typedef struct celspan_light {
  float r, g, b, a;
} celspan_light;

/* A light with a shape, instead of one colour everywhere: at each point it is gain * beta * pigment
 * of its texture there, and as a back light its matte is matte * beta: with a matte of 0 it adds
 * light to the layers behind and leaves their alpha. Media are not used. Beyond a picture there is
 * no light; a picture without a box lies on the film's frame. The structure lies in others, so it
 * never changes: what else a light may have becomes a field of the cel and of the rostrum. */
typedef enum celspan_light_place {
  CELSPAN_LIGHT_ON_FRAME = 0, /* film units after the viewport: the camera moves it */
  CELSPAN_LIGHT_ON_CEL        /* the cel's own units: it moves with the cel */
} celspan_light_place;

typedef struct celspan_light_texture {
  struct celspan_texture *texture; /* kept; NULL: none, so the plain light counts */
  double gain;                     /* >= 0 */
  celspan_light_place on;
  double matte; /* 0..1; the descriptions of cels and rostrums begin with 1; unused in front */
} celspan_light_texture;

/* ---------------------------------------------------------------- textures
 * In the units of the primitive they are given to; they move with it. A texture is kept by the
 * objects made with it. All _create functions: arrays are copied; Errors NO_MEMORY, BAD_ARGUMENT
 * for numbers that are not finite or beyond 1e12 and paints outside 0..1; out is new. */

typedef struct celspan_texture celspan_texture;

typedef struct celspan_stop {
  double at; /* 0..1, ascending */
  celspan_paint paint;
} celspan_stop;

typedef enum celspan_sampling {
  CELSPAN_SAMPLING_AUTO = 0, /* identity at scale 1, bilinear enlarged, average when shrunk */
  CELSPAN_SAMPLING_NEAREST,
  CELSPAN_SAMPLING_BILINEAR, /* the four texels about the centre, at any scale */
  CELSPAN_SAMPLING_BICUBIC
} celspan_sampling;

typedef enum celspan_wrap {
  CELSPAN_WRAP_CLEAR = 0,
  CELSPAN_WRAP_CLAMP,
  CELSPAN_WRAP_REPEAT
} celspan_wrap;

typedef enum celspan_picture_use {
  CELSPAN_PICTURE_PAINT = 0, /* pigment = rgb, beta = alpha, medium clear */
  CELSPAN_PICTURE_GEL        /* medium = rgb, beta 0; alpha mixes it with clear */
} celspan_picture_use;

typedef struct celspan_surface celspan_surface; /* a picture in memory: see below */

/* A picture in tiles, as Deep Zoom has them: tile (column, row) of a level is the file
 * LEVEL/COLUMN_ROW.ENDING of a folder, and in level 0 the picture is one pixel. Where a tile is
 * missing, the next smaller level is enlarged. */
typedef struct celspan_picture_tiles {
  int32_t width, height; /* of the picture, pixels: 1 to 16777216 */
  int32_t size, overlap; /* a tile's side, pixels: 1 to 1048576; what it shares with each neighbour,
                            at most half of that */
  char ending[8];
} celspan_picture_tiles;

typedef struct celspan_picture_desc {
  size_t struct_size;
  const char *file;   /* copied; NULL where there is a surface */
  const char *colour; /* NULL: by the file; "srgb" "linear" "rec709" "cineon"; copied */
  const char *layer;  /* NULL, or the name of a subimage; copied */
  int subimage;       /* from 0, when layer is NULL */
  celspan_sampling sampling;
  celspan_picture_use use;
  celspan_wrap wrap;
  bool has_box; /* false: the primitive's own tight bounding rectangle */
  celspan_box box;
  celspan_surface *surface; /* kept; instead of a file. colour NULL: integers sRGB, floats linear */
  /* A part of the picture, as if it were a file of its own: whole pixels, inside the picture, whose
   * header is read at once. */
  bool has_source;
  celspan_box source;
  /* Where alpha has 8 bits, the mean of the alphas around it, within half a step of its own: a glow
   * that fades slowly shows no rings. Alpha of more bits, and 0 and 1, stay as they are. */
  bool smooth;
  /* Copied; `file` is then the folder of the tiles. Without layer, subimage, source and smooth. */
  const celspan_picture_tiles *tiles;
} celspan_picture_desc;

CELSPAN_DESCRIPTION(celspan_picture_desc)
#define CELSPAN_PICTURE_DESC (celspan_picture_desc_initial())

CELSPAN_API CELSPAN_CHECKED celspan_status celspan_texture_create_paint(celspan_context *context,
                                                                        const celspan_paint *paint,
                                                                        celspan_texture **out);
/* The paper's triangle: linear in premultiplied values, extrapolated outside: beta is clamped to
 * 0..1, then S to 0..beta and T to 0..1-beta. A triangle without area has the last paint
 * everywhere. */
CELSPAN_API CELSPAN_CHECKED celspan_status
celspan_texture_create_gradient(celspan_context *context, const celspan_point points[3],
                                const celspan_paint paints[3], celspan_texture **out);
/* Stops along a line or out from a centre, from 0 (`from`, `centre`) to 1 (`to`, `radius`): one or
 * more, ascending in 0..1, linear between them in premultiplied values, held before the first and
 * after the last. Where two are at one place the colour jumps. Without a length, or a radius, the
 * last stop is everywhere. */
CELSPAN_API CELSPAN_CHECKED celspan_status
celspan_texture_create_linear(celspan_context *context, celspan_point from, celspan_point to,
                              const celspan_stop *stops, size_t stop_count, celspan_texture **out);
CELSPAN_API CELSPAN_CHECKED celspan_status
celspan_texture_create_radial(celspan_context *context, celspan_point centre, double radius,
                              const celspan_stop *stops, size_t stop_count, celspan_texture **out);
/* A radial gradient whose 0 lies at the focus: its circles grow from there to the whole one. A
 * focus beyond the circle is held just inside of it. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_texture_create_focal(
    celspan_context *context, celspan_point centre, double radius, celspan_point focus,
    const celspan_stop *stops, size_t stop_count, celspan_texture **out);
/* Stops around a centre, from 0 at `radians`, clockwise from up, once round to 1. Where the
 * last paint is not the first, the colour jumps. */
CELSPAN_API CELSPAN_CHECKED celspan_status
celspan_texture_create_conic(celspan_context *context, celspan_point centre, double radians,
                             const celspan_stop *stops, size_t stop_count, celspan_texture **out);
/* How a gradient without points lies in the bounds of each primitive that it paints, before the
 * primitive's transform; of a text from the ascent of its first line to the descent of its last
 * one, and of a stroke without its dashes. As a light, in the frame of the film. */
typedef enum celspan_gradient_fit {
  CELSPAN_GRADIENT_SIDE = 0, /* to a side, or from corner to corner */
  CELSPAN_GRADIENT_ANGLE,    /* at an angle, from the first corner to the last one that it meets */
  CELSPAN_GRADIENT_ELLIPSE   /* out from the middle to the ellipse that touches all sides */
} celspan_gradient_fit;

typedef struct celspan_fitted_desc {
  size_t struct_size;
  celspan_gradient_fit fit;
  int to_x, to_y; /* SIDE: where 1 lies: -1 is left and the top, 1 right and the bottom */
  double degrees; /* ANGLE: where 1 lies, clockwise from up; as a light, of a square frame */
  const celspan_stop *stops;
  size_t stop_count;
} celspan_fitted_desc;

CELSPAN_DESCRIPTION(celspan_fitted_desc)
#define CELSPAN_FITTED_DESC (celspan_fitted_desc_initial())

/* A gradient without points: by default from the top to the bottom. In bounds without a size it is
 * its first colour. out: new      Errors: NO_MEMORY, BAD_ARGUMENT. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_texture_create_fitted(
    celspan_context *context, const celspan_fitted_desc *desc, celspan_texture **out);
typedef enum celspan_noise_kind {
  CELSPAN_NOISE_PERLIN = 0, /* smooth hills and hollows: (1 + n) / 2 */
  CELSPAN_NOISE_VALUE,      /* a random value at each corner of a cell: (1 + n) / 2 */
  CELSPAN_NOISE_FRACTAL,    /* octaves of Perlin's noise: (1 + their sum) / 2 */
  CELSPAN_NOISE_TURBULENCE, /* the sum of the absolute values of these octaves */
  CELSPAN_NOISE_CELLS,      /* the distance to the nearest of random points, in cells */
  CELSPAN_NOISE_WHITE       /* a random value in each cell, the same in all of it */
} celspan_noise_kind;

typedef struct celspan_noise_desc {
  size_t struct_size;
  celspan_noise_kind kind;
  int octaves; /* 1 to 16, of FRACTAL and TURBULENCE: each has half the size of the one before */
  double size; /* the side of a cell of the first octave, above 0 */
  double gain; /* 0 to 1: of an octave, as a share of the one before */
  double at;   /* the third dimension, in cells */
  const celspan_stop *stops; /* as of gradients; copied */
  size_t stop_count;         /* 0: from black to white */
  int seed;
  bool fades; /* true by default; false: octaves finer than pixels stay, as for grain */
} celspan_noise_desc;

CELSPAN_DESCRIPTION(celspan_noise_desc)
#define CELSPAN_NOISE_DESC (celspan_noise_desc_initial())

/* Noise, clamped to 0..1, as the place along stops. The same bits on every machine. Octaves whose
 * cells are smaller than 4 pixels of the film (CELLS 6, TURBULENCE 10) fade out, and are replaced
 * by their mean below half of that; the probe sees all. out: new      Errors: NO_MEMORY,
 * BAD_ARGUMENT, LIMIT. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_texture_create_noise(
    celspan_context *context, const celspan_noise_desc *desc, celspan_texture **out);
/* How a linear or radial gradient continues before 0 and after 1. */
typedef enum celspan_spread {
  CELSPAN_SPREAD_HOLD = 0, /* the first and the last colour */
  CELSPAN_SPREAD_REPEAT,   /* from 0 to 1 again and again */
  CELSPAN_SPREAD_REFLECT   /* from 0 to 1, back to 0, and so on */
} celspan_spread;
/* The linear or radial gradient with another spread. A primitive may show 4,096 stops of it, each
 * counted as often as it is repeated; a light is repeated as often as these last, and held then.
 * out: new      Errors: NO_MEMORY, BAD_ARGUMENT. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_texture_with_spread(celspan_context *context,
                                                                       celspan_texture *texture,
                                                                       celspan_spread spread,
                                                                       celspan_texture **out);
/* The gradient, noise or picture moved by a matrix, while what it is on stays. A singular matrix
 * makes it clear. out: new      Errors: NO_MEMORY, BAD_ARGUMENT. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_texture_with_matrix(celspan_context *context,
                                                                       celspan_texture *texture,
                                                                       const celspan_matrix *matrix,
                                                                       celspan_texture **out);
/* Nothing is read yet: the header when a size is needed, the pixels when they are first seen. A box
 * of no size draws nothing. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_texture_create_picture(
    celspan_context *context, const celspan_picture_desc *desc, celspan_texture **out);
/* A picture used as paint with a medium of its own: S is its rgb, beta its alpha, and T the rgb of
 * the picture `medium`, which lies where the texture's does. The colour, layer, subimage and source
 * of `medium` count, its sampling, use, wrap and box do not. As a light the texture is its picture
 * alone. out: new    Errors: NO_MEMORY; BAD_ARGUMENT for a texture that is no picture, or a gel. */
CELSPAN_API CELSPAN_CHECKED celspan_status
celspan_texture_with_medium(celspan_context *context, celspan_texture *texture,
                            const celspan_picture_desc *medium, celspan_texture **out);
typedef struct celspan_pattern_desc {
  size_t struct_size;
  struct celspan_object *art; /* kept; lit with what the pattern is on */
  celspan_box box;            /* the part of the art that is repeated, in its units */
  bool has_matrix;
  celspan_matrix matrix; /* the art's units to the object's; affine, regular */
} celspan_pattern_desc;

CELSPAN_DESCRIPTION(celspan_pattern_desc)
#define CELSPAN_PATTERN_DESC (celspan_pattern_desc_initial())

/* A pattern: the box of the art repeated over the plane, for primitives. It is sharp at every size,
 * and only its visible part is drawn. A primitive with a pattern is a level of nesting, like a
 * boolean. out: new Errors: NO_MEMORY; BAD_ARGUMENT; LIMIT where it is nested too deep. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_texture_create_pattern(
    celspan_context *context, const celspan_pattern_desc *desc, celspan_texture **out);
/* _ref gives the value back, counted once more; _unref ignores NULL. Here and below: any thread. */
CELSPAN_API celspan_texture *celspan_texture_ref(celspan_texture *texture);
CELSPAN_API void celspan_texture_unref(celspan_texture *texture);

/* Names, for people: of textures here, of objects, cels and rostrums below. A named value is a new
 * value with the same content; names, as the places where values were made, are no part of hashes.
 * Messages, celspan info and celspan check tell them.
 * name: copied; 1 to 255 bytes of UTF-8 without control characters      out: new
 * Errors: NO_MEMORY, BAD_ARGUMENT.
 * _name: "" when the value has none; lives as long as the value. Shared read. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_texture_named(celspan_context *context,
                                                                 celspan_texture *texture,
                                                                 const char *name,
                                                                 celspan_texture **out);
CELSPAN_API const char *celspan_texture_name(const celspan_texture *texture);
CELSPAN_API celspan_origin celspan_texture_origin(const celspan_texture *texture);

typedef struct celspan_picture_info {
  size_t struct_size;
  int32_t width, height; /* the display window, in pixels, after the orientation tag */
  int channels;
  bool has_alpha;
  bool is_float;
  char format[16]; /* "png", "openexr", ...; "memory" for a surface */
  char colour[16]; /* how it would be read by default: "srgb", "linear", "cineon" */
} celspan_picture_info;

CELSPAN_RESULT(celspan_picture_info)
#define CELSPAN_PICTURE_INFO (celspan_picture_info_initial())

/* Reads a picture's header; describes a surface without asking for its pixels. Errors: INPUT,
 * LIMIT, NO_MEMORY, BAD_ARGUMENT. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_picture_inspect(celspan_context *context,
                                                                   const celspan_picture_desc *desc,
                                                                   celspan_picture_info *out);

/* ---- surfaces: pictures in memory */

/* A picture in memory, a buffer of the caller's or what a function fills on demand, so that a
 * host's own images and live surfaces are textures. It is immutable and counted like a scene value,
 * and may be shared by pictures, threads and contexts. Channels are interleaved, in the machine's
 * byte order. */
typedef enum celspan_surface_format {
  CELSPAN_SURFACE_RGBA8 = 0,
  CELSPAN_SURFACE_RGB8,
  CELSPAN_SURFACE_GREY8,
  CELSPAN_SURFACE_RGBA16,
  CELSPAN_SURFACE_RGBAF
} celspan_surface_format;

typedef struct celspan_rectangle { /* pixels */
  int32_t x, y, width, height;
} celspan_rectangle;

/* Fills a rectangle of a surface: row i of it from destination + i * stride on, in the surface's
 * format. The function sets *rows to the number of rows that it filled, from the top: fewer than
 * the rectangle has are a failure. Rectangles lie inside the surface; they are up to 64 rows of its
 * whole width, or where it is too large for `picture_bytes` of a part of it, and are asked for when
 * they are first seen, and again when they had to be forgotten. A function that fails may record a
 * sentence with celspan_context_fail. The frame then ends with CALLBACK and a sentence that names
 * the rectangle. It must not render with this surface itself. */
typedef celspan_status (*celspan_surface_fill)(void *user, celspan_context *context,
                                               const celspan_rectangle *rectangle,
                                               void *destination, size_t stride, int32_t *rows);

typedef struct celspan_surface_desc {
  size_t struct_size;
  int32_t width, height; /* 1..1,048,576 */
  celspan_surface_format format;
  celspan_alpha alpha; /* DEFAULT: integers straight, floats premultiplied */
  /* Either pixels: copied where release is NULL, else used as they are, unchanged, until release.
   * Rows from top to bottom, stride bytes apart; 0: without gaps. */
  const void *pixels;
  size_t stride;
  celspan_surface_fill fill; /* or a function that gives them */
  void *user;
  void (*release)(void *user); /* NULL, or called once when the surface is destroyed, by the thread
                                  that drops the last reference; not when _create fails */
  bool any_thread; /* fill may be called by workers, by several at once; false: by the rendering
                      thread alone */
  /* A name for the content, instead of all of its bytes; a fill function needs one. Surfaces of the
   * same key, size, format and alpha count as the same picture, in a frame and from frame to
   * frame: a live surface whose content changed is a new one with another key. */
  bool has_key;
  uint64_t key[2];
} celspan_surface_desc;

CELSPAN_DESCRIPTION(celspan_surface_desc)
#define CELSPAN_SURFACE_DESC (celspan_surface_desc_initial())

/* Premultiplied integers are coded colours multiplied by alpha, as in TIFF and most window systems.
 * In floats NaN becomes 0, larger values become 65504, and alpha is clamped to 0..1, as in
 * files. The bytes of buffers do not count in picture_bytes; what is decoded from them does.
 * desc: borrowed      out: new      Errors: NO_MEMORY, BAD_ARGUMENT. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_surface_create(celspan_context *context,
                                                                  const celspan_surface_desc *desc,
                                                                  celspan_surface **out);
CELSPAN_API celspan_surface *celspan_surface_ref(celspan_surface *surface);
CELSPAN_API void celspan_surface_unref(celspan_surface *surface);
/* Bytes of a pixel: 4, 3, 1, 8 or 16; 0 for an unknown format. Any thread. */
CELSPAN_API size_t celspan_surface_pixel_size(celspan_surface_format format);

/* ---------------------------------------------------------------- objects
 * Primitives and boolean trees of them: one type. texture NULL is opaque black; textures and
 * operands are kept. A shape of no size, an empty boolean or a singular transform is legal and
 * draws nothing. NaN, infinity, |number| > 1e12, negative sizes and bad knots are refused.
 * All _create functions: desc is borrowed; Errors NO_MEMORY, BAD_ARGUMENT; out is new. */

typedef struct celspan_object celspan_object;

typedef enum celspan_rule { CELSPAN_RULE_NONZERO = 0, CELSPAN_RULE_EVENODD } celspan_rule;

typedef struct celspan_rect_desc {
  size_t struct_size;
  double x, y, width, height;
  double radius; /* the radius of the corners; clamped to half the shorter side */
  celspan_texture *texture;
} celspan_rect_desc;

CELSPAN_DESCRIPTION(celspan_rect_desc)
#define CELSPAN_RECT_DESC (celspan_rect_desc_initial())

typedef struct celspan_triangle_desc {
  size_t struct_size;
  celspan_point points[3];
  celspan_texture *texture;
} celspan_triangle_desc;

CELSPAN_DESCRIPTION(celspan_triangle_desc)
#define CELSPAN_TRIANGLE_DESC (celspan_triangle_desc_initial())

typedef struct celspan_ellipse_desc { /* a circle: radius_x == radius_y */
  size_t struct_size;
  celspan_point centre;
  double radius_x, radius_y;
  celspan_texture *texture;
} celspan_ellipse_desc;

CELSPAN_DESCRIPTION(celspan_ellipse_desc)
#define CELSPAN_ELLIPSE_DESC (celspan_ellipse_desc_initial())

typedef struct celspan_polygon_desc {
  size_t struct_size;
  const celspan_point *points; /* copied */
  size_t point_count;
  celspan_rule rule;
  celspan_texture *texture;
} celspan_polygon_desc;

CELSPAN_DESCRIPTION(celspan_polygon_desc)
#define CELSPAN_POLYGON_DESC (celspan_polygon_desc_initial())

typedef enum celspan_nurbs_closure {
  CELSPAN_NURBS_PERIODIC = 0, /* knots: point_count + 1 values of one period */
  CELSPAN_NURBS_CLAMPED       /* knots: point_count + degree + 1 values; a line closes it */
} celspan_nurbs_closure;

typedef struct celspan_nurbs_desc {
  size_t struct_size;
  const celspan_point *points; /* the points themselves, not multiplied by weight; copied */
  const double *weights;       /* NULL: all 1; else > 0, largest/smallest <= 1e6; copied */
  size_t point_count;          /* at least degree + 1, at most 100,000 */
  int degree;                  /* 1..15; 3 */
  const double *knots;         /* NULL: uniform; copied */
  size_t knot_count;
  celspan_nurbs_closure closure;
  celspan_rule rule;
  celspan_texture *texture;
} celspan_nurbs_desc;

CELSPAN_DESCRIPTION(celspan_nurbs_desc)
#define CELSPAN_NURBS_DESC (celspan_nurbs_desc_initial())

/* A line of straight pieces and cubics, in the units of the object that it becomes. It begins at
 * its first point. Each piece then has three: two control points, and its end. A piece whose
 * control points are equal to its two ends is straight.
 *
 *       1 o - - - o 2
 *        .         .         A cubic from 0 to 3, and a straight piece from 3 to 6, whose control
 *     0 *         3 * 4      points are 4, which is equal to 3, and 5, which is equal to 6.
 *                    |
 *                  5 * 6     point_count is 7
 */
typedef struct celspan_contour {
  const celspan_point *points;
  size_t point_count; /* 1, and 3 more for each piece */
  bool closed;        /* a stroke of it is joined at its ends, with a straight piece between them if
                       * they differ; a path is closed in any case */
} celspan_contour;

/* Contours that are drawn point by point, for programs that do not keep arrays of them:
 *
 *   celspan_contours_move_to(contours, 0, 0);
 *   celspan_contours_line_to(contours, 90, 0);
 *   celspan_contours_cubic_to(contours, 90, 50, 50, 90, 0, 90);
 *   celspan_contours_close(contours);
 *   status = celspan_contours_get(contours, &desc.contours, &desc.contour_count);
 *
 * Numbers are not checked before an object is made of them. If memory runs out,
 * celspan_contours_get says so. Only for the thread of the context, which must outlive them. */
typedef struct celspan_contours celspan_contours;

/* *out: new, without contours. Errors: NO_MEMORY. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_contours_create(celspan_context *context,
                                                                   celspan_contours **out);
/* Begins a contour. */
CELSPAN_API void celspan_contours_move_to(celspan_contours *contours, double x, double y);
/* A piece from the current point. Where there is none, a contour begins at the first point given;
 * and after a contour was closed, at the point where that one began. */
CELSPAN_API void celspan_contours_line_to(celspan_contours *contours, double x, double y);
CELSPAN_API void celspan_contours_cubic_to(celspan_contours *contours, double x1, double y1,
                                           double x2, double y2, double x, double y);
/* Closes the contour that was begun last; nothing if there is none, or if it is closed. */
CELSPAN_API void celspan_contours_close(celspan_contours *contours);
/* *out, *count: all contours, which are valid until more is drawn or the contours are destroyed.
 * *out is never NULL. Errors: NO_MEMORY. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_contours_get(celspan_contours *contours,
                                                                const celspan_contour **out,
                                                                size_t *count);
CELSPAN_API void celspan_contours_destroy(celspan_contours *contours); /* NULL is ignored */

/* Of data and contours, one is given. */
typedef struct celspan_path_desc {
  size_t struct_size;
  const char *data; /* SVG path data; open subpaths are closed; copied */
  celspan_rule rule;
  celspan_texture *texture;
  const celspan_contour *contours; /* NULL: not given; copied */
  size_t contour_count;            /* 0: nothing is drawn */
} celspan_path_desc;

CELSPAN_DESCRIPTION(celspan_path_desc)
#define CELSPAN_PATH_DESC (celspan_path_desc_initial())

typedef enum celspan_stroke_cap {
  CELSPAN_STROKE_CAP_BUTT = 0,
  CELSPAN_STROKE_CAP_ROUND,
  CELSPAN_STROKE_CAP_SQUARE
} celspan_stroke_cap;

typedef enum celspan_stroke_join {
  CELSPAN_STROKE_JOIN_MITER = 0,
  CELSPAN_STROKE_JOIN_ROUND,
  CELSPAN_STROKE_JOIN_BEVEL
} celspan_stroke_join;

/* The width at the share u of the length of a taper, divided by the width without the taper. */
typedef enum celspan_stroke_profile {
  CELSPAN_STROKE_PROFILE_STRAIGHT = 0, /* u */
  CELSPAN_STROKE_PROFILE_ROUND         /* u (2 - u): no corner where the taper ends */
} celspan_stroke_profile;

/* A line and its width: of points, data, outline and contours, one is given. The sides are the
 * envelope of a disc of that width that moves along the line, caps and joins have the width there,
 * and a smooth point has no join. The outline is made again for every frame, as fine as that frame
 * needs. Lengths are measured in the stroke's own units, along the line. */
typedef struct celspan_stroke_desc {
  size_t struct_size;
  const celspan_point *points; /* of a spline, clamped or, when closed, periodic; copied */
  const double *widths;        /* one for each point; NULL: all `width`; copied */
  size_t point_count;
  int degree;              /* the degree of the spline, 1..15, clamped to point_count - 1; 1 */
  bool closed;             /* the points' */
  const char *data;        /* SVG path data; Z closes a subpath; copied */
  celspan_object *outline; /* a primitive with an outline, whose transform and fade do not matter;
                            * borrowed */
  double width;            /* 1 */
  celspan_stroke_cap cap;
  celspan_stroke_join join;
  double miter;         /* limit: the length of a miter divided by the width, 1 or more; 4 */
  const double *dashes; /* lengths drawn and left out in turn, twice over if their number is odd;
                          * their sum is above 0; copied; NULL: none */
  size_t dash_count;    /* at most 1,000,000 dashes in one stroke */
  double dash_offset;   /* how far into the dashes every subpath begins */
  double taper[2];      /* lengths over which what is drawn of a subpath grows from 0 and falls to
                          * 0, scaled down together when it is shorter; not with dashes; 0 0 */
  double from, to;      /* the part of the whole length that is drawn, clamped to 0..1; 0 and 1 */
  celspan_texture *texture;
  celspan_stroke_profile profile;  /* the profile of tapers */
  const celspan_contour *contours; /* as of a path */
  size_t contour_count;
} celspan_stroke_desc;

CELSPAN_DESCRIPTION(celspan_stroke_desc)
#define CELSPAN_STROKE_DESC (celspan_stroke_desc_initial())

typedef enum celspan_fit {
  CELSPAN_FIT_FILL = 0,
  CELSPAN_FIT_CONTAIN,
  CELSPAN_FIT_COVER
} celspan_fit;

/* A rectangle textured with a picture. width, height: if both are 0, its size in pixels; if one is
 * 0, it follows from the aspect; fit counts when both are given: CONTAIN keeps the aspect and shows
 * all of it (the rectangle is then the picture's own, unless it wraps), COVER keeps it and leaves
 * no part of the rectangle bare. Reads the picture's header when either is 0 or fit is not FILL:
 * then Errors INPUT, LIMIT. */
typedef struct celspan_image_desc {
  size_t struct_size;
  const celspan_picture_desc *picture; /* borrowed; its box is not used */
  double x, y, width, height;
  celspan_fit fit;
} celspan_image_desc;

CELSPAN_DESCRIPTION(celspan_image_desc)
#define CELSPAN_IMAGE_DESC (celspan_image_desc_initial())

/* The paper's extension point: a primitive given by a procedure that returns its spans on a row. */
typedef struct celspan_scanline_row {
  double x0, x1; /* the part that can be seen, in the primitive's own units */
  double pixel;  /* the width of a pixel, likewise */
} celspan_scanline_row;

typedef struct celspan_scanline_output celspan_scanline_output;

/* Appends [x0, x1): sorted, disjoint, cut to the bounds by celspan. One paint is flat, two lie at
 * x0 and x1, more are evenly spaced from x0 to x1. paints: copied. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_scanline_emit(celspan_scanline_output *output,
                                                                 double x0, double x1,
                                                                 const celspan_paint *paints,
                                                                 size_t paint_count);

typedef celspan_status (*celspan_scanline_spans)(void *user, celspan_context *context, double y,
                                                 const celspan_scanline_row *row,
                                                 celspan_scanline_output *output);

typedef struct celspan_scanline_desc {
  size_t struct_size;
  celspan_box bounds;
  celspan_scanline_spans spans; /* a pure function of y */
  void *user;
  void (*release)(void *user); /* NULL, or called once when the object is destroyed */
  bool any_thread; /* spans may be called by workers; false: the rendering thread alone */
} celspan_scanline_desc;

CELSPAN_DESCRIPTION(celspan_scanline_desc)
#define CELSPAN_SCANLINE_DESC (celspan_scanline_desc_initial())

CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_create_rect(celspan_context *context,
                                                                      const celspan_rect_desc *desc,
                                                                      celspan_object **out);
/* A rectangle with a radius for each corner, clockwise from the top left; desc->radius does not
 * count. Where two along a side are longer than it, all four become less in proportion. */
CELSPAN_API CELSPAN_CHECKED celspan_status
celspan_object_create_rounded(celspan_context *context, const celspan_rect_desc *desc,
                              const double radii[4], celspan_object **out);
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_create_triangle(
    celspan_context *context, const celspan_triangle_desc *desc, celspan_object **out);
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_create_ellipse(
    celspan_context *context, const celspan_ellipse_desc *desc, celspan_object **out);
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_create_polygon(
    celspan_context *context, const celspan_polygon_desc *desc, celspan_object **out);
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_create_nurbs(
    celspan_context *context, const celspan_nurbs_desc *desc, celspan_object **out);
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_create_path(celspan_context *context,
                                                                      const celspan_path_desc *desc,
                                                                      celspan_object **out);
/* Errors: also LIMIT, for too many dashes. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_create_stroke(
    celspan_context *context, const celspan_stroke_desc *desc, celspan_object **out);
/* The stroke of a primitive's outline, with the primitive's transform and fade, so that its width
 * is scaled with it. desc->outline is not used. Errors: as above. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_stroke(celspan_context *context,
                                                                 celspan_object *object,
                                                                 const celspan_stroke_desc *desc,
                                                                 celspan_object **out);
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_create_image(
    celspan_context *context, const celspan_image_desc *desc, celspan_object **out);
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_create_scanline(
    celspan_context *context, const celspan_scanline_desc *desc, celspan_object **out);

typedef enum celspan_operator {
  CELSPAN_OPERATOR_UNION = 0,    /* later over earlier */
  CELSPAN_OPERATOR_INTERSECTION, /* where all operands are present; later over earlier */
  CELSPAN_OPERATOR_DIFFERENCE,   /* the first, where no other operand is present */
  CELSPAN_OPERATOR_XOR,          /* where an odd number is present: these, later over earlier */
  /* two operands: the first where the second is present; only the first is painted */
  CELSPAN_OPERATOR_CLIP
} celspan_operator;

/* operands: kept, the list copied; an empty list is legal (except for CLIP) and draws nothing.
 * Nesting is limited to 128 levels, and an object to 16,777,216 primitives, shared ones counted
 * wherever they are used. Errors: NO_MEMORY, BAD_ARGUMENT, LIMIT. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_create_boolean(
    celspan_context *context, celspan_operator op, celspan_object *const *operands,
    size_t operand_count, celspan_object **out);
/* The boolean with more operands after those it has, as if it had been made with all of them at
 * once: a | b | c. Many, one after the other, cost and hold as much as one boolean of them all.
 * boolean: not a clip, and neither transformed nor faded. Errors: as above. Threads: one boolean
 * may be extended on several. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_extend_boolean(
    celspan_context *context, celspan_object *boolean, celspan_object *const *operands,
    size_t operand_count, celspan_object **out);

/* How an object or a cel is combined with its backdrop: all that is behind it in its nearest group
 * that isolates, else in the frame. W3C Compositing and Blending Level 1, except for ADD, which
 * adds premultiplied colours and clamps alpha to 1, and for those after it, which are of painting
 * programs, with a backdrop b and a source s channel by channel: LINEAR_DODGE is b + s,
 * SOFT_LIGHT_PHOTOSHOP brightens dark backdrops by the square root, too, LINEAR_BURN is b + s - 1,
 * LINEAR_LIGHT b + 2 s - 1, SUBTRACT b - s and DIVIDE b / s; VIVID_LIGHT is COLOR_BURN by 2 s or,
 * from s = 1/2 on, COLOR_DODGE by 2 s - 1, PIN_LIGHT is DARKEN and LIGHTEN by the same; HARD_MIX is
 * 1 where b + s is 1 or more and b above 0, and 0 elsewhere; DARKER_COLOR and LIGHTER_COLOR are the
 * one of both colours that has less or more luminosity, and b where that is equal. Colours are
 * clamped to 0..1 inside a mode, and what it gives too. */
typedef enum celspan_blend {
  CELSPAN_BLEND_NORMAL = 0,
  CELSPAN_BLEND_MULTIPLY,
  CELSPAN_BLEND_SCREEN,
  CELSPAN_BLEND_OVERLAY,
  CELSPAN_BLEND_DARKEN,
  CELSPAN_BLEND_LIGHTEN,
  CELSPAN_BLEND_COLOR_DODGE,
  CELSPAN_BLEND_COLOR_BURN,
  CELSPAN_BLEND_HARD_LIGHT,
  CELSPAN_BLEND_SOFT_LIGHT,
  CELSPAN_BLEND_DIFFERENCE,
  CELSPAN_BLEND_EXCLUSION,
  CELSPAN_BLEND_HUE,
  CELSPAN_BLEND_SATURATION,
  CELSPAN_BLEND_COLOR,
  CELSPAN_BLEND_LUMINOSITY,
  CELSPAN_BLEND_ADD,
  CELSPAN_BLEND_LINEAR_DODGE,
  CELSPAN_BLEND_SOFT_LIGHT_PHOTOSHOP,
  CELSPAN_BLEND_LINEAR_BURN,
  CELSPAN_BLEND_VIVID_LIGHT,
  CELSPAN_BLEND_LINEAR_LIGHT,
  CELSPAN_BLEND_PIN_LIGHT,
  CELSPAN_BLEND_HARD_MIX,
  CELSPAN_BLEND_SUBTRACT,
  CELSPAN_BLEND_DIVIDE,
  CELSPAN_BLEND_DARKER_COLOR,
  CELSPAN_BLEND_LIGHTER_COLOR
} celspan_blend;

/* ---------------------------------------------------------------- grades */

/* What becomes of the colours of a group, a cel or a rostrum, after they have been composited:
 * divided by alpha, they go through these steps in this order, in the numbers of the working space,
 * and are multiplied by alpha again. What is let through does not change. */
typedef struct celspan_grade celspan_grade;

#define CELSPAN_GRADE_STOPS 64   /* exposures are within this and its negative */
#define CELSPAN_GRADE_GAMMA 1024 /* gammas are within 1 through this, and this */

typedef struct celspan_grade_desc {
  size_t struct_size;
  double exposure; /* times 2 to the power of this */
  double contrast; /* (c - pivot) * contrast + pivot; 0 or more */
  bool has_pivot;  /* else 0.18, and 0.46 in SRGB */
  double pivot;
  /* The matrices of SVG's and CSS's filters, with 0.2126, 0.7152 and 0.0722. */
  double saturation, hue_radians;
  double temperature, tint; /* -1..1: red times 2^(t/2), green 2^(-tint/2), blue 2^(-t/2), divided
                               by what that makes of white's luma */
  double gamma;             /* sign(c) |c|^(1/gamma) */
  bool has_matrix;
  double matrix[3][4];           /* from red, green, blue and 1 to red, green, blue */
  const celspan_point *curve[3]; /* of each channel, x becomes y: monotone cubics, straight beyond
                                    their ends; x ascends. Copied */
  size_t curve_count[3];         /* 0: none, else 2..1024 */
  const char *lut;               /* the name of a .cube file, or NULL: colours are clamped to its
                                    domain, and interpolated trilinearly */
  celspan_space lut_space;       /* the numbers that the table is for: codes (SRGB) or LINEAR */
  /* The ASC CDL, after the exposure: c * slope + offset, held above 0, to the power, which has the
   * range of gamma. Colours are not held where all nine numbers do nothing. */
  double slope[3], offset[3], power[3];
  int steps; /* after the curves: as many equal levels of each channel's sRGB code from 0 through 1,
                2..256; a code at a border takes the upper one. 0: none */
} celspan_grade_desc;

CELSPAN_DESCRIPTION(celspan_grade_desc)
#define CELSPAN_GRADE_DESC (celspan_grade_desc_initial())

/* desc: borrowed. Errors: NO_MEMORY, BAD_ARGUMENT; INPUT, with the line, for a file that cannot be
 * read or is damaged; LIMIT. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_grade_create(celspan_context *context,
                                                                const celspan_grade_desc *desc,
                                                                celspan_grade **out);
CELSPAN_API celspan_grade *celspan_grade_ref(celspan_grade *grade);
CELSPAN_API void celspan_grade_unref(celspan_grade *grade);

/* Whether modes inside a group act on the backdrop of the group. */
typedef enum celspan_isolation {
  CELSPAN_ISOLATION_AUTO = 0, /* it isolates if it is faded, has a mode, a grade, or another space
                                 than what it is in */
  CELSPAN_ISOLATION_ON,
  CELSPAN_ISOLATION_OFF /* refused for a group that is faded or has a mode, a space or a grade */
} celspan_isolation;

typedef struct celspan_group_desc {
  size_t struct_size;
  celspan_object *const *objects; /* kept; from the rear */
  size_t object_count;
  double opacity; /* 0..1 */
  celspan_blend blend;
  celspan_isolation isolate;
  celspan_space space;  /* its result is graded, converted, then lit and faded */
  celspan_grade *grade; /* kept; NULL: none */
} celspan_group_desc;

CELSPAN_DESCRIPTION(celspan_group_desc)
#define CELSPAN_GROUP_DESC (celspan_group_desc_initial())

/* Objects that are composited by themselves and then put into the picture as one. Errors:
 * NO_MEMORY, BAD_ARGUMENT, LIMIT. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_create_group(
    celspan_context *context, const celspan_group_desc *desc, celspan_object **out);
/* The object with a mode, instead of the one it may have had. Errors: NO_MEMORY, BAD_ARGUMENT,
 * LIMIT. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_blend(celspan_context *context,
                                                                celspan_object *object,
                                                                celspan_blend mode,
                                                                celspan_object **out);
/* Its mode. Shared read. */
CELSPAN_API celspan_blend celspan_object_mode(const celspan_object *object);

/* What of the matte counts. */
typedef enum celspan_matte_from {
  CELSPAN_MATTE_ALPHA = 0, /* 1 - the mean of what it lets through */
  CELSPAN_MATTE_LUMA,      /* 0.2126 r + 0.7152 g + 0.0722 b of its premultiplied colour under white
                              light, clamped to 0..1 */
  CELSPAN_MATTE_DISSOLVE   /* the same; but where it is more than 1 less the alpha of the art, the
                              art is opaque, and elsewhere it is clear. Not with `grow` */
} celspan_matte_from;

/* The paint of `art` mixed with clear by what `by` is at each point. `by` is not drawn. The shape
 * of the object is that of `art`. Errors: NO_MEMORY, BAD_ARGUMENT, LIMIT. */
CELSPAN_API CELSPAN_CHECKED celspan_status
celspan_object_create_matte(celspan_context *context, celspan_object *art, celspan_object *by,
                            celspan_matte_from from, bool invert, celspan_object **out);

#define CELSPAN_BLUR_MOST 1e6 /* units: the greatest radius of an effect */

typedef struct celspan_matte_desc {
  size_t struct_size;
  celspan_matte_from from;
  bool invert; /* after the rest */
  double grow; /* units, within 1e6 and its negative: the matte reaches farther by this, or (below
                     0) ends sooner */
  double feather; /* the radius of a Gaussian blur of the matte, which comes after that; 0..1e6 */
} celspan_matte_desc;

CELSPAN_DESCRIPTION(celspan_matte_desc)
#define CELSPAN_MATTE_DESC (celspan_matte_desc_initial())

/* The same by a matte that is grown and blurred first. Shapes of opaque colours grow exactly, with
 * round corners, and each shape of a union by itself. Anything else, and light, grows as the alpha
 * of an outline does (celspan_object_outline), where it is at least half there. Errors: NO_MEMORY,
 * LIMIT; BAD_ARGUMENT, also where a shape reaches the horizon of its perspective. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_matte(celspan_context *context,
                                                                celspan_object *art,
                                                                celspan_object *by,
                                                                const celspan_matte_desc *desc,
                                                                celspan_object **out);

/* What a key compares, in sRGB codes of the colour of the art. */
typedef enum celspan_key_by {
  /* the distance of (Cb, Cr), of Rec. 709, from that of a colour: clear up to `tolerance`, whole
     from there on by `softness` */
  CELSPAN_KEY_CHROMA = 0,
  CELSPAN_KEY_LUMA /* Y, of Rec. 709: clear at `from`, whole at `to`, which may be less */
} celspan_key_by;

typedef struct celspan_key_desc {
  size_t struct_size;
  celspan_key_by by;
  celspan_texture *colour; /* CHROMA: of the screen, one opaque colour that is not grey; borrowed;
                                 NULL: #0b0 */
  double tolerance, softness; /* CHROMA: 0 or more; 0.2 and 0.1; a softness below 1/1024 is that */
  double spill;    /* CHROMA: the part of the screen's light in the art that is taken off,
                                 0..1; 1 */
  double from, to; /* LUMA; 0 and 1; 1/1024 apart at least */
} celspan_key_desc;

CELSPAN_DESCRIPTION(celspan_key_desc)
#define CELSPAN_KEY_DESC (celspan_key_desc_initial())

/* The paint of `art`, which is composited by itself, clear where it is the screen. The shape of the
 * object is that of `art`. Errors: NO_MEMORY, BAD_ARGUMENT, LIMIT. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_key(celspan_context *context,
                                                              celspan_object *art,
                                                              const celspan_key_desc *desc,
                                                              celspan_object **out);

typedef enum celspan_defocus_kernel {
  CELSPAN_DEFOCUS_GAUSSIAN = 0,
  CELSPAN_DEFOCUS_BOX,
  CELSPAN_DEFOCUS_DISC,
  CELSPAN_DEFOCUS_PIXEL /* no blur: the mean over each pixel, in the space around the object; the
                           radius, above 0, only says how far its pixels may extend beyond it */
} celspan_defocus_kernel;

/* What a blur takes from beyond the edges: those of the frame for a cel, of its bounds for an
 * object. */
typedef enum celspan_blur_edge {
  CELSPAN_BLUR_CLEAR = 0, /* the art itself, of which an object has none */
  CELSPAN_BLUR_EXTEND     /* what lies on the edge, continued; an object ends at its bounds */
} celspan_blur_edge;

/* Where a blur takes the points that it shows at a point: around it, or evenly along a line, a ray
 * or an arc through it, as far to either side. */
typedef enum celspan_blur_along {
  CELSPAN_BLUR_AROUND = 0,
  CELSPAN_BLUR_LINE, /* radius: units */
  CELSPAN_BLUR_ZOOM, /* radius: per cent of the distance from the centre, 0..90 */
  CELSPAN_BLUR_SPIN  /* radius: degrees, 0..180 */
} celspan_blur_along;

typedef struct celspan_blur_desc {
  size_t struct_size;
  double radius; /* AROUND: as that of a cel's defocus, but in the object's units, 0..1e6 */
  celspan_defocus_kernel kernel; /* AROUND */
  celspan_blur_edge edge;
  celspan_blur_along along;
  double degrees;       /* LINE: clockwise from the right */
  celspan_point centre; /* ZOOM, SPIN: in the object's units */
} celspan_blur_desc;

CELSPAN_DESCRIPTION(celspan_blur_desc)
#define CELSPAN_BLUR_DESC (celspan_blur_desc_initial())

/* The object out of focus. Its shape is the rectangle that the blur reaches; with EXTEND, its
 * bounds. A mode stays outermost. Errors: NO_MEMORY, BAD_ARGUMENT, LIMIT. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_blur(celspan_context *context,
                                                               celspan_object *object,
                                                               const celspan_blur_desc *desc,
                                                               celspan_object **out);

typedef enum celspan_channel {
  CELSPAN_CHANNEL_RED = 0,
  CELSPAN_CHANNEL_GREEN,
  CELSPAN_CHANNEL_BLUE,
  CELSPAN_CHANNEL_ALPHA
} celspan_channel;

typedef struct celspan_displace_desc {
  size_t struct_size;
  celspan_object *by;   /* borrowed, in the units of the object, which it may be */
  celspan_channel x, y; /* of `by`, without its alpha; RED and GREEN */
  double scale;         /* units, -1e6..1e6; 20 */
  celspan_space space;  /* the space of the channels: LINEAR, or SRGB, their codes */
} celspan_displace_desc;

CELSPAN_DESCRIPTION(celspan_displace_desc)
#define CELSPAN_DISPLACE_DESC (celspan_displace_desc_initial())

/* The object, which shows at each point p what lies at p + scale (channel - 0.5); channels are
 * clamped to 0..1, and nothing moves where `by` is clear. Its shape is the rectangle that it can
 * reach. A mode stays outermost. Errors: NO_MEMORY, BAD_ARGUMENT, LIMIT. */
CELSPAN_API CELSPAN_CHECKED celspan_status
celspan_object_displace(celspan_context *context, celspan_object *object,
                        const celspan_displace_desc *desc, celspan_object **out);

#define CELSPAN_SHARPEN_RADIUS_MOST 1000
#define CELSPAN_SHARPEN_MOST 100

typedef struct celspan_sharpen_desc {
  size_t struct_size;
  double radius; /* as that of a blur, in the object's units, 0..1000; 2 */
  double amount; /* 0..100; 1 */
} celspan_sharpen_desc;

CELSPAN_DESCRIPTION(celspan_sharpen_desc)
#define CELSPAN_SHARPEN_DESC (celspan_sharpen_desc_initial())

/* The object plus `amount` times its difference from itself out of focus, not below 0. Its alpha
 * does not change, and what lies around it does not count. A radius of more than 500 pixels of the
 * frame acts like one of 500. Its shape is the rectangle of its bounds and two radii, at least 2
 * units, on each side. A mode stays outermost. Errors: NO_MEMORY, BAD_ARGUMENT, LIMIT. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_sharpen(celspan_context *context,
                                                                  celspan_object *object,
                                                                  const celspan_sharpen_desc *desc,
                                                                  celspan_object **out);

typedef struct celspan_shadow_desc {
  size_t struct_size;
  celspan_point offset;
  double blur;             /* a radius, 0..1e6 */
  celspan_texture *colour; /* NULL: black */
  double opacity;          /* limited to 0..1 */
  bool is_inside;          /* within the object and over it, else behind it */
  bool is_alone;           /* without the object */
} celspan_shadow_desc;

CELSPAN_DESCRIPTION(celspan_shadow_desc)
#define CELSPAN_SHADOW_DESC (celspan_shadow_desc_initial())

/* The object with its shape in a colour, moved and blurred, behind it. A mode stays outermost.
 * Errors: NO_MEMORY, BAD_ARGUMENT, LIMIT. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_shadow(celspan_context *context,
                                                                 celspan_object *object,
                                                                 const celspan_shadow_desc *desc,
                                                                 celspan_object **out);

typedef struct celspan_glow_desc {
  size_t struct_size;
  double radius;           /* 0..1e6 */
  celspan_texture *colour; /* NULL: black */
  double gain;             /* >= 0; multiplies the light */
} celspan_glow_desc;

CELSPAN_DESCRIPTION(celspan_glow_desc)
#define CELSPAN_GLOW_DESC (celspan_glow_desc_initial())

/* The object with its shape in a colour, blurred, behind it in the mode ADD. A mode of the object
 * stays outermost. Errors: NO_MEMORY, BAD_ARGUMENT, LIMIT. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_glow(celspan_context *context,
                                                               celspan_object *object,
                                                               const celspan_glow_desc *desc,
                                                               celspan_object **out);

typedef struct celspan_outline_desc {
  size_t struct_size;
  double width;             /* how far it reaches beyond the shape, 0..1e6 */
  celspan_texture *texture; /* NULL: black */
  celspan_stroke_join join; /* at the corners of shapes; ROUND */
  double blur;              /* a radius, 0..1e6 */
  double opacity;           /* limited to 0..1 */
  bool is_alone;            /* without the object */
} celspan_outline_desc;

CELSPAN_DESCRIPTION(celspan_outline_desc)
#define CELSPAN_OUTLINE_DESC (celspan_outline_desc_initial())

/* The object with its shape, grown by a width, behind it: exactly, or, where there are pictures,
 * mattes, keys, compositions or procedures in it, with its alpha spread by the width. A mode stays
 * outermost. Errors: NO_MEMORY, LIMIT; BAD_ARGUMENT, also where a shape reaches the horizon of its
 * perspective. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_outline(celspan_context *context,
                                                                  celspan_object *object,
                                                                  const celspan_outline_desc *desc,
                                                                  celspan_object **out);

/* Where a point goes, both in the units around the object. It must be continuous, and a function of
 * the point alone. A status other than OK ends the warp with that status. */
typedef celspan_status (*celspan_warp_map)(void *user, celspan_context *context, celspan_point from,
                                           celspan_point *to);

typedef struct celspan_warp_desc {
  size_t struct_size;
  celspan_warp_map map;
  void *user;
  double within; /* units that outlines may lie from their place; 0: 2^-27 of the object's size,
                  * 1/100 pixel where that is 1,048,576 pixels */
  size_t pieces; /* triangles, 18..20000, that a picture or a gradient becomes at most; 400 */
} celspan_warp_desc;

CELSPAN_DESCRIPTION(celspan_warp_desc)
#define CELSPAN_WARP_DESC (celspan_warp_desc_initial())

/* The object bent by a map: outlines and strokes stay curves; pictures and gradients become meshes
 * of triangles that abut exactly. Fades, modes and names stay. The map is called by this thread,
 * and not after the call.
 * Errors: NO_MEMORY; LIMIT for a map that is too rough; BAD_ARGUMENT for one that jumps or folds
 * the object, and for rostrums, effects that blur, and scan-line procedures; those of the map. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_warp(celspan_context *context,
                                                               celspan_object *object,
                                                               const celspan_warp_desc *desc,
                                                               celspan_object **out);

/* Applied after the existing matrix, about the origin. The object is kept in part, never changed.
 * Errors: NO_MEMORY; BAD_ARGUMENT when a number of the matrix, or of the product, is not
 * finite or beyond 1e12. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_transform(celspan_context *context,
                                                                    celspan_object *object,
                                                                    const celspan_matrix *matrix,
                                                                    celspan_object **out);
/* The object's composited paint mixed with clear; k is limited to 0..1, fades multiply. It keeps
 * its shape: a faded operand still cuts. Errors: NO_MEMORY, BAD_ARGUMENT. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_fade(celspan_context *context,
                                                               celspan_object *object, double k,
                                                               celspan_object **out);
/* Names and origins: see celspan_texture_named. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_named(celspan_context *context,
                                                                celspan_object *object,
                                                                const char *name,
                                                                celspan_object **out);
CELSPAN_API const char *celspan_object_name(const celspan_object *object);
CELSPAN_API celspan_origin celspan_object_origin(const celspan_object *object);
CELSPAN_API celspan_object *celspan_object_ref(celspan_object *object);
CELSPAN_API void celspan_object_unref(celspan_object *object);
/* The smallest upright rectangle around what can be painted; false when there is nothing. For
 * booleans: of their operands (intersections intersect). Without memory that of a stroke is larger.
 * Shared read. */
CELSPAN_API bool celspan_object_bounds(const celspan_object *object, celspan_box *out);
/* Whether the point is inside the shape, whatever its paint: left and top edges are in, right and
 * bottom ones out. A scan-line procedure is not asked; its shape is its bounds. Shared read. */
CELSPAN_API bool celspan_object_contains(const celspan_object *object, celspan_point point);
/* What an object shows in two halves, each 128 bits that are equal for equal content in every
 * process: drawing, all but its outermost transform and fade, and placement, those two. Exposure
 * sheets tell with them whether a drawing changed or only moved. false: the object holds a
 * scan-line procedure, which cannot be compared, and `drawing` differs from object to object.
 * Shared read. */
CELSPAN_API bool celspan_object_hash(const celspan_object *object, uint64_t drawing[2],
                                     uint64_t placement[2]);

/* ---------------------------------------------------------------- cels and rostrum */

typedef struct celspan_cel celspan_cel;
typedef struct celspan_rostrum celspan_rostrum;

typedef struct celspan_cel_desc {
  size_t struct_size;
  celspan_object *const *objects; /* kept; later is nearer */
  size_t object_count;
  bool has_front; /* false: the rostrum's, else white */
  celspan_light front;
  celspan_light back; /* shines through the whole frame behind this cel */
  bool has_viewport;  /* false: the whole film */
  celspan_box viewport;
  double defocus_radius; /* film units on the frame; 0: sharp */
  celspan_defocus_kernel defocus_kernel;
  double opacity;                                    /* limited to 0..1 */
  celspan_light_texture front_texture, back_texture; /* instead of front and back */
  celspan_blend blend;
  /* The numbers of the light are a colour, which is converted to codes where those are mixed; else
   * they are factors, which multiply codes as they are. Likewise of a rostrum. */
  bool front_is_colour, back_is_colour;
  celspan_grade *grade; /* of the cel as it is lit, before it is faded; kept; NULL: none */
  celspan_blur_edge defocus_edge;
} celspan_cel_desc;

CELSPAN_DESCRIPTION(celspan_cel_desc)
#define CELSPAN_CEL_DESC (celspan_cel_desc_initial())

/* desc: borrowed, except for the objects. Errors: NO_MEMORY; BAD_ARGUMENT for lights below 0, a
 * matte outside 0..1, a viewport without size. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_cel_create(celspan_context *context,
                                                              const celspan_cel_desc *desc,
                                                              celspan_cel **out);
/* As for objects; the transform comes before the viewport. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_cel_transform(celspan_context *context,
                                                                 celspan_cel *cel,
                                                                 const celspan_matrix *matrix,
                                                                 celspan_cel **out);
/* Its mode. Shared read. */
CELSPAN_API celspan_blend celspan_cel_mode(const celspan_cel *cel);
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_cel_fade(celspan_context *context,
                                                            celspan_cel *cel, double k,
                                                            celspan_cel **out);
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_cel_named(celspan_context *context,
                                                             celspan_cel *cel, const char *name,
                                                             celspan_cel **out);
CELSPAN_API const char *celspan_cel_name(const celspan_cel *cel);
CELSPAN_API celspan_origin celspan_cel_origin(const celspan_cel *cel);
CELSPAN_API celspan_cel *celspan_cel_ref(celspan_cel *cel);
CELSPAN_API void celspan_cel_unref(celspan_cel *cel);
/* In the cel's units after its own transform, before the viewport. Shared read. */
CELSPAN_API bool celspan_cel_bounds(const celspan_cel *cel, celspan_box *out);
CELSPAN_API bool celspan_cel_contains(const celspan_cel *cel, celspan_point point);
/* The hashes of a cel: drawing, its objects as they lie in it; placement, its transform, viewport,
 * lights, defocus and opacity. */
CELSPAN_API bool celspan_cel_hash(const celspan_cel *cel, uint64_t drawing[2],
                                  uint64_t placement[2]);

typedef enum celspan_antialias_mode {
  CELSPAN_ANTIALIAS_AREA = 0, /* the exact mean over each pixel */
  CELSPAN_ANTIALIAS_NONE,     /* pixel centres */
  CELSPAN_ANTIALIAS_FILTER    /* a kernel: see celspan_filter_desc */
} celspan_antialias_mode;

/* Kernels of antialiasing filters: separable, normalised, cut at the radius. */
typedef enum celspan_kernel {
  CELSPAN_KERNEL_BOX = 0,  /* radius 0.5 */
  CELSPAN_KERNEL_GAUSSIAN, /* radius 1.5; sigma is a third of the radius */
  CELSPAN_KERNEL_MITCHELL, /* radius 2; stretched with the radius */
  CELSPAN_KERNEL_LANCZOS,  /* radius 3: the lobes of the window */
  CELSPAN_KERNEL_FUNCTION  /* the caller's */
} celspan_kernel;

/* *out: the kernel's value at x pixels from its centre. */
typedef celspan_status (*celspan_kernel_function)(void *user, celspan_context *context, double x,
                                                  double *out);

/* The boundaries of a row are filtered as they are, without a raster of samples: exactly in x, and
 * in y by cutting slanted ones into up to `rows` pieces a pixel. Where a kernel is negative, alpha
 * is clamped to 0..1 and each channel to the range of the values under the kernel. */
typedef struct celspan_filter_desc {
  size_t struct_size;
  celspan_kernel kernel;
  bool has_radius; /* false: the kernel's own, named above; FUNCTION has none */
  double radius;   /* pixels, at most 256; 0: no filter, pixel centres */
  int rows;        /* 1..256; 16 */
  /* FUNCTION: called 2048 times while the value is made, at places spread evenly over the
   * diameter, and never again; its values are copied. */
  celspan_kernel_function function;
  void *function_user;
} celspan_filter_desc;

CELSPAN_DESCRIPTION(celspan_filter_desc)
#define CELSPAN_FILTER_DESC (celspan_filter_desc_initial())

typedef struct celspan_rostrum_desc {
  size_t struct_size;
  celspan_cel *const *cels; /* kept; later is nearer */
  size_t cel_count;
  bool has_front; /* for the cels that name none; else white */
  celspan_light front;
  celspan_light back; /* behind the rearmost cel */
  double brightness;  /* >= 0; multiplies the light, not alpha */
  bool has_camera_centre, has_camera_width;
  celspan_point camera_centre;
  double camera_width;
  double camera_radians; /* turns the camera, so the picture turns back */
  celspan_antialias_mode antialias;
  const celspan_filter_desc *filter; /* where antialias is FILTER; borrowed; NULL: a box */
  celspan_light_texture front_texture, back_texture; /* instead of front and back; back: on the
                                                        frame only */
  bool has_size; /* its own size in film units: needed for celspan_object_create_rostrum */
  double width, height;
  bool front_is_colour, back_is_colour; /* as in celspan_cel_desc */
  celspan_space space;
  celspan_grade *grade; /* the grade of the whole; kept; NULL: none */
  /* Over all of it, on the frame of the film, after the grade: the codes of this texture, times 2,
     less 1, are added to the sRGB codes of the picture (LINEAR_LIGHT); alpha stays. Inside another
     composition a rostrum with grain has LINEAR for AROUND. Kept; NULL: none */
  celspan_texture *grain;
} celspan_rostrum_desc;

CELSPAN_DESCRIPTION(celspan_rostrum_desc)
#define CELSPAN_ROSTRUM_DESC (celspan_rostrum_desc_initial())

/* desc: borrowed, except for the cels. Errors: NO_MEMORY; BAD_ARGUMENT for lights or a brightness
 * below 0, a camera without width, a kernel that sums to nothing; what its function returns. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_rostrum_create(celspan_context *context,
                                                                  const celspan_rostrum_desc *desc,
                                                                  celspan_rostrum **out);
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_rostrum_named(celspan_context *context,
                                                                 celspan_rostrum *rostrum,
                                                                 const char *name,
                                                                 celspan_rostrum **out);
CELSPAN_API const char *celspan_rostrum_name(const celspan_rostrum *rostrum);
CELSPAN_API celspan_origin celspan_rostrum_origin(const celspan_rostrum *rostrum);
CELSPAN_API celspan_rostrum *celspan_rostrum_ref(celspan_rostrum *rostrum);
CELSPAN_API void celspan_rostrum_unref(celspan_rostrum *rostrum);
/* A composition used inside another: a rostrum with a size as an object, present in its frame
 * {0, 0, width, height}, swept in place and sharp at every zoom. As paint it has S = the light it
 * sends to its own camera, T = 1 - its matte channel by channel, beta = 1 - the greatest T; S may
 * exceed beta. Its lights, brightness and camera stay inside, its antialias is not used. It counts
 * as a level of nesting. rostrum: kept. Errors: NO_MEMORY; BAD_ARGUMENT for one without a size, or
 * with a singular viewport or camera; LIMIT. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_object_create_rostrum(celspan_context *context,
                                                                         celspan_rostrum *rostrum,
                                                                         celspan_object **out);
/* 128 bits that are equal for equal scenes, in every process: a name for a frame's content.
 * Pictures count by their names, surfaces by their content or key. A scan-line procedure cannot be
 * compared: each object made with one is another. Shared read. */
CELSPAN_API void celspan_rostrum_hash(const celspan_rostrum *rostrum, uint64_t out[2]);

/* What a rostrum holds, every level counted. */
typedef struct celspan_rostrum_counts {
  size_t cels, primitives, pictures;
} celspan_rostrum_counts;
CELSPAN_API void celspan_rostrum_count(const celspan_rostrum *rostrum, celspan_rostrum_counts *out);
/* Reads the header of every picture, hidden or not, up to the first that cannot be read, and keeps
 * it for the frames to come. Errors: INPUT, LIMIT, NO_MEMORY. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_rostrum_check(celspan_context *context,
                                                                 const celspan_rostrum *rostrum);

/* A picture that cannot be read, where a rostrum has it. cel, primitive: counted from 1; a cel's
 * primitives are counted through its booleans and the rostrums inside it. primitive 0: a light has
 * it, of the cel or of a rostrum inside; cel 0: a light of the rostrum itself. */
typedef struct celspan_fault {
  celspan_status status; /* INPUT, LIMIT, BAD_ARGUMENT; CALLBACK of a surface */
  const char *message;   /* borrowed for the call; it begins with the file, where there is one */
  size_t cel, primitive;
  const char *cel_name, *name; /* of the cel and of the object that is the primitive; "": none */
  celspan_origin cel_origin, origin; /* where these were made */
} celspan_fault;

typedef struct celspan_inspect_desc {
  size_t struct_size;
  bool is_deep; /* pictures are read whole, not only their headers */
  /* Called for every fault, in the order of cels and primitives; false: stop. NULL:
   * faults are only counted. */
  bool (*report)(void *user, const celspan_fault *fault);
  /* Called now and then while a picture is read whole; false: stop. NULL: nobody asks. */
  bool (*progress)(void *user, int32_t rows_done, int32_t rows_total);
  void *user;
} celspan_inspect_desc;

CELSPAN_DESCRIPTION(celspan_inspect_desc)
#define CELSPAN_INSPECT_DESC (celspan_inspect_desc_initial())

/* Looks at every picture, hidden or not, and reports all that cannot be read; nothing is kept of
 * them. The answer is OK, or the status and sentence of the first fault. Other errors: NO_MEMORY,
 * BAD_ARGUMENT for the description; CANCELLED. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_rostrum_inspect(
    celspan_context *context, const celspan_rostrum *rostrum, const celspan_inspect_desc *desc);

typedef struct celspan_exposure {
  celspan_rostrum *rostrum; /* borrowed */
  double weight;            /* >= 0 */
} celspan_exposure;

/* ---------------------------------------------------------------- frames, rows and sinks */

typedef enum celspan_span_kind {
  CELSPAN_SPAN_SINGLE = 0, /* one colour */
  CELSPAN_SPAN_GRADIENT,   /* colour + slope * (column - origin) */
  CELSPAN_SPAN_ARRAY       /* a colour for every pixel */
} celspan_span_kind;

typedef struct celspan_span {
  int32_t x0, x1; /* columns of the frame */
  celspan_span_kind kind;
  int32_t origin;     /* gradient: the column of `colour`; cutting a span leaves it alone */
  float colour[4];    /* premultiplied RGBA, in the space of the frame */
  float slope[4];     /* gradient: a column */
  const float *array; /* array: 4 floats a pixel, from x0 on */
  /* An array for a sink that takes codes may have these instead, and NULL for `array`: the pixels
   * as RGBA of 8 bits, sRGB, straight. */
  const unsigned char *codes;
} celspan_span;

/* The colour of one column of a span without codes, x0 <= x < x1. Any thread. */
static inline void celspan_span_colour(const celspan_span *span, int32_t x, float rgba[4]) {
  for (int c = 0; c < 4; c++)
    rgba[c] = span->kind == CELSPAN_SPAN_ARRAY ? span->array[4 * (size_t)(x - span->x0) + c]
              : span->kind == CELSPAN_SPAN_GRADIENT
                  ? span->colour[c] + span->slope[c] * (float)(x - span->origin)
                  : span->colour[c];
}

typedef struct celspan_frame_desc {
  size_t struct_size;
  const celspan_exposure *exposures; /* borrowed; light adds, alpha adds and is clamped to 1 */
  size_t exposure_count;
  double film_width, film_height;  /* film units; 0 0: the size in pixels */
  int32_t width, height;           /* pixels of the whole frame, 1..1,048,576 */
  int32_t crop_x, crop_y;          /* below 0: the crop begins beyond the frame */
  int32_t crop_width, crop_height; /* 0 0: the whole frame; clear beyond the frame, of which the
                                      crop has at least one pixel; 1,048,576 at most */
  bool has_antialias;              /* false: each rostrum's own */
  celspan_antialias_mode antialias;
  const celspan_filter_desc *filter; /* where antialias is FILTER; borrowed; NULL: a box */
  int workers;                       /* 0: one per processor; 1: the calling thread alone */
  int strip_rows;                    /* rows handed to a worker at a time; 0: chosen */
  /* Called by the rendering thread between strips; false stops with CANCELLED. NULL: never. */
  bool (*progress)(void *user, int32_t rows_done, int32_t rows_total);
  void *progress_user;
  /* How far gradient spans may be from the colours that they stand for, as a share of full scale:
   * 2^-20 .. 1. Finer ones are more spans. */
  bool has_tolerance; /* false: 1/1023 */
  double tolerance;
  /* In which pixels are antialiased, and of the numbers in spans; exposures add light in any
   * space. */
  celspan_space space;
  /* Whether its drawings are likely to return in other frames, as those of a film do: the maps
   * that it makes of them (docs/how-rows.md) may then take the place of older ones in the
   * context; otherwise they are kept only where there is room. And rows that are the same as in an
   * earlier frame are not made again. It changes no pixel. */
  bool repeats;
} celspan_frame_desc;

CELSPAN_DESCRIPTION(celspan_frame_desc)
#define CELSPAN_FRAME_DESC (celspan_frame_desc_initial())

/* One point by direct evaluation of the tree: no sweep, no spans, no antialiasing, no defocus.
 * desc: borrowed; its exposures, its film and its space count. x, y: film units. rgba: linear,
 * premultiplied. Errors: INPUT, LIMIT, NO_MEMORY, CALLBACK, BAD_ARGUMENT for the description. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_probe(celspan_context *context,
                                                         const celspan_frame_desc *desc,
                                                         celspan_point point, double rgba[4]);

typedef struct celspan_statistics {
  size_t struct_size;
  uint64_t rows, spans, single, gradient, array;
  uint64_t pixels_in_arrays;
  uint64_t colour_evaluations; /* times a colour was composed from layers */
  uint64_t allocations;        /* from the built scene to the last row */
  uint64_t peak_bytes;         /* above what was held before the frame began */
  uint64_t maps;               /* cels, or parts of cels, drawn from maps */
  uint64_t maps_made;          /* how many of these maps were not kept from another frame */
  uint64_t swept;              /* those that were not drawn from maps */
  uint64_t rows_held;          /* rows that were not made, but kept from another frame */
} celspan_statistics;

CELSPAN_RESULT(celspan_statistics)
#define CELSPAN_STATISTICS (celspan_statistics_initial())

/* Where rows go. Called by one thread, rows from top to bottom; spans are borrowed, sorted,
 * disjoint, without gap from column 0 to width-1 of the crop. `end` is called once after a
 * successful `begin`, with the outcome so far; what it returns counts. begin and end may be NULL;
 * without `row` rows are made, and counted in the statistics, and go nowhere.
 */
typedef struct celspan_sink {
  size_t struct_size;
  void *user;
  celspan_status (*begin)(void *user, celspan_context *context, int32_t width, int32_t height);
  celspan_status (*row)(void *user, celspan_context *context, int32_t y, const celspan_span *spans,
                        size_t span_count);
  celspan_status (*end)(void *user, celspan_context *context, celspan_status outcome);
  bool takes_codes; /* row is content with codes where pictures are copied, and codes to 8 bits,
                       sRGB, straight (celspan_spans_code takes them) */
} celspan_sink;

CELSPAN_DESCRIPTION(celspan_sink)
#define CELSPAN_SINK (celspan_sink_initial())

/* Renders a frame into a sink. statistics: begun with CELSPAN_STATISTICS, or NULL.
 * Errors: any; BAD_ARGUMENT for a singular viewport or camera. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_frame_render(celspan_context *context,
                                                                const celspan_frame_desc *desc,
                                                                const celspan_sink *sink,
                                                                celspan_statistics *statistics);

/* Rows on demand, in any order (ascending order is cheapest): for hosts with a loop of their own.
 * The desc's workers are not used. One thread at a time. */
typedef struct celspan_rows celspan_rows;
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_rows_create(celspan_context *context,
                                                               const celspan_frame_desc *desc,
                                                               celspan_rows **out);
/* y: row of the crop, from 0. *spans stays valid until the next call on `rows`. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_rows_get(celspan_rows *rows, int32_t y,
                                                            const celspan_span **spans,
                                                            size_t *span_count);
CELSPAN_API void celspan_rows_destroy(celspan_rows *rows);

/* ---------------------------------------------------------------- pixels and files */

typedef enum celspan_depth {
  CELSPAN_DEPTH_DEFAULT = 0, /* by the file format; for pixels and raw frames: 8 */
  CELSPAN_DEPTH_8,
  CELSPAN_DEPTH_16,
  CELSPAN_DEPTH_HALF,
  CELSPAN_DEPTH_FLOAT,
  /* 8 bits, rounded up or down by the place of the pixel in the whole frame: gradients show no
   * bands, and the mean of 16 x 16 pixels of one colour is within 1/130560 of it. What is exact in
   * 8 bits stays as it is. Not for span files. */
  CELSPAN_DEPTH_8_DITHER
} celspan_depth;

typedef enum celspan_transfer {
  CELSPAN_TRANSFER_DEFAULT = 0, /* integers sRGB, floats linear, DPX Cineon */
  CELSPAN_TRANSFER_LINEAR,
  CELSPAN_TRANSFER_SRGB,
  CELSPAN_TRANSFER_REC709,
  CELSPAN_TRANSFER_CINEON
} celspan_transfer;

/* How colours are coded. Straight: un-premultiplied in the space of the spans, then coded, then
 * rounded to nearest. */
typedef struct celspan_coding {
  size_t struct_size;
  celspan_depth depth;
  celspan_transfer transfer;
  celspan_alpha alpha;
  celspan_space space; /* of the spans. SRGB: codes of sRGB are their numbers, others are made of
                          the light that these stand for. What renders a frame sets it */
  /* NULL, or instead of `transfer`: replaces straight linear light by the numbers that are coded,
   * in `count` pixels of four floats, of which the fourth stays. It is called by several threads
   * at once, and the same light must always give the same numbers. */
  void (*convert)(void *user, float *rgba, size_t count);
  void *user;
  const char *colour; /* with `convert`: the name of the space, for the headers of files */
} celspan_coding;

CELSPAN_DESCRIPTION(celspan_coding)
#define CELSPAN_CODING (celspan_coding_initial())

/* Bytes of one RGBA pixel: 4, 8, 8 or 16. */
CELSPAN_API size_t celspan_coding_pixel_size(const celspan_coding *coding);

/* Codes the spans of one row, which cover [0, width) without gap, as width RGBA pixels: for hosts
 * that take rows and want pixels. Any thread. */
CELSPAN_API void celspan_spans_code(const celspan_coding *coding, const celspan_span *spans,
                                    size_t span_count, void *pixels);

/* The same for a coding that dithers: x, y is the place of the first pixel in the whole frame;
 * celspan_spans_code takes it for 0, 0. */
CELSPAN_API void celspan_spans_code_at(const celspan_coding *coding, int32_t x, int32_t y,
                                       const celspan_span *spans, size_t span_count, void *pixels);

/* Renders into memory: RGBA interleaved, rows top to bottom, `stride` bytes apart. pixels NULL:
 * rows are coded, each over the one before, and dropped: for measuring. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_frame_pixels(celspan_context *context,
                                                                const celspan_frame_desc *desc,
                                                                const celspan_coding *coding,
                                                                void *pixels, size_t stride,
                                                                celspan_statistics *statistics);

typedef struct celspan_file_desc {
  size_t struct_size;
  /* NULL: by the ending of the path; "png", "span", "exr", "tiff", "dpx", ... */
  const char *format;
  const celspan_coding *coding; /* borrowed; NULL: by the format */
  const char *title;            /* metadata; NULL: none */
  double frames_second;         /* metadata; 0: none */
  int32_t frame;                /* metadata: the frame's number */
  bool is_opaque;               /* every pixel's alpha is 1: formats that can leave it out */
  int workers; /* threads that compress; 0: one per processor; the bytes do not change */
  /* Of the sink's first pixel in the whole frame, where the depth dithers; celspan_frame_write adds
   * the corner of the crop. */
  int32_t place_x, place_y;
  /* Of a strip, which `celspan join` puts under those above it: the row of the whole picture that
   * its row 0 is, and how many rows that has. strip_height 0: a picture by itself. PNG, Targa and
   * span files; BAD_ARGUMENT for others, and for a strip that is not within its picture. */
  int32_t strip_row, strip_height;
} celspan_file_desc;

CELSPAN_DESCRIPTION(celspan_file_desc)
#define CELSPAN_FILE_DESC (celspan_file_desc_initial())

/* Whether every pixel of the frame is certain to have alpha 1, because a back light of matte 1
 * is behind everything. Shared read. */
CELSPAN_API bool celspan_frame_is_opaque(const celspan_frame_desc *desc);

/* Renders into a file; the file's is_opaque is found from the frame. The file appears under its
 * name whole or not at all; one that is there is replaced; missing folders are made. Errors: any;
 * OUTPUT, LIMIT for sizes the format lacks. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_frame_write(celspan_context *context,
                                                               const celspan_frame_desc *desc,
                                                               const char *path,
                                                               const celspan_file_desc *file,
                                                               celspan_statistics *statistics);

/* The sink that celspan_frame_write renders into, for rows that come from elsewhere: call its
 * begin, then row for each row from the top, then end, which completes the file when the outcome is
 * OK and no call failed, else leaves nothing, and in any case destroys the sink. end must be
 * called once whatever happened, even when begin failed or was not called.
 * path, file: copied; file may be NULL      out: new
 * Errors: NO_MEMORY, OUTPUT, LIMIT; BAD_ARGUMENT for a format or coding that is not known. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_file_sink_create(celspan_context *context,
                                                                    const char *path,
                                                                    const celspan_file_desc *file,
                                                                    celspan_sink *out);

/* The short way: the rostrum as a picture of width x height pixels. Its film has its own size, or
 * else a unit for each pixel; everything else has its default.
 * _write: into a file. _pixels: into width * height RGBA pixels of 8 bits, sRGB, straight.
 * Errors: any. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_rostrum_write(celspan_context *context,
                                                                 celspan_rostrum *rostrum,
                                                                 int32_t width, int32_t height,
                                                                 const char *path);
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_rostrum_pixels(celspan_context *context,
                                                                  celspan_rostrum *rostrum,
                                                                  int32_t width, int32_t height,
                                                                  unsigned char *pixels);

/* A digest of a frame's pixels in a coding: 128 bits, for comparing runs and machines. */
CELSPAN_API CELSPAN_CHECKED celspan_status celspan_frame_digest(celspan_context *context,
                                                                const celspan_frame_desc *desc,
                                                                const celspan_coding *coding,
                                                                uint64_t digest[2]);

#ifdef __cplusplus
}
#endif
#endif
