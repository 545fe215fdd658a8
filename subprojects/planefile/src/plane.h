/* A plane in memory. */
#pragma once

#include "band.h"
#include "codes.h"
#include "nest.h"

/* A band of another frame, from which one of this frame was made. */
typedef struct pf_kept {
  uint64_t offset; /* the offset of its record; 0: there is none */
  pf_band band;
  pf_base base;
} pf_kept;

struct planefile_plane {
  pf_memory memory;
  planefile_info info;
  uint64_t *inner;     /* where each plane of its nest ends; NULL: it is in none */
  pf_band *bands;      /* info.band_count; those that were not read have no cells */
  planefile_cell base; /* cell 0 of all bands */
  bool has_base;
  pf_kept *kept;        /* info.band_count; NULL: nothing is kept */
  pf_picture *pictures; /* info.picture_count; those that no band shows are empty */
  unsigned char codes[PLANEFILE_WHITE + 1]; /* the codes of linear light: in sRGB, 8 bits */
  pf_light_curve curve;                     /* where info.varies */
};

void pf_pixels_make(const pf_codes *codes, unsigned char out[PLANEFILE_WHITE + 1]);
