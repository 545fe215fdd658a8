/* Recipes of filters: steps that make one object of another.
 *
 *     0 the element ----+--> 2 blur --> 3 offset --+
 *     1 its silhouette  |                          +--> 4 merge = the result
 *                       +--------------------------+
 *
 * Several filters of one element are a list of recipes: each acts on the result of the previous
 * one. They are kept with their item, because they act on whatever `with` puts into the item's
 * place. Everything in it is in the user units of the element, and the result of a step is cut off
 * at the step's box.
 *
 * INVARIANT: an input of a step is one of the two sources or an earlier step; recipes do not change
 * once they are complete.
 */
#pragma once

#include <stdatomic.h>

#include "inside/scene.h"

#define CS_SVG_SOURCES 2 /* the element, and its silhouette in black */
/* How often the result of a recipe may contain the sources. */
#define CS_SVG_RECIPE_USES 1024

typedef enum cs_svg_step_kind {
  CS_SVG_STEP_MERGE,  /* the inputs on top of each other, the first one behind */
  CS_SVG_STEP_BLEND,  /* the first input in a mode over the second one */
  CS_SVG_STEP_IN,     /* the first input where the second one is */
  CS_SVG_STEP_OUT,    /* the first input where the second one is not */
  CS_SVG_STEP_ATOP,   /* IN, and the second input where the first one is not */
  CS_SVG_STEP_XOR,    /* each input where the other one is not */
  CS_SVG_STEP_SUM,    /* the weighted sum of both inputs, white and a product */
  CS_SVG_STEP_COLOUR, /* the input graded and faded */
  CS_SVG_STEP_LUMA,   /* black, as opaque as the input is light */
  CS_SVG_STEP_OFFSET,
  CS_SVG_STEP_BLUR,
  CS_SVG_STEP_DISPLACE, /* the first input, displaced by the second one */
  CS_SVG_STEP_GROW,     /* the paint at each point whose rectangle contains some of the input */
  CS_SVG_STEP_SHRINK,   /* the paint at each point whose rectangle is full of the input */
  CS_SVG_STEP_SHADOW,   /* the input over its silhouette, blurred and moved */
  CS_SVG_STEP_FLOOD,
  CS_SVG_STEP_TILE,   /* a part of the input, repeated */
  CS_SVG_STEP_NEARBY, /* the input changed by a rule */
  CS_SVG_STEP_IMAGE
} cs_svg_step_kind;

typedef struct cs_svg_step {
  cs_svg_step_kind kind;
  celspan_space space; /* the space whose numbers are mixed */
  celspan_box box;     /* nothing is drawn if it has no size */
  size_t first_input, input_count;
  celspan_blend blend; /* BLEND */
  /* SUM: the weights of the inputs, of white and of the product: 0..CS_SVG_SUM_MOST */
  double weights[4];
  int flood;            /* SUM: the input that is a flood, if there is a product */
  celspan_grade *grade; /* COLOUR; SUM: of the factor that is not the flood; owned; NULL: none */
  double opacity;       /* COLOUR */
  celspan_point offset; /* OFFSET, SHADOW */
  celspan_point radius; /* BLUR, SHADOW, GROW, SHRINK: along x and y */
  celspan_paint paint;  /* FLOOD, SHADOW, GROW, SHRINK */
  celspan_box tile;     /* TILE; NEARBY: what is repeated first, if it has a size */
  celspan_channel channels[2]; /* DISPLACE: along x and y */
  double scale;                /* DISPLACE */
  cs_nearby *nearby;           /* NEARBY; COLOUR: afterwards; owned; NULL: none */
  celspan_object *object;      /* IMAGE; owned; NULL: nothing */
} cs_svg_step;

#define CS_SVG_SUM_MOST 4

typedef struct cs_svg_recipe {
  atomic_size_t references;
  struct cs_svg_recipe *next; /* owned; NULL: it is the last one */
  cs_memory *memory;
  celspan_space space; /* the space of the drawing: for the element itself, and for images */
  celspan_box region;  /* the element is cut off outside of it */
  celspan_matrix matrix, back;  /* from user units to the drawing's, and back */
  CS_ARRAY(cs_svg_step, steps); /* none: nothing is drawn */
  CS_ARRAY(size_t, inputs); /* for all steps: the numbers of sources and steps, as in the figure */
  size_t step_count, input_count;
} cs_svg_recipe;

/* A recipe without steps. *out: new. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_recipe_create(celspan_context *context, cs_svg_recipe **out);
/* Appends a step, and owns its contents from now on, also after a failure. Errors: NO_MEMORY. */
CELSPAN_CHECKED celspan_status cs_svg_recipe_append(celspan_context *context, cs_svg_recipe *recipe,
                                                    const cs_svg_step *step);
cs_svg_recipe *cs_svg_recipe_ref(cs_svg_recipe *recipe);
/* Releases the recipes after it, too. */
void cs_svg_recipe_unref(cs_svg_recipe *recipe);

/* Replaces *object by the result of this recipe and the following ones. *object may be NULL before
 * and after the call: then nothing is drawn. Errors: NO_MEMORY, LIMIT; *object is then the result
 * so far. */
CELSPAN_CHECKED celspan_status cs_svg_recipe_apply(celspan_context *context,
                                                   const cs_svg_recipe *recipe,
                                                   celspan_object **object);
