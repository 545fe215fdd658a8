/* The table of the web module: a server that one thread runs by hand, for 127.0.0.1 alone.
 *
 *   run --> take --> a whole request --> answer --> run       as often as `descriptor` is readable,
 *            ^------------------------------'                 and after the time that run returned
 *
 * Requests may be answered in any order, at any later time.
 *
 * INVARIANT: what a stranger sends has a bound: CS_WEB_HEAD bytes of a request before its body,
 * CS_WEB_BODY bytes of a body, CS_WEB_CONNECTIONS connections, and CS_WEB_IDLE seconds until a
 * request is whole. When all connections are taken, a new one takes the place of the oldest that
 * has no whole request; if all have one, the new one is closed. So slow strangers keep nobody out.
 * A request with two lines for a header that counts is refused: who reads one of them could be
 * deceived by the other.
 */
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "celspan/celspan.h"

#define CS_WEB_MODULE_VERSION 2

enum {
  CS_WEB_HEAD = 8192,
  CS_WEB_BODY = 4096,
  CS_WEB_CONNECTIONS = 32,
  CS_WEB_IDLE = 10,   /* seconds, for a whole request */
  CS_WEB_SENDING = 30 /* seconds, for a client to read an answer */
};

typedef struct cs_web cs_web;

#define CS_WEB_TOKEN "Celspan-Token" /* the header of a request that has a token */

/* A complete request; its texts live until it is answered. Headers that are missing are NULL; none
 * of them was sent twice. */
typedef struct cs_web_request {
  uint64_t id;
  const char *method;
  const char *target; /* path and query as they were sent */
  const char *host, *origin, *token, *site;
  const char *body;
  size_t body_size;
} cs_web_request;

typedef struct cs_web_header {
  const char *name, *value;
} cs_web_header;

typedef struct cs_web_answer {
  unsigned status;
  const cs_web_header *headers;
  size_t header_count;
  const void *bytes; /* copied */
  size_t size;
} cs_web_answer;

/* Counts of refusals since the server was opened. */
typedef struct cs_web_counts {
  uint64_t requests;  /* whole ones */
  uint64_t displaced; /* connections without a complete request that were closed for another one */
  uint64_t refused;   /* connections that found no place */
  uint64_t late;      /* connections that were too slow */
  uint64_t oversized; /* requests whose head or body was too long */
} cs_web_counts;

typedef struct cs_web_module {
  uint32_t version;
  /* port: 0: any free one. Returns 0, or an errno. */
  int (*open)(uint16_t port, cs_web **out);
  uint16_t (*port)(const cs_web *web);
  int (*descriptor)(const cs_web *web);
  /* Accepts, reads and writes without waiting. Returns the milliseconds after which it must be
   * called again even if nothing is readable: 0 while a request waits to be taken, -1 for ever. */
  int (*run)(cs_web *web);
  /* The next complete request; NULL: there is none. */
  const cs_web_request *(*take)(cs_web *web);
  /* Answers a request that was taken. false: there is no memory, and its connection is closed. */
  bool (*answer)(cs_web *web, uint64_t id, const cs_web_answer *answer);
  cs_web_counts (*counts)(const cs_web *web);
  void (*close)(cs_web *web); /* NULL is ignored */
} cs_web_module;

/* The module's one symbol. */
CELSPAN_API const void *celspan_web_module(void);
