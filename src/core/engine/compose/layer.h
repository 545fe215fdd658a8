/* One layer of a compiled frame, and the data of each kind of layer.
 *
 * A layer is one primitive in its place: what it paints and how it is lit. The sweep decides where
 * it is present. Other data of a layer are in an array for its kind, at `index`.
 *
 * Invariant: nothing here changes while rows are made, so workers share it.
 */
#pragma once

#include <assert.h>

#include "base/vector.h"
#include "model/colour/grade.h"
#include "model/colour/paint.h"
#include "model/scene/scene.h"
#include "model/scene/texture.h"

#define CS_STACK_NONE UINT32_MAX /* no group, no layer */
/* Products of the lights of several levels are clamped to this, so that all sums remain finite. */
#define CS_LAYER_BRIGHTEST 1e12f

typedef enum cs_layer_kind {
  CS_LAYER_FLAT,
  CS_LAYER_SHADED,   /* a gradient or noise: varies along a row, as a formula */
  CS_LAYER_PICTURE,  /* varies from pixel to pixel */
  CS_LAYER_SCANLINE, /* its paints are in the procedure spans of the row */
  CS_LAYER_DEFOCUSED /* a defocused cel */
} cs_layer_kind;

/* The effect of a layer's paint. */
typedef enum cs_layer_role {
  CS_LAYER_PAINT, /* covers what lies behind it */
  /* a back light with a shape: its pigment is added to the light, and it dims nothing */
  CS_LAYER_BACK,
  CS_LAYER_FRONT /* the front light of its group, which its pigment lights. Present nowhere: it is
                     listed when its group is entered */
} cs_layer_role;

typedef struct cs_layer {
  cs_v4 s; /* FLAT: the light that it scatters under its front light; lane 3 is 0 */
  cs_v4 t; /* FLAT: transmission. Else the most that each channel lets through wherever the
                     layer is present, fade included; PICTURE: unless the picture is known to be
                     opaque. Lane 3 is 0 */
  /* the front light of its cel, brightness included, or the gain of a light; lane 3 is 0 */
  cs_v4 front;
  uint32_t group; /* innermost group, or CS_STACK_NONE */
  uint32_t index; /* for all kinds except FLAT: the index in the array of its kind */
  float fade;     /* the fade of its paint, if the paint varies */
  uint8_t kind;   /* a cs_layer_kind */
  uint8_t role;   /* a cs_layer_role */
} cs_layer;
static_assert(sizeof(cs_layer) == 64, "a layer fills a line of the cache");

/* The values of a layer that the walk along a row needs. */
typedef struct cs_layer_rule {
  uint64_t key[2];      /* identifies the layer in the hash of a set */
  int32_t winding_mask; /* inside where (winding & mask) != 0: -1 non-zero, 1 even-odd */
} cs_layer_rule;

/* A formula as planes, value = a x + b y + c.
 * TRIANGLE: premultiplied s, t and beta over own units.
 * LINEAR: where a point lies along the stops, over frame pixels; RADIAL: the two legs of its
 * distance from the centre, as shares of the radius. Both must be divided by the w of the point
 * unless is_affine. CONIC: the ways from the centre along the direction of 0 and across it. NOISE:
 * the coordinates in cells. */
typedef struct cs_shade {
  const celspan_texture *texture; /* borrowed from the scene */
  celspan_matrix inverse;         /* frame pixels to own units */
  double plane[7][3];
  double eccentricity; /* RADIAL: 0 without a focus; else see engine/paint/shade.h */
  bool is_affine;      /* and w is above 0 everywhere */
  bool is_steady;      /* the paint is the same in all columns of a row */
  bool is_even;        /* the stops' paints dim the three channels alike */
} cs_shade;

typedef struct cs_image_layer {
  const celspan_texture *texture; /* borrowed from the scene */
  celspan_matrix inverse;         /* frame pixels to own units */
  celspan_box box;                /* the box that the picture fills, own units */
  celspan_wrap wrap;
  celspan_space space; /* the space in which its samples are mixed with others */
} cs_image_layer;

/* Whether nothing shines through the layer wherever it is present, provided that its picture has no
 * alpha. */
static inline bool cs_image_layer_hides(const cs_image_layer *image) {
  return image->texture->variation->use == CELSPAN_PICTURE_PAINT &&
         !image->texture->variation->medium && image->wrap != CELSPAN_WRAP_CLEAR;
}

typedef struct cs_procedure {
  const celspan_scanline_desc *desc; /* borrowed from the scene */
  uint32_t layer;
  double scale_x, shift_x, scale_y, shift_y; /* own units to frame pixels */
  celspan_space space;                       /* in which its paints are mixed with others */
} cs_procedure;

/* What a group does with its contents after they have been composited by themselves. */
typedef enum cs_group_kind {
  CS_GROUP_PLAIN,  /* it is lit, faded, and put over the layers behind it */
  CS_GROUP_HEAD,   /* the frontmost part of the group around it, which needs it in another way */
  CS_GROUP_GROUND, /* the backdrop of a source, and the source: its head is the source, and the rest
                      is everything behind it. Without a head it has no effect */
  CS_GROUP_MATTE   /* its head is the matte, which says how much of the rest is visible */
} cs_group_kind;

/* Layers that are composited by themselves.
 *
 *     camera --> [ ground  [ head: source ]   layer  layer  [ ground [ head ] layer layer ] ]
 *
 * A film in which sources with modes lie over each other has a ground inside a ground: all grounds
 * of one isolating group begin with the same layer, its rearmost one. */
typedef struct cs_group {
  uint32_t parent; /* or CS_STACK_NONE */
  uint32_t first;  /* the rearmost layer of the group */
  float fade;
  bool has_light; /* a front light with a shape */
  bool varies;    /* it has such a light, or a group around it has one */
  bool curves;    /* it is a head (but not of a matte of alpha), a matte that dissolves, graded,
                     converted to another space, or inside such a group: the colours of the frame
                     are no affine function of its paints */
  bool is_source; /* the group is a head, or inside one */
  bool inverts;   /* MATTE: 1 less its strength */
  bool is_luma;   /* MATTE: its strength is luma, else alpha */
  bool dissolves; /* MATTE: the rest is opaque or clear */
  /* it lies directly in the frame, or is the whole frame: its back lights lie behind everything
   * else in it */
  bool is_frame;
  uint8_t kind;          /* a cs_group_kind */
  const cs_grade *grade; /* PLAIN: NULL: none. Borrowed from the scene */
  uint8_t space;         /* grade: the space of its contents */
  /* PLAIN: the celspan_space to which its result is converted; AROUND: it is not converted */
  uint8_t converts;
  uint8_t blend;      /* GROUND: a celspan_blend */
  bool has_front;     /* a flat front light, since its parts could not be lit one by one */
  cs_v4 front;        /* has_front: that light; lane 3 is 0 */
  uint32_t light;     /* has_light: the layer of that light, in front of all its others */
  uint32_t around;    /* GROUND: the group around all the grounds inside each other */
  uint32_t innermost; /* GROUND: the innermost of these grounds, whose number names them all */
} cs_group;

/* Whether a group has a key, which changes what is let through. */
static inline bool cs_group_keys(const cs_group *group) {
  return group->grade && group->grade->keying.is_given;
}

/* A back light, met on the way from the camera before every layer below `below`. */
typedef struct cs_back_light {
  uint32_t below;
  cs_v4 light; /* brightness included; lane 3 is 0 */
  float keep;  /* 1 - matte */
} cs_back_light;
