/* A frame being compiled: the state that the files of this room share.
 *
 *   compile.c    rostrum, cels            calls
 *   objects.c    objects, trees, groups   |  |  ^  a rostrum that is an object comes back
 *   lights.c     lights of a film         v  |  |  as a callback
 *   layers.c     layers of primitives        v  |
 *
 * Layers are appended from the rear to the camera. Invariant: the layers of a group are neighbours,
 * and so are the layers of a tree: nothing else is appended between them.
 */
#pragma once

#include "engine/row/plan.h"
#include "model/geometry/boundary_build.h"
#include "model/scene/scene.h"

/* The film that cels belong to: the frame itself, or a rostrum that is an object. */
typedef struct cs_compiler_film {
  double width, height;
  celspan_matrix to_pixels;  /* film units to pixels of the frame */
  cs_v4 shine;               /* the light that falls on it from outside: multiplies its lights; lane
                                3 is 0 */
  const cs_outline *outline; /* around an object's frame, film units; NULL: the whole plane */
} cs_compiler_film;

/* Counts of the outlines in the frame. Outlines that are left out because they are on no requested
 * row are included, so that the counts depend on the scene and the frame's size alone. */
typedef struct cs_compiler_census {
  double pieces, rows; /* rows: the heights of the outlines, pixels */
  double depth;        /* halvings of light that the layers make behind a point, on the average */
} cs_compiler_census;

/* An isolating group: the frame, a rostrum that is an object, or a group. Where a source with a
 * mode is inside, its layers are appended to a ground (engine/compose/layer.h), and layers in front
 * of the source to the next ground, around the first. */
typedef struct cs_compiler_isolation {
  uint32_t ground; /* the ground being filled; CS_STACK_NONE: no source is inside */
  /* The front light with a shape of the cel being compiled, which lights its parts between sources
   * each by itself; NULL: there is none, or the cel has no source. Borrowed */
  const struct cs_lights_front *light;
  const cs_compiler_film *film; /* the film of that light */
  /* A film that has mattes of back lights, in layers behind all others (lights.h): where the layers
   * behind the cel being compiled begin, and where the layers that are in no ground yet end.
   * Otherwise both 0. */
  uint32_t mattes, mattes_end;
} cs_compiler_isolation;

struct cs_defocus_job; /* engine/defocus/layer.h */
struct cs_defocus_made;
struct cs_patterns; /* patterns.h */

typedef struct cs_compiler cs_compiler;
struct cs_compiler {
  celspan_context *context;
  cs_plan *plan;
  int workers; /* threads at most */
  cs_boundary_frame frame;
  cs_boundary_builder *boundaries; /* the boundaries of the plan, in the frame; shared by copies */
  double first_height, end_height; /* of the rows that will be asked for, with their margin */
  double first_place, end_place;   /* columns that will be asked for */
  size_t most_dashes;              /* with more in view, the plan is crowded */
  const size_t *cel_numbers;       /* see cs_view */
  size_t cel;                      /* from 1; it and the mark are for messages */
  cs_mark mark;                    /* the mark of the cel; borrowed */
  cs_v4 front;
  celspan_space space; /* the space of the object being compiled */
  celspan_point unit;  /* the unit of planes: see cs_view */
  uint32_t group;      /* the group being filled, or CS_STACK_NONE */
  cs_compiler_isolation isolation;
  bool records;     /* an operand is being compiled: it leaves one result on the tree's stack */
  bool is_nested;   /* inside a rostrum that is an object, so inside a tree */
  uint32_t results; /* is_nested: the results that the trees inside it have left so far */
  bool fades_out;   /* inside something faded to nothing: present, but clear */
  cs_compiler_census census;
  /* Of the frame; shared by copies, and by compilers of single cels. */
  struct cs_patterns *patterns;
  struct cs_defocus_made *blurs;
  /* Compiles one cel alone, as for a defocused one, and frees its plan. user: the compiler. */
  celspan_status (*compile_alone)(void *user, const struct cs_defocus_job *job, cs_plan *out);
  void (*free_alone)(cs_plan *plan, cs_memory *memory);
  /* Compiles the cels of a rostrum that is an object. */
  celspan_status (*compile_nested)(cs_compiler *c, const celspan_rostrum *rostrum,
                                   const cs_compiler_film *film);
};

/* Room for one more item of an array of the stack. Errors: NO_MEMORY. */
#define CS_COMPILER_APPEND(compiler, array, count)                                                 \
  CS_ARRAY_RESERVE((compiler)->context, (compiler)->plan->stack.array,                             \
                   (compiler)->plan->stack.count + 1)
