/* XML through the art module: what is read, what is refused and where.
 */
#include "artwork/xml.h"

#include <stdlib.h>

#include "artwork/artwork.h"
#include "tests/support/check.h"

static celspan_context *context;

typedef struct record {
  char text[2000];
  size_t used;
  const char *stop_at; /* an element at which the handler fails */
  celspan_status failure;
} record;

static void say(record *out, const char *text, size_t size) {
  if (out->used + size < sizeof out->text) {
    memcpy(out->text + out->used, text, size);
    out->used += size;
    out->text[out->used] = 0;
  }
}

static bool on_start(void *user, const char *name, const char *const *attributes, uint64_t line) {
  record *out = user;
  char piece[300];
  if (out->stop_at && strcmp(name, out->stop_at) == 0) {
    out->failure = cs_fail(context, CELSPAN_BAD_ARGUMENT, "stopped");
    return false;
  }
  say(out, piece, (size_t)snprintf(piece, sizeof piece, "<%s@%d", name, (int)line));
  for (; *attributes; attributes += 2)
    say(out, piece, (size_t)snprintf(piece, sizeof piece, " %s=%s", attributes[0], attributes[1]));
  say(out, ">", 1);
  return true;
}

static bool on_end(void *user, const char *name, uint64_t line) {
  (void)name, (void)line;
  say(user, "</>", 3);
  return true;
}

static bool on_text(void *user, const char *bytes, size_t size, uint64_t line) {
  (void)line;
  say(user, bytes, size);
  return true;
}

static celspan_status parse_bytes(record *out, const char *bytes, size_t size) {
  const cs_xml_handler handler = {on_start, on_end, on_text, out, 8};
  return cs_xml_parse(context, "a.xml", "a test", bytes, size, &handler, &out->failure);
}

static void check_reads(const char *text, const char *expected) {
  record out = {.used = 0};
  if (CHECK(parse_bytes(&out, text, strlen(text)) == CELSPAN_OK))
    CHECK_TEXT(out.text, expected);
  else
    fprintf(stderr, "  %s\n", celspan_context_error(context));
}

static void check_refuses(const char *text, celspan_status expected, const char *message) {
  record out = {.used = 0};
  CHECK(parse_bytes(&out, text, strlen(text)) == expected);
  CHECK_TEXT(celspan_context_error(context), message);
}

static void documents_are_read(void) {
  check_reads("<a/>", "<a@1></>");
  check_reads("<a b='1' c='&amp;&#65;'>x<d/>\n<!-- no --><e><![CDATA[<]]></e></a>",
              "<a@1 b=1 c=&A>x<d@1></>\n<e@2><</></>");
  check_reads("<s:a xmlns:s='u' xmlns='v' s:b='1' c='2'><d/></s:a>",
              "<u a@1 u b=1 c=2><v d@1></></>");
  check_reads("<!DOCTYPE a PUBLIC 'x' 'http://nowhere/x.dtd'>\n<a/>", "<a@2></>");
  check_reads("<?xml version='1.0' encoding='ISO-8859-1'?><a b='\xe9'/>", "<a@1 b=\xc3\xa9></>");
}

static void faults_have_lines(void) {
  check_refuses("", CELSPAN_INPUT, "a.xml:1: no element found");
  check_refuses("<a>\n<b></a>", CELSPAN_INPUT, "a.xml:2: mismatched tag");
  check_refuses("<a>\n\n<b", CELSPAN_INPUT, "a.xml:3: unclosed token");
  check_refuses("<a x='1' x='2'/>", CELSPAN_INPUT, "a.xml:1: duplicate attribute");
  check_refuses("<q:a/>", CELSPAN_INPUT, "a.xml:1: unbound prefix");
  check_refuses("<!DOCTYPE a [\n<!ENTITY b 'cc'>]>\n<a>&b;</a>", CELSPAN_INPUT,
                "a.xml:2: the entity \"b\" is declared; entities are not expanded: write out what "
                "they stand for");
  check_refuses("<!DOCTYPE a [<!ENTITY b SYSTEM '/etc/passwd'>]>\n<a>&b;</a>", CELSPAN_INPUT,
                "a.xml:1: the entity \"b\" is declared; entities are not expanded: write out what "
                "they stand for");
  check_refuses("<?xml version='1.0' encoding='x-none'?><a/>", CELSPAN_INPUT,
                "a.xml:1: unknown encoding");
}

static void nesting_has_a_limit(void) {
  check_reads("<a><a><a><a><a><a><a><a/></a></a></a></a></a></a></a>",
              "<a@1><a@1><a@1><a@1><a@1><a@1><a@1><a@1></></></></></></></></>");
  check_refuses("<a><a><a><a><a><a><a>\n<a><a/></a></a></a></a></a></a></a></a>", CELSPAN_LIMIT,
                "a.xml:2: elements are nested more than 8 deep");
}

static void a_handler_can_stop(void) {
  record out = {.stop_at = "b"};
  const char *text = "<a><b/><c/></a>";
  CHECK(parse_bytes(&out, text, strlen(text)) == CELSPAN_BAD_ARGUMENT);
  CHECK_TEXT(celspan_context_error(context), "stopped");
  CHECK_TEXT(out.text, "<a@1>");
}

static void every_cut_is_refused(void) {
  const char *text = "<a b='1'>x<d/>\n<!-- no --><e><![CDATA[<]]></e></a>";
  for (size_t size = 0; size < strlen(text); size++) {
    record out = {.used = 0};
    CHECK(parse_bytes(&out, text, size) == CELSPAN_INPUT);
  }
}

/* Larger than what is handed to expat at a time. */
static void large_documents_are_read(void) {
  size_t size = 5u << 20;
  char *text = malloc(size);
  if (!CHECK(text))
    return;
  memset(text, ' ', size);
  memcpy(text, "<a>", 3);
  memcpy(text + size - 4, "</a>", 4);
  record out = {.used = 0};
  CHECK(parse_bytes(&out, text, size) == CELSPAN_OK);
  free(text);
}

static void a_missing_module_is_told(void) {
  celspan_context *other;
  if (!CHECK(celspan_context_create(NULL, &other) == CELSPAN_OK))
    return;
  setenv("CELSPAN_ART_MODULE", "/nowhere/art.so", 1);
  const cs_art_module *module;
  CHECK(cs_artwork_module(other, "reading SVG", &module) == CELSPAN_INPUT);
  CHECK(strstr(celspan_context_error(other),
               "reading SVG needs the module celspan-art.so, which was not found at "
               "/nowhere/art.so"));
  unsetenv("CELSPAN_ART_MODULE");
  CHECK(cs_artwork_module(other, "reading SVG", &module) == CELSPAN_OK);
  celspan_context_destroy(other);
}

int main(void) {
  if (!CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK))
    return check_done();
  documents_are_read();
  faults_have_lines();
  nesting_has_a_limit();
  a_handler_can_stop();
  every_cut_is_refused();
  large_documents_are_read();
  a_missing_module_is_told();
  celspan_context_destroy(context);
  return check_done();
}
