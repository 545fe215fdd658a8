/* Shifts: rules by which a composition's only cel shows other points than its own. It is averaged
 * over pixels, and these are read along the rule:
 *
 *     displaced        line           zoom              spin
 *                                        .                 .
 *     p--.             .               .p             .  p '
 *         `--> q         `p.         .'             .'       `
 *                            `.    x               '    x      read evenly from end to end
 *
 * Displacement reads one place q = p + scale (code - 0.5). Its codes are those of another cel at p.
 * All of this is in the units of the cel's objects.
 */
#pragma once

#include "model/scene/scene.h"

typedef struct cs_shift cs_shift;

typedef enum cs_shift_kind {
  CS_SHIFT_DISPLACED,
  CS_SHIFT_LINE,
  CS_SHIFT_ZOOM,
  CS_SHIFT_SPIN
} cs_shift_kind;

struct cs_shift {
  atomic_size_t references;
  cs_memory *memory;
  cs_hash hash;
  cs_shift_kind kind;
  celspan_point at; /* LINE: from p to an end; ZOOM, SPIN: the centre */
  /* how far to either side. ZOOM: a share of the distance, less than 1; SPIN: radians, up to pi */
  double extent;
  bool is_cut;     /* the composition ends where the cel may continue */
  celspan_cel *by; /* DISPLACED, and all that follows; a reference to a cel of one object */
  celspan_channel channels[2];
  double scale;
  celspan_space space; /* the space of the channels: LINEAR or SRGB */
  bool moves_clear;    /* clear counts as black; else nothing moves there */
};

cs_shift *cs_shift_ref(cs_shift *shift);
void cs_shift_unref(cs_shift *shift);

cs_hash cs_shift_hash(const cs_shift *shift);

/* The box of all points that are read for the points of a box, and of all that show a point of
 * it. */
celspan_box cs_shift_reads(const cs_shift *shift, const celspan_box *shown);
celspan_box cs_shift_shows(const cs_shift *shift, const celspan_box *read);
