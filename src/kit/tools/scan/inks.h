/* The lines of a page, a layer of alpha for each ink.
 *
 *   brightness / field --> darkness below the white of the paper --> blots that are dust, out
 *     --> by hue, in Oklab: which ink has a pixel and those around it --> alpha = darkness / that
 *     of the ink --> layer.h
 *
 * INVARIANT: a pixel has one ink. What lies outside of the paper, or in a hole, is clear.
 */
#pragma once

#include "tools/scan/layer.h"
#include "tools/scan/rough.h"

#define CS_INKS_MOST 8

typedef struct cs_inks_desc {
  size_t count; /* 1..CS_INKS_MOST */
  unsigned char codes[CS_INKS_MOST][3];
  bool has_tones;
  double black, white; /* 0..1: brightness of the darkest ink and of the paper */
  uint32_t dust;       /* blots of at most this many pixels */
  cs_layer_place place;
} cs_inks_desc;

typedef struct cs_inks {
  celspan_surface *layers[CS_INKS_MOST]; /* NULL: none */
  double black, white;                   /* those that were used */
  uint64_t covered;                      /* pixels of the scan that are at least half covered */
} cs_inks;

/* Errors: NO_MEMORY; *out must be finished even then. */
CELSPAN_CHECKED celspan_status cs_inks_make(const cs_rough *page, const cs_inks_desc *desc,
                                            cs_inks *out);
void cs_inks_finish(cs_inks *inks); /* also if it is all zero */
