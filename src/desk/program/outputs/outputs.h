/* The table of outputs, and what is asked of it: the row of a name, refusals, frames. */
#pragma once

#include "inside/films.h"
#include "program/film/output.h"
#include "program/film/script.h"

/* In the order in which they are searched; the last one has no kind. */
extern const cs_output cs_outputs[];

/* The row of a file that the verb of the request makes. path: NULL: of --hash alone. frames: how
 * many it will hold; 0: that is not known yet. NULL: there is none. */
const cs_output *cs_output_of(const cs_request *request, const char *path, size_t frames);
/* The same for the output of the request itself: -o, or the operand after the input. */
const cs_output *cs_output_own(const cs_request *request);
/* The names of the formats of a row: "svg, pdf"; cut if there is no room for all. */
enum { CS_OUTPUT_NAMES = 160 };
void cs_output_names(const cs_output *output, char out[CS_OUTPUT_NAMES]);
/* Whether such a file holds all frames. */
bool cs_output_is_whole(const cs_output *output, const char *path);
/* OK if the file can be written under the options. Otherwise the reason is reported. */
cs_exit cs_output_refuse(celspan_context *context, const cs_request *request, const char *path,
                         size_t frames);

/* ---- for `render`, and for the commands of `farm` */

/* Refuses wrong requests as far as possible without running the script. */
cs_exit cs_output_refuse_early(celspan_context *context, const cs_request *request);
/* Refuses parts of a frame that the film does not have, and sizes and rates of videos. */
cs_exit cs_output_refuse_film(const cs_script *script, const cs_request *request);

/* The frames of --frames, or all frames; with --task only its share of these, which may be empty.
 * Each frame exists in the film and has its own name in the output, unless the output is NULL. out:
 * new. OK, or reported. */
cs_exit cs_output_frames(const cs_script *script, const cs_request *request, const char *path,
                         cs_sequence *out);
