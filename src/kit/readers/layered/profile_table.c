#include "readers/layered/profile_table.h"

#include <math.h>
#include <string.h>

#include "inside/colour.h"
#include "inside/context.h"
#include "inside/elementary.h"
#include "inside/module.h"

enum { MOST = 65535 };

/* ---------------------------------------------------------------- making */

cs_hash cs_profile_table_hash(const cs_colour_request *request) {
  cs_hash hash = cs_hash_begin(0x70726f66u);
  if (request->bytes)
    cs_hash_bytes(&hash, request->bytes, request->size);
  cs_hash_word(&hash, request->power);
  for (size_t i = 0; request->has_places && i < 8; i++)
    cs_hash_word(&hash, request->places[i]);
  return cs_hash_end(hash);
}

celspan_status cs_profile_table_module(celspan_context *context, const cs_colour_module **out) {
  const void *table = context->root->colour_module;
  if (!table)
    CS_TRY(cs_module_load(context, &cs_modules_colour, CS_COLOUR_MODULE_VERSION, CELSPAN_INPUT,
                          &table));
  *out = table;
  return CELSPAN_OK;
}

static celspan_status fill(celspan_context *context, const cs_input *input,
                           const cs_colour_request *request, cs_colour_table *out) {
  const cs_colour_module *module;
  cs_picture_failure failure;
  if (!CELSPAN_WITH_COLOUR)
    return CELSPAN_OK; /* the form is unknown */
  CS_TRY(cs_profile_table_module(context, &module));
  celspan_status status = module->sample(request, out, &failure);
  if (status == CELSPAN_NO_MEMORY)
    return cs_fail_memory(context);
  return status == CELSPAN_OK
             ? status
             : cs_input_fail(context, input, -1, status, "a colour profile: %s", failure.text);
}

/* Whether all codes stand for the light that a transfer curve gives them, within 0.004. */
static bool has_curve(const cs_colour_table *light, celspan_transfer transfer) {
  for (int i = 0; i <= CS_COLOUR_STEPS; i++) {
    float expected = cs_transfer_decode(transfer, (float)i / CS_COLOUR_STEPS);
    for (int channel = 0; channel < 3; channel++)
      for (int k = 0; k < 3; k++)
        if (fabsf(light->curves[channel][i][k] - (k == channel ? expected : 0)) > 0.004f)
          return false;
  }
  return true;
}

/* The form GRID is the larger one. */
enum { VALUES = sizeof((cs_colour_table *)0)->grid / sizeof(float) };

static bool is_usable(const cs_colour_table *light) {
  const float *values = &light->grid[0][0][0][0];
  for (size_t i = 0; i < VALUES; i++)
    if (!isfinite(values[i]))
      return false;
  return light->form == CS_COLOUR_CURVES || light->form == CS_COLOUR_GRID;
}

static cs_profile_codes codes_of(const cs_colour_table *light) {
  if (!is_usable(light))
    return CS_PROFILE_UNKNOWN;
  if (light->form == CS_COLOUR_GRID)
    return CS_PROFILE_CONVERTED;
  return has_curve(light, CELSPAN_TRANSFER_SRGB)     ? CS_PROFILE_SRGB
         : has_curve(light, CELSPAN_TRANSFER_LINEAR) ? CS_PROFILE_LINEAR
                                                     : CS_PROFILE_CONVERTED;
}

/* ---------------------------------------------------------------- places of a grid */

/* From light in the primaries of sRGB to XYZ, where no colour has negative values, and back.
 * Source: IEC 61966-2-1, F.5. */
static const double to_xyz[3][3] = {
    {0.4124, 0.3576, 0.1805}, {0.2126, 0.7152, 0.0722}, {0.0193, 0.1192, 0.9505}};
static const float from_xyz[3][3] = {{3.2406254773f, -1.5372079722f, -0.4986285987f},
                                     {-0.9689307147f, 1.8757560609f, 0.0415175238f},
                                     {0.0557101204f, -0.2040210506f, 1.0569959423f}};

/* The lightness of CIE Lab, which grows evenly for the eye: a cube root, and a line below LINE.
 * Source: ISO/CIE 11664-4, 4. */
#define LINE (6.0 / 29)

static double code_lightness(double x) {
  return x > LINE * LINE * LINE ? cs_elementary_pow(x, 1.0 / 3) : x / (3 * LINE * LINE) + 4.0 / 29;
}

static float decode_lightness(float code) {
  return code > (float)LINE ? code * code * code
                            : (float)(3 * LINE * LINE) * (code - (float)(4.0 / 29));
}

/* Replaces light by the lightness of XYZ, because colours between places are mixed in this form. */
static void code_grid(cs_colour_table *light) {
  float(*values)[3] = &light->grid[0][0][0];
  for (size_t i = 0; i < VALUES / 3; i++) {
    double codes[3];
    for (int k = 0; k < 3; k++) {
      const double *row = to_xyz[k];
      codes[k] = code_lightness(row[0] * (double)values[i][0] + row[1] * (double)values[i][1] +
                                row[2] * (double)values[i][2]);
    }
    for (int k = 0; k < 3; k++)
      values[i][k] = (float)codes[k];
  }
}

static void decode_grid(float colour[3]) {
  float xyz[3];
  for (int k = 0; k < 3; k++)
    xyz[k] = decode_lightness(colour[k]);
  for (int k = 0; k < 3; k++)
    colour[k] = from_xyz[k][0] * xyz[0] + from_xyz[k][1] * xyz[1] + from_xyz[k][2] * xyz[2];
}

/* ---------------------------------------------------------------- life */

celspan_status cs_profile_table_create(celspan_context *context, const cs_input *input,
                                       const cs_colour_request *request, cs_profile_table **out) {
  cs_profile_table *table;
  CS_TRY(CS_MAKE(context, table, 1));
  atomic_init(&table->references, 1);
  table->memory = context->memory;
  table->hash = cs_profile_table_hash(request);
  celspan_status status = fill(context, input, request, &table->light);
  if (status != CELSPAN_OK) {
    cs_profile_table_unref(table);
    return status;
  }
  table->codes = codes_of(&table->light);
  if (table->codes == CS_PROFILE_CONVERTED && table->light.form == CS_COLOUR_GRID)
    code_grid(&table->light);
  *out = table;
  return CELSPAN_OK;
}

static void destroy(cs_profile_table *table) { cs_mem_free(table->memory, table, sizeof *table); }

CS_COUNTED(cs_profile_table)

/* ---------------------------------------------------------------- converting */

/* The place of a code among points from 0 to `last`: after `point`, by `share` of the way to the
 * next one. */
typedef struct place {
  uint32_t point;
  float share;
} place;

static place place_of(uint32_t code, uint32_t last) {
  uint32_t scaled = code * last;
  return (place){scaled / MOST, (float)(scaled % MOST) / MOST};
}

static void sum_curves(const cs_colour_table *light, const uint32_t codes[3], float out[3]) {
  for (int k = 0; k < 3; k++)
    out[k] = 0;
  for (int channel = 0; channel < 3; channel++) {
    place at = place_of(codes[channel], CS_COLOUR_STEPS);
    const float *low = light->curves[channel][at.point];
    const float *high = at.share > 0 ? low + 3 : low;
    for (int k = 0; k < 3; k++)
      out[k] += low[k] + (high[k] - low[k]) * at.share;
  }
}

/* Tetrahedral interpolation: starts at the corner below, goes first along the axis with the
 * greatest share, then along the axis with the next greatest one. */
static void blend_grid(const cs_colour_table *light, const uint32_t codes[3], float out[3]) {
  static const int strides[] = {3 * CS_COLOUR_SIDE * CS_COLOUR_SIDE, 3 * CS_COLOUR_SIDE, 3};
  const float *corner = &light->grid[0][0][0][0];
  float shares[3];
  int axes[] = {0, 1, 2};
  for (int c = 0; c < 3; c++) {
    place at = place_of(codes[c], CS_COLOUR_SIDE - 1);
    corner += (size_t)at.point * (size_t)strides[c];
    shares[c] = at.share;
  }
  for (int i = 0; i < 3; i++)
    if (shares[axes[i % 2]] < shares[axes[i % 2 + 1]]) {
      int other = axes[i % 2];
      axes[i % 2] = axes[i % 2 + 1];
      axes[i % 2 + 1] = other;
    }
  for (int k = 0; k < 3; k++)
    out[k] = corner[k];
  for (int i = 0; i < 3 && shares[axes[i]] > 0; i++) {
    const float *next = corner + strides[axes[i]];
    for (int k = 0; k < 3; k++)
      out[k] += (next[k] - corner[k]) * shares[axes[i]];
    corner = next;
  }
  decode_grid(out);
}

static uint32_t code_at(const void *codes, int bits, size_t i) {
  return bits == 16 ? ((const uint16_t *)codes)[i] : ((const unsigned char *)codes)[i] * 257u;
}

void cs_profile_table_convert(const cs_profile_table *table, int bits, const void *codes,
                              size_t count, float *out) {
  bool is_grid = table->light.form == CS_COLOUR_GRID;
  for (size_t i = 0; i < count; i++, out += 4) {
    uint32_t pixel[4];
    for (size_t c = 0; c < 4; c++)
      pixel[c] = code_at(codes, bits, 4 * i + c);
    if (is_grid)
      blend_grid(&table->light, pixel, out);
    else
      sum_curves(&table->light, pixel, out);
    out[3] = (float)pixel[3] / MOST;
  }
}
