/* The kinds of values of options, and reading them: from text into a field of C.
 *
 * A reader changes its field only if it returns true. Numbers are read in the C locale, which
 * main() sets for its thread.
 */
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "celspan/celspan.h"

#define CS_SIDE_MAX 1048576

typedef enum cs_progress_style {
  CS_PROGRESS_AUTO = 0,
  CS_PROGRESS_BAR,
  CS_PROGRESS_LINES,
  CS_PROGRESS_NONE,
  CS_PROGRESS_JSON,
  CS_PROGRESS_OPENJD
} cs_progress_style;

/* How a film of another shape goes into a frame. */
typedef enum cs_fit { CS_FIT_STRETCH = 0, CS_FIT_CONTAIN, CS_FIT_COVER } cs_fit;

typedef struct cs_given_antialias {
  celspan_antialias_mode mode;
  celspan_filter_desc filter; /* the filter of mode FILTER */
} cs_given_antialias;

/* What the layers of a file are. */
typedef enum cs_layers { CS_LAYERS_NONE = 0, CS_LAYERS_CELS } cs_layers;

enum { CS_TEXTS_MOST = 48 };

/* The values of an option that may be given several times. */
typedef struct cs_given_texts {
  const char *items[CS_TEXTS_MOST];
  size_t count;
} cs_given_texts;

/* The limits of the processes that decode pictures, of a script, and of rendering what it made. */
typedef enum cs_limit {
  CS_LIMIT_PICTURE_MEMORY, /* bytes */
  CS_LIMIT_PICTURE_TIME,   /* seconds */
  CS_LIMIT_MEMORY,         /* bytes */
  CS_LIMIT_STEPS,
  CS_LIMIT_TIME,          /* seconds */
  CS_LIMIT_PRINT,         /* bytes */
  CS_LIMIT_RENDER_MEMORY, /* bytes */
  CS_LIMIT_COUNT
} cs_limit;

/* Limits that are not given have their defaults. */
typedef struct cs_given_limits {
  bool has[CS_LIMIT_COUNT];
  double values[CS_LIMIT_COUNT]; /* whole numbers, except times */
} cs_given_limits;

/* A kind of value. */
typedef struct cs_argument {
  const char *allowed; /* the allowed values, for messages: "--size: '12' is not ..." */
  bool (*read)(const struct cs_argument *kind, const char *text, void *field);
  double least, most; /* bounds of a number, and of each number in a list */
  char separator;     /* the separator of two numbers or more */
  const struct cs_choice *choices;
} cs_argument;

/* Reads the text into the field. Returns whether it is a value of this kind. */
bool cs_argument_read(const cs_argument *kind, const char *text, void *field);

/* const char *: a text that is not empty */
extern const cs_argument cs_argument_text, cs_argument_file, cs_argument_folder,
    cs_argument_file_or_folder, cs_argument_frames, cs_argument_format, cs_argument_cel,
    cs_argument_codec, cs_argument_colour, cs_argument_pattern, cs_argument_picture,
    cs_argument_setting;
/* const char *: the verb interprets it */
extern const cs_argument cs_argument_colours, cs_argument_lamp, cs_argument_light;
/* int32_t */
extern const cs_argument cs_argument_integer, cs_argument_every, cs_argument_mebibytes,
    cs_argument_minutes, cs_argument_count, cs_argument_pixels, cs_argument_tile,
    cs_argument_workers, cs_argument_port, cs_argument_memory, cs_argument_quality, cs_argument_crf,
    cs_argument_plays, cs_argument_precision;
/* int32_t[2]. Of rows and levels, the first is not greater than the second; of a share, both are
 * also at least 1. */
extern const cs_argument cs_argument_size, cs_argument_grid, cs_argument_onion, cs_argument_share,
    cs_argument_task, cs_argument_rows, cs_argument_levels;
/* int32_t[4]: x, y, width, height */
extern const cs_argument cs_argument_crop;
/* double */
extern const cs_argument cs_argument_rate, cs_argument_millions, cs_argument_scale,
    cs_argument_tolerance, cs_argument_smooth, cs_argument_loudness;
/* The enumeration of the name: celspan_depth, celspan_alpha, cs_pyramid_layout,
 * cs_progress_style, cs_fit, cs_layers, cs_flat; for the model of a track, a number. */
extern const cs_argument cs_argument_depth, cs_argument_alpha, cs_argument_layout,
    cs_argument_progress, cs_argument_fit, cs_argument_layers, cs_argument_mattes,
    cs_argument_model, cs_argument_flat;
extern const cs_argument cs_argument_antialias; /* cs_given_antialias */
extern const cs_argument cs_argument_tint;      /* float[3]: linear light, opaque */
extern const cs_argument cs_argument_texts;     /* cs_given_texts: adds a folder */
extern const cs_argument cs_argument_bytes;     /* double: a size such as 512M, at least 1M */
/* cs_given_limits: adds "memory=512M,steps=2e9,time=60,print=1M,render-memory=8G,picture-memory=1G,
 * picture-time=20"; the other kind accepts only the limits of pictures. */
extern const cs_argument cs_argument_limits, cs_argument_picture_limits;

/* Which task of a farm's array this process is, as the farm says in the environment. task: the
 * number of the task, from 1, and how many there are. count: how many; 0: the farm must
 * say it. Returns false, without a change, unless a farm's array has set its variables. Threads: no
 * other thread changes the environment. */
bool cs_task_find(int32_t count, int32_t task[2]);
