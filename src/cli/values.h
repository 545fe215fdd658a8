/* Reading the values of options: text to a field, one function a kind of value.
 *
 * A reader changes its field only when it answers READ. Numbers are read in the C locale, which
 * main() sets for its thread.
 */
#ifndef CS_CLI_VALUES_H
#define CS_CLI_VALUES_H

#include <stdbool.h>
#include <stdint.h>

#include "celspan/celspan.h"

#define CS_SIDE_MAX 1048576

typedef enum cs_value_outcome {
  CS_VALUE_READ = 0,
  CS_VALUE_BAD
} cs_value_outcome;

typedef cs_value_outcome (*cs_value_reader)(const char *text, void *field);

typedef enum cs_progress_style {
  CS_PROGRESS_AUTO = 0,
  CS_PROGRESS_BAR,
  CS_PROGRESS_LINES,
  CS_PROGRESS_NONE,
  CS_PROGRESS_JSON,
  CS_PROGRESS_OPENJD
} cs_progress_style;

typedef struct cs_given_antialias {
  bool is_given;
  celspan_antialias_mode mode;
  celspan_filter_desc filter;
} cs_given_antialias;

typedef struct cs_given_integer {
  bool is_given;
  int32_t value;
} cs_given_integer;

cs_value_outcome cs_value_text(const char *text, void *field);      /* const char * */
cs_value_outcome cs_value_integer(const char *text, void *field);   /* cs_given_integer */
cs_value_outcome cs_value_workers(const char *text, void *field);   /* int32_t, 1..1024 */
cs_value_outcome cs_value_memory(const char *text, void *field);    /* cs_given_integer, 0..1048576 */
cs_value_outcome cs_value_number(const char *text, void *field);    /* double, finite */
cs_value_outcome cs_value_scale(const char *text, void *field);     /* double, above 0 */
cs_value_outcome cs_value_tolerance(const char *text, void *field); /* double, 0 or more */
cs_value_outcome cs_value_size(const char *text, void *field);      /* int32_t[2] */
cs_value_outcome cs_value_crop(const char *text, void *field);      /* int32_t[4] */
cs_value_outcome cs_value_rows(const char *text, void *field);      /* int32_t[2], inclusive */
cs_value_outcome cs_value_antialias(const char *text, void *field); /* cs_given_antialias */
cs_value_outcome cs_value_depth(const char *text, void *field);     /* celspan_depth */
cs_value_outcome cs_value_colour(const char *text, void *field);    /* celspan_transfer */
cs_value_outcome cs_value_alpha(const char *text, void *field);     /* celspan_alpha */
cs_value_outcome cs_value_count(const char *text, void *field);     /* cs_given_integer, 0.. */
cs_value_outcome cs_value_layout(const char *text, void *field);    /* cs_pyramid_layout */
cs_value_outcome cs_value_progress(const char *text, void *field);  /* cs_progress_style */

#endif
