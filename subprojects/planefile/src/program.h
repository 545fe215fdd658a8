/* Programs of cells that vary: their code, and the colours that they give.
 *
 *     steps, from the front        flat   enter   ramp   flat   leave   ramp
 *                                            \_____________________/
 *     what is composed             layer          one layer             layer
 *
 * A pixel is composed from the front: each layer adds its colour times what shines through those
 * before it.
 *
 * INVARIANT: a colour is a function of the program and the place of the pixel in the frame, whose
 * operations are all defined to the bit.
 */
#pragma once

#include "picture.h"

typedef struct pf_program_models {
  uint16_t varies[2], kinds[4], hows[16], axis_kinds[4], is_wide[2], wraps[4], filters[4];
  uint16_t axis_bytes[8][256], stop_bytes[8][256]; /* trees */
  pf_number steps, axes, stops, pictures, flat[4], stop[4], factor[4];
  pf_number recoloured[3][4]; /* of programs of a base: flat layers, stops, factors */
} pf_program_models;

/* What the code of the programs of a band depends on. */
typedef struct pf_program_coding {
  pf_program_models models;
  int32_t shade;         /* the shade of which colours are multiples */
  planefile_cell colour; /* the colour of the latest stop */
  uint32_t *axes;        /* encoding: of each axis of the plane its number plus 1; 0: none yet */
  uint32_t step_count, axis_count, stop_count; /* so far */
} pf_program_coding;

void pf_put_program(pf_encoder *encoder, pf_program_coding *coding, const planefile_band *plane,
                    planefile_program program);

/* Where a decoded program goes. */
typedef struct pf_program_room {
  planefile_step *steps;
  planefile_axis *axes;
  planefile_stop *stops;
  uint32_t step_count, axis_count, stop_count; /* that there is room for */
  uint32_t picture_count;                      /* of the file */
} pf_program_room;

/* Returns why it is refused, or NULL. What was decoded is checked. */
const char *pf_get_program(pf_decoder *decoder, pf_program_coding *coding,
                           const pf_program_room *room, planefile_program *out);

/* The last numbers of an axis: those that change when it is moved. False: it is not allowed. */
void pf_put_patch(pf_encoder *encoder, pf_program_coding *coding, const planefile_axis *axis);
bool pf_get_patch(pf_decoder *decoder, pf_program_coding *coding, planefile_axis *axis);

/* The colours of the steps and stops of a program, by how much they differ from those of another
 * one of the same form, `of` in `from`; decoding changes its own. */
void pf_put_recoloured(pf_encoder *encoder, pf_program_coding *coding, const planefile_band *from,
                       planefile_program of, const planefile_band *plane,
                       planefile_program program);
/* Returns why it is refused, or NULL. */
const char *pf_get_recoloured(pf_decoder *decoder, pf_program_coding *coding,
                              const pf_program_room *room, planefile_program program);

/* Whether a program is as planefile.h says; and whether nothing shines through it, anywhere or,
 * is_faced, in front of its gradients. */
bool pf_program_is_good(const planefile_band *band, planefile_program program);
bool pf_program_hides(const planefile_band *band, planefile_program program, bool is_faced);

/* ---------------------------------------------------------------- colours */

void pf_light_curve_make(pf_light_curve *out);

/* What programs are made of. */
typedef struct pf_program_source {
  const planefile_band *band;
  const pf_picture *pictures; /* the pictures of the file */
  const pf_light_curve *curve;
} pf_program_source;

/* Of each group that may be inside another one, and of the program: its colours, and its veils. */
enum { PF_ROOM = 2 * (PLANEFILE_DEPTH + 1) };
/* The colours are in the first one of the room. */
void pf_program_colours(const pf_program_source *source, planefile_program program,
                        const pf_pixels *pixels, pf_colours room[PF_ROOM]);
