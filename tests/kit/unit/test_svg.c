/* Drawings through the C interface: reading, questions, changed parts, and allocations that
 * fail. */
#include "celspan/celspan.h"
#include "celspan/svg.h"
#include "readers/svg/document/art.h"
#include "readers/svg/motion/motion.h"
#include "readers/svg/read.h"
#include "readers/svg/words/colours.h"
#include "tests/support/check.h"
#include "tests/support/memory.h"

#include <stdlib.h>
#include <unistd.h>

static const char drawing[] =
    "<svg xmlns='http://www.w3.org/2000/svg' width='40' height='30'>\n"
    "<style>[id] { fill: lime }</style>\n"
    "<linearGradient id='l'><stop stop-color='red'/><stop offset='1'/></linearGradient>\n"
    "<marker id='m' orient='auto'><rect width='3' height='3'/></marker>\n"
    "<g id='arm' opacity='.5'><path id='hand' d='M5 5A9 9 0 0 1 20 20Z' stroke='url(#l)'\n"
    "  stroke-dasharray='3 1' marker-mid='url(#m)'/></g>\n"
    "<polyline points='1 1 9 9 9 1' stroke='red' stroke-width='2' fill='none'/>\n"
    "<foreignObject/>\n"
    "</svg>";

static celspan_status read_bytes(celspan_context *context, const char *text, celspan_svg **out) {
  static const celspan_svg_font font = {.family = "default",
                                        .file = TEST_ROOT "/scripts/type/block.ttf"};
  celspan_svg_desc desc = CELSPAN_SVG_DESC;
  desc.fonts = &font;
  desc.font_count = 1;
  desc.bytes = text;
  desc.size = strlen(text);
  desc.name = "a.svg";
  return celspan_svg_read(context, &desc, out);
}

static celspan_status move_right(void *user, celspan_context *context, celspan_object *part,
                                 celspan_object **out) {
  const celspan_matrix matrix = celspan_matrix_translation(*(double *)user, 0);
  return celspan_object_transform(context, part, &matrix, out);
}

static celspan_status refuse(void *user, celspan_context *context, celspan_object *part,
                             celspan_object **out) {
  (void)user, (void)context, (void)part, (void)out;
  return CELSPAN_CANCELLED;
}

static celspan_object *part_named(const celspan_svg *svg, const char *name) {
  for (size_t i = 0; i < celspan_svg_part_count(svg); i++) {
    const char *found;
    celspan_object *part = celspan_svg_part(svg, i, &found);
    if (strcmp(found, name) == 0)
      return part;
  }
  return NULL;
}

static void a_drawing_answers(celspan_context *context) {
  celspan_svg *svg;
  celspan_box box;
  int32_t line;
  if (!CHECK(read_bytes(context, drawing, &svg) == CELSPAN_OK))
    return;
  CHECK(celspan_svg_size(svg).x == 40 && celspan_svg_size(svg).y == 30);
  CHECK(celspan_svg_part_count(svg) == 2);
  CHECK(part_named(svg, "arm") && part_named(svg, "hand") && !part_named(svg, "m"));
  CHECK(celspan_object_bounds(celspan_svg_object(svg), &box) && box.x < 1 && box.width > 15);
  CHECK(celspan_svg_skipped_count(svg) == 1);
  CHECK_TEXT(celspan_svg_skipped(svg, 0, &line), "foreignObject");
  CHECK(line == 8);
  CHECK(celspan_svg_ref(svg) == svg);
  celspan_svg_unref(svg);
  celspan_svg_unref(svg);
  celspan_svg_unref(NULL);
}

static void parts_are_changed(celspan_context *context) {
  celspan_svg *svg, *other;
  celspan_box before, after;
  double by = 100;
  const celspan_svg_changed change = {"hand", move_right, &by}, none = {"leg", move_right, &by},
                            refused = {"arm", refuse, NULL}, empty = {"arm", NULL, NULL};
  if (!CHECK(read_bytes(context, drawing, &svg) == CELSPAN_OK))
    return;
  if (CHECK(celspan_svg_with(context, svg, &change, 1, &other) == CELSPAN_OK)) {
    CHECK(celspan_object_bounds(part_named(svg, "arm"), &before));
    celspan_svg_unref(svg); /* the other keeps what it has of it */
    CHECK(celspan_object_bounds(part_named(other, "arm"), &after));
    CHECK_NEAR(after.x, before.x + 100, 1e-9);
    CHECK(celspan_svg_skipped_count(other) == 1);
    svg = other;
  }
  CHECK(celspan_svg_with(context, svg, &none, 1, &other) == CELSPAN_BAD_ARGUMENT);
  CHECK_TEXT(celspan_context_error(context), "svg: there is no part \"leg\"");
  CHECK(celspan_svg_with(context, svg, &refused, 1, &other) == CELSPAN_CANCELLED);
  CHECK(celspan_svg_with(context, svg, &empty, 1, &other) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_svg_with(context, svg, NULL, 1, &other) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_svg_with(context, NULL, &change, 1, &other) == CELSPAN_BAD_ARGUMENT);
  if (CHECK(celspan_svg_with(context, svg, NULL, 0, &other) == CELSPAN_OK))
    celspan_svg_unref(other);
  celspan_svg_unref(svg);
}

static void faults_are_reported(celspan_context *context) {
  celspan_svg_desc desc = CELSPAN_SVG_DESC;
  celspan_svg *svg;
  CHECK(celspan_svg_read(context, NULL, &svg) == CELSPAN_BAD_ARGUMENT);
  CHECK(celspan_svg_read(context, &desc, &svg) == CELSPAN_BAD_ARGUMENT);
  desc.struct_size = 1;
  CHECK(celspan_svg_read(context, &desc, &svg) == CELSPAN_BAD_ARGUMENT);
  desc = CELSPAN_SVG_DESC;
  desc.file = "/no/such.svg";
  CHECK(celspan_svg_read(context, &desc, &svg) == CELSPAN_INPUT);
  CHECK_TEXT(celspan_context_error(context), "/no/such.svg: No such file or directory");
  CHECK(read_bytes(context,
                   "<svg xmlns='http://www.w3.org/2000/svg'>\n<path stroke-width='nan'/></svg>",
                   &svg) == CELSPAN_INPUT);
  CHECK(strstr(celspan_context_error(context), "a.svg:2: stroke-width is \"nan\""));
}

/* The reader of a colour stays within its text. */
static void a_colour_may_lack_its_end(void) {
  static const char *const texts[] = {"rgb(1, 2, 3", "hsl(1, 2%, 3%, .5", "rgba(1"};
  for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
    const char *end = texts[i];
    cs_svg_colour colour;
    CHECK(!cs_svg_take_colour(&end, &colour));
    CHECK(end <= texts[i] + strlen(texts[i]));
  }
}

/* Everything with memory of its own: clip paths, masks, markers, gradients, texts, images. */
/* Styles in every form, and what is noted of them. */
/* A clock that knows one animation: from 0 to 10 in a second. */
static celspan_status move_first(void *user, cs_svg_mover *mover, double *seconds) {
  const cs_svg_mixture mixture = {
      .from = {.text = "0"}, .to = {.text = "10"}, .share = mover->reading->seconds};
  (void)user;
  *seconds = 1;
  if (mixture.share < 0)
    return CELSPAN_OK;
  CHECK(mover->count == 1);
  return cs_svg_mover_mix(mover, &mover->animations[0], &mixture);
}

static double left_of(const celspan_svg *svg) {
  celspan_box box;
  return celspan_object_bounds(celspan_svg_object(svg), &box) ? box.x : -1;
}

/* Hosts that cannot ask for other times do not pay for a copy of the file. */
static void a_file_is_kept_where_it_is_asked_for(celspan_context *context) {
  static const char text[] =
      "<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'><rect width='9' height='9'>"
      "<animate attributeName='x' to='5' dur='1s'/></rect></svg>";
  char path[] = "/tmp/celspan-test-XXXXXX";
  celspan_svg_desc desc = CELSPAN_SVG_DESC;
  celspan_svg *without = NULL, *with = NULL, *later = NULL;
  int file = mkstemp(path);
  CHECK(file >= 0 && write(file, text, sizeof text - 1) == (ssize_t)sizeof text - 1);
  desc.file = path;
  const cs_svg_clock clock = {move_first, NULL};
  const cs_svg_options options = {.clock = &clock};
  if (CHECK(celspan_svg_read(context, &desc, &without) == CELSPAN_OK &&
            cs_svg_read_file(context, path, &options, &with) == CELSPAN_OK)) {
    CHECK(!without->file && with->file);
    CHECK(without->seconds == 0 && with->seconds == 1);
    CHECK(cs_svg_at(context, without, &clock, 0.5, &later) == CELSPAN_OK && later == without);
    celspan_svg_unref(later);
    CHECK(cs_svg_at(context, with, &clock, 0.5, &later) == CELSPAN_OK && later != with);
    CHECK(left_of(with) == 0 && left_of(later) == 5);
    celspan_svg_unref(later);
  }
  celspan_svg_unref(without);
  celspan_svg_unref(with);
  close(file);
  unlink(path);
}

static const char styled_drawing[] =
    "<svg xmlns='http://www.w3.org/2000/svg' width='40' height='30'>\n"
    "<style>:root{--a:red;--b:var(--a)} rect{width:9px;height:9px;fill:var(--b);unheard:1}\n"
    "path{d:path('M0 0H9V9');stroke:oklch(.5 .1 20);zoom:2;rx:2} g{a{fill:red}}</style>\n"
    "<g id='hand' style='--c:5px;translate:var(--c);opacity:x' unknown='1'>\n"
    "<rect/><path stroke-dasharray='1' pathLength='9'/><blink/>\n"
    "<text dominant-baseline='middle'>A<tspan baseline-shift='super'>B</tspan></text></g>\n"
    "<linearGradient id='l'><stop stop-color='red'/><stop offset='1'/></linearGradient>\n"
    "<g id='u'><rect fill='context-fill'/><use href='#u'/></g>\n"
    "<use href='#u' fill='url(#l)' style='--a:hwb(9 9% 9%)'/>\n"
    "</svg>";

static const char rich_drawing[] =
    "<svg xmlns='http://www.w3.org/2000/svg' width='40' height='30' viewBox='0 0 80 60'>\n"
    "<style>g > .a[id^=h], #none { fill: lime } @media x { rect { fill: red } }</style>\n"
    "<linearGradient id='l' spreadMethod='reflect' x2='.2'><stop stop-color='red'/>\n"
    "  <stop offset='1' stop-opacity='0'/></linearGradient>\n"
    "<radialGradient id='r' href='#l' fr='.1' spreadMethod='repeat'/>\n"
    "<clipPath id='c'><use href='#d'/><text y='9'>A</text></clipPath>\n"
    "<clipPath id='b' clip-path='url(#c)' clipPathUnits='objectBoundingBox'>"
    "<rect width='1' height='1'/></clipPath>\n"
    "<mask id='k'><g opacity='.5'><use href='#d'/></g><path d='M20 20h9' stroke='red'/></mask>\n"
    "<marker id='m' viewBox='0 0 2 2' markerUnits='userSpaceOnUse'>"
    "<circle r='2' fill='context-stroke'/></marker>\n"
    "<symbol id='y' viewBox='0 0 9 9'><ellipse id='d' cx='5' cy='5' rx='4' ry='3'/></symbol>\n"
    "<g id='hand' clip-path='url(#b)' opacity='.5' mask='url(#k)'>\n"
    "  <rect id='h' class='a' width='20' height='20' rx='3' clip-path='inset(1)'/>\n"
    "  <use href='#y' width='20' height='20'/><svg x='9' width='9' height='9' viewBox='0 0 1 1'>"
    "<line x2='1' y2='1' stroke='url(#r)' stroke-width='.1'/></svg></g>\n"
    "<path d='M5 50H40C50 60 60 40 70 50' fill='url(#l)' stroke='url(#r) blue' marker='url(#m)'\n"
    "  marker-start='url(#m)' paint-order='markers' vector-effect='non-scaling-stroke'/>\n"
    "<path id='w' d='M0 30Q20 0 70 30'/>\n"
    "<text x='9 12' rotate='9' textLength='30' stroke='red'>AB<tspan opacity='.5'>C</tspan>\n"
    "  <textPath href='#w' startOffset='20%'>DE</textPath></text>\n"
    "<switch><g systemLanguage='xx'/><g filter='url(#none)'><image width='9'\n"
    "  height='9' preserveAspectRatio='xMidYMid slice'\n"
    "  href=\"data:image/svg+xml,%3Csvg xmlns='http://www.w3.org/2000/svg' width='2' "
    "height='1'%3E%3Crect "
    "width='1' height='1' filter='x'/%3E%3C/svg%3E\"/></g></switch>\n"
    "<image x='20' width='9' height='9' href='data:image/png;base64,"
    "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR4nGP4z8DQAAAEgQGALFXOsAAAAABJRU5ErkJggg"
    "=='/>\n"
    "</svg>";

/* Reads the drawing and changes a part; the allocation with the number `fail_at` fails. */
static celspan_status read_and_change(celspan_context *context, memory_watch *watch,
                                      const char *text, size_t fail_at) {
  celspan_svg *svg, *other;
  double by = 7;
  const celspan_svg_changed change = {"hand", move_right, &by};
  watch->fail_at = watch->allocations + fail_at;
  celspan_status status = read_bytes(context, text, &svg);
  if (status == CELSPAN_OK) {
    status = celspan_svg_with(context, svg, &change, 1, &other);
    if (status == CELSPAN_OK)
      celspan_svg_unref(other);
    celspan_svg_unref(svg);
  }
  watch->fail_at = 0;
  return status;
}
/* The places of parts are left out if the names of their files cannot be kept. A drawing has
 * few. */
enum { NAMES_MOST = 2 };

/* Whichever allocation fails, alone or with all that follow: the status says so, nothing leaks, and
 * the context stays usable. */
static void memory_may_fail_anywhere(const char *text, bool is_for_good) {
  bool is_done = false;
  int names = 0;
  for (size_t fail_at = 1; fail_at < 5000 && !is_done; fail_at++) {
    if (!check_is_drawn((int)fail_at))
      continue;
    memory_watch watch = {.is_for_good = is_for_good};
    celspan_context *context = memory_watch_context(&watch);
    size_t before = watch.allocations;
    celspan_status status = read_and_change(context, &watch, text, fail_at);
    is_done = status == CELSPAN_OK && watch.allocations < before + fail_at;
    names += !is_done && status == CELSPAN_OK;
    CHECK(is_done ? fail_at > 20 : status == CELSPAN_NO_MEMORY || names <= NAMES_MOST);
    CHECK(fail_at % 8 != 1 || read_and_change(context, &watch, text, SIZE_MAX / 2) == CELSPAN_OK);
    celspan_context_destroy(context);
    CHECK(watch.blocks == 0 && watch.bytes == 0 && watch.size_errors == 0);
  }
  CHECK(is_done);
}

int main(void) {
  celspan_context *context;
  if (!CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK))
    return check_done();
  a_drawing_answers(context);
  parts_are_changed(context);
  faults_are_reported(context);
  a_file_is_kept_where_it_is_asked_for(context);
  celspan_context_destroy(context);
  a_colour_may_lack_its_end();
  for (int is_for_good = 0; is_for_good < 2; is_for_good++) {
    memory_may_fail_anywhere(drawing, is_for_good);
    memory_may_fail_anywhere(rich_drawing, is_for_good);
    memory_may_fail_anywhere(styled_drawing, is_for_good);
  }
  return check_done();
}
