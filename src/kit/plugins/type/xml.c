/* XML documents through expat, element by element. */
#include "plugins/type/parts.h"

/* The header declares the functions that limit the growth of entities only if this is defined; the
 * libraries of distributions are built with it. */
#define XML_DTD
#include <errno.h>
#include <expat.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Bytes that expat gets at a time, because it counts them in an int. */
#define PIECE_BYTES (1 << 20)
/* The most bytes of one entity's text, as the message about it says. */
#define ENTITY_BYTES 1024
/* Entities may make a document this many times as large, and any to this many bytes. */
#define GROWTH 2
#define GROWN_BYTES (1 << 20)

typedef struct document {
  XML_Parser parser;
  const cs_xml_handler *handler;
  cs_type_failure *failure;
  uint32_t depth; /* elements that are open */
} document;

static celspan_status fail(document *doc, celspan_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
static celspan_status fail(document *doc, celspan_status status, const char *format, ...) {
  va_list arguments;
  va_start(arguments, format);
  vsnprintf(doc->failure->text, sizeof doc->failure->text, format, arguments);
  va_end(arguments);
  doc->failure->status = status;
  doc->failure->line = XML_GetCurrentLineNumber(doc->parser);
  return status;
}

static void stop(document *doc) { XML_StopParser(doc->parser, XML_FALSE); }

/* After a stop expat may still make calls that belong to the same token. */
static bool is_stopped(const document *doc) {
  XML_ParsingStatus status;
  XML_GetParsingStatus(doc->parser, &status);
  return status.parsing == XML_FINISHED;
}

static void on_start(void *user, const XML_Char *name, const XML_Char **attributes) {
  document *doc = user;
  if (is_stopped(doc))
    return;
  if (doc->depth >= doc->handler->depth) {
    fail(doc, CELSPAN_LIMIT, "elements are nested more than %u deep", doc->handler->depth);
    stop(doc);
    return;
  }
  doc->depth++;
  if (!doc->handler->start(doc->handler->user, name, (const char *const *)attributes,
                           XML_GetCurrentLineNumber(doc->parser)))
    stop(doc);
}

static void on_end(void *user, const XML_Char *name) {
  document *doc = user;
  if (is_stopped(doc))
    return;
  doc->depth--;
  if (!doc->handler->end(doc->handler->user, name, XML_GetCurrentLineNumber(doc->parser)))
    stop(doc);
}

static void on_text(void *user, const XML_Char *bytes, int size) {
  document *doc = user;
  if (!is_stopped(doc) && !doc->handler->text(doc->handler->user, bytes, (size_t)size,
                                              XML_GetCurrentLineNumber(doc->parser)))
    stop(doc);
}

/* Why an entity may not be declared; NULL: it may be. Refused are entities of the document type
 * itself and those in other files, by which one file reads another; and those made of other
 * entities, by which a small file grows without bound. value: the text, with character references
 * replaced; NULL for another file. */
static const char *refusal_of(const XML_Char *value, int size, int is_parameter) {
  if (is_parameter)
    return "is a parameter entity, which is not read";
  if (!value)
    return "is in another file, which is not read";
  if (size > ENTITY_BYTES)
    return "is longer than 1,024 bytes";
  return memchr(value, '&', (size_t)size) ? "refers to other entities, which is not allowed" : NULL;
}

static void on_entity(void *user, const XML_Char *name, int is_parameter, const XML_Char *value,
                      int value_size, const XML_Char *base, const XML_Char *system_id,
                      const XML_Char *public_id, const XML_Char *notation) {
  (void)base, (void)system_id, (void)public_id, (void)notation;
  document *doc = user;
  const char *reason = refusal_of(value, value_size, is_parameter);
  if (is_stopped(doc) || !reason)
    return;
  fail(doc, CELSPAN_INPUT, "the entity \"%.100s\" %s: write out what it stands for", name, reason);
  stop(doc);
}

/* An entity without a declaration, which another file might contain. */
static void on_skipped(void *user, const XML_Char *name, int is_parameter) {
  document *doc = user;
  if (is_stopped(doc) || is_parameter)
    return;
  fail(doc, CELSPAN_INPUT,
       "the entity \"%.100s\" is not declared here: write out what it stands for", name);
  stop(doc);
}

static XML_Parser create_parser(document *doc) {
  XML_Parser parser = XML_ParserCreateNS(NULL, ' ');
  if (!parser)
    return NULL;
  XML_SetUserData(parser, doc);
  XML_SetElementHandler(parser, on_start, on_end);
  XML_SetCharacterDataHandler(parser, on_text);
  XML_SetEntityDeclHandler(parser, on_entity);
  XML_SetSkippedEntityHandler(parser, on_skipped);
  XML_SetBillionLaughsAttackProtectionMaximumAmplification(parser, GROWTH);
  XML_SetBillionLaughsAttackProtectionActivationThreshold(parser, GROWN_BYTES);
  return parser;
}

static celspan_status parse(document *doc, const char *bytes, size_t size) {
  size_t done = 0;
  errno = 0;
  do {
    size_t piece = size - done < PIECE_BYTES ? size - done : PIECE_BYTES;
    bool is_last = done + piece == size;
    if (XML_Parse(doc->parser, bytes + done, (int)piece, is_last) != XML_STATUS_OK) {
      enum XML_Error error = XML_GetErrorCode(doc->parser);
      /* in this case expat may report another error */
      if (error == XML_ERROR_NO_MEMORY || errno == ENOMEM)
        return fail(doc, CELSPAN_NO_MEMORY, "out of memory");
      if (error == XML_ERROR_ABORTED)
        return doc->failure->status != CELSPAN_OK ? doc->failure->status : CELSPAN_CANCELLED;
      if (error == XML_ERROR_AMPLIFICATION_LIMIT_BREACH)
        return fail(doc, CELSPAN_LIMIT, "entities make the document more than %d times as large",
                    GROWTH);
      return fail(doc, CELSPAN_INPUT, "%s", XML_ErrorString(error));
    }
    done += piece;
  } while (done < size);
  return CELSPAN_OK;
}

celspan_status cs_xml_parse_bytes(const char *bytes, size_t size, const cs_xml_handler *handler,
                                  cs_type_failure *failure) {
  failure->status = CELSPAN_OK;
  document doc = {.handler = handler, .failure = failure};
  doc.parser = create_parser(&doc);
  if (!doc.parser) {
    failure->status = CELSPAN_NO_MEMORY;
    return CELSPAN_NO_MEMORY;
  }
  celspan_status status = parse(&doc, bytes, size);
  XML_ParserFree(doc.parser);
  return status;
}
