/* Reading the values of options: from text into a field, one function for each kind of value.
 *
 * A reader changes its field only when it answers READ. Numbers are read in the C locale, which
 * main() sets for its thread.
 */
#ifndef CS_CLI_ARGUMENT_H
#define CS_CLI_ARGUMENT_H

#include <stdbool.h>
#include <stdint.h>

#include "celspan/celspan.h"
#include "sandbox/guard.h"

#define CS_SIDE_MAX 1048576

typedef enum cs_argument_outcome { CS_ARGUMENT_READ = 0, CS_ARGUMENT_BAD } cs_argument_outcome;

typedef cs_argument_outcome (*cs_argument_reader)(const char *text, void *field);

typedef enum cs_progress_style {
  CS_PROGRESS_AUTO = 0,
  CS_PROGRESS_BAR,
  CS_PROGRESS_LINES,
  CS_PROGRESS_NONE,
  CS_PROGRESS_JSON,
  CS_PROGRESS_OPENJD
} cs_progress_style;

typedef enum cs_pyramid_layout { CS_PYRAMID_DZI = 0, CS_PYRAMID_IIIF } cs_pyramid_layout;

typedef struct cs_given_antialias {
  bool is_given;
  celspan_antialias_mode mode;
  celspan_filter_desc filter;
} cs_given_antialias;

typedef struct cs_given_integer {
  bool is_given;
  int32_t value;
} cs_given_integer;

enum { CS_TEXTS_MOST = 48 };

/* Of an option that may be given several times. */
typedef struct cs_given_texts {
  const char *items[CS_TEXTS_MOST];
  size_t count;
} cs_given_texts;

/* The limits of a script, and of the processes that decode pictures; those that are not given have
 * their defaults. */
typedef struct cs_given_limits {
  bool has_memory, has_steps, has_time, has_print, has_picture_memory, has_picture_time;
  cs_limits values;
  uint64_t picture_memory; /* bytes */
  double picture_seconds;
} cs_given_limits;

/* "#rgb" or "#rrggbb": linear light, opaque. */
typedef struct cs_given_colour {
  bool is_given;
  float rgb[3];
} cs_given_colour;

/* A light: a colour as above or "r,g,b" in linear light, each above 0; or one to be estimated. */
typedef struct cs_given_light {
  bool is_given;
  bool is_grey; /* it is to be estimated: the mean of the picture is grey */
  float rgb[3];
} cs_given_light;

/* How many colours, or which. */
typedef struct cs_given_colours {
  int32_t count; /* 0: not given */
  bool has_codes;
  unsigned char codes[3 * 64]; /* sRGB */
} cs_given_colours;

cs_argument_outcome cs_argument_text(const char *text, void *field);    /* const char * */
cs_argument_outcome cs_argument_integer(const char *text, void *field); /* cs_given_integer */
cs_argument_outcome cs_argument_workers(const char *text, void *field); /* int32_t, 1..1024 */
cs_argument_outcome cs_argument_memory(const char *text,
                                       void *field); /* cs_given_integer, 0..1048576 */
cs_argument_outcome cs_argument_quality(const char *text,
                                        void *field); /* cs_given_integer, 0..100 */
cs_argument_outcome cs_argument_number(const char *text, void *field);    /* double, finite */
cs_argument_outcome cs_argument_scale(const char *text, void *field);     /* double, above 0 */
cs_argument_outcome cs_argument_tolerance(const char *text, void *field); /* double, 0 or more */
cs_argument_outcome cs_argument_size(const char *text, void *field);      /* int32_t[2] */
cs_argument_outcome cs_argument_crop(const char *text, void *field);      /* int32_t[4] */
cs_argument_outcome cs_argument_rows(const char *text, void *field); /* int32_t[2], inclusive */
cs_argument_outcome cs_argument_antialias(const char *text, void *field); /* cs_given_antialias */
cs_argument_outcome cs_argument_depth(const char *text, void *field);     /* celspan_depth */
cs_argument_outcome cs_argument_colour(const char *text, void *field);    /* celspan_transfer */
cs_argument_outcome cs_argument_alpha(const char *text, void *field);     /* celspan_alpha */
cs_argument_outcome cs_argument_count(const char *text, void *field);  /* cs_given_integer, 0.. */
cs_argument_outcome cs_argument_every(const char *text, void *field);  /* cs_given_integer, 1.. */
cs_argument_outcome cs_argument_grid(const char *text, void *field);   /* int32_t[2], 1..100 */
cs_argument_outcome cs_argument_share(const char *text, void *field);  /* int32_t[2]: "3/24" */
cs_argument_outcome cs_argument_onion(const char *text, void *field);  /* int32_t[2], 0..16 */
cs_argument_outcome cs_argument_layout(const char *text, void *field); /* cs_pyramid_layout */
cs_argument_outcome cs_argument_tint(const char *text, void *field);   /* cs_given_colour */
cs_argument_outcome cs_argument_lamp(const char *text, void *field);   /* cs_given_light */
/* cs_given_light: a colour alone, and channels may be 0 */
cs_argument_outcome cs_argument_light(const char *text, void *field);
cs_argument_outcome cs_argument_colours(const char *text, void *field); /* cs_given_colours */
cs_argument_outcome cs_argument_smooth(const char *text, void *field);  /* double, 0..16 */
cs_argument_outcome cs_argument_model(const char *text, void *field); /* const char *, of a track */
cs_argument_outcome cs_argument_progress(const char *text, void *field); /* cs_progress_style */
cs_argument_outcome cs_argument_texts(const char *text, void *field);    /* cs_given_texts: adds */
/* cs_given_limits: adds "memory=512M,steps=2e9,time=60,print=1M,picture-memory=1G,picture-time=20" */
cs_argument_outcome cs_argument_limits(const char *text, void *field);
/* The same, but those of pictures alone. */
cs_argument_outcome cs_argument_picture_limits(const char *text, void *field);

#endif
