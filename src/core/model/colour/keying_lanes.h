/* The formulas of keys (keying.h), for as many colours at once as a register has. Lane 3 of a
 * colour is 0; what is said of whole colours is in all their lanes. */
#pragma once

#include "base/wide.h"
#include "model/colour/primaries.h"

#define CS_KEYING_ACROSS 0.57735027f /* 1 / tan 60 degrees */
#define CS_KEYING_MOST 0.9f          /* of a colour counts as spill when the rest takes its place */
#define CS_KEYING_BRIGHTEST 1e12f

typedef struct cs_keying {
  bool is_given, is_luma;
  float chroma[2]; /* the chroma of the screen: Cb, Cr */
  float along[2];  /* the chroma, divided by the square of its length */
  float screen[4]; /* the screen's codes; lane 3 is 0 */
  float spill;     /* the part of the spill that is taken off, 0..1; not by luma */
  float from;      /* the distance or the Y up to which a colour is clear */
  float gain;      /* above that, how fast it is there; below 0 it is the other way round */
} cs_keying;

static inline cs_wide cs_keying_lanes_most(cs_wide c) {
  return cs_wide_max(cs_wide_max(CS_WIDE_SPREAD(c, 0), CS_WIDE_SPREAD(c, 1)), CS_WIDE_SPREAD(c, 2));
}

/* How much there is of a premultiplied colour; 0 for none. */
static inline cs_wide cs_keying_lanes_there(cs_wide e, cs_wide alpha) {
  const cs_wide most = cs_keying_lanes_most(cs_wide_max(e, -e));
  return cs_wide_choose(alpha > 0, alpha, cs_wide_min(most, cs_wide_all(1)));
}

/* The colour by itself, clamped to CS_KEYING_BRIGHTEST and its negative, so that it is finite. */
static inline cs_wide cs_keying_lanes_straight(cs_wide e, cs_wide there) {
  const cs_wide most = cs_wide_all(CS_KEYING_BRIGHTEST);
  return cs_wide_choose(there > 0, cs_wide_min(cs_wide_max(e / there, -most), most),
                        cs_wide_all(0));
}

static inline cs_wide cs_keying_lanes_luma(cs_wide codes) {
  return CS_LUMA(float, CS_WIDE_SPREAD(codes, 0), CS_WIDE_SPREAD(codes, 1),
                 CS_WIDE_SPREAD(codes, 2));
}

static inline cs_wide cs_keying_lanes_cb(cs_wide codes, cs_wide luma) {
  return (CS_WIDE_SPREAD(codes, 2) - luma) / 1.8556f;
}

static inline cs_wide cs_keying_lanes_cr(cs_wide codes, cs_wide luma) {
  return (CS_WIDE_SPREAD(codes, 0) - luma) / 1.5748f;
}

/* The share of the colours that stays. */
static inline cs_wide cs_keying_lanes_stays(const cs_keying *key, cs_wide codes) {
  const cs_wide luma = cs_keying_lanes_luma(codes);
  if (key->is_luma)
    return cs_wide_unit((luma - key->from) * key->gain);
  const cs_wide cb = cs_keying_lanes_cb(codes, luma) - key->chroma[0];
  const cs_wide cr = cs_keying_lanes_cr(codes, luma) - key->chroma[1];
  return cs_wide_unit((cs_wide_sqrt(cb * cb + cr * cr) - key->from) * key->gain);
}

/* The share of the screen in the colours, as far as it must be taken off. */
static inline cs_wide cs_keying_lanes_spill(const cs_keying *key, cs_wide codes) {
  const cs_wide luma = cs_keying_lanes_luma(codes);
  const cs_wide cb = cs_keying_lanes_cb(codes, luma), cr = cs_keying_lanes_cr(codes, luma);
  const cs_wide x = cb * key->along[0] + cr * key->along[1];
  const cs_wide z = cr * key->along[0] - cb * key->along[1];
  const cs_wide q = x - CS_KEYING_ACROSS * cs_wide_max(z, -z);
  return key->spill * cs_wide_max(q, cs_wide_all(0));
}

/* The colours without the spill. */
static inline cs_wide cs_keying_lanes_clean(cs_wide screen, cs_wide spill, cs_wide codes) {
  const cs_wide left = 1 - cs_wide_min(spill, cs_wide_all(CS_KEYING_MOST));
  const cs_wide most = cs_wide_max(cs_keying_lanes_most(codes), cs_wide_all(1));
  return cs_wide_min(cs_wide_max((codes - spill * screen) / left, cs_wide_all(0)), most);
}
