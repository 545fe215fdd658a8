/* The table of options, and what is made from it: parsing and help. */
#include "cli/request.h"

#include <ctype.h>
#include <stddef.h>
#include <string.h>

#include "bind/suggest.h"

typedef struct option {
  const char *name;
  const char *value; /* what the help calls the value; NULL: a flag, without one */
  const char *allowed;
  unsigned verbs;
  size_t offset;
  cs_argument_reader read; /* NULL: a flag (bool) */
  const char *help;
} option;

#define FIELD(field) offsetof(cs_request, field)
#define CODED (CS_VERB_RENDER | CS_VERB_CONVERT | CS_VERB_FARM)

static const option OPTIONS[] = {
    {"-o", "DIR", "the name of a folder", CS_VERB_TILES, FIELD(output), cs_argument_text,
     "the folder for the pyramid and its page; made when it is missing"},
    {"-o", "OUT", "the name of a file", CS_VERB_RENDER, FIELD(output), cs_argument_text,
     "shot.####.png, shot.%04d.exr, one.png for a single frame, - for raw frames;\n"
     "                     film.mp4, .mov, .webm, .mkv, .gif or .webp: a video, by ffmpeg"},
    {"-o", "OUT", "the name of a file", CS_VERB_SHEET, FIELD(output), cs_argument_text,
     "shot.xdts, shot.csv (TVPaint, Krita) or shot.txt; default: text on standard output"},
    {"-o", "SHEET", "the name of a file", CS_VERB_CONTACT, FIELD(output), cs_argument_text,
     "the picture to make; sheet.####.png for several pages"},
    {"-o", "OUT", "the name of a file", CS_VERB_TRACE, FIELD(output), cs_argument_text,
     "art.svg, or art.lua: a script that shows the drawing, and is a module"},
    {"-o", "OUT", "the name of a file", CS_VERB_JOIN, FIELD(output), cs_argument_text,
     "the picture to make; its ending is that of the strips"},
    {"-o", "OUT", "the name of a file", CS_VERB_FARM, FIELD(output), cs_argument_text,
     "what the job makes, as for render: shot.####.png, one.png for a single frame"},
    {"--slurm", NULL, NULL, CS_VERB_FARM, FIELD(slurm), NULL, "an array script for Slurm"},
    {"--openjd", NULL, NULL, CS_VERB_FARM, FIELD(openjd), NULL,
     "a template of Open Job Description 2023-09, in JSON"},
    {"--chunk", "N", "a whole number, 1 or more", CS_VERB_FARM, FIELD(chunk), cs_argument_every,
     "at most N frames a task; default: 10"},
    {"--strips", "N", "a whole number, 1 or more", CS_VERB_FARM, FIELD(strips), cs_argument_every,
     "one frame in N strips, a task each, and a join behind them"},
    {"--job-name", "NAME", "a name", CS_VERB_FARM, FIELD(name), cs_argument_text,
     "the name of the job; default: that of the script"},
    {"--job-memory", "MiB", "a whole number of MiB, 1 or more", CS_VERB_FARM, FIELD(task_memory),
     cs_argument_every, "what each task is given; default: what the farm gives"},
    {"--job-time", "MIN", "a whole number of minutes, 1 or more", CS_VERB_FARM, FIELD(task_minutes),
     cs_argument_every, "minutes that each task may take; default: as above"},
    {"--logs", "DIR", "the name of a folder", CS_VERB_FARM, FIELD(logs), cs_argument_text,
     "where Slurm puts what tasks say; default: where it was told to"},
    {"--workers", "N", "a whole number from 1 to 1024", CS_VERB_FARM, FIELD(workers),
     cs_argument_workers, "processors, and threads, of each task; default: what the farm gives"},
    {"--colours", "N|LIST", "a whole number from 1 to 64, or colours like #ffffff,#203040",
     CS_VERB_TRACE, FIELD(colours), cs_argument_colours,
     "how many colours are found in the picture, or which there are; default: 2"},
    {"--smooth", "S", "a number from 0 to 16", CS_VERB_TRACE, FIELD(smooth), cs_argument_smooth,
     "how far curves may leave the edges; 0: the sides of the pixels; default: 1"},
    {"--speckle", "N", "a whole number of pixels, 0 or more", CS_VERB_TRACE, FIELD(speckle),
     cs_argument_count, "areas of at most N pixels go to their neighbours; default: 2"},
    {"--lines", NULL, NULL, CS_VERB_TRACE, FIELD(lines), NULL,
     "strokes along what is drawn on the ground, instead of areas"},
    {"-o", "OUT", "the name of a file", CS_VERB_RELIGHT, FIELD(output), cs_argument_text,
     "the picture in the light --to; without it an .exr that takes any light"},
    {"--light", "COLOUR", "a colour like #ffe0b0, r,g,b with each above 0, or grey",
     CS_VERB_RELIGHT, FIELD(light), cs_argument_lamp,
     "the light that IN was taken in; grey: that in which its mean is a grey of 0.18"},
    {"--to", "COLOUR", "a colour like #203060, or r,g,b", CS_VERB_RELIGHT, FIELD(to),
     cs_argument_light, "the light that it is to be shown in"},
    {"-o", "OUT.json", "the name of a file", CS_VERB_TRACK, FIELD(output), cs_argument_text,
     "the track, for celspan.track; default: on standard output"},
    {"--from", "N", "the number of a frame", CS_VERB_TRACK, FIELD(from), cs_argument_integer,
     "the frame in which the region is given"},
    {"--at", "X,Y,W,H", "four whole numbers of pixels, width and height above 0", CS_VERB_TRACK,
     FIELD(at), cs_argument_crop, "the region there, in pixels"},
    {"--model", "NAME", "translation, similarity or perspective", CS_VERB_TRACK, FIELD(model),
     cs_argument_model,
     "translation, similarity (turned and scaled too) or perspective; default: similarity"},
    {"--frames", "LIST", "a list of frames such as 1-10,20-30:2,45",
     CS_VERB_RENDER | CS_VERB_CHECK | CS_VERB_CONTACT | CS_VERB_SHEET | CS_VERB_TRACK |
         CS_VERB_FARM,
     FIELD(frames), cs_argument_text, "the frames, such as 1-10,20-30:2,45; default: all"},
    {"--frame", "N", "the number of one frame", CS_VERB_SPANS | CS_VERB_PROBE | CS_VERB_TILES,
     FIELD(frame), cs_argument_integer, "the frame; default: the first"},
    {"--size", "WxH", "width x height in whole pixels, 1 to 1048576, such as 1920x1080",
     CODED | CS_VERB_SPANS | CS_VERB_TILES, FIELD(size), cs_argument_size,
     "pixels of the whole frame; each axis is scaled on its own"},
    {"--scale", "S", "a number above 0 such as 0.5", CS_VERB_RENDER | CS_VERB_FARM | CS_VERB_TILES,
     FIELD(scale), cs_argument_scale, "pixels a film unit, instead of --size"},
    {"--crop", "X,Y,W,H", "four whole numbers of pixels, width and height above 0", CODED,
     FIELD(crop), cs_argument_crop, "the part to make, in pixels of the output"},
    {"--crop", "X,Y,W,H", "four whole numbers of pixels, width and height above 0", CS_VERB_TILES,
     FIELD(crop), cs_argument_crop, "only tiles that touch this part of the frame, in its pixels"},
    {"--strip", "I/N", "a number and how many there are, such as 3/24", CS_VERB_RENDER,
     FIELD(strip), cs_argument_share, "the I-th of N strips of the frame, for 'celspan join'"},
    {"--task", "I/N", "a number and how many there are, such as 3/24", CS_VERB_RENDER, FIELD(task),
     cs_argument_share, "the I-th of N parts of the frames"},
    {"--rows", "A-B", "two rows from 0, the first not below the second", CS_VERB_SPANS, FIELD(rows),
     cs_argument_rows, "rows from A to B, both included; default: all"},
    {"--antialias", "MODE",
     "'area', 'none', or 'box', 'gaussian', 'mitchell' or 'lanczos' with ':ROWS' (1 to 256) or "
     "without",
     CS_VERB_RENDER | CS_VERB_FARM | CS_VERB_SPANS | CS_VERB_TILES, FIELD(antialias),
     cs_argument_antialias,
     "area (the mean over each pixel), none (pixel centres), or KERNEL[:ROWS]: box,\n"
     "                     gaussian, mitchell, lanczos; ROWS: parts of a pixel row, 16"},
    {"--format", "NAME", "dzi or iiif", CS_VERB_TILES, FIELD(layout), cs_argument_layout,
     "dzi (Deep Zoom) or iiif (IIIF Image API 3.0, level 0); default: dzi"},
    {"--format", "NAME", "the name of a file format such as png", CODED | CS_VERB_RELIGHT,
     FIELD(format), cs_argument_text, "file format; default: by the ending of OUT"},
    {"--depth", "DEPTH", "8, 16, half or float", CODED | CS_VERB_RELIGHT, FIELD(coding.depth),
     cs_argument_depth, "8, 16, half or float; default: by the format"},
    {"--colour", "CODING", "srgb, linear, rec709 or cineon", CODED | CS_VERB_RELIGHT,
     FIELD(coding.transfer), cs_argument_colour,
     "srgb, linear, rec709 or cineon; default: srgb, floats linear"},
    {"--alpha", "KIND", "straight or premultiplied", CODED | CS_VERB_RELIGHT, FIELD(coding.alpha),
     cs_argument_alpha, "straight or premultiplied; default: straight, floats premultiplied"},
    {"--dither", NULL, NULL, CS_VERB_RENDER | CS_VERB_FARM, FIELD(dithers), NULL,
     "8 bits without bands: rounded up or down by the place of the pixel"},
    {"--quality", "Q", "a whole number from 0 to 100", CS_VERB_RENDER, FIELD(quality),
     cs_argument_quality, "of a video: 0 (small) to 100 (hardly any loss); default: 75"},
    {"--background", "RGB", "a colour like #336699", CS_VERB_RENDER | CS_VERB_FARM,
     FIELD(background), cs_argument_tint,
     "a back light of this colour and matte 1 behind everything"},
    {"--cel", "NAME", "the name of a cel", CS_VERB_RENDER | CS_VERB_FARM, FIELD(cel),
     cs_argument_text, "the cels of this name alone (cel:named), with their lights"},
    {"--grid", "CxR", "columns x rows, each 1 to 100, such as 6x4", CS_VERB_CONTACT, FIELD(grid),
     cs_argument_grid, "columns and rows of a page; default: 6x4"},
    {"--every", "N", "a whole number, 1 or more", CS_VERB_CONTACT, FIELD(every), cs_argument_every,
     "one frame in N; default: as many as fit on one page"},
    {"--onion", "B,A", "two numbers of frames, 0 to 16, not both 0, such as 2,1",
     CS_VERB_RENDER | CS_VERB_FARM, FIELD(onion), cs_argument_onion,
     "lay B frames before (red) and A after (green) over each frame"},
    {"--only", "PATTERN", "a pattern of names", CS_VERB_TEST, FIELD(only), cs_argument_text,
     "tests whose names match this Lua pattern alone"},
    {"--workers", "N", "a whole number from 1 to 1024", CS_VERB_TEST, FIELD(workers),
     cs_argument_workers, "spec files at a time; default: one a processor"},
    {"--workers", "N", "a whole number from 1 to 1024",
     CS_VERB_CONTACT | CS_VERB_RENDER | CS_VERB_SPANS | CS_VERB_CONVERT | CS_VERB_TILES,
     FIELD(workers), cs_argument_workers, "threads that render; default: one a processor"},
    {"--progress", "HOW", "auto, bar, lines, none, json or openjd", CS_VERB_RENDER | CS_VERB_TILES,
     FIELD(progress), cs_argument_progress,
     "auto, bar, lines, none or json on standard error; openjd on standard output"},
    {"--hash", NULL, NULL, CS_VERB_RENDER, FIELD(hash), NULL,
     "print FRAME DIGEST of each frame's pixels; OUT may be left out"},
    {"--stats", NULL, NULL, CS_VERB_SPANS, FIELD(statistics), NULL,
     "make all rows, count their spans by kind, print one line of counts"},
    {"--pixels", "DEPTH", "8, 16, half or float", CS_VERB_SPANS, FIELD(pixels), cs_argument_depth,
     "with --stats: make each row as pixels, in a row that is reused"},
    {"--picture", "NAME", "png or jpg", CS_VERB_TILES, FIELD(picture), cs_argument_text,
     "png or jpg: what a tile is; default: png"},
    {"--tile", "N", "a whole number of pixels, 16 to 8192", CS_VERB_TILES, FIELD(tile),
     cs_argument_count, "pixels of a tile's side; default: 254, iiif 512"},
    {"--overlap", "N", "a whole number of pixels, 0 or more", CS_VERB_TILES, FIELD(overlap),
     cs_argument_count, "pixels that tiles share with their neighbours; default: 1, iiif 0"},
    {"--levels", "A-B", "two levels from 0, the first not above the second", CS_VERB_TILES,
     FIELD(levels), cs_argument_rows, "levels to make, 0 is one pixel; default: all"},
    {"--places", "FILE", "the name of a file", CS_VERB_TILES, FIELD(places), cs_argument_text,
     "lines X Y WIDTH NAME: links in the page; deeper levels are made around them"},
    {"--tiles-limit", "N", "a whole number", CS_VERB_TILES, FIELD(tile_limit), cs_argument_count,
     "tiles to make at most; default: 200000"},
    {"--skip-empty", NULL, NULL, CS_VERB_TILES, FIELD(skips_empty), NULL,
     "leave out tiles that show nothing but the background"},
    {"--fresh", NULL, NULL, CS_VERB_TILES, FIELD(is_fresh), NULL,
     "remove the tiles of an earlier run and start over"},
    {"--viewer", "PATH", "the name of a folder or file", CS_VERB_TILES, FIELD(viewer),
     cs_argument_text, "OpenSeadragon, to be copied beside the page in place of its own viewer"},
    {"-o", "DIFFERENCE", "the name of a file", CS_VERB_COMPARE, FIELD(output), cs_argument_text,
     "a picture of where they differ: A in pale grey, differences in red"},
    {"--fail", "D", "a number, 0 or more", CS_VERB_COMPARE, FIELD(tolerance), cs_argument_tolerance,
     "largest difference of coded values (0..1) that is let pass; default 0"},
    {"--resume", NULL, NULL, CS_VERB_RENDER, FIELD(resumes), NULL,
     "keep the frames of earlier runs with --resume that would come out the same"},
    {"--force", NULL, NULL, CS_VERB_RENDER | CS_VERB_FARM, FIELD(is_forced), NULL,
     "with --resume: keep every frame that stands there whole, whatever it shows"},
    {"--keep-going", NULL, NULL, CS_VERB_RENDER | CS_VERB_FARM, FIELD(keeps_going), NULL,
     "go on after frames that fail; the exit code is then 1"},
    {"--deep", NULL, NULL, CS_VERB_CHECK, FIELD(is_deep), NULL,
     "read pictures whole, not only their headers"},
    {"--trust", NULL, NULL, CS_VERBS_WITH_SCRIPT, FIELD(trusts), NULL,
     "give the script the whole of Lua: files, programs, no limits; decode pictures in\n"
     "                     this process, without limits"},
    {"--trust", NULL, NULL, CS_VERBS_WITH_PICTURES, FIELD(trusts), NULL,
     "decode pictures in this process, without limits"},
    {"--strict", NULL, NULL, CS_VERBS_WITH_SCRIPT, FIELD(is_strict), NULL,
     "confine the process too, by the kernel: no other files, programs or network"},
    {"--allow", "DIR", "the name of a folder, of which there may be 48", CS_VERBS_WITH_SCRIPT, FIELD(allowed),
     cs_argument_texts, "let the script read below this folder too; may be given several times"},
    {"--limit", "NAME=V",
     "memory=SIZE, steps=N, time=SECONDS, print=SIZE, picture-memory=SIZE or picture-time=SECONDS, "
     "such as memory=512M,time=60; 0: no limit",
     CS_VERBS_WITH_SCRIPT, FIELD(limits), cs_argument_limits,
     "limits of the script: memory=512M, steps=2e9 (a frame), time=60 (seconds a call),\n"
     "                     print=1M (a frame) are the defaults; of decoding a picture:\n"
     "                     picture-memory=1G, picture-time=20 (seconds a part); several with\n"
     "                     commas; 0: none"},
    {"--limit", "NAME=V",
     "picture-memory=SIZE or picture-time=SECONDS, such as picture-memory=1G,picture-time=20; 0: "
     "no "
     "limit",
     CS_VERBS_WITH_PICTURES, FIELD(limits), cs_argument_picture_limits,
     "limits of decoding a picture: picture-memory=1G, picture-time=20 (seconds a part)\n"
     "                     are the defaults; 0: none"},
    {"--memory", "MiB", "a whole number of MiB from 0 to 1048576",
     CS_VERB_RENDER | CS_VERB_SPANS | CS_VERB_FARM, FIELD(memory), cs_argument_memory,
     "pictures and defocused cels kept in memory; default: 768; 0: every frame is made\n"
     "                     as if it were the first"},
};

enum { OPTION_COUNT = sizeof OPTIONS / sizeof OPTIONS[0], NAME_SIZE = 32 };

/* ---------------------------------------------------------------- parsing */

typedef struct parser {
  const cs_verb *verb;
  char *const *arguments;
  size_t count, next;
  cs_request *out;
} parser;

static bool belongs(const option *candidate, const cs_verb *verb) {
  return (candidate->verbs & verb->self) != 0;
}

static const option *find(const cs_verb *verb, const char *name) {
  for (size_t i = 0; i < OPTION_COUNT; i++)
    if (belongs(&OPTIONS[i], verb) && strcmp(OPTIONS[i].name, name) == 0)
      return &OPTIONS[i];
  return NULL;
}

static cs_exit refuse_unknown(const cs_verb *verb, const char *name) {
  const char *names[OPTION_COUNT];
  size_t count = 0;
  for (size_t i = 0; i < OPTION_COUNT; i++)
    if (belongs(&OPTIONS[i], verb))
      names[count++] = OPTIONS[i].name;
  const char *nearest = cs_suggest_name(name, names, count);
  if (nearest)
    return cs_report_usage("unknown option '%s': did you mean '%s'?", name, nearest);
  return cs_report_usage("unknown option '%s' ('celspan help %s' lists the options)", name,
                         verb->name);
}

/* What a farm's job gives to its tasks: the options that it has from render. */
static cs_exit pass_on(const cs_verb *verb, const option *known, const char *text,
                       cs_request *out) {
  if (verb->self != CS_VERB_FARM || !(known->verbs & CS_VERB_RENDER))
    return CS_EXIT_OK;
  if (out->passed_count == CS_PASSED_MOST)
    return cs_report_usage("%s: there are more than %d options", known->name, CS_PASSED_MOST);
  out->passed[out->passed_count++] = (cs_passed){known->name, text};
  return CS_EXIT_OK;
}

static cs_exit read_value(const cs_verb *verb, const option *known, const char *text,
                          cs_request *out) {
  void *field = (char *)out + known->offset;
  if (known->read(text, field) == CS_ARGUMENT_READ)
    return pass_on(verb, known, text, out);
  return cs_report_usage("%s: '%s' is not %s", known->name, text, known->allowed);
}

/* One option: --name value, --name=value, or a flag. */
static cs_exit parse_option(parser *p) {
  const char *argument = p->arguments[p->next++];
  char name[NAME_SIZE];
  size_t length = argument[1] == '-' ? strcspn(argument, "=") : strlen(argument);
  if (length >= sizeof name)
    return refuse_unknown(p->verb, argument);
  memcpy(name, argument, length);
  name[length] = '\0';
  const option *known = find(p->verb, name);
  if (!known)
    return refuse_unknown(p->verb, name);
  const char *value = argument[length] ? argument + length + 1 : NULL;
  if (!known->value && value)
    return cs_report_usage("%s takes no value", name);
  if (!known->read) {
    *(bool *)((char *)p->out + known->offset) = true;
    return pass_on(p->verb, known, NULL, p->out);
  }
  if (known->value && !value) {
    if (p->next == p->count)
      return cs_report_usage("%s needs a value: %s", name,
                             known->allowed ? known->allowed : known->value);
    value = p->arguments[p->next++];
  }
  return read_value(p->verb, known, value, p->out);
}

/* "-" alone is a file, and "-3" a number. */
static bool is_option(const char *text) {
  return text[0] == '-' && text[1] && !isdigit((unsigned char)text[1]) && text[1] != '.';
}

static cs_exit read_script_arguments(parser *p) {
  if (!(p->verb->self & CS_VERBS_WITH_SCRIPT))
    return cs_report_usage("'--' ends the options of verbs that run a script; '%s' runs none",
                           p->verb->name);
  p->out->script_arguments = p->arguments + p->next;
  p->out->script_argument_count = p->count - p->next;
  p->next = p->count;
  return CS_EXIT_OK;
}

static cs_exit read_operand(parser *p) {
  const char *operand = p->arguments[p->next++];
  if (p->out->operand_count == p->verb->operand_most)
    return cs_report_usage("'%s' is one too many: celspan %s %s [options]", operand, p->verb->name,
                           p->verb->operands);
  p->out->operands[p->out->operand_count++] = operand;
  return CS_EXIT_OK;
}

cs_exit cs_request_parse(const cs_verb *verb, size_t count, char *const *arguments,
                         cs_request *out) {
  *out = (cs_request){.rows = {0, -1},
                      .levels = {0, -1},
                      .makes_folder = verb->self == CS_VERB_TILES,
                      .smooth = -1};
  parser p = {verb, arguments, count, 0, out};
  cs_exit outcome = CS_EXIT_OK;
  while (p.next < count && outcome == CS_EXIT_OK) {
    if (strcmp(arguments[p.next], "--") == 0) {
      p.next++;
      outcome = read_script_arguments(&p);
    } else if (is_option(arguments[p.next])) {
      outcome = parse_option(&p);
    } else {
      outcome = read_operand(&p);
    }
  }
  if (outcome == CS_EXIT_OK && out->operand_count < verb->operand_least)
    return cs_report_usage("usage: celspan %s %s [options] ('celspan help %s' says more)",
                           verb->name, verb->operands, verb->name);
  return outcome;
}

/* ---------------------------------------------------------------- help */

void cs_request_list(const cs_verb *verb,
                     void (*call)(void *user, const char *name, const char *value,
                                  const char *help),
                     void *user) {
  for (size_t i = 0; i < OPTION_COUNT; i++)
    if (belongs(&OPTIONS[i], verb))
      call(user, OPTIONS[i].name, OPTIONS[i].value, OPTIONS[i].help);
}

typedef struct help_page {
  FILE *stream;
  bool has_options; /* so far */
} help_page;

static void print_option(void *user, const char *name, const char *value, const char *help) {
  help_page *page = user;
  char left[40];
  if (!page->has_options)
    fputs("\nOptions\n", page->stream);
  page->has_options = true;
  snprintf(left, sizeof left, "%s %s", name, value ? value : "");
  fprintf(page->stream, "  %-18s %s\n", left, help);
}

void cs_request_help(const cs_verb *verb, FILE *stream) {
  bool has_script = (verb->self & CS_VERBS_WITH_SCRIPT) != 0;
  help_page page = {stream, false};
  fprintf(stream, "celspan %s %s [options]%s\n\n%s\n", verb->name, verb->operands,
          has_script ? " [-- ARGS]" : "", verb->summary);
  if (verb->notes)
    fprintf(stream, "\n%s", verb->notes);
  cs_request_list(verb, print_option, &page);
  if (has_script)
    fputs("\nWhat follows -- arrives in the script as its arguments (...).\n", stream);
}
