#include "model/colour/primaries.h"

#include <math.h>
#include <string.h>

/* How much numbers of the same primaries may differ: headers have them with four digits, and
 * configurations their matrices with six or more. */
#define SAME 1e-4
#define LINEAR 1e-4 /* by how much light may differ from a sum of its parts */
#define LEAST 1e-6  /* below this a determinant belongs to primaries on one line */

/* Source: ITU-R BT.709 and BT.2020, SMPTE ST 2065-1 (AP0), S-2014-004 (AP1), EG 432-1 (P3). */
const cs_known_primaries cs_primaries_known[] = {
    {"BT.709", {0.64F, 0.33F, 0.3F, 0.6F, 0.15F, 0.06F, 0.3127F, 0.329F}},
    {"BT.2020", {0.708F, 0.292F, 0.17F, 0.797F, 0.131F, 0.046F, 0.3127F, 0.329F}},
    {"P3-D65", {0.68F, 0.32F, 0.265F, 0.69F, 0.15F, 0.06F, 0.3127F, 0.329F}},
    {"ACES AP1", {0.713F, 0.293F, 0.165F, 0.83F, 0.128F, 0.044F, 0.32168F, 0.33767F}},
    {"ACES AP0", {0.7347F, 0.2653F, 0, 1, 0.0001F, -0.077F, 0.32168F, 0.33767F}},
    {NULL, {0}}};

/* ---------------------------------------------------------------- matrices of 3 x 3, in rows */

static void multiply(const double a[9], const double b[9], double out[9]) {
  for (int i = 0; i < 9; i++) {
    const double *row = a + i / 3 * 3, *column = b + i % 3;
    out[i] = row[0] * column[0] + row[1] * column[3] + row[2] * column[6];
  }
}

static void apply(const double m[9], const double v[3], double out[3]) {
  for (int i = 0; i < 3; i++)
    out[i] = m[3 * i] * v[0] + m[3 * i + 1] * v[1] + m[3 * i + 2] * v[2];
}

static bool invert(const double m[9], double out[9]) {
  for (int i = 0; i < 9; i++) {
    int r = i % 3, c = i / 3; /* transposed */
    int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
    out[i] = m[3 * r1 + c1] * m[3 * r2 + c2] - m[3 * r1 + c2] * m[3 * r2 + c1];
  }
  double determinant = m[0] * out[0] + m[1] * out[3] + m[2] * out[6];
  for (int i = 0; i < 9; i++)
    out[i] /= determinant;
  return fabs(determinant) > LEAST; /* false for NaN, too */
}

/* ---------------------------------------------------------------- XYZ */

/* A colour of brightness 1; false: this chromaticity has none. */
static bool bright(const float xy[2], double out[3]) {
  double x = (double)xy[0], y = (double)xy[1];
  out[0] = x / y;
  out[1] = 1;
  out[2] = (1 - x - y) / y;
  return fabs(y) > LEAST && isfinite(x) && isfinite(y);
}

/* From light of these primaries to XYZ in which white has the brightness 1. */
static bool to_xyz(const float xy[CS_PRIMARIES], double out[9]) {
  double inverse[9], white[3], scale[3];
  for (int c = 0; c < 3; c++) {
    double x = (double)xy[2 * c], y = (double)xy[2 * c + 1];
    out[c] = x;
    out[3 + c] = y;
    out[6 + c] = 1 - x - y;
  }
  if (!invert(out, inverse) || !bright(xy + 6, white))
    return false;
  apply(inverse, white, scale);
  for (int i = 0; i < 9; i++)
    out[i] *= scale[i % 3];
  return true;
}

/* Bradford's adaptation from one white to another. Source: Lam (1985), as in ICC.1, annex E. */
static bool adapt(const float from[2], const float to[2], double out[9]) {
  static const double cones[9] = {0.8951, 0.2664, -0.1614, -0.7502, 1.7135,
                                  0.0367, 0.0389, -0.0685, 1.0296};
  double back[9], a[3], b[3], response_a[3], response_b[3], scaled[9];
  if (!bright(from, a) || !bright(to, b) || !invert(cones, back))
    return false;
  apply(cones, a, response_a);
  apply(cones, b, response_b);
  for (int i = 0; i < 9; i++)
    scaled[i] = cones[i] * response_b[i / 3] / response_a[i / 3];
  multiply(back, scaled, out);
  return true;
}

bool cs_primaries_to_bt709(const float xy[CS_PRIMARIES], double out[9]) {
  const float *own = cs_primaries_known[0].xy;
  double here[9], there[9], back[9], adapted[9], whole[9];
  if (!to_xyz(xy, here) || !to_xyz(own, there) || !invert(there, back) ||
      !adapt(xy + 6, own + 6, adapted))
    return false;
  multiply(adapted, here, whole);
  multiply(back, whole, out);
  double unused[9];
  return invert(out, unused);
}

void cs_primaries_from_bt709(const cs_known_primaries *known, double out[9]) {
  double back[9];
  bool is_known = cs_primaries_to_bt709(known->xy, back) && invert(back, out);
  (void)is_known;
}

const char *cs_primaries_name(const float xy[CS_PRIMARIES]) {
  for (const cs_known_primaries *known = cs_primaries_known; known->name; known++) {
    bool is_same = true;
    for (int i = 0; i < CS_PRIMARIES; i++)
      is_same = is_same && fabs((double)xy[i] - (double)known->xy[i]) < SAME;
    if (is_same)
      return known->name;
  }
  return NULL;
}

/* ---------------------------------------------------------------- conversions */

/* Black, red, green, blue, white, a quarter of red, of green and of blue, and white four times. */
enum { PROBES = 9 };

static bool is_linear(float out[PROBES][4]) {
  double most = 0, error = 0;
  for (int i = 0; i < PROBES; i++) /* fmax leaves out what is not a number */
    if (!isfinite(out[i][0]) || !isfinite(out[i][1]) || !isfinite(out[i][2]))
      return false;
  for (int c = 0; c < 3; c++) {
    double sum = 0;
    for (int i = 1; i <= 3; i++) {
      sum += (double)out[i][c];
      most = fmax(most, fabs((double)out[i][c]));
      error = fmax(error, fabs((double)out[i][c] / 4 - (double)out[4 + i][c]));
    }
    error = fmax(error, fabs((double)out[0][c]));
    error = fmax(error, fabs(sum - (double)out[4][c]));
    error = fmax(error, fabs(4 * sum - (double)out[8][c]) / 4);
  }
  return error <= LINEAR * most;
}

/* The known primaries that have this matrix from light. */
static const cs_known_primaries *find_known(const double matrix[9]) {
  for (const cs_known_primaries *known = cs_primaries_known; known->name; known++) {
    double of[9], error = 0;
    cs_primaries_from_bt709(known, of);
    for (int i = 0; i < 9; i++)
      error = fmax(error, fabs(of[i] - matrix[i]));
    if (error < SAME)
      return known;
  }
  return NULL;
}

static void set_chromaticity(const double xyz[3], float out[2]) {
  double sum = xyz[0] + xyz[1] + xyz[2];
  out[0] = (float)(xyz[0] / sum);
  out[1] = (float)(xyz[1] / sum);
}

/* The primaries whose matrix from light this is, with the white of BT.709. */
static bool derive(const double matrix[9], float xy[CS_PRIMARIES]) {
  double back[9], own[9], whole[9], unused[9];
  if (!invert(matrix, back) || !to_xyz(cs_primaries_known[0].xy, own))
    return false;
  multiply(own, back, whole);
  for (int c = 0; c < 3; c++)
    set_chromaticity((double[]){whole[c], whole[3 + c], whole[6 + c]}, xy + 2 * c);
  set_chromaticity((double[]){whole[0] + whole[1] + whole[2], whole[3] + whole[4] + whole[5],
                              whole[6] + whole[7] + whole[8]},
                   xy + 6);
  return cs_primaries_to_bt709(xy, unused);
}

bool cs_primaries_of(cs_primaries_convert convert, void *user, float xy[CS_PRIMARIES]) {
  float out[PROBES][4] = {{0, 0, 0, 1},     {1, 0, 0, 1},     {0, 1, 0, 1},
                          {0, 0, 1, 1},     {1, 1, 1, 1},     {0.25F, 0, 0, 1},
                          {0, 0.25F, 0, 1}, {0, 0, 0.25F, 1}, {4, 4, 4, 1}};
  double matrix[9];
  convert(user, out[0], PROBES);
  if (!is_linear(out))
    return false;
  for (int i = 0; i < 9; i++)
    matrix[i] = (double)out[1 + i % 3][i / 3];
  const cs_known_primaries *known = find_known(matrix);
  if (known)
    memcpy(xy, known->xy, sizeof known->xy);
  return known || derive(matrix, xy);
}
