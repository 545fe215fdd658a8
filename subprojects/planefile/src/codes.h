/* 8-bit sRGB codes, as integers that are the same everywhere: no powers are taken.
 *
 *   light --least--> code --light--> light
 *
 * INVARIANT: the code of the light of a code is that code.
 */
#pragma once

#include "layout.h"

typedef struct pf_codes {
  int32_t least[257]; /* the least light that has a code or a greater one; 256 is never reached */
  int32_t light[256];
} pf_codes;

void pf_codes_make(pf_codes *codes);
/* Of linear light, limited to 0..1. */
uint32_t pf_codes_find(const pf_codes *codes, int32_t light);
/* Straight codes and alpha of a colour, and the colour that has them. */
void pf_codes_of(const pf_codes *codes, const planefile_cell *cell, int32_t out[4]);
planefile_cell pf_codes_cell(const pf_codes *codes, const int32_t straight[4]);
