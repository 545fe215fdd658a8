#include "program/outputs/outputs.h"

#include <ctype.h>
#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

#include "inside/sinks.h"
#include "program/film/view.h"
#include "program/outputs/outlets.h"
#include "program/outputs/target.h"
#include "program/outputs/video_target.h"
#include "program/outputs/writers.h"

enum { NAME_SIZE = 16, LIST_SIZE = 1024 };

/* ---------------------------------------------------------------- the table */

static cs_exit refuse_picture(celspan_context *context, const cs_request *request,
                              const char *path);

#define NO_FILE " --hash "
#define SCENE " --background --cel --onion --ocio --report "
#define SIZES SCENE "--size --scale "
#define VIEW SIZES "--fit --draft --crop --antialias "
#define COLOURS " --colour --display --view --alpha "
#define DITHERS " --dither --no-dither "
#define RUNS " --resume --force --keep-going "
#define FILES RUNS "--format --task "
#define VIDEO                                                                                      \
  VIEW COLOURS DITHERS RUNS                                                                        \
      "--format --hash --depth --codec --quality --crf --fps --max-size --loudness "
#define DIGITS " 8 or 16 "
#define SHOWN " srgb or rec709, or a space of --ocio "
#define RENDER " render farm "
#define DRAW " render convert "
#define FILM " render farm convert "

#define VIDEOS(list, more, coded, form)                                                            \
  {                                                                                                \
    .kind = "videos", .names = list, .makers = FILM, .takes = VIDEO more, .depths = DIGITS,        \
    .offers = form, .colours = SHOWN, .holds = CS_HOLDS_FILM, .codes_stills = coded,               \
    .outlet = &cs_outlet_video, .refuse = cs_video_target_refuse                                   \
  }
#define PAINTINGS(list, format)                                                                    \
  {                                                                                                \
    .kind = "files with layers", .names = list, .makers = RENDER,                                  \
    .takes = VIEW FILES "--depth --colour --alpha --no-dither --layers ", .depths = DIGITS,        \
    .colours = " srgb ", .alphas = " straight ", .layers = format, .write = cs_write_layers        \
  }

const cs_output cs_outputs[] = {
    {.kind = "raw frames",
     .names = " - ",
     .makers = " render ",
     .takes = VIEW COLOURS DITHERS "--depth --keep-going ",
     .outlet = &cs_outlet_raw},
    {.kind = "digests",
     .names = NO_FILE,
     .makers = " render ",
     .takes = VIEW COLOURS DITHERS "--depth --hash --strip --format --task --keep-going "},
    VIDEOS(" mp4 mkv mov webm ", "", true,
           "mp4 MP4 video (H.264)\n"
           "mkv Matroska video (H.264)\n"
           "webm WebM video, with alpha\n"
           "mov ProRes video, with alpha\n"),
    VIDEOS(" gif webp apng ", "--loop ", false,
           "gif GIF\n"
           "webp animated WebP\n"
           "apng animated PNG\n"),
    VIDEOS(" avif ", "--loop ", true, "avif animated AVIF\n"),
    {.kind = "files with layers",
     .names = " exr openexr ",
     .makers = RENDER,
     .takes = VIEW FILES DITHERS "--depth --colour --alpha --layers --cryptomatte ",
     .colours = " linear ",
     .layers = &cs_apart_exr,
     .write = cs_write_layers,
     .refuse = refuse_picture},
    {.kind = "files with layers",
     .names = " png ",
     .makers = RENDER,
     .takes = VIEW FILES COLOURS DITHERS "--depth --layers ",
     .layers = &cs_apart_png,
     .write = cs_write_layers,
     .refuse = refuse_picture},
    PAINTINGS(" ora ", &cs_apart_ora),
    PAINTINGS(" psd ", &cs_apart_psd),
    {.kind = "pictures",
     .names = " png tga targa span ",
     .offers = "png PNG pictures\n",
     .takes = VIEW COLOURS DITHERS FILES "--depth --hash --strip ",
     .refuse = refuse_picture},
    {.kind = "pictures",
     .takes = VIEW COLOURS DITHERS FILES "--depth --hash ",
     .offers = "exr EXR pictures\n",
     .refuse = refuse_picture},
    {.kind = "planes",
     .names = " plane ",
     .takes = SCENE FILES "--depth ",
     .depths = DIGITS,
     .holds = CS_HOLDS_EITHER,
     .write = cs_write_plane,
     .outlet = &cs_outlet_plane},
    {.kind = "drawings",
     .names = " svg ",
     .makers = DRAW,
     .takes = SIZES "--format --task --keep-going --flat --precision ",
     .write = cs_write_svg},
    {.kind = "drawings",
     .names = " pdf ",
     .makers = DRAW,
     .takes = SIZES "--format --task --keep-going --flat ",
     .holds = CS_HOLDS_EITHER,
     .write = cs_write_pdf,
     .outlet = &cs_outlet_pages},
    {.kind = "Lottie animations",
     .names = " json lottie ",
     .makers = " render ",
     .takes = " --scale ",
     .holds = CS_HOLDS_FILM,
     .codes_stills = true,
     .part = "lottie.lua"},
    {.kind = "graphics for broadcast",
     .names = " ograf ",
     .makers = " render ",
     .takes = " --engine ",
     .holds = CS_HOLDS_FILM,
     .asks_files = true,
     .codes_stills = true,
     .part = "ograf.lua"},
    {.kind = "sounds",
     .names = " wav ",
     .makers = " sound ",
     .takes = " --depth --loudness --stems --resume --keep-going ",
     .depths = " 16 or float "},
    {.kind = NULL}};

/* ---------------------------------------------------------------- the row of a name */

/* The name of a format, in small letters; "": the path has no ending. That of a folder may end with
 * a slash. */
static void name_of(const cs_request *request, const char *path, char out[NAME_SIZE]) {
  const char *format = cs_request_text(request, "--format");
  const char *name = !path                    ? "--hash"
                     : strcmp(path, "-") == 0 ? "-"
                     : format                 ? format
                                              : cs_file_ending(path);
  size_t size = path ? strlen(path) : 0, end = size;
  while (end > 0 && path[end - 1] == '/')
    end--;
  if (end < size && end >= 6 && strncasecmp(path + end - 6, ".ograf", 6) == 0)
    name = "ograf";
  snprintf(out, NAME_SIZE, "%s", name);
  for (char *at = out; *at; at++)
    *at = (char)tolower((unsigned char)*at);
}

/* Whether a picture has the name. Without an ending, the sink says what is missing. */
static bool is_picture(const char *name) {
  celspan_file_desc file = CELSPAN_FILE_DESC;
  file.format = name;
  return !name[0] || cs_sink_file_knows("", &file);
}

static bool is_made(const cs_output *output, const cs_request *request) {
  bool is_apart = cs_request_has(request, "--layers") || cs_request_has(request, "--cryptomatte");
  return (!output->makers || cs_output_lists(output->makers, request->verb->name)) &&
         (is_apart || !output->layers);
}

/* Whether a name that could be a picture's is the name of a film. */
static bool is_film(const cs_output *output, const char *path, size_t frames) {
  return !cs_sequence_has_number(path) && (frames != 1 || output->codes_stills);
}

static bool is_named(const cs_output *output, const char *name) {
  return output->names ? cs_output_lists(output->names, name) : is_picture(name);
}

const cs_output *cs_output_of(const cs_request *request, const char *path, size_t frames) {
  char name[NAME_SIZE];
  name_of(request, path, name);
  for (const cs_output *output = cs_outputs; output->kind; output++)
    if (is_named(output, name) && is_made(output, request) &&
        (output->holds != CS_HOLDS_FILM || !is_picture(name) || is_film(output, path, frames)))
      return output;
  return NULL;
}

const cs_output *cs_output_own(const cs_request *request) {
  const char *path = cs_request_text(request, "-o");
  return cs_output_of(request, path || request->operand_count < 2 ? path : request->operands[1], 0);
}

bool cs_output_is_whole(const cs_output *output, const char *path) {
  return output->holds == CS_HOLDS_FILM ||
         (output->holds == CS_HOLDS_EITHER && !cs_sequence_has_number(path));
}

/* ---------------------------------------------------------------- sentences */

typedef struct sentence {
  char text[LIST_SIZE];
  size_t length;
} sentence;

static void add(sentence *out, const char *format, ...) __attribute__((format(printf, 2, 3)));
static void add(sentence *out, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  if (out->length < LIST_SIZE)
    out->length +=
        (size_t)vsnprintf(out->text + out->length, LIST_SIZE - out->length, format, arguments);
  va_end(arguments);
}

void cs_output_names(const cs_output *output, char out[CS_OUTPUT_NAMES]) {
  size_t length = 0;
  if (!output->names) {
    cs_sink_picture_list(out, CS_OUTPUT_NAMES);
    return;
  }
  for (const char *at = output->names + 1; *at; at++) {
    if (*at == ' ' && at[1])
      out[length++] = ',';
    if (*at != ' ' || at[1])
      out[length++] = *at;
  }
  out[length] = '\0';
}

/* Which rows of files are listed: those that take an option, or those that a verb makes or that it
 * does not make. */
typedef struct wanted {
  const char *option, *verb; /* NULL: any */
  bool is_made;
} wanted;

static bool is_wanted(const cs_output *output, const wanted *rows) {
  bool is_file = !output->names || strcmp(output->names, NO_FILE) != 0;
  bool is_taken = !rows->option || cs_output_lists(output->takes, rows->option);
  bool is_made = !rows->verb || !output->makers || cs_output_lists(output->makers, rows->verb);
  return is_file && is_taken && is_made == rows->is_made;
}

/* Lists rows by their kind: "videos (mp4, webm), drawings (svg)". */
static void list_rows(wanted rows, sentence *out) {
  const char *kind = "";
  char names[CS_OUTPUT_NAMES];
  *out = (sentence){.length = 0};
  for (const cs_output *output = cs_outputs; output->kind; output++) {
    if (!is_wanted(output, &rows))
      continue;
    cs_output_names(output, names);
    if (strcmp(kind, output->kind) == 0)
      add(out, ", %s", names);
    else
      add(out, "%s%s (%s", kind[0] ? "), " : "", output->kind, names);
    kind = output->kind;
  }
  add(out, "%s", kind[0] ? ")" : "");
}

/* ---------------------------------------------------------------- refusals */

/* A request whose options are compared with a row. */
typedef struct comparison {
  const cs_request *request;
  const cs_output *output;
  const char *path; /* for messages */
  char name[NAME_SIZE];
  cs_exit outcome;
} comparison;

/* "png", "png with layers" */
static const char *subject_of(const comparison *c, char out[40]) {
  const char *name = strcmp(c->name, "-") == 0       ? "standard output"
                     : strcmp(c->path, c->name) == 0 ? "--hash alone"
                     : c->name[0]                    ? c->name
                                                     : "a picture";
  snprintf(out, 40, "%s%s", name, c->output->layers ? " with layers" : "");
  return out;
}

static bool is_of_outputs(const char *option) {
  const cs_output *output = cs_outputs;
  while (output->kind && !cs_output_lists(output->takes, option))
    output++;
  return output->kind != NULL;
}

static void compare_option(void *user, const char *option, const char *value) {
  comparison *c = user;
  sentence takers;
  char subject[40];
  (void)value;
  if (c->outcome != CS_EXIT_OK || cs_output_lists(c->output->takes, option) ||
      !is_of_outputs(option))
    return;
  list_rows((wanted){.option = option, .is_made = true}, &takers);
  c->outcome = cs_report_usage("%s: %s takes no %s: leave it out; it is only for %s", c->path,
                               subject_of(c, subject), option, takers.text);
}

static cs_exit refuse_value(const comparison *c, const char *option, const char *allowed) {
  const char *value = cs_request_text(c->request, option);
  char subject[40];
  if (!value || !allowed || cs_output_lists(allowed, value) ||
      (c->request->spaces && cs_output_lists(allowed, "--ocio")))
    return CS_EXIT_OK;
  return cs_report_usage("%s: %s takes %s%.*s, and not %s", c->path, subject_of(c, subject), option,
                         (int)strlen(allowed) - 1, allowed, value);
}

/* Makes a sink and discards it: a sink opens no file before its first row. */
static cs_exit refuse_picture(celspan_context *context, const cs_request *request,
                              const char *path) {
  celspan_coding coding;
  celspan_file_desc file = cs_target_file(request, &coding);
  celspan_sink sink = CELSPAN_SINK;
  celspan_status status = celspan_file_sink_create(context, path, &file, &sink);
  if (status == CELSPAN_BAD_ARGUMENT)
    return cs_report_usage("%s", celspan_context_error(context));
  if (status == CELSPAN_OK)
    cs_sink_discard(context, &sink);
  return cs_report_failure(context, status, NULL);
}

/* The format is not known, or other verbs make it. */
static cs_exit refuse_name(const cs_request *request, const char *path) {
  const char *verb = request->verb->name;
  const cs_output *other = cs_outputs;
  char name[NAME_SIZE];
  sentence makes, others;
  name_of(request, path, name);
  list_rows((wanted){.verb = verb, .is_made = true}, &makes);
  list_rows((wanted){.verb = verb}, &others);
  while (other->kind && !is_named(other, name))
    other++;
  if (other->kind && other->layers)
    return cs_report_usage("%s: the format \"%s\" cannot be written without layers: give --layers "
                           "cels to 'celspan render'",
                           path, name);
  if (other->kind)
    return cs_report_usage("%s: %s is for %s, which 'celspan %s' makes; 'celspan %s' makes %s",
                           path, name, other->kind,
                           cs_output_lists(other->makers, "sound") ? "sound" : "render", verb,
                           makes.text);
  return cs_report_usage("%s: the format \"%s\" cannot be written; 'celspan %s' makes %s; other "
                         "verbs make %s",
                         path, name, verb, makes.text, others.text);
}

/* Refuses what a file of all frames cannot be made with. */
static cs_exit refuse_whole(const comparison *c, bool is_sure) {
  static const char *const options[] = {"--strip", "--task", "--keep-going"};
  if (c->output->holds == CS_HOLDS_FILM && cs_sequence_has_number(c->path))
    return cs_report_usage("%s: one %s file holds all frames: leave the frame's number out of its "
                           "name",
                           c->path, c->name);
  for (size_t i = 0; i < (is_sure ? 3 : 2); i++)
    if (cs_request_has(c->request, options[i]))
      return cs_report_usage("%s: one %s file holds all frames, and is made in one run: leave %s "
                             "out, or render shot.####.%s",
                             c->path, c->name, options[i],
                             c->output->holds == CS_HOLDS_FILM ? "png" : c->name);
  return CS_EXIT_OK;
}

cs_exit cs_output_refuse(celspan_context *context, const cs_request *request, const char *path,
                         size_t frames) {
  comparison c = {.request = request, .path = path ? path : "--hash"};
  c.output = cs_output_of(request, path, frames);
  if (!c.output)
    return refuse_name(request, path);
  name_of(request, path, c.name);
  bool is_sure = frames > 0 || c.output->holds != CS_HOLDS_FILM || !is_picture(c.name);
  if (cs_output_is_whole(c.output, c.path))
    CS_TRY_EXIT(refuse_whole(&c, is_sure));
  if (!is_sure)
    return CS_EXIT_OK;
  cs_request_each(request, compare_option, &c);
  CS_TRY_EXIT(c.outcome);
  CS_TRY_EXIT(refuse_value(&c, "--depth", c.output->depths));
  CS_TRY_EXIT(refuse_value(&c, "--colour", c.output->colours));
  CS_TRY_EXIT(refuse_value(&c, "--alpha", c.output->alphas));
  return c.output->refuse ? c.output->refuse(context, request, path) : CS_EXIT_OK;
}

/* ---------------------------------------------------------------- render */

static cs_exit refuse_dither(const cs_request *request) {
  celspan_depth depth = CELSPAN_DEPTH_8;
  cs_request_read(request, "--depth", &depth);
  if (cs_request_has(request, "--dither") && cs_request_has(request, "--no-dither"))
    return cs_report_usage("--dither and --no-dither exclude each other: give one of them");
  return cs_request_has(request, "--dither") && depth != CELSPAN_DEPTH_8
             ? cs_report_usage("--dither makes 8 bits: leave --depth out, or give --depth 8")
             : CS_EXIT_OK;
}

cs_exit cs_output_refuse_early(celspan_context *context, const cs_request *request) {
  const char *path = cs_request_text(request, "-o");
  cs_progress_style style = CS_PROGRESS_AUTO;
  cs_request_read(request, "--progress", &style);
  if (!path && !cs_request_has(request, "--hash"))
    return cs_report_usage("-o is missing: give -o film.mp4 for a video, -o shot.####.png for "
                           "pictures, or --hash for digests only");
  if (cs_request_has(request, "--force") && !cs_request_has(request, "--resume"))
    return cs_report_usage("--force needs --resume");
  CS_TRY_EXIT(refuse_dither(request));
  if (path && strcmp(path, "-") == 0 && style == CS_PROGRESS_OPENJD)
    return cs_report_usage("--progress openjd prints to standard output, where -o - puts the "
                           "frames: give one of them");
  return cs_output_refuse(context, request, path, 0);
}

cs_exit cs_output_refuse_film(const cs_script *script, const cs_request *request) {
  const cs_film_info *film = &script->film;
  celspan_frame_desc frame;
  const cs_output *output =
      cs_output_of(request, cs_request_text(request, "-o"), (size_t)film->count);
  CS_TRY_EXIT(cs_view_frame(request, film->width, film->height, &frame));
  return output && output->outlet == &cs_outlet_video
             ? cs_video_target_refuse_frames(script, request, &frame)
             : CS_EXIT_OK;
}

/* ---------------------------------------------------------------- frames */

static celspan_status list_frames(const cs_script *script, const cs_request *request,
                                  cs_sequence *out) {
  const cs_film_info *film = &script->film;
  const char *list = cs_request_text(request, "--frames");
  if (!list)
    return cs_sequence_count(script->context, film->first, film->count, out);
  celspan_status status = cs_sequence_parse(script->context, list, film, out);
  if (status == CELSPAN_OK)
    status = cs_sequence_within(script->context, out, film->first, film->count);
  return status;
}

/* Keeps only the frames of the request's task. The numbers of frames of two tasks differ by at most
 * one. */
static void take_task(const cs_request *request, cs_sequence *frames) {
  int32_t task[2];
  if (!cs_request_read(request, "--task", task))
    return;
  size_t count = frames->count, of = (size_t)task[1];
  size_t begin = count * ((size_t)task[0] - 1) / of, end = count * (size_t)task[0] / of;
  memmove(frames->frames, frames->frames + begin, (end - begin) * sizeof *frames->frames);
  frames->count = end - begin;
}

/* Whether each frame needs a name of its own. */
static bool needs_numbers(const cs_request *request, const char *path) {
  const cs_output *output = path ? cs_output_of(request, path, 0) : NULL;
  return path && !cs_sequence_has_number(path) &&
         !(output && (output->outlet == &cs_outlet_raw || cs_output_is_whole(output, path)));
}

cs_exit cs_output_frames(const cs_script *script, const cs_request *request, const char *path,
                         cs_sequence *out) {
  celspan_status status = list_frames(script, request, out);
  if (status == CELSPAN_BAD_ARGUMENT)
    return cs_report_usage("%s", celspan_context_error(script->context));
  if (status != CELSPAN_OK)
    return cs_report_failure(script->context, status, NULL);
  if (needs_numbers(request, path) && out->count > 1)
    return cs_report_usage("%s: several frames (%zu) need a number in the name, such as "
                           "shot.####.png; for one, name it: --frames %" PRId64,
                           path, out->count, out->frames[0]);
  take_task(request, out);
  return CS_EXIT_OK;
}
