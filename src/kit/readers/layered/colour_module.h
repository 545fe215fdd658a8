/* The interface of the colour module (src/kit/plugins/icc, over Little CMS): colour profiles as
 * tables of numbers.
 *
 *   ICC profile --module: sample--> table --reader--> light of each pixel
 *
 * A table has one of two forms, with red, green and blue codes r, g and b of 0 to 1:
 *
 *   CURVES   light = curves[0](r) + curves[1](g) + curves[2](b), three values each: profiles of
 *            primaries and tone curves, and those of grey
 *   GRID     light at 33 x 33 x 33 places: all others
 *
 * Light is linear, in the primaries of sRGB with white at 1; colours beyond those primaries have
 * values below 0 or above 1.
 *
 * INVARIANT: no memory changes its owner, nothing outside the bytes is read, and every failure
 * comes with a sentence.
 */
#pragma once

#include "inside/pictures.h"

#define CS_COLOUR_MODULE_VERSION 1u

enum {
  CS_COLOUR_STEPS = 16 * 255, /* from code 0 to code 1: codes of 8 bits are points of a curve */
  CS_COLOUR_SIDE = 33
};

typedef enum cs_colour_form {
  CS_COLOUR_UNKNOWN = 0, /* a damaged profile, or not one of RGB or grey */
  CS_COLOUR_CURVES,
  CS_COLOUR_GRID
} cs_colour_form;

typedef struct cs_colour_table {
  int32_t form; /* cs_colour_form */
  /* Of the profile: printable ASCII; "": not known. Also where the form is UNKNOWN. */
  char name[64];
  union {
    float curves[3][CS_COLOUR_STEPS + 1][3];
    float grid[CS_COLOUR_SIDE][CS_COLOUR_SIDE][CS_COLOUR_SIDE][3]; /* by red, green, blue */
  };
} cs_colour_table;

/* A profile, or the values of the gAMA and cHRM chunks of a PNG instead of one. */
typedef struct cs_colour_request {
  const void *bytes; /* an ICC profile; NULL: the fields below */
  size_t size;
  uint32_t power;     /* the code is light^(power / 100,000); above 0 */
  bool has_places;    /* false: the primaries of sRGB */
  uint32_t places[8]; /* x and y of white, red, green and blue, in 1/100,000 */
} cs_colour_request;

typedef struct cs_colour_module {
  uint32_t version;
  /* Errors: NO_MEMORY; the table of a profile that cannot be used has the form UNKNOWN. If another
   * process does the work, also INPUT, LIMIT and CANCELLED. Any thread. */
  celspan_status (*sample)(const cs_colour_request *request, cs_colour_table *out,
                           cs_picture_failure *failure);
} cs_colour_module;

/* The module's one symbol. */
CELSPAN_API const void *celspan_colour_module(void);
