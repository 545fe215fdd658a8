/* The command line: chooses the verb, runs it, and turns its outcome into the exit code.
 *
 *   main -> request (what is asked) -> a verb -> report (exit code, one line of error)
 *
 * Nothing is loaded that the verb does not need: the Lua state is made by the verbs that run a
 * script; OpenImageIO by the first picture, in another process (decoder/keeper.h).
 */
#include <errno.h>
#include <fcntl.h>
#include <locale.h>
#include <stdlib.h>
#include <string.h>

#include "bind/suggest.h"
#include "cli/confine.h"
#include "cli/decoder/keeper.h"
#include "cli/decoder/pictures.h"
#include "cli/interrupt.h"
#include "cli/manual.h"
#include "cli/progress.h"
#include "cli/verbs.h"

static const cs_verb VERBS[] = {
    {CS_VERB_RENDER, "render", "SCRIPT -o OUT", 1, 1,
     "Renders the frames of a film to files, or raw to standard output.",
     "Missing folders are made and existing frames are replaced; a frame appears under its name\n"
     "whole or not at all. Colours are worked out in linear light. By default integers are 8 bit,\n"
     "sRGB-coded, alpha straight; floats are linear, alpha premultiplied. With -o - RGBA rows go "
     "to\n"
     "standard output, top to bottom, little endian. A video is made by ffmpeg, with the film's\n"
     "sound in step: mp4 and mkv hold H.264, mov ProRes 4444 and webm VP9, both with alpha.\n",
     cs_verb_render},
    {CS_VERB_INFO, "info", "SCRIPT|FILE", 1, 1,
     "Prints frames, size, cels, primitives and pictures of a film; or what a picture or span file "
     "is.",
     "Which it is, the content tells. Of a picture the headers are read: format, size, channels, "
     "alpha,\n"
     "depth, colour, subimages and layers. A span file is read to its end and every checksum "
     "looked at.\n",
     cs_verb_info},
    {CS_VERB_CHECK, "check", "SCRIPT", 1, 1,
     "Builds every frame without rendering and reports all faults.",
     "Each frame is built twice, the second time in another order in a fresh film: a frame "
     "function\n"
     "that answers differently is not a pure function of its frame. Every picture is looked for,\n"
     "hidden or not. Frames that hold scan-line procedures are built, but not compared. Equal\n"
     "faults are one line, with the frames that have them.\n",
     cs_verb_check},
    {CS_VERB_SPANS, "spans", "SCRIPT", 1, 1, "Prints the spans of a frame as text.",
     "One line a span, colours linear and premultiplied, columns half-open, rows from 0:\n"
     "  row x0 x1 single r g b a\n"
     "  row x0 x1 gradient r g b a r g b a     colours of the first and the last pixel\n"
     "  row x0 x1 array N\n",
     cs_verb_spans},
    {CS_VERB_PROBE, "probe", "SCRIPT X Y", 3, 3,
     "Prints r g b a of one point, by direct evaluation: linear, premultiplied.",
     "X and Y are film units. There is no antialiasing and no defocus at a point.\n",
     cs_verb_probe},
    {CS_VERB_CONVERT, "convert", "IN OUT", 2, 2, "Converts any picture to any other.", NULL,
     cs_verb_convert},
    {CS_VERB_COMPARE, "compare", "A B", 2, 2,
     "Compares two pictures or films: exit 0 when they show the same, 1 when not.",
     "Prints the largest difference of coded values (0..1: sRGB, alpha straight), where it is, "
     "and\n"
     "how many pixels differ by more than --fail. A and B may be patterns such as shot.####.png:\n"
     "then there is a line for each frame.\n",
     cs_verb_compare},
    {CS_VERB_TILES, "tiles", "SCRIPT|FILE -o DIR", 1, 1,
     "Cuts a frame or a picture into tiles to be explored in a browser.",
     "Makes a pyramid of tiles straight from the scene, and index.html, which shows it. A FILE is "
     "any\n"
     "picture; what ends in .lua is a script. Equal tiles are one file with several names. A run "
     "that\n"
     "was stopped goes on where it was.\n",
     cs_verb_tiles},
    {CS_VERB_SHEET, "sheet", "FILE|SCRIPT", 1, 1,
     "Prints an exposure sheet as text, converts it, or writes the sheet of a film.",
     "A FILE is an exposure sheet: XDTS, the CSV of TVPaint, Krita or Clip Studio, an OCA folder, "
     "or "
     "the\n"
     "text that is printed; what ends in .lua is a script. The sheet of a film has a row for each "
     "cel and\n"
     "object with a name, and for cels without one by their places. Drawings are numbered as they "
     "appear;\n"
     "|  the drawing above goes on      -  nothing is there\n"
     "/m  its placement, fade, viewport or lights changed      /p  a procedure draws it: not "
     "compared\n",
     cs_verb_sheet},
    {CS_VERB_CONTACT, "contact", "SCRIPT -o SHEET", 1, 1,
     "Makes a sheet of frames side by side, each with its number.",
     "Without --every the frames are thinned until they fit on one page. With it, SHEET needs a\n"
     "number such as sheet.####.png when there are more frames than cells.\n",
     cs_verb_contact},
    {CS_VERB_RELIGHT, "relight", "IN -o OUT", 1, 1,
     "Takes the light off a picture, and shows it in another light.",
     "IN is any picture, and --light what it was taken in; highlights are kept. Without --to OUT "
     "is "
     "an\n"
     "EXR file of seven channels, which takes any light: for celspan.relight, or as IN of another "
     "run,\n"
     "which needs no --light.\n",
     cs_verb_relight},
    {CS_VERB_TRACE, "trace", "IN -o OUT", 1, 1,
     "Turns a scanned or flat-coloured drawing into shapes: SVG, or a script.",
     "IN is any picture. Areas of one colour become closed paths of lines and cubics; those that "
     "abut\n"
     "share their border, so that nothing shows between them. A script renders as it is, and gives "
     "its\n"
     "shapes to other scripts by require. OUT appears whole or not at all.\n",
     cs_verb_trace},
    {CS_VERB_TRACK, "track", "PATTERN --from N --at X,Y,W,H", 1, 1,
     "Follows a region through frames, and writes where it lies in each.",
     "PATTERN names pictures with a number, such as head.####.png. Frames in which the region was\n"
     "not found are told as lost. The track is for celspan.track, which places art on it.\n",
     cs_verb_track},
    {CS_VERB_FARM, "farm", "SCRIPT -o OUT", 1, 1,
     "Writes a job for a render farm: a Slurm array script, or an Open Job Description.",
     "The job goes to standard output. Its tasks render the frames to OUT as 'celspan render' "
     "would, in\n"
     "chunks that go on where they were stopped, or one frame in strips, which are joined at the "
     "end.\n",
     cs_verb_farm},
    {CS_VERB_JOIN, "join", "STRIP ... -o OUT", 1, CS_OPERANDS_MAX,
     "Puts strips of a frame together, without unpacking them.",
     "STRIPs are PNG, Targa or span files of 'celspan render --strip', from the top down, or a "
     "pattern\n"
     "such as strips/####.png. OUT shows what the whole frame would, and appears whole or not at "
     "all.\n",
     cs_verb_join},
    {CS_VERB_TEST, "test", "[SPEC ...]", 0, CS_OPERANDS_MAX,
     "Runs specs in busted, with the assertions of celspan.spec.",
     "A SPEC is a file, or a folder whose files that end in _spec.lua are run; default: spec. "
     "Each\n"
     "file is run in a process of its own, several at a time. Exit code 1 when a test failed, 5 "
     "when\n"
     "busted is not installed.\n",
     cs_verb_test},
    {CS_VERB_INIT, "init", "NAME", 1, 1,
     "Lays out a film: script, sheet, spec, settings for editors, a page that tells about it.",
     "NAME is a folder, new or empty. The film renders and its tests pass as they are.\n",
     cs_verb_init},
};

enum { VERB_COUNT = sizeof VERBS / sizeof VERBS[0] };

static const cs_verb *find_verb(const char *name) {
  for (size_t i = 0; i < VERB_COUNT; i++)
    if (strcmp(VERBS[i].name, name) == 0)
      return &VERBS[i];
  return NULL;
}

static cs_exit refuse_verb(const char *name) {
  const char *names[VERB_COUNT + 1] = {"help"};
  for (size_t i = 0; i < VERB_COUNT; i++)
    names[i + 1] = VERBS[i].name;
  const char *nearest = cs_suggest_name(name, names, VERB_COUNT + 1);
  if (nearest)
    return cs_report_usage("unknown verb '%s': did you mean '%s'?", name, nearest);
  return cs_report_usage("unknown verb '%s' ('celspan help' lists them)", name);
}

static void help_overview(FILE *stream) {
  fprintf(stream,
          "celspan %s - compositing for cel animation: Lua scripts in, frames out\n\n"
          "celspan VERB ...\n",
          celspan_version());
  for (size_t i = 0; i < VERB_COUNT; i++)
    fprintf(stream, "  %-8s %-19s %s\n", VERBS[i].name, VERBS[i].operands, VERBS[i].summary);
  fprintf(stream, "  %-8s %-19s %s\n\n", "help", "VERB", "Says more about a verb.");
  fputs("celspan --version prints the version, celspan --man the manual page.\n\nExit codes\n",
        stream);
  cs_manual_exit_codes(stream);
}

static cs_exit help(const char *name) {
  if (!name || strcmp(name, "help") == 0) {
    help_overview(stdout);
    return CS_EXIT_OK;
  }
  const cs_verb *verb = find_verb(name);
  if (!verb)
    return refuse_verb(name);
  cs_request_help(verb, stdout);
  return CS_EXIT_OK;
}

static cs_exit run_verb(const cs_verb *verb, size_t count, char **arguments) {
  for (size_t i = 0; i < count && strcmp(arguments[i], "--") != 0; i++)
    if (strcmp(arguments[i], "--help") == 0 || strcmp(arguments[i], "-h") == 0)
      return help(verb->name);
  cs_request request;
  cs_exit outcome = cs_request_parse(verb, count, arguments, &request);
  if (outcome != CS_EXIT_OK)
    return outcome;
  cs_progress_choose(request.progress);
  celspan_context *context = NULL;
  celspan_context_desc desc = {.struct_size = sizeof desc};
  desc.defocus_bytes = (size_t)request.memory.value * 1048576 / 3; /* divided as the defaults are */
  desc.picture_bytes = 2 * desc.defocus_bytes;
  if (celspan_context_create(&desc, &context) != CELSPAN_OK) {
    cs_report_error("no memory to begin");
    return CS_EXIT_MEMORY;
  }
  outcome = cs_confine_pictures(context, &request);
  if (outcome == CS_EXIT_OK)
    outcome = verb->run(context, &request);
  celspan_context_destroy(context);
  cs_pictures_finish();
  return outcome;
}

static cs_exit dispatch(int count, char **arguments) {
  if (count < 2) {
    help_overview(stderr);
    return CS_EXIT_USAGE;
  }
  const char *first = arguments[1];
  if (strcmp(first, "--version") == 0) {
    printf("celspan %s\n", celspan_version());
    return CS_EXIT_OK;
  }
  if (strcmp(first, "--man") == 0) {
    cs_manual_print(VERBS, VERB_COUNT, stdout);
    return CS_EXIT_OK;
  }
  if (strcmp(first, "help") == 0 || strcmp(first, "--help") == 0 || strcmp(first, "-h") == 0)
    return help(count > 2 ? arguments[2] : NULL);
  const cs_verb *verb = find_verb(first);
  return verb ? run_verb(verb, (size_t)count - 2, arguments + 2) : refuse_verb(first);
}

/* Daemons and farms start programs with descriptors 0 to 2 closed; the next file opened would then
 * take their place, and messages would be written into frames. /dev/null holds the places. It is
 * opened for reading alone where standard output was, so that what is written there still fails. */
static bool hold_descriptors(void) {
  static const int modes[] = {O_RDONLY, O_RDONLY, O_WRONLY};
  for (int number = 0; number <= 2; number++)
    if (fcntl(number, F_GETFD) < 0 && errno == EBADF && open("/dev/null", modes[number]) != number)
      return false;
  return true;
}

int main(int count, char **arguments) {
  if (!hold_descriptors())
    return CS_EXIT_INTERNAL;
  /* Numbers are read and printed in the C locale by this thread, whatever a script may set. */
  uselocale(newlocale(LC_ALL_MASK, "C", (locale_t)0));
  if (cs_keeper_is_meant(count, arguments))
    cs_keeper_run(count, arguments);
  cs_interrupt_install();
  cs_exit outcome = dispatch(count, arguments);
  outcome = cs_report_close_output(outcome);
  if (cs_interrupt_signal())
    cs_interrupt_die();
  return (int)outcome;
}
