/* The scene: textures, objects, cels, rostrum. Immutable once made, counted atomically, each with a
 * 128-bit structural hash made at construction.
 *
 *   rostrum -> cels -> objects (boolean trees) -> primitives -> texture
 *      ^        |                  |
 *      |        +-> lights         |     a rostrum may be an object of a cel of another one: a
 *      +---------------------------+     composition inside a composition
 *
 * Only scene/ writes these; the compiler of frames (frames/render/compile.c) and the oracle
 * (model/scene/probe.c) read them. Invariant: every number was checked (finite, in range), every
 * child pointer is set, nesting is at most CS_SCENE_DEPTH, and an object has at most
 * CS_SCENE_PRIMITIVES primitives, where a shared operand counts each time it occurs.
 */
#pragma once

#include "base/hash.h"
#include "base/mark.h"
#include "celspan/celspan.h"
#include "model/colour/space.h"
#include "model/geometry/outline.h"
#include "model/scene/antialias.h"
#include "model/scene/grade.h"
#include "model/scene/operands.h"
#include "model/scene/texture.h"
#include "model/stroke/stroke.h"

/* A light of a cel or a rostrum: one colour everywhere, or a texture.
 *
 *     flat          r, g, b; and the matte a of a back light
 *     texture       gain * beta * pigment at each point; the matte is matte * beta
 *
 *         on = FRAME                             on = CEL
 *      +------------------+                   +------------------+
 *      |   .  * .         |  stays while      |        .  * .    |  moves with the cel
 *      |  . light .  cel  |  the cel moves    |   cel . light .  |
 *      |     . .          |                   |          . .     |
 *      +------------------+                   +------------------+
 *
 * Invariant: a texture here is no flat one, and its paints have clear media, so its T is 1 - beta.
 */
typedef struct cs_light {
  bool is_given;            /* front lights: false for a cel that uses the light of its rostrum */
  celspan_light flat;       /* where there is no texture; else 0 */
  celspan_light coded;      /* the same light where codes are mixed: converted if it is a colour */
  celspan_texture *texture; /* NULL: flat */
  double gain;              /* the factor of the texture; 0 without a texture */
  celspan_light_place on;   /* where the texture lies; 0 without one */
  double matte;             /* the factor of the texture's beta; 0 without a texture */
} cs_light;

/* One light of a description. */
typedef struct cs_light_desc {
  const char *noun, *field;
  bool is_given; /* the plain light was given */
  celspan_light flat;
  const celspan_light_texture *texture;
  bool is_colour; /* the plain light is converted to codes if these are mixed */
} cs_light_desc;

/* *out: owns a reference to its texture. Errors: NO_MEMORY, BAD_ARGUMENT. */
CELSPAN_CHECKED celspan_status cs_light_make(celspan_context *context, const cs_light_desc *desc,
                                             cs_light *out);
/* Another owner of the same light. */
cs_light cs_light_ref(const cs_light *light);
void cs_light_unref(const cs_light *light);
void cs_light_hash(cs_hash *hash, const cs_light *light);
/* The colour of a flat light in a space. */
static inline celspan_light cs_light_in(const cs_light *light, celspan_space space) {
  return space == CELSPAN_SPACE_SRGB ? light->coded : light->flat;
}
/* The light times a brightness; the matte does not change. Borrows the texture. */
cs_light cs_light_scale(const cs_light *light, double brightness);

#define CS_SCENE_DEPTH 128
#define CS_SCENE_PRIMITIVES 16777216 /* in one object, every level counted */

typedef enum cs_primitive_data_kind {
  CS_PRIMITIVE_DATA_OUTLINE,
  CS_PRIMITIVE_DATA_SCANLINE,
  CS_PRIMITIVE_DATA_BOOLEAN,
  CS_PRIMITIVE_DATA_ROSTRUM
} cs_primitive_data_kind;

/* A matte among the operators: it has two operands. The second is never painted; its strength at a
 * point fades the first. */
#define CS_OPERATOR_MATTE ((celspan_operator)(CELSPAN_OPERATOR_CLIP + 1))

/* A known fact about where a boolean is present: it is present wherever `object`, grown by `width`,
 * is present (model/scene/grow.h). */
typedef struct cs_inner {
  celspan_object *object; /* in the boolean's units; NULL: nothing is known. A reference */
  double width;
  celspan_stroke_join join;
} cs_inner;

/* The values that only booleans have. A group is a union, and so is an object with a mode of its
 * own. */
typedef struct cs_boolean {
  celspan_operator op;
  celspan_blend blend;
  /* its operands are like CS_MIXING_MIXED: the space matters, if there is one */
  celspan_space space;
  bool mixes;                /* they need CS_MIXING_MIXED, if there is a space */
  celspan_grade *grade;      /* the grade of the result; NULL: none. A reference */
  bool isolates;             /* modes inside do not act on the backdrop of this object */
  bool is_luma;              /* MATTE: the strength is luma, not alpha */
  bool inverts;              /* MATTE: the strength is 1 minus the usual one */
  bool dissolves;            /* MATTE: what the strength and the alpha decide is all or nothing */
  bool is_filled;            /* CLIP: the plane of a pattern, and the primitive that it fills */
  cs_inner inner;            /* inside an outline; not in the hash: it changes no pixel */
  cs_operands view;          /* keeps the operands */
  celspan_object **operands; /* the operands of the view */
  size_t operand_count;
  /* the hash of the first hashed_count operands; further operands continue it */
  cs_hash operands_hash;
  size_t hashed_count;
} cs_boolean;

/* How a working space changes the look of an object by itself. Pixels are averaged in the film's
 * space, so edges do not count. */
typedef enum cs_mixing {
  CS_MIXING_OPAQUE, /* not at all: one opaque paint at each point */
  /* not at all, unless something lies behind it: one paint, or one colour of a picture, at each
   * point */
  CS_MIXING_SINGLE,
  CS_MIXING_MIXED /* paints may be mixed, as in a gradient */
} cs_mixing;

/* How a rostrum is repeated over the plane. INVARIANT: `matrix` is affine and not singular. */
typedef struct cs_repeat {
  celspan_box box; /* the place of the rostrum's frame that is repeated, in the pattern's units */
  celspan_matrix matrix, inverse; /* from those units to the data's */
} cs_repeat;

#define CS_SHAPE_PIECES 4

/* The data of an object without its transform and fade: shared by all its transformed copies. A
 * scene may have a million of them, nearly all outlines: the values of other kinds are behind a
 * pointer, and an upright rectangle is kept as a box. cs_primitive_data_outline gives the outline
 * of either. */
typedef struct cs_primitive_data {
  atomic_size_t references;
  cs_memory *memory;
  cs_hash hash;
  cs_primitive_data_kind kind;
  celspan_rule rule;
  bool is_empty;            /* nothing to draw: no contour, or an operator without operands */
  bool has_procedure;       /* this object or one below it is a procedure */
  bool blends[CS_SPACES];   /* in that space, a mode below acts on the backdrop of this object */
  bool has_uneven;          /* this object or one below it has a paint that does not dim the three
                               channels alike, or stays on its thread; or is a procedure or a
                               rostrum */
  uint8_t mixing;           /* a cs_mixing */
  bool has_modes;           /* a mode is in this object or below it, except inside a rostrum */
  bool is_box;              /* the outline is `box`, which has an area */
  int16_t depth;            /* levels of booleans and rostrums, with this object */
  uint32_t piece_count;     /* of outlines, at least CS_SHAPE_PIECES a shape, of which a mesh and
                               a stroke are one; without what a difference cuts away */
  uint32_t primitive_count; /* primitives of the tree; a shared one counts each time */
  celspan_texture *texture; /* OUTLINE; never NULL */
  /* all kinds except BOOLEAN: own units; tight, but the bounds of a stroke only where tight
   * bounds can be seen */
  celspan_box bounds;
  /* OUTLINE: the data whose stroke or outline this has, too, a reference; NULL: it owns them */
  struct cs_primitive_data *shape;
  cs_stroke *stroke; /* OUTLINE, instead of an outline; else NULL. Owned */
  union {
    celspan_box box;     /* is_box. SCANLINE: its bounds; ROSTRUM: its frame */
    cs_outline *outline; /* not is_box: packed and owned. NULL for strokes and booleans */
  };
  union {
    cs_boolean *boolean;             /* BOOLEAN; owned */
    celspan_scanline_desc *scanline; /* SCANLINE; owned */
    struct celspan_rostrum *rostrum; /* ROSTRUM; a reference */
  };
  cs_repeat *repeat; /* ROSTRUM, whose frame is then the plane of a pattern; else NULL. Owned */
} cs_primitive_data;

/* The outline of data that have one, else NULL. room: where the outline of a box is made. */
static inline const cs_outline *cs_primitive_data_outline(const cs_primitive_data *data,
                                                          cs_outline_box *room) {
  return data->is_box ? cs_outline_of_box(&data->box, room) : data->outline;
}

struct celspan_object {
  atomic_size_t references;
  cs_memory *memory;
  cs_hash hash;
  cs_mark mark;
  cs_primitive_data *data;
  double fade;                  /* 0..1 */
  const celspan_matrix *matrix; /* own units to the parent's: `own`, or the identity, shared */
  celspan_matrix own[];         /* one; none where the matrix is shared */
};

static inline celspan_blend cs_object_mode(const celspan_object *object) {
  const cs_primitive_data *data = object->data;
  return data->kind == CS_PRIMITIVE_DATA_BOOLEAN ? data->boolean->blend : CELSPAN_BLEND_NORMAL;
}

/* The space in which the operands of a boolean are composited; around: the space that the boolean
 * is in. Operands that are not mixed use the space around, because the result is the same and costs
 * less. */
static inline celspan_space cs_boolean_space(const cs_boolean *boolean, celspan_space around) {
  return boolean->mixes ? cs_space_inside(boolean->space, around) : around;
}

/* Whether the result of a boolean inside a space is changed as a whole: graded, or converted. */
static inline bool cs_boolean_develops(const cs_boolean *boolean, celspan_space around) {
  return boolean->grade || cs_boolean_space(boolean, around) != around;
}

/* Whether the look of the object depends on its backdrop, in a space. */
static inline bool cs_object_blends(const celspan_object *object, celspan_space space) {
  const cs_primitive_data *data = object->data;
  if (data->kind != CS_PRIMITIVE_DATA_BOOLEAN)
    return false;
  return data->boolean->blend != CELSPAN_BLEND_NORMAL ||
         (data->blends[space] && object->fade == 1 && !data->boolean->isolates &&
          cs_boolean_space(data->boolean, space) == space);
}

struct celspan_cel {
  atomic_size_t references;
  cs_memory *memory;
  cs_hash hash;
  cs_mark mark;
  celspan_object **objects;
  size_t object_count;
  celspan_matrix matrix; /* the cel's own transform, before the viewport */
  cs_light front, back;
  bool has_viewport;
  celspan_box viewport;
  double defocus_radius;
  celspan_defocus_kernel defocus_kernel;
  celspan_blur_edge defocus_edge;
  double opacity;
  celspan_blend blend;
  celspan_grade *grade; /* NULL: none. A reference */
  /* Only where it is defocused by pixels, one of the two at most. NULL: none. References. */
  struct cs_shift *shift;        /* shift.h */
  struct cs_nearby *nearby;      /* nearby.h */
  bool blends_inside[CS_SPACES]; /* in that space, any of its objects acts on its backdrop */
  /* a mode is in the cel, except inside a rostrum, or is its own; or it has a grade */
  bool has_modes;
};

/* Whether the cel composites its objects by themselves, and puts them into the picture as one. */
static inline bool cs_cel_isolates(const celspan_cel *cel) {
  return cel->opacity < 1 || cel->defocus_radius > 0 || cel->grade ||
         cel->blend != CELSPAN_BLEND_NORMAL;
}

/* Whether the object or anything below it has a mode, except inside a rostrum. */
static inline bool cs_object_has_modes(const celspan_object *object) {
  return object->data->has_modes || cs_object_mode(object) != CELSPAN_BLEND_NORMAL;
}

/* Whether the look of the cel depends on its backdrop, in a space. */
static inline bool cs_cel_blends(const celspan_cel *cel, celspan_space space) {
  return cel->blend != CELSPAN_BLEND_NORMAL || (cel->blends_inside[space] && !cs_cel_isolates(cel));
}

struct celspan_rostrum {
  atomic_size_t references;
  cs_memory *memory;
  cs_hash hash;
  cs_mark mark;
  celspan_cel **cels;
  size_t cel_count;
  cs_light front, back;
  double brightness;
  bool has_size;
  double width, height; /* 0 without a size */
  bool has_camera_centre, has_camera_width;
  celspan_point camera_centre;
  double camera_width;
  double camera_radians;
  cs_antialias antialias;
  celspan_space space;
  celspan_grade *grade;   /* the grade of the whole; NULL: none. A reference */
  celspan_texture *grain; /* the grain over the whole frame; NULL: none. A reference */
};

/* Whether any cel of a rostrum acts on its backdrop, in a space. */
static inline bool cs_rostrum_blends(const celspan_rostrum *rostrum, celspan_space space) {
  for (size_t i = 0; i < rostrum->cel_count; i++)
    if (cs_cel_blends(rostrum->cels[i], space))
      return true;
  return false;
}

/* Whether a mode is in a rostrum, except in a rostrum inside it, or a cel has a grade. */
static inline bool cs_rostrum_has_modes(const celspan_rostrum *rostrum) {
  for (size_t i = 0; i < rostrum->cel_count; i++)
    if (rostrum->cels[i]->has_modes)
      return true;
  return false;
}

/* The matrix from a cel's own units (before its transform) to film units on the frame: transform,
 * then viewport, then camera. Errors: BAD_ARGUMENT, naming the cel, when viewport or camera is
 * singular. cel_index is only for the message. */
CELSPAN_CHECKED celspan_status cs_scene_cel_matrix(celspan_context *context,
                                                   const celspan_rostrum *rostrum, size_t cel_index,
                                                   double film_width, double film_height,
                                                   celspan_matrix *out);
/* The factors of that matrix that come after the cel's own transform: the view, which is the
 * viewport and then the camera, and the camera alone, which is the identity where there is none.
 * They are not checked. */
celspan_matrix cs_scene_view(const celspan_rostrum *rostrum, const celspan_cel *cel,
                             double film_width, double film_height);
celspan_matrix cs_scene_camera(const celspan_rostrum *rostrum, double film_width,
                               double film_height);
/* The front light of a cel, brightness included: the cel's own, else the rostrum's, else white. */
cs_light cs_scene_front(const celspan_rostrum *rostrum, const celspan_cel *cel);
/* A back light times the rostrum's brightness; the matte does not change. */
cs_light cs_scene_back(const celspan_rostrum *rostrum, const cs_light *back);
/* *out: new; a copy of `cel`, name and line included, without the given parts. Without lights,
 * white light shines on the cel and no light through it. For tools that show a part of the work.
 * Errors: NO_MEMORY. */
typedef struct cs_cel_without {
  bool lights, defocus;
  bool mixing; /* opacity and mode */
} cs_cel_without;
CELSPAN_CHECKED celspan_status cs_cel_bare(celspan_context *context, const celspan_cel *cel,
                                           cs_cel_without without, celspan_cel **out);
/* *out: new, unlit and without a transform; shows its objects, averaged over pixels, in one of
 * these ways. Errors: NO_MEMORY. */
typedef struct cs_cel_reading {
  struct cs_shift *shift;   /* shift.h, or NULL */
  struct cs_nearby *nearby; /* nearby.h, or NULL */
} cs_cel_reading;
CELSPAN_CHECKED celspan_status cs_cel_of_pixels(celspan_context *context,
                                                celspan_object *const *objects, size_t count,
                                                cs_cel_reading reading, celspan_cel **out);
/* *out: new; like `cel`, name and line included, with these objects alone. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_cel_with(celspan_context *context, const celspan_cel *cel,
                                           celspan_object *const *objects, size_t count,
                                           celspan_cel **out);
/* *out: new; a rostrum with one cel, of this object, with all defaults. */
CELSPAN_CHECKED celspan_status cs_rostrum_alone(celspan_context *context, celspan_object *object,
                                                celspan_rostrum **out);
/* *out: new; like `from`, name and line included, with these cels, which are kept.
 * cs_rostrum_change replaces the back light, too. Neither checks its arguments. For tools that show
 * a part of a frame, or show it before another ground. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_rostrum_with(celspan_context *context,
                                               const celspan_rostrum *from,
                                               celspan_cel *const *cels, size_t cel_count,
                                               celspan_rostrum **out);
CELSPAN_CHECKED celspan_status cs_rostrum_change(celspan_context *context,
                                                 const celspan_rostrum *from,
                                                 celspan_cel *const *cels, size_t cel_count,
                                                 cs_light back, celspan_rostrum **out);
/* *out: new; like `from`, name and line included, as the camera of `by` sees it. Errors:
 * NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_rostrum_by_camera(celspan_context *context,
                                                    const celspan_rostrum *from,
                                                    const celspan_rostrum *by,
                                                    celspan_rostrum **out);
/* Adds all that belongs to a rostrum itself, without its cels. */
void cs_rostrum_hash_own(cs_hash *hash, const celspan_rostrum *rostrum);
/* Sets the hash of a new rostrum whose members have been changed. */
void cs_rostrum_rehash(celspan_rostrum *rostrum);
/* *out: new; what is drawn instead of a rostrum that is the frame of a film, or an object of that
 * size. Without grain it is the rostrum itself. With grain it has one cel, in which the rostrum is
 * an object under a sheet of grain; everything that asks for cels, their names and lights asks the
 * rostrum. margin: how far beyond the frame it is right, for filters, in film units; 0 for an
 * object, which ends at its frame. space: of the film. Errors: those of
 * celspan_object_create_rostrum. */
CELSPAN_CHECKED celspan_status cs_rostrum_shown(celspan_context *context, celspan_rostrum *rostrum,
                                                double width, double height, double margin,
                                                celspan_space space, celspan_rostrum **out);
/* A hash of the contents of exposures, independent of the frame's size. Exposures with equal hashes
 * show the same, provided that they contain no procedure and the files of their pictures do not
 * change. */
cs_hash cs_scene_hash(const celspan_exposure *exposures, size_t count);
/* Whether any exposure contains a scan-line procedure. */
bool cs_scene_has_procedure(const celspan_exposure *exposures, size_t count);

/* A rostrum in which one light shines, at 1, and all others are out.
 *
 *     camera
 *       |    cel n      front 0, back 0
 *       |    ...
 *       |    cel i      front 1            or   back 1, behind it
 *       v    ---------------------------
 *            cels behind it are left out: no light of theirs is left
 *
 * The light that it sends to the camera is what a unit of that light adds to the frame. Mattes are
 * 0, so that the alpha is 1 less the mean share of light that comes through all of these cels.
 *
 * INVARIANT: it borrows everything from the rostrum that it was made of, which must outlive it. It
 * has the hashes of that rostrum and its cels: the items that caches keep under them do not depend
 * on lights.
 */
typedef struct cs_lit_alone {
  celspan_rostrum rostrum;
  celspan_cel *cels; /* owned; the rostrum's list points to them */
  size_t count;
} cs_lit_alone;

/* index: the place of the cel, from 0; is_back: its back light, else its front light.
 * Errors: NO_MEMORY; BAD_ARGUMENT for a rostrum with modes or grades, whose lights do not add
 * up. */
CELSPAN_CHECKED celspan_status cs_lit_alone_make(celspan_context *context,
                                                 const celspan_rostrum *rostrum, size_t index,
                                                 bool is_back, cs_lit_alone *out);
void cs_lit_alone_finish(celspan_context *context, cs_lit_alone *alone);
