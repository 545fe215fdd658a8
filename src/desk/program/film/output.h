/* What a verb writes: a row of the table in outputs.c for each kind of file, with its formats.
 *
 *   row      which names it has, which verbs make it, what it holds, which options it takes
 *   write    one frame as a file (writers.h); NULL: celspan_frame_write
 *   outlet   all frames as one file, or as standard output (outlets.h)
 *   part     all of it by a file of verbs/, in Lua
 *
 * INVARIANT: where -o leads, and what is refused there, is asked of the row alone. An option is one
 * of outputs if a row takes it; every other row refuses it.
 */
#pragma once

#include "celspan/plane.h"
#include "program/options/request.h"
#include "writers/apart/apart.h"

struct cs_outlet;

typedef enum cs_holds {
  CS_HOLDS_FRAME, /* one frame: several are several files, with a number in the name */
  CS_HOLDS_FILM,  /* all frames */
  CS_HOLDS_EITHER /* one frame under a numbered name, all frames under another */
} cs_holds;

/* A frame, or a plane, that becomes a file. */
typedef struct cs_page {
  const celspan_frame_desc *frame;
  const celspan_plane *plane; /* NULL: the frame */
  const char *path;
  const celspan_file_desc *file;
} cs_page;

/* Lists of words have a space before and after each. */
typedef struct cs_output {
  const char *kind;   /* what it is called in messages and tables, in the plural */
  const char *names;  /* the formats: endings of names; NULL: those of the picture module */
  const char *makers; /* the verbs that make it; NULL: all that write pictures */
  const char *takes;  /* the options of outputs that it takes */
  const char *offers; /* formats in the form of watch: lines of a name and words; or NULL */
  const char *depths, *colours, *alphas; /* the values that it takes; NULL: any */
  cs_holds holds;
  bool asks_files;   /* its part asks which files the script has read */
  bool codes_stills; /* one frame is coded as a film is, too, where it could be a picture */
  /* Only with --layers or --cryptomatte; NULL: without. */
  const cs_apart_format *layers;
  celspan_status (*write)(celspan_context *context, const cs_request *request,
                          const struct cs_output *output, const cs_page *page);
  const struct cs_outlet *outlet;
  const char *part;
  /* Refuses what depends on more than the row. OK, or reported. */
  cs_exit (*refuse)(celspan_context *context, const cs_request *request, const char *path);
} cs_output;

/* Whether a list has a word. */
bool cs_output_lists(const char *list, const char *word);
