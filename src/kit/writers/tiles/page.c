#include "writers/tiles/page.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "inside/context.h"
#include "inside/sinks.h"

/* page.html, which has marks for its script and its data, and viewer.js; each ends with a zero. */
extern const unsigned char cs_tile_page_html[], cs_tile_page_viewer[];

#define OPENSEADRAGON "/openseadragon/openseadragon.min.js" /* below the folder of the page */

enum { PATH_SIZE = 4096 };

/* ---------------------------------------------------------------- text files */

/* A text that is written in parts, until the first failure. */
typedef struct text_file {
  celspan_context *context;
  cs_file *file;
  celspan_status status;
} text_file;

static void put_bytes(text_file *out, const char *bytes, size_t size) {
  if (out->status == CELSPAN_OK)
    out->status = cs_file_write(out->file, out->context, bytes, size);
}

static void put(text_file *out, const char *text) { put_bytes(out, text, strlen(text)); }

__attribute__((format(printf, 2, 3))) static void put_line(text_file *out, const char *format,
                                                           ...) {
  char text[512];
  va_list arguments;
  va_start(arguments, format);
  int length = vsnprintf(text, sizeof text, format, arguments);
  va_end(arguments);
  if (length > 0)
    put_bytes(out, text, (size_t)length < sizeof text ? (size_t)length : sizeof text - 1);
}

/* A string of JSON inside a script element: nothing in it can end the element or begin a tag. */
static void put_string(text_file *out, const char *text) {
  put(out, "\"");
  for (; *text; text++)
    if ((unsigned char)*text < ' ' || strchr("\"\\<>&", *text))
      put_line(out, "\\u%04x", (unsigned char)*text);
    else
      put_bytes(out, text, 1);
  put(out, "\"");
}

static celspan_status open_text(celspan_context *context, const char *path, text_file *out) {
  *out = (text_file){.context = context, .status = CELSPAN_OK};
  return cs_file_create(context, NULL, path, &out->file);
}

static celspan_status close_text(text_file *out) {
  return cs_file_end(out->file, out->context, out->status);
}

/* ---------------------------------------------------------------- descriptions */

static void put_dzi(text_file *out, const cs_pyramid *pyramid) {
  put_line(out,
           "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
           "<Image xmlns=\"http://schemas.microsoft.com/deepzoom/2008\" Format=\"%s\" "
           "Overlap=\"%d\" TileSize=\"%d\">\n"
           "  <Size Width=\"%d\" Height=\"%d\"/>\n"
           "</Image>\n",
           pyramid->ending, pyramid->overlap, pyramid->tile, pyramid->width, pyramid->height);
}

/* Static files do not know their address on a server: users write it into "id". */
static void put_info(text_file *out, const cs_pyramid *pyramid) {
  int32_t single = cs_pyramid_single(pyramid), top = cs_pyramid_top(pyramid), width, height;
  put(out, "{\n  \"@context\": \"http://iiif.io/api/image/3/context.json\",\n"
           "  \"id\": \"http://localhost:8000/");
  for (const char *c = pyramid->name; *c; c++)
    if (strchr(" %\"\\<>?#", *c))
      put_line(out, "%%%02X", (unsigned char)*c);
    else
      put_bytes(out, c, 1);
  put_line(out,
           "\",\n  \"type\": \"ImageService3\",\n  \"protocol\": \"http://iiif.io/api/image\",\n"
           "  \"profile\": \"level0\",\n  \"width\": %d,\n  \"height\": %d,\n",
           pyramid->width, pyramid->height);
  put_line(out, "  \"tiles\": [{ \"width\": %d, \"height\": %d, \"scaleFactors\": [", pyramid->tile,
           pyramid->tile);
  for (int32_t level = top; level >= single; level--)
    put_line(out, "%s%d", level < top ? ", " : "", (int32_t)1 << (top - level));
  cs_pyramid_size(pyramid, single, &width, &height);
  put_line(out, "] }],\n  \"sizes\": [{ \"width\": %d, \"height\": %d }]", width, height);
  if (strcmp(pyramid->ending, "jpg") != 0)
    put_line(out, ",\n  \"preferredFormats\": [\"%s\"],\n  \"extraFormats\": [\"%s\"]",
             pyramid->ending, pyramid->ending);
  put(out, "\n}\n");
}

static celspan_status write_description(celspan_context *context, const cs_pyramid *pyramid) {
  char path[PATH_SIZE];
  text_file out;
  if (!cs_pyramid_description_path(pyramid, path, sizeof path))
    return cs_pyramid_too_long(context, pyramid);
  CS_TRY(open_text(context, path, &out));
  if (pyramid->layout == CS_PYRAMID_DZI)
    put_dzi(&out, pyramid);
  else
    put_info(&out, pyramid);
  return close_text(&out);
}

/* ---------------------------------------------------------------- the page */

/* The existing tiles, as rectangles [level, row, end of rows, column, end of columns]. */
static void put_coverage(text_file *out, const cs_tile_log *log) {
  for (size_t i = 0; i < log->count;) {
    cs_tile_row first = log->rows[i];
    size_t end = i + 1;
    while (end < log->count && log->rows[end].level == first.level &&
           log->rows[end].first == first.first && log->rows[end].end == first.end &&
           log->rows[end].row == first.row + (int32_t)(end - i))
      end++;
    put_line(out, "%s[%d,%d,%d,%d,%d]", i ? "," : "", first.level, first.row,
             first.row + (int32_t)(end - i), first.first, first.end);
    i = end;
  }
}

/* The places, in pixels of the frame. */
static void put_places(text_file *out, const cs_tile_page *page) {
  double across = page->pyramid->width / page->frame->film_width;
  double down = page->pyramid->height / page->frame->film_height;
  for (size_t i = 0; i < page->plan->place_count; i++) {
    const cs_tile_place *place = &page->plan->places[i];
    put_line(out, "%s\n    [%.9g, %.9g, %.9g, ", i ? "," : "", place->x * across, place->y * down,
             place->width * across);
    put_string(out, place->name);
    put(out, "]");
  }
}

/* Whether the file was copied, by this run or an earlier one. */
static bool has_openseadragon(const cs_pyramid *pyramid) {
  char path[PATH_SIZE];
  int length = snprintf(path, sizeof path, "%s" OPENSEADRAGON, pyramid->folder);
  return length < (int)sizeof path && access(path, R_OK) == 0;
}

static void put_data(text_file *out, const cs_tile_page *page) {
  const cs_pyramid *pyramid = page->pyramid;
  put(out, "{\n  \"name\": ");
  put_string(out, pyramid->name);
  put(out, ",\n  \"title\": ");
  put_string(out, page->title);
  put_line(out,
           ",\n  \"layout\": \"%s\", \"ending\": \"%s\", \"background\": \"%s\",\n"
           "  \"openseadragon\": %s,\n"
           "  \"width\": %d, \"height\": %d, \"tile\": %d, \"overlap\": %d,\n",
           pyramid->layout == CS_PYRAMID_DZI ? "dzi" : "iiif", pyramid->ending, page->background,
           has_openseadragon(pyramid) ? "true" : "false", pyramid->width, pyramid->height,
           pyramid->tile, pyramid->overlap);
  put(out, "  \"places\": [");
  put_places(out, page);
  put(out, "],\n  \"tiles\": [");
  put_coverage(out, page->log);
  put(out, "]\n}");
}

/* Writes the text up to a mark, which is in it, and moves *text behind the mark. */
static void put_until(text_file *out, const char **text, const char *mark) {
  const char *at = strstr(*text, mark);
  put_bytes(out, *text, (size_t)(at - *text));
  *text = at + strlen(mark);
}

static celspan_status write_page(celspan_context *context, const cs_tile_page *page) {
  const char *html = (const char *)cs_tile_page_html;
  char path[PATH_SIZE];
  text_file out;
  if (snprintf(path, sizeof path, "%s/index.html", page->pyramid->folder) >= (int)sizeof path)
    return cs_pyramid_too_long(context, page->pyramid);
  CS_TRY(open_text(context, path, &out));
  put_until(&out, &html, "@VIEWER@");
  put(&out, (const char *)cs_tile_page_viewer);
  put_until(&out, &html, "@PYRAMID@");
  put_data(&out, page);
  put(&out, html);
  return close_text(&out);
}

celspan_status cs_tile_page_write(celspan_context *context, const cs_tile_page *page) {
  CS_TRY(write_description(context, page->pyramid));
  return write_page(context, page);
}

/* ---------------------------------------------------------------- the viewer */

static celspan_status copy_all(text_file *out, FILE *in, const char *path) {
  char bytes[16384];
  size_t size;
  while ((size = fread(bytes, 1, sizeof bytes, in)) > 0)
    put_bytes(out, bytes, size);
  if (ferror(in) && out->status == CELSPAN_OK)
    out->status =
        cs_fail(out->context, CELSPAN_INPUT, "%s: cannot be read: %s", path, strerror(errno));
  return close_text(out);
}

/* Opens a file of at least one byte. A folder can be opened, but not read. */
static FILE *open_filled(const char *path) {
  FILE *file = fopen(path, "rb");
  if (!file)
    return NULL;
  if (getc(file) == EOF) {
    fclose(file);
    return NULL;
  }
  rewind(file);
  return file;
}

static FILE *open_viewer(const char *from, char path[PATH_SIZE]) {
  static const char *const PLACES[] = {"", "/openseadragon.min.js",
                                       "/build/openseadragon/openseadragon.min.js"};
  for (size_t i = 0; i < sizeof PLACES / sizeof *PLACES; i++) {
    int length = snprintf(path, PATH_SIZE, "%s%s", from, PLACES[i]);
    size_t ending = length > 3 ? (size_t)length - 3 : 0;
    FILE *file = length < PATH_SIZE && strcmp(path + ending, ".js") == 0 ? open_filled(path) : NULL;
    if (file)
      return file;
  }
  return NULL;
}

static celspan_status find_viewer(celspan_context *context, const char *from, char path[PATH_SIZE],
                                  FILE **out) {
  *out = open_viewer(from, path);
  return *out ? CELSPAN_OK
              : cs_fail(context, CELSPAN_INPUT,
                        "--viewer %s: it contains no readable openseadragon.min.js", from);
}

celspan_status cs_tile_page_find_viewer(celspan_context *context, const char *from) {
  char path[PATH_SIZE];
  FILE *file;
  CS_TRY(find_viewer(context, from, path, &file));
  fclose(file);
  return CELSPAN_OK;
}

celspan_status cs_tile_page_copy_viewer(celspan_context *context, const cs_pyramid *pyramid,
                                        const char *from) {
  char path[PATH_SIZE], to[PATH_SIZE];
  text_file out;
  FILE *in;
  CS_TRY(find_viewer(context, from, path, &in));
  celspan_status status = CELSPAN_OK;
  if (snprintf(to, sizeof to, "%s" OPENSEADRAGON, pyramid->folder) >= (int)sizeof to)
    status = cs_pyramid_too_long(context, pyramid);
  if (status == CELSPAN_OK)
    status = open_text(context, to, &out);
  if (status == CELSPAN_OK)
    status = copy_all(&out, in, path);
  fclose(in);
  return status;
}
