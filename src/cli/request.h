/* The options of every verb: one table drives parsing, the help text and the nearest name that is
 * suggested for a misspelt option.
 */
#ifndef CS_CLI_REQUEST_H
#define CS_CLI_REQUEST_H

#include <stdio.h>

#include "celspan/celspan.h"
#include "cli/argument.h"
#include "cli/report.h"

#define CS_OPERANDS_MAX 1024

/* An option as it was given. */
typedef struct cs_passed {
  const char *name, *value; /* value NULL: a flag */
} cs_passed;

enum { CS_PASSED_MOST = 128 };

typedef struct cs_request {
  const char *operands[CS_OPERANDS_MAX]; /* borrowed from argv, as are all texts here */
  size_t operand_count;
  char *const *script_arguments; /* what follows -- */
  size_t script_argument_count;
  const char *output, *format, *frames; /* NULL: not given */
  cs_given_integer frame;
  int32_t size[2];           /* 0 0: not given */
  double scale;              /* 0: not given */
  int32_t crop[4];           /* width 0: not given */
  int32_t strip[2], task[2]; /* number from 1, count; 0 0: not given */
  int32_t rows[2];           /* first and last, both included; last -1: not given */
  cs_given_antialias antialias;
  celspan_coding coding;
  bool dithers;
  cs_given_integer quality; /* of a video, 0..100 */
  const char *cel;          /* NULL: not given */
  cs_given_colour background;
  int32_t workers;         /* 0: one a processor */
  cs_given_integer memory; /* MiB; 0: nothing is kept from frame to frame */
  cs_progress_style progress;
  bool hash, statistics;
  bool resumes, is_forced, keeps_going;
  bool is_deep;
  celspan_depth pixels; /* DEFAULT: not given */
  double tolerance;
  cs_pyramid_layout layout;
  const char *picture, *viewer, *places; /* NULL: not given */
  cs_given_integer tile, overlap, tile_limit;
  int32_t levels[2]; /* first and last, both included; last -1: not given */
  bool skips_empty, is_fresh;
  const char *only;       /* NULL: not given */
  int32_t grid[2];        /* columns and rows; 0 0: not given */
  cs_given_integer every; /* 1 or more */
  int32_t onion[2];       /* frames before and after; both 0: not given */
  bool trusts, is_strict;
  bool makes_folder;      /* the output is one */
  cs_given_texts allowed; /* folders */
  cs_given_limits limits;
  cs_given_colours colours;
  double smooth;            /* below 0: not given */
  cs_given_integer speckle; /* pixels */
  bool lines;
  cs_given_integer from; /* the frame in which `at` is */
  int32_t at[4];         /* x, y, width, height; width 0: not given */
  const char *model;     /* NULL: not given */
  bool slurm, openjd;
  cs_given_integer chunk, strips;             /* frames of a task; strips of a frame */
  cs_given_integer task_memory, task_minutes; /* MiB */
  const char *name, *logs;                    /* of a job; NULL: not given */
  cs_passed passed[CS_PASSED_MOST];           /* of a farm's job: what its tasks are given */
  size_t passed_count;
  cs_given_light light, to;
} cs_request;

typedef enum cs_verb_set {
  CS_VERB_RENDER = 1 << 0,
  CS_VERB_INFO = 1 << 1,
  CS_VERB_CHECK = 1 << 2,
  CS_VERB_SPANS = 1 << 3,
  CS_VERB_PROBE = 1 << 4,
  CS_VERB_CONVERT = 1 << 5,
  CS_VERB_COMPARE = 1 << 6,
  CS_VERB_TILES = 1 << 7,
  CS_VERB_SHEET = 1 << 8,
  CS_VERB_TEST = 1 << 9,
  CS_VERB_INIT = 1 << 10,
  CS_VERB_CONTACT = 1 << 11,
  CS_VERB_TRACE = 1 << 12,
  CS_VERB_TRACK = 1 << 13,
  CS_VERB_JOIN = 1 << 14,
  CS_VERB_FARM = 1 << 15,
  CS_VERB_RELIGHT = 1 << 16,
  CS_VERBS_WITH_SCRIPT = CS_VERB_RENDER | CS_VERB_INFO | CS_VERB_CHECK | CS_VERB_SPANS |
                         CS_VERB_PROBE | CS_VERB_TILES | CS_VERB_SHEET | CS_VERB_CONTACT |
                         CS_VERB_FARM,
  CS_VERBS_WITH_PICTURES =
      CS_VERB_CONVERT | CS_VERB_COMPARE | CS_VERB_TRACE | CS_VERB_TRACK | CS_VERB_RELIGHT
} cs_verb_set;

typedef struct cs_verb {
  cs_verb_set self; /* one bit */
  const char *name;
  const char *operands; /* as the help shows them */
  size_t operand_least, operand_most;
  const char *summary; /* one line */
  const char *notes;   /* more help, whole lines, or NULL */
  cs_exit (*run)(celspan_context *context, const cs_request *request);
} cs_verb;

/* arguments: what follows the verb. OK, or reported and CS_EXIT_USAGE. */
cs_exit cs_request_parse(const cs_verb *verb, size_t count, char *const *arguments,
                         cs_request *out);
/* Calls `call` for each option of a verb. value: NULL for a flag. */
void cs_request_list(const cs_verb *verb,
                     void (*call)(void *user, const char *name, const char *value,
                                  const char *help),
                     void *user);
/* Usage, summary and all options of a verb. */
void cs_request_help(const cs_verb *verb, FILE *stream);

#endif
