/* XML through the type module: what is read, what is refused and where.
 */
#include "readers/type/xml.h"

#include <stdlib.h>

#include "readers/type/type_module.h"
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
  check_refuses("<?xml version='1.0' encoding='x-none'?><a/>", CELSPAN_INPUT,
                "a.xml:1: unknown encoding");
}

static void entities_of_plain_text_are_read(void) {
  check_reads(
      "<!DOCTYPE a [<!ENTITY b 'c'><!ENTITY e '<d f=\"&#65;\"/>'>]><a g='&b;&b;'>&b;\n&e;</a>",
      "<a@1 g=cc>c\n<d@2 f=A></></>");
  check_reads("<!DOCTYPE a [<!ENTITY ns 'u'>]><a xmlns='&ns;'/>", "<u a@1></>");
}

static void other_entities_are_refused(void) {
  check_refuses(
      "<!DOCTYPE a [\n<!ENTITY b 'cc'><!ENTITY d '&b;&b;'>]>\n<a/>", CELSPAN_INPUT,
      "a.xml:2: the entity \"d\" refers to other entities, which is not allowed: write out what it "
      "stands for");
  check_refuses(
      "<!DOCTYPE a [<!ENTITY b '&#38;b;'>]><a>&b;</a>", CELSPAN_INPUT,
      "a.xml:1: the entity \"b\" refers to other entities, which is not allowed: write out what it "
      "stands for");
  check_refuses("<!DOCTYPE a [<!ENTITY b SYSTEM '/etc/passwd'>]>\n<a>&b;</a>", CELSPAN_INPUT,
                "a.xml:1: the entity \"b\" is in another file, which is not read: write out "
                "what it stands for");
  check_refuses("<!DOCTYPE a [<!ENTITY % b '<!ENTITY c \"d\">'> %b;]>\n<a>&c;</a>", CELSPAN_INPUT,
                "a.xml:1: the entity \"b\" is a parameter entity, which is not read: "
                "write out what it stands for");
  check_refuses("<!DOCTYPE a SYSTEM 'x.dtd'><a>\n&nbsp;</a>", CELSPAN_INPUT,
                "a.xml:2: the entity \"nbsp\" is not declared here: write out what it stands for");
}

/* `count` references to an entity of `size` bytes, in an attribute or as text. */
static celspan_status parse_grown(size_t size, size_t count, bool is_attribute) {
  const size_t room = 200 + size + 3 * count;
  char *text = malloc(room);
  record out = {.used = 0};
  if (!CHECK(text))
    return CELSPAN_NO_MEMORY;
  size_t used = (size_t)snprintf(text, room, "<!DOCTYPE a [<!ENTITY b '");
  memset(text + used, 'x', size);
  used += size;
  used += (size_t)snprintf(text + used, room - used, "'>]>%s", is_attribute ? "<a b='" : "<a>");
  for (size_t i = 0; i < count; i++, used += 3)
    memcpy(text + used, "&b;", 3);
  used += (size_t)snprintf(text + used, room - used, "%s", is_attribute ? "'/>" : "</a>");
  celspan_status status = parse_bytes(&out, text, used);
  free(text);
  return status;
}

static void entities_make_no_bomb(void) {
  CHECK(parse_grown(1024, 100, true) == CELSPAN_OK);
  CHECK(parse_grown(1025, 1, false) == CELSPAN_INPUT);
  CHECK_TEXT(celspan_context_error(context),
             "a.xml:1: the entity \"b\" is longer than 1,024 bytes: "
             "write out what it stands for");
  for (int i = 0; i < 2; i++) {
    CHECK(parse_grown(1024, 2000, i == 0) == CELSPAN_LIMIT);
    CHECK_TEXT(celspan_context_error(context),
               "a.xml:1: entities make the document more than 2 times as large");
  }
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

/* Larger than the parts that are passed to expat. */
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

static void a_missing_module_is_reported(void) {
  celspan_context *other;
  if (!CHECK(celspan_context_create(NULL, &other) == CELSPAN_OK))
    return;
  setenv("CELSPAN_TYPE_MODULE", "/nowhere/type.so", 1);
  const cs_type_module *module;
  CHECK(cs_type_module_load(other, "reading SVG", &module) == CELSPAN_INPUT);
  CHECK(strstr(celspan_context_error(other),
               "reading SVG needs the module celspan-type.so, which was not found at "
               "/nowhere/type.so"));
  unsetenv("CELSPAN_TYPE_MODULE");
  CHECK(cs_type_module_load(other, "reading SVG", &module) == CELSPAN_OK);
  celspan_context_destroy(other);
}

int main(void) {
  if (!CHECK(celspan_context_create(NULL, &context) == CELSPAN_OK))
    return check_done();
  documents_are_read();
  faults_have_lines();
  entities_of_plain_text_are_read();
  other_entities_are_refused();
  entities_make_no_bomb();
  nesting_has_a_limit();
  a_handler_can_stop();
  every_cut_is_refused();
  large_documents_are_read();
  a_missing_module_is_reported();
  celspan_context_destroy(context);
  return check_done();
}
