/* The interface of the type module (src/kit/plugins/type, over expat, HarfBuzz, FriBidi and
 * libunibreak): a table of C functions.
 *
 *   bytes of a file --module: parse--> elements, attributes, text --readers--> scene values
 *
 * The module knows libraries, and the readers know what documents mean.
 *
 * INVARIANT: no memory changes its owner, nothing outside the bytes is read, and every failure
 * comes with a sentence.
 */
#pragma once

#include "readers/type/letters.h"

#define CS_TYPE_MODULE_VERSION 4u

typedef struct cs_type_failure {
  celspan_status status;
  uint64_t line; /* the line of the document, from 1; 0: not known */
  char text[512];
} cs_type_failure;

/* The contents of an XML document, in its order. Names are "local", or "namespace local" with one
 * blank between them; everything is UTF-8 and borrowed. If a function returns false, parsing stops
 * with the status CANCELLED. */
typedef struct cs_xml_handler {
  /* attributes: name, value, name, value, ... NULL */
  bool (*start)(void *user, const char *name, const char *const *attributes, uint64_t line);
  bool (*end)(void *user, const char *name, uint64_t line);
  /* in pieces of any size */
  bool (*text)(void *user, const char *bytes, size_t size, uint64_t line);
  void *user;
  uint32_t depth; /* the most elements that may be open at a time, 1 or more */
} cs_xml_handler;

typedef struct cs_type_module {
  uint32_t version;
  /* Errors: INPUT for a document that is not well-formed, that declares entities made of others or
   * lying in other files, or whose encoding is not UTF-8, UTF-16, ISO-8859-1 or ASCII; LIMIT for
   * one that nests too deeply, or that entities make too large; NO_MEMORY; CANCELLED. */
  celspan_status (*parse_xml)(const char *bytes, size_t size, const cs_xml_handler *handler,
                              cs_type_failure *failure);
  const cs_type_functions *type;
} cs_type_module;

/* The module's one symbol. */
CELSPAN_API const void *celspan_type_module(void);
