/* Upright pictures: rows of the frame are rows of the picture.
 *
 *     picture   +----+----+----+----+----+
 *               |    |    |    |    |    |   row y      \  mixed or averaged into one line of
 *               +----+----+----+----+----+               >  texels
 *               |    |    |    |    |    |   row y + 1  /
 *               +----+----+----+----+----+
 *     pixels       *  *  *  *  *  *  *           then each pixel is interpolated along the line
 *
 *   nearest    the row of texels under the centre
 *   bilinear   the two rows about it, mixed
 *   box        the rows that the footprint covers, their mean
 */
#pragma once

#include "engine/sample/sampler_pixel.h"

void cs_sampler_row_run(const cs_sampling *run, cs_run pixels, float (*rgba)[4]);
void cs_sampler_row_at(const cs_sampling *run, const int32_t *columns, int32_t count, double y,
                       float (*rgba)[4]);

/* ---- sampler_row_wide.c: loops over `count` pixels or texels */

/* out = a + share (b - a); out may be a. */
CS_WIDE_DECLARE(void, cs_sampler_mix_rows,
                (const float (*a)[4], const float (*b)[4], float share, int32_t count,
                 float (*out)[4]));
/* sum += weight (texels - first) */
CS_WIDE_DECLARE(void, cs_sampler_add_row,
                (const float (*texels)[4], const float (*first)[4], float weight, int32_t count,
                 float (*sum)[4]));
/* sum = first + sum / total */
CS_WIDE_DECLARE(void, cs_sampler_end_sum,
                (const float (*first)[4], float total, int32_t count, float (*sum)[4]));
/* The boxes around the centres. */
CS_WIDE_DECLARE(void, cs_sampler_cut_row,
                (const cs_sampler_axis *axis, const double *u, int32_t count,
                 cs_sampler_extent *boxes));
/* Where the centres of a row's columns lie. */
CS_WIDE_DECLARE(void, cs_sampler_place_row,
                (const cs_sampler *sampler, int32_t x0, int32_t count, double y, double *u));
CS_WIDE_DECLARE(void, cs_sampler_place_columns,
                (const cs_sampler *sampler, const int32_t *columns, int32_t count, double y,
                 double *u));
/* As cs_sampler_reduce, for pictures that do not repeat. */
CS_WIDE_DECLARE(void, cs_sampler_clamp_row, (int32_t count, double *u));
/* The texels under the centres. */
CS_WIDE_DECLARE(void, cs_sampler_floor_row, (const double *u, int32_t count, int32_t *at));
/* The texels left of or at u - 1/2, and the shares of their right neighbours. */
CS_WIDE_DECLARE(void, cs_sampler_split_row,
                (const double *u, int32_t count, int32_t *at, float *across));
/* Mixes texels[at[i] - first] and the next one. */
CS_WIDE_DECLARE(void, cs_sampler_mix_along,
                (const float (*texels)[4], int32_t first, const int32_t *at, const float *across,
                 int32_t count, float (*rgba)[4]));
